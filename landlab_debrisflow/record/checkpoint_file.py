"""Files of checkpoints: NetCDF and a trailer that tells whether the file is whole.

The file is the NetCDF file of a Dataset, which any reader of NetCDF opens, and behind it `TRAILER`: magic bytes,
version of the format, length of the NetCDF and BLAKE2b of everything before. The trailer is read first: a damaged file
never reaches the HDF5 library, which may crash on one.
"""

import os
import re
import struct
from hashlib import blake2b
from pathlib import Path

import xarray as xr

from ..core.errors import InputError, OutputError
from .files import check_writable

VERSION = 1
"""Version of the format that is written, and the newest that is read."""

MAGIC = b"\x93DFCHECK\r\n\x1a\n"
"""Begin of the trailer; line ends and a control character show a transfer as text."""

TRAILER = struct.Struct(f"<{len(MAGIC)}sIQ32s")
"""Magic bytes, version, length of the NetCDF [bytes], digest of the NetCDF and of the trailer so far."""


WORTH_COMPRESSING = 4096
"""Size from which on an array is compressed [bytes]: the index of a compressed array alone takes 2 kB."""


def previous_path(path: str | os.PathLike[str]) -> Path:
    """Return the path of the checkpoint before the last one.

    Examples
    --------
    >>> previous_path("run/event.nc").as_posix()
    'run/event.previous.nc'
    """
    path = Path(path)
    return path.with_name(f"{path.stem}.previous{path.suffix}")


def write_checkpoint(path: str | os.PathLike[str], dataset: xr.Dataset) -> Path:
    """Write a Dataset as a checkpoint; one that is there is kept under `previous_path`.

    At every moment the file of that name, if there has been one, is a whole checkpoint.

    Parameters
    ----------
    path : str or os.PathLike
        The file.
    dataset : xarray.Dataset
        Dataset of numbers and texts.

    Returns
    -------
    pathlib.Path
        Where it is.

    Raises
    ------
    InputError
        If it cannot be written; the one before stays.
    """
    path = check_writable(path)
    content = _to_bytes(dataset)
    head = MAGIC, VERSION, len(content)
    digest = blake2b(content, digest_size=32)
    digest.update(TRAILER.pack(*head, b"")[:-32])
    temporary = path.with_name(f".{path.stem}.{os.getpid()}{path.suffix}")
    _remove_leftovers(path)
    try:
        with open(temporary, "wb") as file:
            file.write(content)
            file.write(TRAILER.pack(*head, digest.digest()))
            file.flush()
            os.fsync(file.fileno())
        if path.exists():
            _keep(path, previous_path(path))
        os.replace(temporary, path)
    except OSError as error:
        kept = "; the checkpoint before is still there" if path.exists() else ""
        raise OutputError(f"cannot write checkpoint {path}: {error.strerror}{kept}") from error
    finally:
        temporary.unlink(missing_ok=True)
    return path


def read_checkpoint(path: str | os.PathLike[str]) -> xr.Dataset:
    """Read a checkpoint.

    Parameters
    ----------
    path : str or os.PathLike
        The file.

    Returns
    -------
    xarray.Dataset
        All of it, in memory.

    Raises
    ------
    InputError
        If the file is missing, was truncated or damaged, or is no checkpoint.
    """
    path = Path(path)
    try:
        data = path.read_bytes()
    except OSError as error:
        raise InputError(f"cannot read checkpoint {path}: {error.strerror}{_alternative(path)}") from error
    content = _checked(path, data)
    try:
        return _from_bytes(content)
    except (OSError, RuntimeError, ValueError, LookupError, TypeError, AttributeError) as error:
        raise InputError(
            f"{path} is no checkpoint that flow.save() wrote: its NetCDF cannot be read ({error}); give "
            f"another{_alternative(path)}"
        ) from error


def _checked(path: Path, data: bytes) -> bytes:
    """Return the NetCDF in the bytes of a file, or raise InputError with the reason why it is no checkpoint."""
    content, trailer = data[: -TRAILER.size], data[-TRAILER.size :]
    if not trailer.startswith(MAGIC) or len(trailer) < TRAILER.size:
        if not data:
            reason = "it is empty"
        elif data.startswith(b"\x89HDF\r\n\x1a\n"):
            reason = f"its end, after {len(data)} bytes, is not that of one: cut off, or another NetCDF file"
        else:
            reason = f"it begins with {data[:8]!r}, which is no NetCDF file"
        raise InputError(
            f"{path} is no whole checkpoint: {reason}; give a file that flow.save() wrote{_alternative(path)}"
        )
    _, version, length, digest = TRAILER.unpack(trailer)
    found = blake2b(content, digest_size=32)
    found.update(trailer[:-32])
    if found.digest() != digest or length != len(content):
        raise InputError(
            f"checkpoint {path} is damaged: its {len(data)} bytes are not those that were written{_alternative(path)}"
        )
    if version > VERSION:
        raise InputError(
            f"checkpoint {path} has version {version} of the format, this package reads up to {VERSION}; load it with "
            "the version of landlab_debrisflow that wrote it, or a later one"
        )
    return content


def _alternative(path: Path) -> str:
    previous = previous_path(path)
    return f"; the one before is {previous}" if previous.exists() else ""


def _remove_leftovers(path: Path) -> None:
    """Remove files that processes which are no more were writing for a checkpoint."""
    if os.name != "posix":
        return
    for other in path.parent.iterdir():
        found = re.fullmatch(rf"\.{re.escape(path.stem)}\.(\d+){re.escape(path.suffix)}", other.name)
        try:
            if found:
                os.kill(int(found[1]), 0)  # signal 0 only asks whether the process exists
        except ProcessLookupError:
            other.unlink(missing_ok=True)
        except (OSError, OverflowError):  # a process of another user
            continue


def _keep(path: Path, previous: Path) -> None:
    """Keep a file under another name, too; without hard links under the other name only."""
    beside = previous.with_name(f".{previous.stem}.{os.getpid()}{previous.suffix}")
    try:
        beside.unlink(missing_ok=True)
        os.link(path, beside)
    except OSError:
        os.replace(path, previous)
        return
    os.replace(beside, previous)
    # os.replace leaves it if both names are one file, after a process that was killed in between
    beside.unlink(missing_ok=True)


def _to_bytes(dataset: xr.Dataset) -> bytes:
    """Return a Dataset as a NetCDF file in memory."""
    from netCDF4 import Dataset  # imported here because loading takes a tenth of a second

    file = Dataset("checkpoint.nc", mode="w", memory=1 << 20)
    encoding = {
        name: {"_FillValue": None} | ({"zlib": True, "complevel": 1} if data.nbytes > WORTH_COMPRESSING else {})
        for name, data in dataset.variables.items()
    }
    dataset.dump_to_store(xr.backends.NetCDF4DataStore(file), encoding=encoding)
    return bytes(file.close())


def _from_bytes(content: bytes) -> xr.Dataset:
    """Return the Dataset of a NetCDF file in memory."""
    from netCDF4 import Dataset

    with Dataset("checkpoint.nc", memory=content) as file:
        store = xr.backends.NetCDF4DataStore(file)
        return xr.open_dataset(store, mask_and_scale=False, decode_times=False).load()
