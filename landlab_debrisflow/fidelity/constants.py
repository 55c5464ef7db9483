"""Constants of plans: how errors follow from pilot runs, and which choices are free.

Those of `ERROR_LAWS` and `FORECAST_RANGE` are fitted to scenes and tested on others (`python -m benchmarks.fidelity`).
"""

from typing import NamedTuple

from ..model.numerics import QUANTITIES

PILOTS = (250, 500, 1000)
"""Particles of the pilot runs, ascending; each twice as many as the one before."""

TOLERANCE, HOLD = 0.05, ("run_out", "speed")
"""Tolerance [-] and quantities of a plan that is asked for none."""

MOST_PARTICLES = 8000
"""Most particles of a plan that is given no other limit."""


class ErrorLaw(NamedTuple):
    """How the error of a quantity follows from pilot runs.

    Attributes
    ----------
    factor : float
        k, error that 95 % of scenes stay below, over the base of pilot runs [-].
    least : float
        f, what is added to it [-].
    order : float
        p, power of the number of particles by which it falls [-].
    related : tuple of str
        Quantities of `quantities.UNITS` of whose bases the largest counts.
    floor : float
        Least error with `FLOOR_COUNT` particles, which falls with the root of the number [-].
    reason : str
        Why no plan holds the quantity; empty if it can be held.
    """

    factor: float
    least: float
    order: float
    related: tuple[str, ...]
    floor: float = 0.0
    reason: str = ""


FLOOR_COUNT = 2000
"""Particles with which an error is at least its floor."""

ERROR_LAWS = {
    "run_out": ErrorLaw(3.0, 0.002, 0.7, ("run_out", "run_out_95", "centre")),
    "speed": ErrorLaw(3.0, 0.002, 0.8, ("speed", "speed_90", "max_speed")),
    "depth": ErrorLaw(2.0, 0.004, 0.7, ("depth", "mean_depth")),
    "area": ErrorLaw(3.0, 0.004, 0.9, ("area",), floor=0.06),
    "eroded": ErrorLaw(6.0, 0.005, 0.7, ("eroded",)),
    "pressure": ErrorLaw(
        4.0, 0.005, 0.6, ("pressure",),
        reason="it rises with the number of particles, where all else has converged",
    ),
    "deposit": ErrorLaw(
        7.0, 0.008, 0.7, ("deposit",),
        reason="it hangs on the pore pressure left at the stop; run-out and eroded volume can be held",
    ),
}  # fmt: skip
"""By quantity, in the order of `QUANTITIES`. The volume eroded has no related quantity, and so the factor of a run-out
without related ones."""

assert tuple(ERROR_LAWS) == QUANTITIES

AFTER_OLD, AFTER_NEW = 0.5, 2.0
"""Parts that the error before, and the change since, have in the error after a run with more particles [-]."""

LEAST_STEP_ORDER = 0.3
"""Least power of the number of particles by which the number of steps grows [-]: waves limit it later, if not in the
pilot runs."""

FORECAST_RANGE = {1000: (0.9, 1.1), 2000: (0.87, 1.3), 4000: (0.86, 1.6), 8000: (0.8, 1.8)}
"""Forecast over actual cost, 5 and 95 % of scenes, by number of particles [-]."""

NO_PRESSURE_RATIO = 0.0015
"""T_c/T up to which columns drain so fast that they need not be computed, where neither body nor bed bring pressure."""

FINE_COLUMN_RATIO, LEVELS, FINE_LEVELS = 30.0, 11, 21
"""T_c/T above which pressure and deposit need more levels; levels below and above it."""

FAST_TOLERANCE = 0.02
"""Least tolerance with which steps may be fast [-]."""

PHASE_RATIO, STIFFNESS = 0.03, 125.0
"""tau (g/h)^(1/2) from which on one phase and two differ [-]; c_v over the relaxation time tau of the velocity between
grains and water, with the default stiffness of the grains [m2 s-2]."""

RASTER_COST, RASTER_COST_RATIO = 0.2, 0.61
"""Largest cost of a run with every second node over the cost of the plan and the run to come, at which it is made
unasked; its cost over that with all nodes [-]."""

RASTER_PILOTS = (1000, 500)
"""Numbers of particles with which every second node may be examined, the better first."""

NEVER_HELD = {
    "time_to_rest": "a flow ends in a creep whose duration changes by a fifth from one number of particles to the next",
    "deposit_area": "it is the area of what lies there, which changes by a sixth; hold area, where the flow came",
    "max_pressure": "it is that of one node; pressure is the 99 % quantile, which is stated",
    "deposit_thickness": "it changes by a fifth at one node; deposit is its mean by volume, which is stated",
}  # fmt: skip
"""Why quantities that users ask for are refused."""

NOTABLE_OUTFLOW = 0.01
"""Least outflow of which a plan tells, over the volume that an event released, took in and eroded [-]."""
