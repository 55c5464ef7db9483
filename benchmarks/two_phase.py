"""Two phases of the engine against the converged finite-volume reference: ``python -m benchmarks.two_phase``.

The cases of `validation.cases.two_phase` that tell drag, friction and buoyancy apart, each in a strip of twelve
particles between closed walls, so that errors fall like 1/N where they are of first order in the spacing. Relative L1
errors at the particles of each phase, weighted with the area A = V/h of its own thickness h:

    sum A |h - h_e| / sum A h_e,   sum A |h v - h_e v_e| / sum A |h_e v_e|,

the reference at 2000 cells taken linearly between their centres. Also writes docs/two_phase.png.
"""

import argparse
import math
import time as clock
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np

from landlab_debrisflow.physics.contracts import WATER
from validation.cases.planes import plane
from validation.cases.two_phase import CASES
from validation.hooks import counting_steps

ACROSS = 12  # particles of each phase
CELLS = 2000  # of the reference
COUNTS = (500, 2000, 8000)
PHASES = ("solid", "water")


@dataclass(frozen=True)
class Place:
    """Where a case lies along the plane: of the raster, of the release, and of what is measured [m]."""

    raster: tuple
    release: tuple
    measured: tuple = (-math.inf, math.inf)
    depth: float = 1.0
    parabolic: bool = True

    def thickness(self, s):
        """Return the slope-normal thickness released [m]."""
        first, last = self.release
        inside = (s > first) & (s < last)
        shape = 1.0 - ((2.0 * s - first - last) / (last - first)) ** 2 if self.parabolic else 1.0
        return np.where(inside, self.depth * shape, 0.0)


PLACES = {
    "cap": Place((-13.0, 27.0), (-5.0, 5.0)),
    "collapse": Place((-19.0, 19.0), (-3.0, 3.0), depth=1.5),
    # as long as what comes from its rear end takes to get where the rarefaction of the dam has not been
    "tight_friction": Place((-22.0, 19.0), (-14.0, 0.0), (-4.0, math.inf), parabolic=False),
}


def keywords(mixture, column="none", **material):
    """Return the keywords of a flow of a `Mixture` of the reference."""
    law = {"law": "two_phase", "drag": mixture.drag}
    if mixture.drag == "darcy":
        law["hydraulic_conductivity"] = mixture.conductivity
    else:
        law |= {"terminal_velocity": mixture.terminal_velocity, "drag_exponent": mixture.exponent}
    return {
        "flow": law, "column": column, "material": material,
        "friction": {"law": "coulomb", "basal_friction_angle": math.degrees(mixture.friction_angle)},
    }  # fmt: skip


def strip(name, count, threads=1, **changed):
    """Put a case on its plane: `count` particles of each phase; `changed` are keywords of DebrisFlow.

    Returns
    -------
    DebrisFlow
        Placed, at rest; map x = s cos(theta).
    """
    case, where = CASES[name], PLACES[name]
    spacing = ACROSS * (where.release[1] - where.release[0]) / count
    first = math.floor(where.raster[0] / spacing) - 0.5  # ends of the release lie between nodes
    last = math.ceil(where.raster[1] / spacing) + 0.5
    edge = 0.5 * (ACROSS + 1)
    extent = tuple(spacing * n for n in (first, last, -edge, edge))
    return plane(
        extent, spacing, case.slope, lambda s, y: where.thickness(s) * (abs(y) < (edge - 0.75) * spacing), 0.0, count,
        walls=True, threads=threads, saturated=keywords(case.mixture) | changed,
    )  # fmt: skip


@lru_cache(maxsize=8)
def reference(name):
    """Return the reference of a case at its end."""
    case = CASES[name]
    return case.run(CELLS, [case.time])


def profile(flow, phase):
    """Return s, own thickness, velocity down the plane and volume of the particles of a phase [m, m, m/s, m3]."""
    p = flow._simulation.particles
    own = (p.phase == WATER) == (phase == "water")
    cosine = (p.thickness / p.depth)[own]
    velocity = np.sign(p.velocity[0, own]) * np.hypot(p.velocity[0, own], p.velocity[2, own])
    return p.x[own] / cosine + flow.grid.x_of_node[0] / cosine, p.own_thickness[own], velocity, p.volume[own]


def errors(flow, name):
    """Return the relative L1 errors of h_s, h_w, h_s v_s and h_w v_w [-]."""
    found, measured = reference(name), PLACES[name].measured
    of_depth, of_momentum = [], []
    for phase in PHASES:
        s, h, v, volume = profile(flow, phase)
        here = (s > measured[0]) & (s < measured[1])
        s, h, v, area = s[here], h[here], v[here], (volume / h)[here]
        depth, velocity = (getattr(found, f"{quantity}_{phase[0]}")[-1] for quantity in "hv")
        exact, flux = np.interp(s, found.x, depth), np.interp(s, found.x, depth * velocity)
        of_depth.append(float((area * abs(h - exact)).sum() / (area * exact).sum()))
        of_momentum.append(float((area * abs(h * v - flux)).sum() / (area * abs(flux)).sum()))
    return (*of_depth, *of_momentum)


def run(name, count, **changed):
    """Run a case to its end; return the flow, CPU time [s] and steps."""
    flow = strip(name, count, **changed)
    with counting_steps() as counted:
        start = clock.process_time()
        flow.run_one_step(CASES[name].time - flow.elapsed_time)
        return flow, clock.process_time() - start, counted[0]


def draw(flows, path) -> None:
    """Draw depths and velocities of both phases: particles over the reference."""
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(len(flows), 2, figsize=(10.0, 3.2 * len(flows)), layout="constrained", squeeze=False)
    for (name, flow), row in zip(flows.items(), axes, strict=True):
        found = reference(name)
        for phase, colour in zip(PHASES, ("#a0522d", "#1f77b4"), strict=True):
            s, h, v, _ = profile(flow, phase)
            depth, velocity = (getattr(found, f"{quantity}_{phase[0]}")[-1] for quantity in "hv")
            wet = depth > 1e-3
            for axis, at_particles, exact in ((row[0], h, depth), (row[1], v, velocity)):
                axis.plot(s, at_particles, ".", color=colour, markersize=2, alpha=0.4, rasterized=True)
                axis.plot(found.x[wet], exact[wet], color=colour, linewidth=1.2, label=phase)
        for axis, label in zip(row, ("thickness of the phase [m]", "velocity down the plane [m/s]"), strict=True):
            axis.set(xlabel="distance down the plane [m]", ylabel=label)
            axis.set_title(f"{name}, {CASES[name].time:g} s, {s.size} particles of each phase", fontsize=9)
        row[0].legend(title="lines: finite volumes", fontsize=8, title_fontsize=8)
    figure.savefig(path, dpi=120)


def main(counts=COUNTS) -> None:
    """Print the table and draw the figure."""
    print(f"relative L1 errors against finite volumes of {CELLS} cells; N particles of each phase, {ACROSS} across")
    print(f"{'case':16s}{'N':>6s}{'steps':>7s}{'CPU s':>8s}" +
          "".join(f"{name:>9s}" for name in ("h_s", "h_w", "h_s v_s", "h_w v_w")))  # fmt: skip
    drawn = {}
    for name in PLACES:
        run(name, 100)  # loads or compiles
        for count in counts:
            flow, cpu, steps = run(name, count)
            print(f"{name:16s}{count:6d}{steps:7d}{cpu:8.2f}" + "".join(f"{e:9.4f}" for e in errors(flow, name)),
                  flush=True)  # fmt: skip
            if name != "tight_friction" and count == counts[min(1, len(counts) - 1)]:
                drawn[name] = flow
    draw(drawn, Path(__file__).parents[1] / "docs" / "two_phase.png")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("counts", nargs="*", type=int, default=COUNTS, help="numbers of particles of each phase")
    main(tuple(parser.parse_args().counts))
