"""Cases with known solutions on which schemes of depth-averaged flow are compared.

``case.solution(x, y, t)`` returns h, u, v; at ``t = 0`` it is the start. One-dimensional cases have no extent in y.
Releases are about 1 m deep, and no time is a moment at which everything rests, where errors have nothing to be
relative to. ``python -m validation.cases.dam_breaks`` prints errors and costs of finite volumes on all of them.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache, partial

import numpy as np

from landlab_debrisflow.exact import flows
from validation.measure import relative_errors
from validation.rivals import finite_volume


@dataclass(frozen=True)
class Case:
    """A flow and its solution.

    Parameters
    ----------
    name : str
    solution : callable
        ``(x, y, t)`` to h, u, v: exact, or converged.
    time : float
        [s].
    extent : tuple of float
        x from, to, and y from, to in two dimensions: room for the flow until then [m].
    slope : float
        Of the plane, down x [rad].
    friction : float
        Apparent friction coefficient [-].
    bed : callable, optional
        ``(x, y)`` to elevation [m], instead of a plane.
    """

    name: str
    solution: Callable
    time: float
    extent: tuple
    slope: float = 0.0
    friction: float = 0.0
    bed: Callable | None = None

    @property
    def gravity_normal(self) -> float:
        return flows.GRAVITY * math.cos(self.slope)

    @property
    def gravity_along(self) -> tuple[float, float]:
        return flows.GRAVITY * math.sin(self.slope), 0.0

    def cells(self, count: int):
        """Centres x, y and size of the square cells, ``count`` of them along x; y has one row in one dimension."""
        spacing = (self.extent[1] - self.extent[0]) / count
        x = self.extent[0] + spacing * (np.arange(count) + 0.5)
        if len(self.extent) == 2:
            return x[None, :], np.zeros((1, count)), spacing
        rows = round((self.extent[3] - self.extent[2]) / spacing)
        return *np.meshgrid(x, self.extent[2] + spacing * (np.arange(rows) + 0.5)), spacing

    def state(self, x, y, time: float):
        """h, hu, hv at points."""
        h, u, v = np.broadcast_arrays(*self.solution(x, y, time))
        return h, h * u, h * v


def _along(solution, *values):
    """A solution in one dimension as one of x, y and t, without motion across."""

    def three(x, y, t):
        h, u = solution(x, t, *values)
        return h, u, np.zeros_like(h)

    return three


@lru_cache(maxsize=8)
def _radial_dam_break(time, radius, depth, depth_ahead, reach, count):
    """Centres of rings, depth and radial velocity there."""
    r = (np.arange(count) + 0.5) * reach / count
    start = np.where(r < radius, depth, depth_ahead), 0.0 * r, 0.0 * r
    found = finite_volume.solve(*start, reach / count, time, radial=True)
    return r, found.h, np.divide(found.hu, found.h, out=np.zeros(count), where=found.h > 1e-9 * depth)


def circular_dam_break(x, y, time: float, radius: float = 10.0, depth: float = 1.0, depth_ahead: float = 0.0,
                       reach: float = 26.0, count: int = 5200):  # fmt: skip
    """h, u, v of a cylinder of water set free on a flat bed: its equation in r, converged; kept for the session.

    There is no exact solution. Linear between rings of 5 mm; half as many change the L1 norm of h and of hu at 2 s by
    2.4e-4 and 4.2e-4 on a dry bed, by 2.9e-4 and 5.8e-4 on water of 0.1 m. Takes some 2 s of CPU time.
    """
    distance = np.hypot(x, y)
    if time <= 0.0:
        return np.where(distance < radius, depth, depth_ahead), 0.0 * distance, 0.0 * distance
    r, h, u = _radial_dam_break(time, radius, depth, depth_ahead, reach, count)
    outward = np.interp(distance, r, u) / np.maximum(distance, 1e-12)
    return np.interp(distance, r, h), outward * x, outward * y


def _cases():
    r22, r30, r35 = math.radians(22.0), math.radians(30.0), math.radians(35.0)
    tan15, tan25 = math.tan(math.radians(15.0)), math.tan(math.radians(25.0))
    swing = flows.thacker_planar_period()  # 14.2 s
    yield Case("ritter", _along(flows.ritter), 1.0, (-10.0, 10.0))
    yield Case("stoker", _along(flows.stoker), 2.0, (-10.0, 10.0))
    yield Case("mangeney", _along(flows.mangeney, 1.0, r22, tan15), 2.0, (-16.0, 16.0), r22, tan15)
    for name, friction in (("ridge", 0.0), ("ridge_friction", 0.3)):
        yield Case(name, _along(flows.ridge, 10.0, 1.0, r30, friction), 5.0, (-15.0, 90.0), r30, friction)
    yield Case("cap", lambda x, y, t: flows.cap(x, y, t, 10.0, 1.0, r30), 5.0, (-15.0, 90.0, -26.25, 26.25), r30)
    yield Case("similarity", flows.similarity, 5.0, (-100.0, 140.0, -100.0, 100.0), r35, tan25)
    bowl = {"bed": flows.basin}

    def to_and_fro(x, y, t):
        return flows.thacker_planar(x, y, t, orbit=(5.0, 0.0))

    yield Case("thacker_line_1d", to_and_fro, 2.25 * swing, (-16.0, 16.0), **bowl)
    square = (-16.0, 16.0, -16.0, 16.0)
    yield Case("thacker_line", to_and_fro, 2.25 * swing, square, **bowl)
    yield Case("thacker_circle", flows.thacker_planar, 2.0 * swing, square, **bowl)
    yield Case("thacker_curved", flows.thacker_curved, 1.125 * swing, square, **bowl)  # its period is half as long
    for name, ahead in (("circular_dam_wet", 0.1), ("circular_dam_dry", 0.0)):
        yield Case(name, partial(circular_dam_break, depth_ahead=ahead), 2.0, (-25.0, 25.0, -25.0, 25.0))


CASES = {case.name: case for case in _cases()}


def rival_row(case: Case | str, count: int) -> dict:
    """Run a case by finite volumes on ``count`` cells along x.

    Returns
    -------
    dict
        ``case``, ``cells`` in all, ``spacing`` [m], ``steps``, ``cpu`` [s] of the time loop, compilation apart, and
        the relative errors ``L1_h``, ``L2_h``, ``max_h``, ``L1_hu``, ``L2_hu``, ``max_hu``, at the centres of cells.
    """
    case = CASES[case] if isinstance(case, str) else case
    x, y, spacing = case.cells(count)
    keywords = {"gravity_normal": case.gravity_normal, "gravity_along": case.gravity_along, "friction": case.friction}
    if case.bed is not None:
        keywords["bed"] = case.bed(x, y)
    start = case.state(x, y, 0.0)
    finite_volume.solve(*start, spacing, 0.0, **keywords)  # loads or compiles
    found = finite_volume.solve(*start, spacing, case.time, **keywords)
    errors = relative_errors((found.h, found.hu, found.hv), case.state(x, y, case.time))
    return {"case": case.name, "cells": x.size, "spacing": spacing, "steps": found.steps, "cpu": found.cpu, **errors}


COUNTS = {1: (100, 200, 400, 800), 2: (40, 80, 160)}  # along x; 320 takes minutes in the basin
NORMS = ("L1_h", "L2_h", "max_h", "L1_hu", "L2_hu", "max_hu")


def main() -> None:
    """Print errors and costs of finite volumes on all cases."""
    print("relative errors; order: of L1 of h and of hu from the line above")
    print(f"{'case':18s}{'cells':>8s}{'steps':>7s}{'CPU s':>9s}" + "".join(f"{n:>9s}" for n in NORMS) + "   order")
    for case in CASES.values():
        last = None
        for count in COUNTS[len(case.extent) // 2]:
            row = rival_row(case, count)
            text = f"{row['case']:18s}{row['cells']:8d}{row['steps']:7d}{row['cpu']:9.2g}"
            text += "".join(f"{row[norm]:9.1e}" for norm in NORMS)
            if last:
                text += "".join(f"{math.log2(last[norm] / row[norm]):6.2f}" for norm in ("L1_h", "L1_hu"))
            print(text, flush=True)
            last = row


if __name__ == "__main__":
    main()
