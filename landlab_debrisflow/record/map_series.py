"""Maps of a run written as it goes: one small file per time, which holds the part of the grid where flow is or was."""

import os
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from ..core.errors import InputError
from ..core.hints import did_you_mean
from ..grid.fields import OUTPUT_PREFIX
from .attributes import NO_FILL, date_created, file_attributes, quantity_attributes, variable_attributes
from .datasets import FIELDS
from .files import check_directory, write_atomically
from .georeference import georeferenced, grid_mapping_attributes
from .observers import check_interval

SERIES = "depth", "speed", "basal_excess_pore_pressure", "eroded_depth", "deposit_depth"
"""Fields that a series of maps holds unless others are asked for."""

REACHED = "depth", "max_depth", "eroded_depth", "deposit_depth"
"""Fields of which one is above 0 wherever flow is or was."""

PREFIX = "maps"
"""Beginning of the names of files, before the number."""


class MapSeries:
    """Writes maps at intervals, each to a small NetCDF file of its own, numbered from 0.

    A file holds numbers of single precision over the smallest rectangle of nodes that has all flow so far in it, and is
    there as a whole or not at all. Values are 0 where nothing is, also at closed nodes. `combine_maps` makes one file of
    all. Memory does not grow with the number of maps.

    Parameters
    ----------
    interval : float
        Event time between maps [s].
    directory : str or os.PathLike
        Existing directory of the files ``maps_000000.nc`` and so on.
    variables : sequence of str
        Names of output fields, with or without ``debris_flow__``.
    crs : str, optional
        Coordinate reference system of the grid, as WKT or such as ``"EPSG:32633"``.
    replace : bool
        Whether files of an earlier series in the directory may be replaced: they are removed when the first map is
        written. A series that goes on after `restore` keeps the files up to there.

    Raises
    ------
    InputError
        If the interval is not > 0, a variable or the system is not known, or the directory cannot be written to or holds
        a series already.

    Examples
    --------
    >>> MapSeries(10.0, "no such directory")
    Traceback (most recent call last):
        ...
    landlab_debrisflow.core.errors.InputError: cannot write to 'no such directory': it does not exist; create it first \
(mkdir -p) or choose another
    """

    def __init__(
        self, interval: float, directory: str | os.PathLike[str], variables: Sequence[str] = SERIES,
        crs: str | None = None, replace: bool = False,
    ) -> None:  # fmt: skip
        self.interval = check_interval(interval, type(self).__name__)
        self.directory = check_directory(directory)
        self.variables = tuple(_field_name(name) for name in variables)
        if crs is not None:
            grid_mapping_attributes(crs)
        if (old := numbered_files(self.directory)) and not replace:
            raise InputError(
                f"MapSeries: {self.directory} already holds {len(old)} maps of a series, {old[0].name} the first; choose "
                "another directory, or replace=True"
            )
        self._crs = crs
        self._times: list[float] = []
        self._attributes: dict[str, Any] = {}

    def prepare(self, grid: Any, setup: Any) -> None:
        """Note the setup, for the attributes of the files.

        Parameters
        ----------
        grid : RasterModelGrid
            Grid of the component.
        setup : Setup
            Laws, material, numerics and inflow.

        Raises
        ------
        InputError
            If a variable is one that only a flow of two phases has.
        """
        if lacking := [name for name in self.variables if FIELDS[name].optional and not setup.two_phases]:
            raise InputError(f"MapSeries: {lacking[0]} is there in a flow of two phases only; leave it out of variables")
        self._attributes = setup.to_attributes()

    @property
    def files(self) -> list[Path]:
        """Files written so far, in order of time."""
        return [self._path(number) for number in range(len(self._times))]

    def observe(self, flow: Any) -> None:
        """Write the maps of now.

        Parameters
        ----------
        flow : DebrisFlow
            The component after a step.

        Raises
        ------
        OSError
            If the file cannot be written, because the disk is full perhaps; all maps before are there.
        """
        time = flow.elapsed_time
        while self._times and self._times[-1] >= time:  # of a call that was undone
            self._times.pop()
        self._remove_from(len(self._times))
        path = self._path(len(self._times))
        maps = window_dataset(flow.grid, self.variables, time)
        maps = georeferenced(maps.assign_attrs(self._attributes), self._crs)
        encoding = {name: {"zlib": True, "complevel": 1, "_FillValue": None} for name in self.variables}
        write_atomically(path, lambda temporary: maps.to_netcdf(temporary, engine="netcdf4", encoding=encoding))
        self._times.append(time)

    def state(self) -> dict[str, Any]:
        """Return the times of the maps written so far [s], by name, for a checkpoint."""
        return {"times": np.array(self._times)}

    def restore(self, state: Mapping[str, Any]) -> None:
        """Go on after the maps of a checkpoint; later files are removed.

        Parameters
        ----------
        state : mapping
            As `state` returned it.

        Raises
        ------
        InputError
            If a file of an earlier map is missing.
        """
        times = [float(time) for time in np.ravel(state["times"])]
        if missing := [path for k in range(len(times)) if not (path := self._path(k)).is_file()]:
            raise InputError(
                f"MapSeries: {missing[0].name} was written before the checkpoint and is not in {self.directory} any more; "
                "put it back, or start from the beginning"
            )
        self._times = times
        self._remove_from(len(times))

    def _path(self, number: int) -> Path:
        return self.directory / f"{PREFIX}_{number:06d}.nc"

    def _remove_from(self, number: int) -> None:
        """Remove the files with this number and later ones."""
        for path in numbered_files(self.directory):
            if _number(path) >= number:
                path.unlink()


def numbered_files(directory: str | os.PathLike[str]) -> list[Path]:
    """Return the files of a series of maps in a directory, in order of their numbers.

    Parameters
    ----------
    directory : str or os.PathLike
        Where `MapSeries` wrote.

    Returns
    -------
    list of pathlib.Path
    """
    return sorted(path for path in Path(directory).iterdir() if _number(path) is not None)


def window_dataset(grid: Any, variables: Sequence[str], time: float) -> xr.Dataset:
    """Return fields over the smallest rectangle of nodes that has all flow so far in it, as numbers of single precision.

    Parameters
    ----------
    grid : RasterModelGrid
        Grid whose fields show the present.
    variables : sequence of str
        Names of fields.
    time : float
        Elapsed time [s].

    Returns
    -------
    xarray.Dataset
        Over ``y`` and ``x``, map coordinates [m], with a scalar coordinate ``time`` [s]. Attributes tell shape of the
        grid, first row and column of the rectangle.
    """
    rows, columns = wet_window([_over_grid(grid, OUTPUT_PREFIX + name) for name in REACHED])
    coordinates: dict[str, xr.Variable] = {}
    for axis, first, spacing, window in zip(
        "yx", grid.xy_of_lower_left[::-1], (grid.dy, grid.dx), (rows, columns), strict=True
    ):
        words = variable_attributes("m", axis)
        words |= {"standard_name": f"projection_{axis}_coordinate", "axis": axis.upper()}
        coordinates[axis] = xr.Variable(axis, first + spacing * np.arange(window.start, window.stop), words, NO_FILL)
    coordinates["time"] = xr.Variable((), time, variable_attributes("s", "elapsed time"), NO_FILL)
    data = {
        name: (("y", "x"), _over_grid(grid, name)[rows, columns].astype(np.float32), _attributes(name))
        for name in variables
    }
    place = {"grid_rows": grid.shape[0], "grid_columns": grid.shape[1], "row": rows.start, "column": columns.start}
    attributes = file_attributes() | date_created() | quantity_attributes("elapsed_time", time, "s")
    return xr.Dataset(data, coordinates, attributes | {name: int(value) for name, value in place.items()})


def wet_window(fields: Sequence[np.ndarray]) -> tuple[slice, slice]:
    """Return rows and columns of the smallest rectangle that has all values above 0 in it.

    Parameters
    ----------
    fields : sequence of ndarray, shape (rows, columns)
        Depths [m].

    Returns
    -------
    tuple of slice
        The first node if nothing is above 0.

    Examples
    --------
    >>> depth = np.zeros((4, 5))
    >>> depth[1, 2] = depth[2, 4] = 1.0
    >>> wet_window([depth])
    (slice(1, 3, None), slice(2, 5, None))
    """
    wet = fields[0] > 0.0
    for field in fields[1:]:
        wet |= field > 0.0
    spans = []
    for axis in (1, 0):
        places = np.flatnonzero(wet.any(axis=axis))
        spans.append(slice(int(places[0]), int(places[-1]) + 1) if places.size else slice(0, 1))
    return spans[0], spans[1]


def _over_grid(grid, name):
    """Return a field as rows and columns, without a copy."""
    return np.asarray(grid.at_node[name]).reshape(grid.shape)


def _attributes(name):
    return variable_attributes(FIELDS[name].unit, FIELDS[name].doc)


def _field_name(name: str) -> str:
    """Return the whole name of an output field."""
    outputs = [field.name for field in FIELDS.values() if field.intent == "out"]
    short = [each.removeprefix(OUTPUT_PREFIX) for each in outputs]
    if name in short:
        return OUTPUT_PREFIX + name
    if name not in outputs:
        raise InputError(f"MapSeries: no output field {name!r}{did_you_mean(name, short)}; there are {', '.join(short)}")
    return name


def _number(path: Path) -> int | None:
    found = re.fullmatch(PREFIX + r"_(\d{6,})\.nc", path.name)
    return int(found[1]) if found else None
