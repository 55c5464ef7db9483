"""Maps of a run written as it goes: one small file per time, which holds the part of the grid where flow is or was."""

import os
import re
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ..core.errors import InputError
from ..core.hints import did_you_mean
from ..grid.fields import OUTPUT_PREFIX, output_fields
from ..model.map_fields import SOLID_FRACTION
from ..spatial.transfer import WIDEST
from .attributes import axis_attributes, date_created, file_attributes, quantity_attributes, variable_attributes
from .classic import classic_file
from .datasets import FIELDS
from .files import check_directory, write_atomically
from .georeference import GRID_MAPPING, grid_mapping_attributes
from .observers import check_interval

SERIES = "depth", "speed", "basal_excess_pore_pressure", "eroded_depth", "deposit_depth"
"""Fields of a series of maps by default."""

REACHED = "depth", "max_depth", "eroded_depth", "deposit_depth"
"""Fields of which at least one is above 0 wherever flow is or was."""

PREFIX = "maps"
"""Beginning of the names of files, before the number."""


class MapSeries:
    """Observer that writes maps at intervals, each to a small NetCDF file of its own, numbered from 0.

    A file holds numbers of single precision over a rectangle of nodes that has all flow so far in it, and is there as a
    whole or not at all. Values are 0 where there is no debris, at closed nodes, too. `combine_maps` makes one small
    file of all. Single maps are not compressed, because this would take longer than the rest of the observer.

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
        If the interval is not > 0, a variable or the system is not known, or the directory cannot be written to or
        holds a series already.

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
        variables = (variables,) if isinstance(variables, str) else variables
        self.variables = tuple(dict.fromkeys(_field_name(name) for name in variables))
        if not self.variables:
            raise InputError("MapSeries: variables must name at least one output field, got none")
        self._mapping = {} if crs is None else grid_mapping_attributes(crs)
        if (old := numbered_files(self.directory)) and not replace:
            raise InputError(
                f"MapSeries: {self.directory} already holds {len(old)} maps of a series, {old[0].name} the first; "
                "choose another directory, or replace=True"
            )
        mapped = {"coordinates": "time"} | ({"grid_mapping": GRID_MAPPING} if self._mapping else {})
        self._words = {
            name: variable_attributes(FIELDS[name].unit, FIELDS[name].doc) | mapped for name in self.variables
        }
        self._times: list[float] = []
        self._attributes: dict[str, Any] = {}
        self._grid: Any = None
        self._window: tuple[tuple[int, int], tuple[int, int]] | None = None  # first and last row, and column

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
            If a variable is one that only a flow of two phases has, or one with dilatancy.
        """
        written = {field.name for field in output_fields(setup)}
        if lacking := [name for name in self.variables if FIELDS[name].optional and name not in written]:
            kind = "columns with dilatancy" if lacking[0] == OUTPUT_PREFIX + SOLID_FRACTION else "flows of two phases"
            raise InputError(f"MapSeries: {lacking[0]} is in {kind} only; leave it out of variables")
        self._attributes = file_attributes() | setup.to_attributes()
        self._grid, self._window = grid, None

    def follow(self, particles: Any, began: float, time: float) -> None:
        """Widen the rectangle to where the flow is.

        Parameters
        ----------
        particles : Particles
            The particles now; x and y are from the lower left node [m].
        began, time : float
            Beginning and end of the step [s].
        """
        if self._window is None:  # includes erosion and deposit of an earlier component
            self._window = occupied([_over_grid(self._grid, OUTPUT_PREFIX + name) for name in REACHED])
        if particles.count:
            grid, (rows, columns) = self._grid, self._window or (NOWHERE, NOWHERE)
            rows = _widened(rows, particles.y, grid.dy, grid.shape[0])
            self._window = rows, _widened(columns, particles.x, grid.dx, grid.shape[1])

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
        if self._times and self._times[-1] >= time:  # times of a call that was undone
            self._times = [each for each in self._times if each < time]
            self._remove_from(len(self._times))
        if not self._times:  # files of an earlier series
            self._remove_from(0)
        content = self._file(time)
        write_atomically(self._path(len(self._times)), lambda temporary: temporary.write_bytes(content))
        self._times.append(time)

    def state(self) -> dict[str, Any]:
        """Return the times of the maps written so far [s], by name, for a checkpoint."""
        return {"times": np.array(self._times), "window": np.array(self._window or (), np.int64)}

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
                f"MapSeries: {missing[0].name} was written before the checkpoint and is not in {self.directory} any "
                "more; put it back, or start from the beginning"
            )
        window = np.ravel(state["window"]).tolist()
        self._times, self._window = times, ((window[0], window[1]), (window[2], window[3])) if window else None
        self._remove_from(len(times))

    def _file(self, time: float) -> bytes:
        """Return the file of the fields of now at a time [s]."""
        grid, (rows, columns) = self._grid, self._window or ((0, 0), (0, 0))
        place = {"grid_rows": grid.shape[0], "grid_columns": grid.shape[1], "row": rows[0], "column": columns[0]}
        attributes = self._attributes | date_created() | quantity_attributes("elapsed_time", time, "s") | place
        x, y = grid.xy_of_lower_left
        variables: dict[str, tuple[tuple[str, ...], np.ndarray, Mapping[str, Any]]] = {}
        for axis, origin, spacing, (first, last) in (("y", y, grid.dy, rows), ("x", x, grid.dx, columns)):
            variables[axis] = (axis,), origin + spacing * np.arange(first, last + 1), axis_attributes(axis)
        variables["time"] = (), np.array(time), variable_attributes("s", "elapsed time")
        if self._mapping:
            variables[GRID_MAPPING] = (), np.array(0, np.int32), self._mapping
        for name in self.variables:
            values = _over_grid(grid, name)[rows[0] : rows[1] + 1, columns[0] : columns[1] + 1]
            variables[name] = ("y", "x"), values.astype(np.float32), self._words[name]
        return classic_file(variables, attributes)

    def _path(self, number: int) -> Path:
        return self.directory / f"{PREFIX}_{number:06d}.nc"

    def _remove_from(self, number: int) -> None:
        """Remove the files from a number on, the last first, so that no gap is left.

        Half a file that a killed process left beside them goes, too.
        """
        for path in self.directory.glob(f".{PREFIX}_*.nc"):
            if re.fullmatch(rf"\.{PREFIX}_\d{{6,}}\.\d+\.nc", path.name):
                path.unlink()
        for path in reversed(numbered_files(self.directory)):
            if (_number(path) or 0) >= number:
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
    numbers = {path: number for path in Path(directory).iterdir() if (number := _number(path)) is not None}
    return sorted(numbers, key=numbers.__getitem__)


def occupied(fields: Sequence[np.ndarray]) -> tuple[tuple[int, int], tuple[int, int]] | None:
    """Return first and last row, and first and last column, with a value above 0, None if there is none.

    Parameters
    ----------
    fields : sequence of ndarray, shape (rows, columns)
        Depths [m].

    Returns
    -------
    tuple of tuple of int, or None

    Examples
    --------
    >>> depth = np.zeros((4, 5))
    >>> depth[1, 2] = depth[2, 4] = 1.0
    >>> occupied([depth])
    ((1, 2), (2, 4))
    """
    wet = np.logical_or.reduce([field > 0.0 for field in fields])
    rows, columns = (np.flatnonzero(wet.any(axis=axis)) for axis in (1, 0))
    return ((int(rows[0]), int(rows[-1])), (int(columns[0]), int(columns[-1]))) if rows.size else None


NOWHERE = sys.maxsize, -1
"""First and last row or column of an empty span."""


def _widened(span, place, spacing, count):
    """Return first and last row or column of a span and of all nodes under particles.

    `place` is x or y of the particles, shape (n,), and `spacing` that of the nodes [m], of which there are `count`.
    """
    first, last = int(place.min() / spacing) - int(WIDEST), int(place.max() / spacing) + int(WIDEST)
    return max(0, min(span[0], first)), min(count - 1, max(span[1], last))


def _over_grid(grid, name):
    """Return a field as rows and columns, without a copy."""
    return np.asarray(grid.at_node[name]).reshape(grid.shape)


def _field_name(name: str) -> str:
    """Return the whole name of an output field."""
    outputs = [field.name for field in FIELDS.values() if field.intent == "out"]
    short = [each.removeprefix(OUTPUT_PREFIX) for each in outputs]
    if name in short:
        return OUTPUT_PREFIX + name
    if name not in outputs:
        raise InputError(
            f"MapSeries: no output field {name!r}{did_you_mean(name, short)}; there are {', '.join(short)}"
        )
    return name


def _number(path: Path) -> int | None:
    found = re.fullmatch(PREFIX + r"_(\d{6,})\.nc", path.name)
    return int(found[1]) if found else None
