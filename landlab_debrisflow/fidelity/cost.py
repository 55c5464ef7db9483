"""Cost of a run with more particles: steps and CPU time, from pilot runs that have been made."""

import math
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from .constants import FORECAST_RANGE, LEAST_STEP_ORDER


class Cost(NamedTuple):
    """Cost of a run.

    Attributes
    ----------
    steps : float
        Number of time steps.
    seconds : float
        CPU time [s].
    """

    steps: float
    seconds: float

    def between(self, count: int) -> tuple[float, float]:
        """Return the CPU times between which 90 % of the runs with `count` particles lie [s].

        Parameters
        ----------
        count : int
            Number of particles.

        Returns
        -------
        tuple of float
            Least and most [s].
        """
        known = min(FORECAST_RANGE, key=lambda number: abs(math.log(number / count)))
        low, high = FORECAST_RANGE[known]
        return self.seconds / high, self.seconds / low


def forecast_cost(costs: Mapping[int, Cost], count: int) -> Cost:
    """Forecast steps and CPU time [s] with another number of particles.

    The number of steps grows with a power of that of particles, `constants.LEAST_STEP_ORDER` at least; the time of a
    step is linear in it.

    Parameters
    ----------
    costs : mapping of int to Cost
        Costs of pilot runs by number of particles; one whose CPU time is not known has NaN.
    count : int
        Number of particles of the run.

    Returns
    -------
    Cost

    Examples
    --------
    >>> costs = {250: Cost(100.0, 0.2), 500: Cost(200.0, 0.6), 1000: Cost(400.0, 2.0)}
    >>> forecast_cost(costs, 2000)  # 800 steps of (1 + 2000/250) ms
    Cost(steps=800.0, seconds=7.2)
    """
    finest = max(costs)
    steps = costs[finest].steps * (count / finest) ** max(_power(costs), LEAST_STEP_ORDER)
    return Cost(round(steps, 6), round(steps * _step_seconds(costs, count), 9))


def _power(costs: Mapping[int, Cost]) -> float:
    """Return the power of the number of particles by which the number of steps grows."""
    known = [(math.log(count), math.log(cost.steps)) for count, cost in costs.items() if cost.steps > 0.0]
    counts, steps = np.transpose(known) if known else (np.zeros(0), np.zeros(0))
    return float(np.polyfit(counts, steps, 1)[0]) if len(known) > 1 else 0.0


def _step_seconds(costs: Mapping[int, Cost], count: int) -> float:
    """Return the CPU time of a step [s] on a line, which does not fall, through pilot runs."""
    known = {number: cost.seconds / cost.steps for number, cost in costs.items() if cost.steps and cost.seconds >= 0.0}
    if not known:
        return math.nan
    finest = max(known)
    slope = float(np.polyfit(np.array(list(known)), np.array(list(known.values())), 1)[0]) if len(known) > 1 else 0.0
    steepest = known[finest] / finest  # no time at all without particles
    return known[finest] + min(max(slope, 0.0), steepest) * (count - finest)
