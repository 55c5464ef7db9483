"""State of a run without its bed, whose arrays belong to the grid (terrain/bed.py)."""

from copy import deepcopy

from .diagnostics import Counters
from .inflow.inflow import Inflow
from .outflow import Outflow
from .particles import Particles
from .phases.exchange import Exchange
from .release.origins import Origins
from .rest import Bodies
from .state_dataset import from_dataset, to_dataset
from .step_control import StepControl
from .stopped import Stopped


class State:
    """State of a run, complete.

    Parameters
    ----------
    particles : Particles
        All particles.
    inflow : Inflow
        Inflow to come.

    Attributes
    ----------
    time : float
        Elapsed time of the event [s].
    outdated : bool
        Whether terrain or particles are new: neighbours and forces must be found again.
    limits : StepLimits or None
        Limits of the next step; None before they were found for the first time.
    control : StepControl
        Choice of the length of steps.
    bodies : Bodies
        Particles connected as neighbours.
    exchange : Exchange
        State of the exchange between grains and water.
    origins : Origins
        Ground of which the particles are made.
    outflow : Outflow
        Volumes that have left [m3].
    settled_solid : float
        Grains laid into the bed so far [m3].
    stopped : Stopped
    counters : Counters
        Counts of the run.
    """

    def __init__(self, particles: Particles, inflow: Inflow):
        self.particles, self.inflow = particles, inflow
        self.time, self.outdated, self.limits = 0.0, True, None
        self.control, self.bodies, self.exchange = StepControl(), Bodies(), Exchange()
        self.origins, self.outflow, self.settled_solid, self.stopped = Origins(), Outflow(), 0.0, Stopped()
        self.counters = Counters()

    def copy(self) -> "State":
        """Return an independent copy of particles, accounts and time."""
        other = object.__new__(State)
        vars(other).update({name: _copied(value) for name, value in vars(self).items()})
        return other

    def to_dataset(self):
        """Return the state as an xarray Dataset, without the CPU time it took; `from_dataset` reads it."""
        return to_dataset(self)

    def from_dataset(self, dataset) -> "State":
        """Return the state that `to_dataset` wrote, of a run with the setup of this one, which is not changed.

        Raises
        ------
        InputError
            If the dataset lacks a variable that particles of this setup have.
        """
        return from_dataset(dataset, self)


def _copied(value):
    """Return an independent copy of a part of the state, by its own method if it has one."""
    return deepcopy(value) if isinstance(value, dict | list) or not hasattr(value, "copy") else value.copy()
