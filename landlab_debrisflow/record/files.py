"""Output paths: refused before anything is computed, and never left half written."""

import os
import tempfile
from collections.abc import Callable
from pathlib import Path

import xarray as xr

from ..core.errors import InputError, OutputError


def check_writable(path: str | os.PathLike[str]) -> Path:
    """Return `path` as a Path if a file can be written there.

    Parameters
    ----------
    path : str or os.PathLike
        The file to be written; it may exist already.

    Returns
    -------
    pathlib.Path

    Raises
    ------
    InputError
        If there is no such directory, or if `path` is one.
    OutputError (an InputError)
        If the directory may not be written to, or the file may not be replaced.
    """
    path = Path(path)
    folder = path.parent
    if path.is_dir():
        raise InputError(f"cannot write {path}: it is a directory; give the name of a file in it")
    if not folder.is_dir():
        word = "is not a directory" if folder.exists() else "does not exist"
        raise InputError(f"cannot write {path}: {folder} {word}; create it first (mkdir -p) or choose another")
    try:  # writing is the only reliable test: permission bits do not tell of read-only or full file systems
        with tempfile.TemporaryFile(dir=folder):
            pass
    except OSError as error:
        raise OutputError(f"cannot write {path}: {error.strerror} in {folder}; choose another directory") from error
    if path.exists() and not os.access(path, os.W_OK):
        raise OutputError(
            f"cannot write {path}: the file is there and write-protected; remove it or choose another name"
        )
    return path


def check_directory(path: str | os.PathLike[str]) -> Path:
    """Return `path` as a Path if files can be written in that directory.

    Parameters
    ----------
    path : str or os.PathLike
        An existing directory.

    Returns
    -------
    pathlib.Path

    Raises
    ------
    InputError
        If there is no such directory, or if it may not be written to.
    """
    path = Path(path)
    if not path.is_dir():
        word = "is a file" if path.exists() else "does not exist"
        raise InputError(
            f"cannot write to {os.fspath(path)!r}: it {word}; create it first (mkdir -p) or choose another"
        )
    check_writable(path / "any")
    return path


def write_atomically(path: str | os.PathLike[str], write: Callable[[Path], object]) -> Path:
    """Write a file beside `path` and rename it when it is complete, so that `path` never holds half a file.

    Parameters
    ----------
    path : str or os.PathLike
        The file to be written.
    write : callable
        Called with the temporary path, which has the same suffix.

    Returns
    -------
    Path
        Where the file is.

    Raises
    ------
    OutputError (an InputError)
        If it cannot be written; see `check_writable`.
    OSError
        If the disk is full.
    """
    path = check_writable(path)
    temporary = path.with_name(f".{path.stem}.{os.getpid()}{path.suffix}")
    try:
        write(temporary)
        os.replace(temporary, path)
    except Exception as failure:
        raise_if_full(path, failure)
        raise
    finally:
        temporary.unlink(missing_ok=True)
    return path


LEAST_ROOM = 2**22
"""Free space below which a disk counts as full [bytes]: a chunk of HDF5 may need more."""


def raise_if_full(path: Path, failure: Exception) -> None:
    """Raise an OSError from a failure if the disk is full: HDF5, GDAL and SQLite report a full disk as other errors.

    Parameters
    ----------
    path : Path
        The file that could not be written.
    failure : Exception
        Failure of a library.

    Raises
    ------
    OSError
        With the path; not if there is room.
    """
    try:
        with tempfile.TemporaryFile(dir=path.parent) as room:
            room.write(bytes(LEAST_ROOM))
            room.flush()
    except OSError as error:
        raise OSError(error.errno, error.strerror, os.fspath(path)) from failure


def write_dataset(path: str | os.PathLike[str], dataset: xr.Dataset) -> Path:
    """Write an xarray Dataset as compressed NetCDF, atomically; return where.

    Parameters
    ----------
    path : str or os.PathLike
        The file; it is replaced if it exists.
    dataset : xarray.Dataset
        Any dataset whose attributes NetCDF can hold, such as `DebrisFlow.maps`.

    Returns
    -------
    pathlib.Path
        Where the file is.

    Raises
    ------
    OutputError (an InputError)
        If it cannot be written; see `check_writable`.
    """
    encoding = {name: {"zlib": True, "complevel": 1} for name, data in dataset.items() if data.ndim >= 2}
    return write_atomically(path, lambda temporary: dataset.to_netcdf(temporary, engine="netcdf4", encoding=encoding))
