"""Constants of plans: how errors follow from pilot runs, and which choices are free.

`ERROR_LAWS` and `FORECAST_RANGE` are fitted to 70 scenes and tested on 130 further ones (`python -m
benchmarks.fidelity`).
"""

from typing import NamedTuple

from ..model.numerics import QUANTITIES

PILOTS = (250, 500, 1000)
"""Particles of the pilot runs, ascending; each twice as many as the one before."""

TOLERANCE, HOLD = 0.05, ("run_out", "speed")
"""Tolerance [-] and quantities of a plan if the user names none."""

MOST_PARTICLES = 8000
"""Most particles of a plan if the user sets no limit."""


class ErrorLaw(NamedTuple):
    """How the error of a quantity follows from pilot runs.

    Attributes
    ----------
    factor : float
        k, error that 95 % of the fitted scenes stay below, over the base of pilot runs [-].
    least : float
        f, added to the product of factor and base [-].
    order : float
        p, power of the number of particles by which it falls [-].
    related : tuple of str
        Quantities of `quantities.UNITS` of whose bases the largest counts.
    reason : str
        Why no plan holds the quantity; empty if it can be held.
    """

    factor: float
    least: float
    order: float
    related: tuple[str, ...]
    reason: str = ""


ERROR_LAWS = {
    "run_out": ErrorLaw(3.2, 0.001, 0.9, ("run_out", "max_speed")),
    "speed": ErrorLaw(2.6, 0.001, 0.7, ("speed", "speed_90", "max_speed")),
    "depth": ErrorLaw(2.7, 0.002, 0.55, ("depth", "max_speed")),
    "area": ErrorLaw(2.2, 0.001, 0.65, ("area", "run_out_95", "deposit")),
    "eroded": ErrorLaw(8.6, 0.005, 0.75, ("eroded",)),
    "pressure": ErrorLaw(
        3.3, 0.001, 0.3, ("pressure", "run_out_95", "speed_90"),
        reason="it rises with the number of particles, where all else has converged",
    ),
    "deposit": ErrorLaw(
        4.5, 0.004, 0.5, ("deposit", "centre", "eroded"),
        reason="it depends on the pore pressure left at the stop; run-out and eroded volume can be held",
    ),
}  # fmt: skip
"""Error laws by quantity, in the order of `QUANTITIES`. The base of one quantity may be small by accident, so the
largest base of several related quantities counts: the set that covered the errors of the fitted scenes with the
smallest stated error."""

assert tuple(ERROR_LAWS) == QUANTITIES

CHANGE_FACTOR = 1.5
"""Error after a run with more particles over the error that Richardson's extrapolation gives from its difference to the
pilot runs [-]; it counts if it exceeds the error stated before the run."""

LEAST_STEP_ORDER = 0.3
"""Least power of the number of particles with which the number of steps grows [-]: with more particles waves limit the
step, even if they did not in the pilot runs."""

FORECAST_RANGE = {1000: (0.9, 1.1), 2000: (0.87, 1.3), 4000: (0.86, 1.6), 8000: (0.8, 1.8)}
"""Forecast over actual cost, 5 and 95 % of scenes, by number of particles [-]."""

NO_PRESSURE_RATIO = 0.0015
"""Largest T_c/T with which columns need not be computed, because they drain fast and neither body nor bed bring
pressure [-]."""

FINE_COLUMN_RATIO, LEVELS, FINE_LEVELS = 30.0, 11, 21
"""T_c/T above which pressure and deposit need more levels; levels below and above it."""

FAST_TOLERANCE = 0.02
"""Least tolerance with which steps may be fast [-]."""

PHASE_RATIO, STIFFNESS = 0.03, 125.0
"""tau (g/h)^(1/2) from which on one phase and two differ [-]; c_v over the relaxation time tau of the velocity between
grains and water, with the default stiffness of the grains [m2 s-2]."""

RASTER_COST, RASTER_COST_RATIO = 0.2, 0.61
"""Largest cost of a run with every second node, over that of the plan and the run to come, with which it is made
without being asked for; its cost over that of a run with all nodes [-]."""

RASTER_PILOTS = (1000, 500)
"""Numbers of particles with which every second node may be examined, the better first."""

NEVER_HELD = {
    "time_to_rest": "a flow ends in a creep whose duration changes by a fifth from one number of particles to the next",
    "deposit_area": "the area of the deposit changes by a sixth; hold area, which the flow reached",
    "max_pressure": "it is that of one node; pressure is the 99 % quantile, which is stated",
    "deposit_thickness": "it changes by a fifth at one node; deposit is its mean by volume, which is stated",
}  # fmt: skip
"""Why quantities that users ask for are refused."""

NOTABLE_OUTFLOW = 0.01
"""Least outflow that a plan mentions, over the volume that an event released, took in and eroded [-]."""
