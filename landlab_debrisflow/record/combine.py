"""Maps of a series put together: one CF NetCDF file or Zarr store over time, made map by map."""

import os
import shutil
import warnings
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from ..core.errors import InputError
from .attributes import date_created, file_attributes, variable_attributes
from .files import check_directory, raise_if_full, write_atomically
from .georeference import GRID_MAPPING
from .map_series import numbered_files

SUFFIXES = ".nc", ".zarr"

SAME = "setup_digest", "grid_rows", "grid_columns"
"""Attributes in which all maps of a series agree."""


class Frame(NamedTuple):
    """Times and place of all maps of a series.

    Attributes
    ----------
    paths : list of Path
        Files in order of time.
    times : ndarray, shape (times,)
        Elapsed time [s].
    rows, columns : slice
        Nodes of the grid that at least one map covers.
    first : Dataset
        The first map, for names and attributes.
    x, y : ndarray
        Map coordinates of the columns and rows [m].
    """

    paths: list[Path]
    times: np.ndarray
    rows: slice
    columns: slice
    first: xr.Dataset
    x: np.ndarray
    y: np.ndarray


def combine_maps(directory: str | os.PathLike[str], path: str | os.PathLike[str]) -> Path:
    """Put the maps that `MapSeries` wrote into one file over time, map by map: memory does not grow with their number.

    Parameters
    ----------
    directory : str or os.PathLike
        Where the series is.
    path : str or os.PathLike
        The file, ``.nc`` for NetCDF, or store, ``.zarr``; an earlier one of this name is replaced when the new one is
        complete. It covers the rectangle of all maps; values are 0 where a map did not reach.

    Returns
    -------
    pathlib.Path
        Where it is.

    Raises
    ------
    InputError
        If the directory holds no maps, maps of several runs or an unreadable one, or `path` cannot be written.

    Examples
    --------
    >>> combine_maps(".", "all.tif")
    Traceback (most recent call last):
        ...
    landlab_debrisflow.core.errors.InputError: combine_maps: the name must end in .nc or .zarr, got 'all.tif'
    """
    path = Path(path)
    if path.suffix not in SUFFIXES:
        raise InputError(f"combine_maps: the name must end in {' or '.join(SUFFIXES)}, got {path.name!r}")
    frame = _frame(check_directory(directory))
    if path.suffix == ".nc":
        return write_atomically(path, lambda temporary: _write_netcdf(temporary, frame))
    return _replace_store(path, frame)


def _frame(directory: Path) -> Frame:
    """Return times and place of the maps in a directory."""
    if not (paths := numbered_files(directory)):
        raise InputError(f"combine_maps: {directory} holds no maps of a MapSeries")
    times, windows, first = [], [], _read(paths[0])
    xs: dict[int, float] = {}
    ys: dict[int, float] = {}
    for path in paths:
        maps = _read(path)
        if differing := [name for name in SAME if maps.attrs.get(name) != first.attrs.get(name)]:
            raise InputError(
                f"combine_maps: {path.name} and {paths[0].name} are of different runs, {differing[0]} differs; keep "
                "the maps of a run in a directory of their own"
            )
        row, column = int(maps.attrs["row"]), int(maps.attrs["column"])
        windows.append((row, row + maps.sizes["y"], column, column + maps.sizes["x"]))
        times.append(float(maps.time))
        xs.update(zip(range(column, column + maps.sizes["x"]), maps.x.values.tolist(), strict=True))
        ys.update(zip(range(row, row + maps.sizes["y"]), maps.y.values.tolist(), strict=True))
    south, north, west, east = np.array(windows).T
    rows, columns = slice(int(south.min()), int(north.max())), slice(int(west.min()), int(east.max()))
    x, y = (_filled(known, span) for known, span in ((xs, columns), (ys, rows)))
    return Frame(paths, np.array(times), rows, columns, first, x, y)


def _filled(known, span):
    """Return the coordinates of all nodes of a span [m], of which some are known by number."""
    numbers = np.array(sorted(known))
    return np.interp(np.arange(span.start, span.stop), numbers, [known[number] for number in numbers.tolist()])


def _read(path: Path) -> xr.Dataset:
    """Return a map in memory; its file is closed."""
    try:
        with xr.open_dataset(path, engine="netcdf4", decode_times=False, decode_coords="all") as stored:
            return stored.load()
    except (OSError, ValueError) as error:
        raise InputError(f"combine_maps: cannot read {path}: {error}; remove it and every later one") from error


def _layers(frame: Frame) -> Iterator[tuple[int, str, np.ndarray]]:
    """Yield number, variable and values over the whole rectangle, map by map."""
    for k, path in enumerate(frame.paths):
        maps = _read(path)
        row, column = int(maps.attrs["row"]) - frame.rows.start, int(maps.attrs["column"]) - frame.columns.start
        for name, data in maps.data_vars.items():
            layer = np.zeros((frame.y.size, frame.x.size), np.float32)
            layer[row : row + data.shape[0], column : column + data.shape[1]] = data.values
            yield k, str(name), layer


def _attributes(frame: Frame) -> dict[str, Any]:
    """Return the attributes of the maps that hold at every time."""
    setup = {name: value for name, value in frame.first.attrs.items() if name.startswith("setup")}
    return file_attributes() | date_created() | _plain(setup)


def _plain(attributes: Mapping[Any, Any]) -> dict[str, Any]:
    """Return attributes as texts, numbers and lists of Python, which JSON can hold."""
    return {name: np.asarray(value).tolist() for name, value in attributes.items()}


def _words(data: xr.DataArray, frame: Frame) -> dict[str, Any]:
    """Return the attributes of a variable."""
    mapped = {"grid_mapping": GRID_MAPPING} if GRID_MAPPING in frame.first.coords else {}
    return _plain(data.attrs) | mapped


def _coordinates(frame: Frame) -> dict[str, tuple[np.ndarray, dict[str, Any]]]:
    """Return values and attributes of the coordinates by name."""
    first = frame.first
    return {
        "time": (frame.times, variable_attributes("s", "elapsed time")),
        "y": (frame.y, _plain(first.y.attrs)),
        "x": (frame.x, _plain(first.x.attrs)),
    }


def _write_netcdf(path: Path, frame: Frame) -> None:
    from netCDF4 import Dataset

    with Dataset(path, "w") as file:
        file.setncatts(_attributes(frame))
        for axis_name, (values, words) in _coordinates(frame).items():
            file.createDimension(axis_name, values.size)
            axis = file.createVariable(axis_name, "f8", (axis_name,))
            axis.setncatts(words)
            axis[:] = values
        for name, data in frame.first.data_vars.items():
            chunk = (1, *(min(512, size) for size in (frame.y.size, frame.x.size)))
            variable = file.createVariable(
                str(name), "f4", ("time", "y", "x"), zlib=True, complevel=1, chunksizes=chunk, fill_value=False
            )
            variable.setncatts(_words(data, frame))
        if GRID_MAPPING in frame.first.coords:
            mapping = file.createVariable(GRID_MAPPING, "i4", ())
            mapping.setncatts(_plain(frame.first[GRID_MAPPING].attrs))
            mapping[...] = 0
        for k, variable_name, layer in _layers(frame):
            file.variables[variable_name][k] = layer


def _replace_store(path: Path, frame: Frame) -> Path:
    """Write a Zarr store beside `path` and put it there when it is complete."""
    if path.exists() and not path.is_dir():
        raise InputError(f"cannot write {path}: it is a file; a Zarr store is a directory: choose another name")
    if path.is_dir() and any(path.iterdir()) and not (path / "zarr.json").is_file():
        raise InputError(f"cannot write {path}: it is a directory but no Zarr store; choose another name")
    check_directory(path.parent)
    temporary, old = (path.with_name(f".{path.stem}.{os.getpid()}{word}.zarr") for word in ("", ".old"))
    try:
        _write_zarr(temporary, frame)
        if path.exists():
            os.replace(path, old)
        os.replace(temporary, path)
    except Exception as failure:
        raise_if_full(path, failure)
        raise
    finally:
        shutil.rmtree(temporary, ignore_errors=True)
        shutil.rmtree(old, ignore_errors=True)
    return path


def _write_zarr(path: Path, frame: Frame) -> None:
    try:
        import zarr
    except ImportError as error:
        raise InputError('combine_maps: Zarr stores need zarr; pip install "landlab_debrisflow[geo]"') from error
    store = zarr.open_group(path, mode="w", attributes=_attributes(frame))
    for axis_name, (values, words) in _coordinates(frame).items():
        axis = store.create_array(
            axis_name, shape=values.shape, dtype="f8", dimension_names=(axis_name,), attributes=words
        )
        axis[:] = values
    shape = frame.times.size, frame.y.size, frame.x.size
    arrays = {}
    for name, data in frame.first.data_vars.items():
        arrays[str(name)] = store.create_array(
            str(name), shape=shape, chunks=(1, min(512, shape[1]), min(512, shape[2])), dtype="f4", fill_value=0.0,
            dimension_names=("time", "y", "x"), attributes=_words(data, frame),
        )  # fmt: skip
    if GRID_MAPPING in frame.first.coords:
        words = _plain(frame.first[GRID_MAPPING].attrs)
        store.create_array(GRID_MAPPING, shape=(), dtype="i4", dimension_names=(), attributes=words)
    for k, variable, layer in _layers(frame):
        arrays[variable][k] = layer
    # xarray looks for consolidated metadata first; zarr warns that they are no part of its standard
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        zarr.consolidate_metadata(path)
