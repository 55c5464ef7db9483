"""The rivals on the cases of the flow suite: fixed smoothing length, and a plain finite-volume scheme.

Finite volumes run on the same plane or basin, to the same time, and are measured in the same part with the same
norms, at the centres of cells. One-dimensional cases take one row of cells.
"""

import math

import numpy as np

from landlab_debrisflow.exact import flows
from validation.cases import basins, dam_breaks, planes
from validation.measure import Result, norms
from validation.rivals import finite_volume
from validation.rivals.fixed_length import fixed_smoothing_length

G = 9.81


def fixed(case, *arguments, **keywords) -> Result:
    """Run a case of ours with smoothing lengths as released and without the terms of their gradient."""
    with fixed_smoothing_length():
        result = case(*arguments, **keywords)
    result.method = "fixed length"
    return result


def _volumes(name, x, y, spacing, time, solution, slope=0.0, friction=0.0, bed=None, inside=None, frame=0.0, rows=1):
    """Run finite volumes from ``solution(x, y, 0)`` and compare with it; `rows` multiplies the cost of one row."""

    def state(t):
        h, u, v = np.broadcast_arrays(*solution(x, y, t))
        return h, h * u, h * v

    keywords = {
        "gravity_normal": G * math.cos(slope),
        "gravity_along": (G * math.sin(slope), 0.0),
        "friction": friction,
    }
    if bed is not None:
        keywords["bed"] = bed
    finite_volume.solve(*state(0.0), spacing, 0.0, **keywords)  # loads or compiles
    found = finite_volume.solve(*state(0.0), spacing, time, **keywords)
    here = np.ones(x.shape, bool) if inside is None else inside(x, y)
    h, hu, hv = (q[here] for q in state(time))
    ours = np.stack([found.hu[here] - frame * found.h[here], found.hv[here]])
    errors = norms(1.0, found.h[here], h), norms(1.0, ours, np.stack([hu - frame * h, hv]))
    cells = x.size * rows
    return Result(name, "finite volume", x.shape[1], cells, found.steps, found.cpu * rows, *errors, {})


def dam_break(name, count) -> Result:
    """Ritter, Stoker or Mangeney with `count` cells per 100 m; cost of the twelve rows of the measured strip."""
    slope, friction = (math.radians(22.0), math.tan(math.radians(15.0))) if name == "Mangeney" else (0.0, 0.0)
    celerity = math.sqrt(G * math.cos(slope))
    away = planes.TRAVEL * 100.0
    time = away / celerity
    drift = 0.5 * G * math.cos(slope) * (math.tan(slope) - friction) * time**2
    solutions = {
        "Ritter": lambda x, t: flows.ritter(x, t),
        "Stoker": lambda x, t: flows.stoker(x, t),
        "Mangeney": lambda x, t: flows.mangeney(x, t, 1.0, slope, friction),
    }

    def solution(x, y, t):
        h, u = solutions[name](x, max(t, 1e-12))
        return h, u, 0.0 * h

    cells = round((1.6 * away + 2.3 * away + drift) * count / 100.0)
    x = (np.arange(cells) + 0.5) * 100.0 / count - round(1.6 * away * count / 100.0) * 100.0 / count
    most = 1.5 * away * 0.8 if name == "Stoker" else np.inf
    x = x[None, :]
    return _volumes(name, x, 0.0 * x, 100.0 / count, time, solution, slope, friction,
                    inside=lambda x, y: (x > drift - 1.1 * away) & (x < most), rows=2 * planes.HALF_STRIP)  # fmt: skip


def _square(west, east, half, count):
    spacing = (east - west) / count
    rows = 2 * round(half / spacing)
    return *np.meshgrid(
        west + spacing * (np.arange(count) + 0.5), spacing * (np.arange(rows) + 0.5 - rows / 2)
    ), spacing


def cap(count, degrees=30.0) -> Result:
    """The circular cap; velocities relative to its centre."""
    slope, time = math.radians(degrees), 5.0
    run = 0.5 * G * math.sin(slope) * time**2
    x, y, spacing = _square(-15.0, run + 25.0, 25.0, count)
    return _volumes(f"cap {degrees:g} deg", x, y, spacing, time, lambda x, y, t: flows.cap(x, y, t, slope=slope), slope,
                    frame=G * math.sin(slope) * time)  # fmt: skip


def similarity(count) -> Result:
    """AvaFrame's similarity solution."""
    x, y, spacing = _square(-100.0, 140.0, 100.0, count)
    friction = math.tan(math.radians(25.0))
    return _volumes("similarity", x, y, spacing, 5.0, flows.similarity, math.radians(35.0), friction)


def slope_dam_break(count) -> Result:
    """The dam break on 22 degrees with friction 21, `count` cells per 34 m; cost of twelve rows."""
    slope, friction = math.radians(22.0), math.tan(math.radians(21.0))

    def solution(x, y, t):
        h, u = flows.mangeney(x, max(t, 1e-12), 1.0, slope, friction)
        return h, u, 0.0 * h

    d = 34.0 / count
    x = ((np.arange(round(62.0 / d)) + 0.5) * d - round(24.0 / d) * d)[None, :]
    return _volumes("dam break 22/21", x, 0.0 * x, d, 5.0, solution, slope, friction,
                    inside=lambda x, y: x > -16.0, rows=2 * planes.HALF_STRIP)  # fmt: skip


def thacker(name, count) -> Result:
    """One of Thacker's basins, 1000 m by 1 m, to the time of ours."""
    planar = name == "Thacker planar"
    period = (flows.thacker_planar_period if planar else flows.thacker_curved_period)(basins.RADIUS)
    half = 1.6 * basins.RADIUS if planar else 1.2 * basins.RADIUS
    x, y, spacing = _square(-half, half, half, count)

    def solution(x, y, t):
        if planar:
            return flows.thacker_planar(x, y, t, basins.RADIUS, orbit=(basins.SWING, 0.0))
        return flows.thacker_curved(x, y, t, basins.RADIUS, first_radius=0.8 * basins.RADIUS)

    return _volumes(name, x, y, spacing, 2.25 * period, solution, bed=flows.basin(x, y, basins.RADIUS))


def circular_dam(count, ahead) -> Result:
    """The circular dam break."""
    x, y, spacing = _square(-25.0, 25.0, 25.0, count)

    def solution(x, y, t):
        return dam_breaks.circular_dam_break(x, y, t, depth_ahead=ahead)

    name = f"circular dam, {'wet' if ahead else 'dry'}"
    return _volumes(name, x, y, spacing, 2.0, solution, inside=lambda x, y: np.hypot(x, y) < 25.0)
