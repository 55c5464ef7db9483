"""The state of a run: all that changes in it but the bed, which has its arrays from others (terrain/bed.py)."""

from .diagnostics import Counters
from .inflow.source import Inflow
from .outflow import Outflow
from .particles import Particles
from .phases.exchange import Exchange
from .release.origins import Origins
from .rest import Bodies
from .step_control import StepControl
from .stopped import Stopped
from .time_step import StepLimits


class State:
    """All that a run is made of.

    Parameters
    ----------
    particles : Particles
    inflow : Inflow

    Attributes
    ----------
    time : float
        [s]
    outdated : bool
        Whether terrain or particles are new: neighbours and forces must be found again.
    limits : StepLimits or None
        What limits the next step; None before particles were looked at for the first time.
    control : StepControl
    bodies : Bodies
    exchange : Exchange
    origins : Origins
    outflow : Outflow
    settled_solid : float
        Grains laid into the bed so far [m3].
    stopped : Stopped
    counters : Counters
    """

    def __init__(self, particles: Particles, inflow: Inflow):
        self.particles, self.inflow = particles, inflow
        self.time, self.outdated, self.limits = 0.0, True, None
        self.control, self.bodies, self.exchange = StepControl(), Bodies(), Exchange()
        self.origins, self.outflow, self.settled_solid, self.stopped = Origins(), Outflow(), 0.0, Stopped()
        self.counters = Counters()

    def copy(self) -> "State":
        """Return an independent copy."""
        other = object.__new__(State)
        vars(other).update({name: _copied(value) for name, value in vars(self).items()})
        return other


def _copied(value):
    """Return a copy of a part of the state; numbers and tuples are never changed."""
    return value if value is None or isinstance(value, bool | float | StepLimits) else value.copy()
