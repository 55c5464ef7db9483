"""Observers that follow the particles step by step and have no need of the fields of the grid."""

from abc import ABC, abstractmethod
from collections.abc import Mapping
from typing import Any

import numpy as np

from ..core.errors import InputError
from ..model.schedule import due_after_step
from .observers import check_interval


class TimeRows:
    """Rows of values against time, each of the same names and shapes.

    Examples
    --------
    >>> rows = TimeRows()
    >>> rows.add(1.0, depth=np.array([0.5, 0.0]))
    >>> rows.add(2.0, depth=np.array([0.7, 0.1]))
    >>> rows.forget_after(1.5)
    >>> rows.arrays()
    {'time': array([1.]), 'depth': array([[0.5, 0. ]])}
    """

    def __init__(self) -> None:
        self._times: list[float] = []
        self._rows: list[dict[str, np.ndarray]] = []

    def __len__(self) -> int:
        return len(self._times)

    @property
    def last_time(self) -> float:
        """Time of the last row [s], minus infinity before the first one."""
        return self._times[-1] if self._times else -np.inf

    def add(self, time: float, **values: Any) -> None:
        """Add a row at a time [s], in place of one at the same time and of later ones."""
        self.forget_after(np.nextafter(time, -np.inf))
        self._times.append(float(time))
        self._rows.append({name: np.array(value) for name, value in values.items()})

    def forget_after(self, time: float) -> None:
        """Forget the rows later than a time [s], made in a call that was undone."""
        while self._times and self._times[-1] > time:
            self._times.pop()
            self._rows.pop()

    def arrays(self) -> dict[str, np.ndarray]:
        """Return times [s], and the values stacked over time, by name."""
        names = self._rows[0] if self._rows else ()
        return {"time": np.array(self._times)} | {name: np.stack([row[name] for row in self._rows]) for name in names}

    def restore(self, state: Mapping[str, Any]) -> None:
        """Put back the times [s] and values that `arrays` returned; further entries of the mapping are left out."""
        self._times = np.ravel(state["time"]).tolist()
        stacked = {name: np.asarray(values) for name, values in state.items() if name != "time"}
        names = [name for name, values in stacked.items() if values.ndim and len(values) == len(self._times)]
        self._rows = [{name: stacked[name][k] for name in names} for k in range(len(self._times))]


class Follower(ABC):
    """Base of observers that follow the particles and need no fields of the grid.

    A subclass has a method ``sample(particles, time)``, called at the beginning, after every step that crosses a
    multiple of the interval, and when the flow comes to rest.

    Parameters
    ----------
    interval : float
        Event time between samples [s].

    Raises
    ------
    InputError
        If the interval is not > 0.
    """

    interval = np.inf
    """The grid need not be shown to the observer, except at rest."""

    def __init__(self, interval: float) -> None:
        self.sampling_interval = check_interval(interval, type(self).__name__)
        self._rows = TimeRows()
        self._lower_left = np.zeros(2)
        self._particles: Any = None

    def prepare(self, grid: Any, setup: Any) -> None:
        """Note the place of the grid on the map.

        Parameters
        ----------
        grid : RasterModelGrid
            Grid of the component.
        setup : Setup
            Laws, material, numerics and inflow.
        """
        self._lower_left = np.array(grid.xy_of_lower_left, float)

    def follow(self, particles: Any, began: float, time: float) -> None:
        """Sample the particles if the step crossed a multiple of the interval.

        Parameters
        ----------
        particles : Particles
            The particles now; x and y are from the lower left node [m].
        began, time : float
            Beginning and end of the step [s]; equal before the first step of a call.
        """
        self._particles = particles
        if began == time:
            self._rows.forget_after(time)
            due = not len(self._rows)
        else:
            due = bool(due_after_step([_Clock(self.sampling_interval)], began, time))
        if due and particles.count:
            self.sample(particles, time)

    def observe(self, flow: Any) -> None:
        """Sample the flow at rest.

        Parameters
        ----------
        flow : DebrisFlow
            The component after a step.
        """
        if self._particles is not None and self._particles.count and self._rows.last_time < flow.elapsed_time:
            self.sample(self._particles, flow.elapsed_time)

    @abstractmethod
    def sample(self, particles: Any, time: float) -> None:
        """Add a row of values.

        Parameters
        ----------
        particles : Particles
            The particles now, at least one.
        time : float
            Elapsed time [s].
        """

    def state(self) -> dict[str, Any]:
        """Return the rows so far by name, for a checkpoint."""
        return self._rows.arrays()

    def restore(self, state: Mapping[str, Any]) -> None:
        """Go on after the rows of a checkpoint.

        Parameters
        ----------
        state : mapping
            As `state` returned it.
        """
        self._rows.restore(state)


class _Clock:
    def __init__(self, interval):
        self.interval = interval


def check_same_names(owner: str, state: Mapping[str, Any], names: Any) -> None:
    """Refuse the state of an observer that watched other places.

    Parameters
    ----------
    owner : str
        Name of the observer, for the message.
    state : mapping
        With the names, one a line, as ``names``.
    names : iterable of str
        Names of the places of this observer.

    Raises
    ------
    InputError
        If the names of the places differ, or their order.
    """
    if (then := str(state["names"]).split("\n")) != (now := list(names)):
        raise InputError(
            f"{owner}: the checkpoint has {', '.join(then)}, here are {', '.join(now)}; give those of the checkpoint"
        )
