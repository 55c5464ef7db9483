"""Two phases of the engine against the converged finite-volume reference.

The cases of `validation.cases.two_phase` that tell drag, friction and buoyancy apart, each in a strip of twelve
particles between closed walls, so that errors fall like 1/N where they are of first order in the spacing. Relative L1
errors at the particles of each phase, weighted with the area A = V/h of its own thickness h (`validation.measure`); the
reference at 2000 cells taken linearly between their centres.
"""

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from landlab_debrisflow.physics.contracts import WATER
from validation.cases.planes import plane
from validation.cases.two_phase import CASES
from validation.measure import advance, norms

ACROSS = 12  # particles of each phase
CELLS = 2000  # of the reference
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
        of_depth.append(norms(area, h, np.interp(s, found.x, depth)).l1)
        of_momentum.append(norms(area, h * v, np.interp(s, found.x, depth * velocity)).l1)
    return (*of_depth, *of_momentum)


def run(name, count, **changed):
    """Run a case to its end; return the flow, CPU time [s] and steps."""
    flow = strip(name, count, **changed)
    return flow, *advance(flow, CASES[name].time)
