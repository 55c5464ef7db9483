"""Error of the raster: how much a pilot run changes when it has every second node only."""

import math
from collections.abc import Callable, Mapping
from typing import NamedTuple

from ..core.errors import InputError, SimulationError
from ..scene.setup import Setup
from .constants import ERROR_LAWS, RASTER_COST, RASTER_COST_RATIO, RASTER_PILOTS
from .event import Event
from .pilots import MeasuredPilot, measure_pilot

HALF = 0.5
"""Part of the change from twice the spacing that an error of first order leaves [-]."""


class RasterErrors(NamedTuple):
    """Errors of the raster.

    Attributes
    ----------
    errors : dict of str to float
        By quantity [-]; empty if they were not examined.
    words : str
        The run from which the errors come, or why there is none.
    seconds : float
        CPU time [s].
    """

    errors: dict[str, float]
    words: str
    seconds: float = 0.0


def raster_errors(fine: Mapping[str, float], coarse: Mapping[str, float]) -> dict[str, float]:
    """Return the errors of a raster, from quantities with all its nodes and with every second one [-].

    Parameters
    ----------
    fine, coarse : mapping of str to float
        Quantities of two runs with the same number of particles.

    Returns
    -------
    dict of str to float
        Half the change over the value with all nodes, by quantity of `constants.ERROR_LAWS`; NaN if not known.

    Examples
    --------
    >>> fine = dict.fromkeys(ERROR_LAWS, 100.0)
    >>> raster_errors(fine, fine | {"area": 110.0})["area"]
    0.05
    """
    found = {}
    for name in ERROR_LAWS:
        change = HALF * abs(coarse[name] - fine[name])
        found[name] = change / abs(fine[name]) if fine[name] else (0.0 if change == 0.0 else math.nan)
    return found


def examine_raster(
    event: Event, setup: Setup, pilots: Mapping[int, MeasuredPilot], cost: float, wanted: bool | None,
    notify: Callable[[str], None],
) -> RasterErrors:  # fmt: skip
    """Run a pilot with every second node, if it is wanted or cheap, and return the errors of the raster.

    Parameters
    ----------
    event : Event
    setup : Setup
        Setup of the pilot runs.
    pilots : mapping of int to MeasuredPilot
        Pilot runs with all nodes by number of particles.
    cost : float
        CPU time of pilot runs and of the run to come [s].
    wanted : bool or None
        Whether the user asks for the run; None: it is made if it is cheap.
    notify : callable
        Called with a text when the run begins.

    Returns
    -------
    RasterErrors
    """
    costs = {count: RASTER_COST_RATIO * pilots[count].cost.seconds for count in RASTER_PILOTS if count in pilots}
    if wanted is False:
        return RasterErrors({}, "raster not examined: raster=False")
    cheap = [count for count, seconds in costs.items() if seconds <= RASTER_COST * cost]
    if not cheap and not wanted:
        return RasterErrors({}, f"raster not examined: it would cost more than {100.0 * RASTER_COST:g} %; raster=True")
    count = next(iter(costs)) if wanted else cheap[0]
    try:
        coarse = event.coarse()
        notify(f"plan: pilot run with {count} particles and every second node")
        run = measure_pilot(coarse, setup if coarse.setup is event.setup else _with_laws(setup, coarse.setup), count)
    except (InputError, SimulationError) as error:
        return RasterErrors({}, f"raster not examined: {error}")
    errors = raster_errors(pilots[count].quantities, run.quantities)
    words = f"half the change with every second node, from runs with {count} particles"
    return RasterErrors(errors, words, run.cost.seconds)


def _with_laws(setup: Setup, coarse: Setup) -> Setup:
    """Return a setup with the laws of another one, which has parameters for every second node."""
    return Setup(**vars(setup) | {kind: getattr(coarse, kind) for kind in ("flow", "friction", "erosion")})
