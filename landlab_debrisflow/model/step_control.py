"""Step control: length of the next step within the limits of stability."""

import math

FASTER = 1.5
"""Largest ratio of a step to the one before: thrust and pore pressure begin to change with the square root of time."""

FIRST = 1.0 / 64.0
"""First step after a release over the one that would be stable."""

TO_STOP = 0.25
"""Largest step over the time in which the flow would stop at its present deceleration: the time of rest is resolved to
this fraction."""

SLOWEST = 1.0 / 16.0
"""Least step for this reason, over the stable one: a flow that oscillates turns round and does not stop."""


class StepControl:
    """Length of steps while the flow starts and stops.

    Attributes
    ----------
    step, speed : float
        The last step [s], and the root of the energy of the flow at the beginning of this step [m5/2 s-1].
    """

    def __init__(self):
        self.step = self.speed = math.inf

    def copy(self) -> "StepControl":
        """Return an independent copy."""
        other = StepControl()
        other.step, other.speed = self.step, self.speed
        return other

    def restart(self) -> None:
        """Restart from short steps, because a new release or inflow begins to move."""
        self.step = 0.0

    def longest(self, stable: float, energy: float) -> float:
        """Return how long the next step may be [s].

        Parameters
        ----------
        stable : float
            Longest step that stability and resolution allow [s].
        energy : float
            Energy of the flow now [m5 s-2].

        Examples
        --------
        >>> control = StepControl()
        >>> control.restart()
        >>> control.longest(0.64, 1.0), control.longest(0.64, 1.0)
        (0.01, 0.015)
        >>> control = StepControl()
        >>> control.longest(0.1, 1.0), control.longest(0.1, 0.64)  # a fifth of the speed lost in 0.1 s
        (0.1, 0.1)
        """
        speed, before, step = math.sqrt(energy), self.speed, self.step
        allowed = min(stable, max(FASTER * step, FIRST * stable))
        if speed < before < math.inf:
            allowed = min(allowed, max(TO_STOP * step * speed / (before - speed), SLOWEST * stable))
        self.step, self.speed = allowed, speed
        return float(allowed)
