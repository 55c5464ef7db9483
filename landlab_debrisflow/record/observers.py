"""Observers: what watches a run. They are given to `DebrisFlow` and never imported by the model.

An observer has an attribute ``interval`` [s] and a method ``observe(flow)``, called every so many
seconds of the event and once more when the flow comes to rest.
"""

from numbers import Real

import xarray as xr
from rich.console import Console

from ..core.errors import InputError
from .attributes import described
from .datasets import join
from .files import check_writable, write_dataset


class Progress:
    """One line on the terminal that follows the event; nothing where there is no terminal.

    Parameters
    ----------
    interval : float
        Event time between updates [s].
    label : str
        What to put in front of the line.
    console : rich.console.Console, optional
        Where to write; standard error by default, so that a redirected result stays clean.

    Raises
    ------
    InputError
        If the interval is not > 0.
    """

    def __init__(self, interval: float = 1.0, label: str = "debris flow", console: Console | None = None):
        self.interval = _positive(interval, type(self).__name__)
        self._label, self._console = label, console or Console(stderr=True)

    def observe(self, flow) -> None:
        """Show time [s], moving volume [m3] and the largest speed on the grid [m/s]."""
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
    """Keeps `flow.maps` at intervals, as one Dataset over ``time``.

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

    def __init__(self, interval: float, path=None, variables=None):
        self.interval = _positive(interval, type(self).__name__)
        self.path = None if path is None else check_writable(path)
        self._variables = None if variables is None else list(variables)
        self._times, self._maps = [], []

    def observe(self, flow) -> None:
        """Keep the maps of now; write the file if the flow is at rest."""
        maps = flow.maps
        if self._variables is not None:
            if unknown := [name for name in self._variables if name not in maps]:
                raise InputError(f"Snapshots: no field {unknown[0]!r} in the maps; there are {', '.join(maps)}")
            maps = maps[self._variables]
        self._times.append(flow.elapsed_time)
        self._maps.append(maps)
        if self.path is not None and flow.at_rest:
            self.write()

    @property
    def dataset(self) -> xr.Dataset:
        """All snapshots so far over ``time`` [s]; attributes that are not the same for all are left out.

        Raises
        ------
        InputError
            If there is none yet.
        """
        if not self._maps:
            raise InputError("Snapshots: nothing was observed yet; give it to DebrisFlow(observers=[...]) and run")
        # elapsed time has no date to count from, so to CF it is a quantity, no time axis
        time = xr.Variable("time", self._times, described("s", "elapsed time"))
        series, last = join(self._maps, xr.DataArray(time, name="time")), self._maps[-1].attrs
        return series.assign_attrs(number_of_particles=last["number_of_particles"])

    def write(self, path=None):
        """Write the dataset as NetCDF, atomically.

        Parameters
        ----------
        path : str or os.PathLike, optional
            Instead of the one given at the beginning.

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


def _positive(interval, owner: str) -> float:
    if isinstance(interval, bool) or not isinstance(interval, Real) or not 0.0 < interval < float("inf"):
        raise InputError(f"{owner}: interval must be a finite number of seconds > 0, got {interval!r}")
    return float(interval)
