"""ESRI ASCII grids.

GDAL reads them, but takes letters and missing values for 0 and floats after a long row of integers for integers.
"""

import math
import re
import warnings
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from ..core.errors import InputError
from ..core.hints import number_in
from .gdal import crs_of_gdal
from .lattice import Lattice, Window
from .references import wkt_of
from .source import RasterSource

HEADER = re.compile(rb"\s*([A-Za-z_]+)[ \t]+([^\s]+)[ \t]*\r?\n?")
WORDS = ("ncols", "nrows", "xllcorner", "yllcorner", "xllcenter", "yllcenter", "cellsize", "dx", "dy", "nodata_value")
CHUNK = 1 << 25
"""Bytes that are turned into numbers at a time."""
NOT_NUMBERS = bytes(set(range(256)) - set(b"0123456789+-.,eE \t\r\n\f\vnaifNAIF"))
REMEDY = "write the grid again, or give a GeoTIFF"


def is_ascii_grid(path: Path, head: bytes) -> bool:
    """Return whether the first bytes of a file belong to an ESRI ASCII grid, complete or not."""
    return bool(re.match(rb"\s*(ncols|nrows|xll|yll|cellsize|dx|dy|nodata)", head, re.IGNORECASE)) or (
        path.suffix.lower() == ".asc" and not re.match(rb"\s*(north:|DSAA)", head)
    )


def open_ascii_grid(path: Path) -> RasterSource:
    """Open an ESRI ASCII grid, with its coordinate reference system from a .prj beside it.

    Raises
    ------
    InputError
        If the header is not complete, or the file is too short for it.
    """
    try:
        with open(path, "rb") as file:
            head = file.read(4096)
    except OSError as error:
        raise InputError(f"cannot read {path}: {error.strerror}") from error
    header, start = _header(path, head)
    shape, spacing, corner, missing = _geometry(path, header)
    size = path.stat().st_size
    if 2 * shape[0] * shape[1] - 1 > size - start + 1:
        raise InputError(
            f"cannot read {path}: {shape[0]} rows of {shape[1]} columns do not fit into its {size} bytes; the file is "
            f"cut off, or its header is wrong; {REMEDY}"
        )

    def read(window: Window, target: tuple[int, int]) -> np.ndarray:
        values = _values(path, start, shape, window)
        if missing is not None:
            values[values == missing] = np.nan
        rows, columns = (
            ((np.arange(new) + 0.5) * old / new).astype(int) for new, old in zip(target, values.shape, strict=True)
        )
        return values if target == values.shape else values[np.ix_(rows, columns)]

    return RasterSource(path, Lattice(shape, spacing, corner, _reference(path)), read)


def _header(path: Path, head: bytes) -> tuple[dict[str, float], int]:
    """Return the numbers of the header by their words, and the place where the values begin."""
    header: dict[str, float] = {}
    start = 0
    while match := HEADER.match(head, start):
        word = match[1].decode().lower()
        if word in ("nan", "inf", "na") or (word not in WORDS and "ncols" in header and "nrows" in header):
            break
        word = "nodata_value" if word.startswith("nodata") else word
        number = number_in(match[2].decode("latin-1"))
        if word not in WORDS or number is None:
            shown = match[0].decode("latin-1").strip()
            raise InputError(
                f"cannot read {path} as an ESRI ASCII grid: its header has {shown[:60]!r}; known are a number after "
                f"one of {', '.join(WORDS)}"
            )
        header[word], start = number, match.end()
    return header, start


def _geometry(path: Path, header: dict[str, float]):
    """Return shape, spacing, first node and the number that marks missing data."""

    def number(*words: str) -> float:
        found = next((header[word] for word in words if word in header), math.nan)
        if not math.isfinite(found):
            raise InputError(
                f"cannot read {path} as an ESRI ASCII grid: its header lacks {' or '.join(words)}; it begins with "
                "ncols, nrows, xllcorner, yllcorner, cellsize and NODATA_value, each with a number"
            )
        return found

    rows, columns = number("nrows"), number("ncols")
    dx, dy = number("dx", "cellsize"), number("dy", "cellsize")
    if not (rows >= 1 and columns >= 1 and rows.is_integer() and columns.is_integer() and dx > 0.0 and dy > 0.0):
        raise InputError(
            f"cannot read {path} as an ESRI ASCII grid: {columns:g} columns, {rows:g} rows and cells of {dx:g} x "
            f"{dy:g} m are none; {REMEDY}"
        )
    corner = tuple(
        header[f"{axis}llcenter"] if f"{axis}llcenter" in header else number(f"{axis}llcorner") + 0.5 * step
        for axis, step in (("x", dx), ("y", dy))
    )
    return (int(rows), int(columns)), (dx, dy), corner, header.get("nodata_value")


def _values(path: Path, start: int, shape: tuple[int, int], window: Window) -> np.ndarray:
    """Return the values of a window from south to north; the file is read down to its last row."""
    rows, columns = shape
    first, last = rows - window.rows.stop, rows - window.rows.start  # the file begins in the north
    values = np.empty(window.shape)
    done, rest = 0, np.empty(0)
    for chunk in _numbers(path, start):
        rest = np.concatenate([rest, chunk]) if rest.size else chunk
        whole = rest.size // columns
        block = rest[: whole * columns].reshape(whole, columns)
        low, high = max(first, done), min(last, done + whole)
        if low < high:
            values[low - first : high - first] = block[low - done : high - done, window.columns]
        rest, done = rest[whole * columns :], done + whole
        if done >= last and last < rows:
            return values[::-1].copy()
    if done != rows or rest.size:
        raise InputError(
            f"cannot read {path}: {done * columns + rest.size} values, its header promises {rows} rows of {columns} = "
            f"{rows * columns}; {REMEDY}"
        )
    return values[::-1].copy()


def _numbers(path: Path, start: int) -> Iterator[np.ndarray]:
    """Yield the numbers of a file from a place on, many at a time."""
    try:
        with open(path, "rb") as file:
            file.seek(start)
            tail = b""
            while piece := file.read(CHUNK):
                text = tail + piece
                end = max(text.rfind(blank) for blank in (b" ", b"\n", b"\t", b"\r")) + 1
                tail = text[end:]
                if len(tail) > 1000:
                    raise InputError(f"cannot read {path}: {tail[:20]!r}... is no number; {REMEDY}")
                yield _parsed(path, text[:end])
            yield _parsed(path, tail)
    except OSError as error:
        raise InputError(f"cannot read {path}: {error.strerror}") from error


def _parsed(path: Path, text: bytes) -> np.ndarray:
    """Return the numbers of a text, with decimal points or commas."""
    if not text.strip():
        return np.empty(0)
    text = text.replace(b",", b".")
    with warnings.catch_warnings():
        warnings.simplefilter("error", DeprecationWarning)
        try:
            if text.translate(None, NOT_NUMBERS) == text:
                return np.fromstring(text.decode("ascii"), sep=" ")
        except (DeprecationWarning, ValueError):
            pass
    bad = next((word for word in text.split() if number_in(word.decode("latin-1")) is None), b"?")
    raise InputError(f"cannot read {path}: {bad.decode('latin-1')[:40]!r} is no number; {REMEDY}")


def _reference(path: Path) -> str | None:
    """Return the coordinate reference system of the .prj beside a grid, or None."""
    beside = next((p for p in (path.with_suffix(".prj"), path.with_suffix(".PRJ")) if p.is_file()), None)
    if beside is None:
        return None
    try:
        text = beside.read_text(encoding="utf-8").strip()
        return wkt_of(text) if text else None
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"cannot read {beside}, the coordinate reference system of {path.name}: {error}") from error
    except InputError as error:
        if (wkt := crs_of_gdal(path)) is not None:  # ArcInfo's form: "Projection UTM", "Zone 33"
            return wkt
        raise InputError(
            f"cannot read {beside}, the coordinate reference system of {path.name}; remove the file and give crs"
        ) from error
