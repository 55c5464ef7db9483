"""Estimate of when a run will end, from how its kinetic energy falls."""

import math
from typing import NamedTuple

HALF = 0.5
"""Fraction of its peak below which the energy must have fallen before its decay is used [-]."""

RECENT = 30.0
"""Wall time over which the pace of a run is averaged [s]."""


class Remaining(NamedTuple):
    """Wall time that a run will still take.

    Attributes
    ----------
    seconds : float
        Wall time [s].
    bound : bool
        Whether this is a bound, by the longest duration, and no estimate.
    """

    seconds: float
    bound: bool


class EndEstimate:
    """Wall time that a run will still take, from its pace and the decay of its kinetic energy.

    Once the energy has fallen below half of its peak, its decay is continued exponentially, at the rate at which it was
    last halved, to the part of the peak at which the flow counts as at rest. Friction stops a flow sooner than an
    exponential decay, creep later: the estimate is right within a factor of about two (`python -m
    benchmarks.forecast`). Before that, and if the energy does not fall, only a bound is known: the longest duration at
    the present pace.

    Parameters
    ----------
    until : float
        Elapsed time at which the run ends in any case [s]; infinite if there is none.
    rest_energy : float
        Kinetic energy over its peak at which the flow counts as at rest [-].

    Examples
    --------
    >>> import math
    >>> estimate = EndEstimate(until=100.0, rest_energy=1e-4)
    >>> for time in range(13):  # 2 s of wall time for each second
    ...     estimate.add(2.0 * time, time, math.exp(-0.5 * time) if time > 5 else 1.0)
    >>> left = estimate.remaining()
    >>> left.bound, abs(left.seconds - 2.0 * (math.log(1e4) / 0.5 - 12.0)) < 1e-9
    (False, True)
    """

    def __init__(self, until: float = math.inf, rest_energy: float = 1e-4):
        self._until, self._rest_energy = until, rest_energy
        self._samples: list[tuple[float, float, float]] = []
        self._peak = 0.0

    def add(self, wall: float, time: float, energy: float) -> None:
        """Add a sample: wall time [s], elapsed time [s], kinetic energy in any unit."""
        self._samples.append((wall, time, energy))
        self._peak = max(self._peak, energy)

    def remaining(self) -> Remaining | None:
        """Return the wall time left, or None if nothing is known."""
        if not self._samples or not (pace := self._pace()):
            return None
        _, time, energy = self._samples[-1]
        bound = self._until - time
        rate = self._decay_rate()
        if rate > 0.0:
            left = max(0.0, math.log(energy / (self._rest_energy * self._peak)) / rate) if energy > 0.0 else 0.0
            if left < bound:
                return Remaining(left * pace, bound=False)
        return Remaining(bound * pace, bound=True) if bound < math.inf else None

    def _pace(self) -> float:
        """Return the wall time that a second takes now [-]; 0 if it is not known yet."""
        wall, time, _ = self._samples[-1]
        since = next((s for s in self._samples if s[0] >= wall - RECENT), self._samples[-1])
        return (wall - since[0]) / (time - since[1]) if time > since[1] else 0.0

    def _decay_rate(self) -> float:
        """Return the rate at which the energy was last halved [s-1]; 0 while it is near its peak."""
        _, time, energy = self._samples[-1]
        if not 0.0 < energy < HALF * self._peak:
            return 0.0
        _, before, then = next(s for s in reversed(self._samples) if s[2] >= energy / HALF)
        return math.log(then / energy) / (time - before)
