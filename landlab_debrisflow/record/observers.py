"""Observers of a run, given to `DebrisFlow` and never imported by the model.

An observer has an attribute ``interval`` [s] and a method ``observe(flow)``, called at the end of every step that
crosses a multiple of the interval, and of the step in which the flow comes to rest. Observers do not influence the
result: steps are as long as without them. So `observe` is called a little after the multiple, and the time of the call
is `flow.elapsed_time`. For a step that crosses several multiples it is called once. With ``interval = EVERY_STEP`` it
is called before the first step of a call and after every step. An observer sees the grid as if the call ended there,
except that nothing settles; it may not run the flow itself.

An observer that raises ends the call after that step, with everything computed kept: call again to go on. The other
observers are still called for this step, and no call is repeated.
"""

import os
from collections.abc import Mapping, Sequence
from numbers import Real
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr

from ..core.checks import require
from ..core.errors import InputError
from ..core.hints import did_you_mean
from ..model.schedule import EVERY_STEP
from .attributes import variable_attributes
from .datasets import stack
from .files import check_writable, write_dataset
from .memories import pack_maps, unpack_maps

__all__ = ["EVERY_STEP", "Progress", "Snapshots", "check_interval"]

if TYPE_CHECKING:
    from rich.console import Console


class Progress:
    """One line on the terminal that follows the event, silent without a terminal.

    Parameters
    ----------
    interval : float
        Event time between updates [s].
    label : str
        Beginning of the line.
    console : rich.console.Console, optional
        Where to write; standard error by default, so that a redirected result stays clean.

    Raises
    ------
    InputError
        If the interval is not > 0.
    """

    def __init__(self, interval: float = 1.0, label: str = "debris flow", console: "Console | None" = None):
        from rich.console import Console  # imported here because loading takes 30 ms

        self.interval = check_interval(interval, type(self).__name__)
        self._label, self._console = label, console or Console(stderr=True)

    def observe(self, flow: Any) -> None:
        """Show time [s], moving volume [m3] and the largest speed on the grid [m/s].

        Parameters
        ----------
        flow : DebrisFlow
            The component after a step.
        """
        if not self._console.is_terminal:
            return
        speed = float(flow.grid.at_node["debris_flow__speed"].max())
        state = "at rest" if flow.at_rest else "moving "
        line = (
            f"{self._label}: {flow.elapsed_time:7.1f} s  {state} {flow.budget['moving']:9.0f} m3  "
            f"fastest {speed:5.1f} m/s"
        )
        self._console.print(line, end="\n" if flow.at_rest else "\r", highlight=False, markup=False)


class Snapshots:
    """Observer that keeps `flow.maps` at intervals, as one Dataset over the ``time`` of the snapshots.

    Parameters
    ----------
    interval : float
        Event time between snapshots [s].
    path : str or os.PathLike, optional
        NetCDF file, written whenever the flow comes to rest and by `write`.
    variables : sequence of str, optional
        Names of the fields to keep; all by default.

    Raises
    ------
    InputError
        If the interval is not > 0, or the file could not be written: before anything is computed.
    """

    def __init__(
        self,
        interval: float,
        path: str | os.PathLike[str] | None = None,
        variables: Sequence[str] | None = None,
    ) -> None:
        self.interval = check_interval(interval, type(self).__name__)
        self.path = None if path is None else check_writable(path)
        self._variables = None if variables is None else list(variables)
        self._times: list[float] = []
        self._maps: list[xr.Dataset] = []

    def observe(self, flow: Any) -> None:
        """Keep the maps of now; write the file if the flow is at rest.

        Parameters
        ----------
        flow : DebrisFlow
            The component after a step.
        """
        maps = flow.maps
        if self._variables is not None:
            if unknown := [name for name in self._variables if name not in maps]:
                hint = did_you_mean(unknown[0], maps)
                raise InputError(f"Snapshots: no field {unknown[0]!r} in the maps{hint}; there are {', '.join(maps)}")
            maps = maps[self._variables]
        self._times.append(flow.elapsed_time)
        self._maps.append(maps)
        if self.path is not None and flow.at_rest:
            try:
                self.write()
            except (OSError, InputError) as failure:
                failure.add_note(
                    "Snapshots: all snapshots are kept; make room and call write(), or write(path) elsewhere"
                )
                raise

    def state(self) -> dict[str, Any]:
        """Return times [s] and maps so far by name, for a checkpoint."""
        return {"times": np.array(self._times)} | pack_maps(self._maps)

    def restore(self, state: Mapping[str, Any]) -> None:
        """Go on after the snapshots of a checkpoint.

        Parameters
        ----------
        state : mapping
            As `state` returned it.
        """
        self._times, self._maps = np.ravel(state["times"]).tolist(), unpack_maps(state)

    @property
    def dataset(self) -> xr.Dataset:
        """All snapshots so far over ``time`` [s], with the attributes that are equal in all of them.

        Raises
        ------
        InputError
            If there is none yet.
        """
        if not self._maps:
            raise InputError("Snapshots: nothing was observed yet; give it to DebrisFlow(observers=[...]) and run")
        # elapsed time counts from no date, so after CF it is a quantity and no time axis
        time = variable_attributes("s", "elapsed time")
        series, last = stack(self._maps, "time", self._times, **time), self._maps[-1].attrs
        return series.assign_attrs(number_of_particles=last["number_of_particles"])

    def write(self, path: str | os.PathLike[str] | None = None) -> Path:
        """Write the dataset as NetCDF, atomically.

        Parameters
        ----------
        path : str or os.PathLike, optional
            Path instead of the one given at the beginning.

        Returns
        -------
        pathlib.Path
            Where it was written.

        Raises
        ------
        InputError
            If no path was given anywhere, or it cannot be written.
        """
        path = self.path if path is None else path
        if path is None:
            raise InputError("Snapshots.write: no path; give one here or as Snapshots(interval, path=...)")
        return write_dataset(path, self.dataset)


def check_interval(interval: object, owner: str) -> float:
    """Return an interval as a number, if it is a finite one > 0 [s].

    Parameters
    ----------
    interval : float
        Interval given by the user [s].
    owner : str
        Name of the observer, for the message.

    Returns
    -------
    float

    Raises
    ------
    InputError
        If it is not.
    """
    number = float(interval) if isinstance(interval, Real) and not isinstance(interval, bool) else 0.0
    good = 0.0 < number < float("inf")
    require(good, f"{owner}: interval", "be a finite number of seconds > 0", interval, error=InputError)
    return number
