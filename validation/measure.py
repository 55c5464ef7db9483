"""How the flow suite runs and measures one case: the same for every case and every method.

Error norms, at the particles inside the measured part, each weighted with its own area A = V/h_n:

    L1  = sum A |h - h_e| / sum A |h_e|,
    L2  = sqrt(sum A (h - h_e)^2 / sum A h_e^2),
    max = max |h - h_e| / max |h_e|,

h the slope-normal thickness [m] and h_e the exact one where the particle is; of hu likewise, with the length
of the vector difference. Where a case passes through rest, hu_e of the denominators is the `scale` the case
names. Node norms are the same over the nodes, h = debris_flow__depth times cos(theta): they also see where no
particle came. Volume off the exact flow counts in the numerators of both.
"""

import time
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np


class Norms(NamedTuple):
    """Relative errors [-]."""

    l1: float
    l2: float
    max: float


@dataclass
class Result:
    """One run of one case by one method."""

    case: str
    method: str  # "ours" until a rival says otherwise
    along: int  # particles (or cells) along the direction that counts
    particles: int
    steps: int
    cpu: float  # of the run without its set-up, one thread [s]
    h: Norms
    hu: Norms
    scalars: dict = field(default_factory=dict)  # case by case; names carry units

    @property
    def rate(self) -> float:
        """Million particle steps per CPU second."""
        return self.particles * self.steps / max(self.cpu, 1e-9) / 1e6


class Body(NamedTuple):
    """The particles as arrays: map position, velocity along the ground, slope-normal thickness, volume."""

    x: np.ndarray
    y: np.ndarray
    velocity: np.ndarray  # (3, n)
    h: np.ndarray
    volume: np.ndarray


def body(flow) -> Body:
    """Read the particles of a flow."""
    p = flow.particles
    velocity = np.stack([p[f"velocity_{axis}"].values for axis in "xyz"])
    return Body(p.x.values, p.y.values, velocity, p.thickness.values, p.volume.values)


def norms(weight, value, exact, scale=None) -> Norms:
    """Compare values with exact ones, shape (n,) or (components, n), see the module's notes."""
    error, size = (np.sqrt(np.sum(np.atleast_2d(a) ** 2, axis=0)) for a in (value - exact, exact))
    size = size if scale is None else np.full_like(size, scale)
    return Norms(
        float(np.sum(weight * error) / np.sum(weight * size)),
        float(np.sqrt(np.sum(weight * error**2) / np.sum(weight * size**2))),
        float(error.max() / size.max()),
    )


def relative_errors(found, exact) -> dict[str, float]:
    """Return `norms` of depth and of momentum by name, at equal weights.

    Parameters
    ----------
    found, exact : tuple of ndarray
        h [m], hu and hv [m2 s-1] at the same points.

    Returns
    -------
    dict
        ``L1_h``, ``L2_h``, ``max_h``, ``L1_hu``, ``L2_hu``, ``max_hu`` [-].
    """
    (h, *momentum), (exact_h, *exact_momentum) = ([np.ravel(q) for q in one] for one in (found, exact))
    pairs = {"h": norms(1.0, h, exact_h), "hu": norms(1.0, np.stack(momentum), np.stack(exact_momentum))}
    return {f"{norm}_{name}": value for name, of in pairs.items()
            for norm, value in zip(("L1", "L2", "max"), of, strict=True)}  # fmt: skip


def advance(flow, duration):
    """Run until `duration` seconds after the release; return CPU time [s] and the number of time steps."""
    steps, start = flow.diagnostics.steps, time.process_time()
    flow.run_one_step(duration - flow.elapsed_time)
    return time.process_time() - start, flow.diagnostics.steps - steps


def energy(flow, gravity=9.81) -> float:
    """Return kinetic energy, that of height and that of thickness, over density [m5 s-2]."""
    b, p = body(flow), flow.particles
    cosine = b.h / p.depth.values
    own = 0.5 * np.sum(b.velocity**2, axis=0) + gravity * p.z.values + 0.5 * gravity * cosine * b.h
    return float(np.sum(b.volume * own))


def momentum(flow):
    """Return the sum of volume times velocity, shape (3,) [m4 s-1], and of volume times speed."""
    b = body(flow)
    return b.velocity @ b.volume, float(np.sum(b.volume * np.linalg.norm(b.velocity, axis=0)))


def compare(case, flow, along, spent, exact, inside=None, scale=None, frame=0.0, scalars=None) -> Result:
    """Compare a flow with ``exact(x, y) -> h, hu (2, n)``; hu along x (on the slope) and y.

    Parameters
    ----------
    spent : tuple
        CPU time and steps, from `advance`.
    inside : callable, optional
        ``inside(x, y)``: the measured part.
    scale : float, optional
        What stands for the exact hu in the denominators [m2 s-1].
    frame : float
        Speed along x of the frame in which `exact` gives hu [m s-1].
    """
    b, depth = body(flow), flow.grid.at_node["debris_flow__depth"]
    cosine = b.h / flow.particles.depth.values
    used = np.ones(b.x.size, bool) if inside is None else inside(b.x, b.y)
    h, hu = exact(b.x, b.y)
    # the length of the velocity on the slope along x: x-component over cos(theta) where the slope is along x
    along_x = np.sign(b.velocity[0]) * np.hypot(b.velocity[0], b.velocity[2])
    area = (b.volume / b.h)[used]
    ours = b.h * np.stack([along_x - frame, b.velocity[1]])
    grid, scalars = flow.grid, dict(scalars or {})
    nodes = grid.core_nodes
    if inside is not None:
        nodes = nodes[inside(grid.x_of_node[nodes], grid.y_of_node[nodes])]
    exact_nodes, _ = exact(grid.x_of_node[nodes], grid.y_of_node[nodes])
    on_nodes = norms(1.0, depth[nodes] * np.median(cosine), exact_nodes)
    scalars["L1 of h on nodes"] = on_nodes.l1
    return Result(
        case, "ours", along, b.x.size, spent[1], spent[0],
        norms(area, b.h[used], h[used]), norms(area, ours[:, used], hu[:, used], scale), scalars,
    )  # fmt: skip
