"""Raster that has been opened and not yet read."""

from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import numpy as np

from .lattice import Lattice, Window


class RasterSource(NamedTuple):
    """Raster of a file, whatever the format.

    Attributes
    ----------
    path : Path
        The file.
    lattice : Lattice
        Place of all values on the map.
    read : callable
        ``read(window, shape)`` returns the values of a `Window` from south to north, thinned out to a shape, as floats
        with NaN where the file states that there are no data.
    unit : str
        Unit of the values as the file states it, "" if it does not.
    integer : bool
        Whether the file holds integers.
    """

    path: Path
    lattice: Lattice
    read: Callable[[Window, tuple[int, int]], np.ndarray]
    unit: str = ""
    integer: bool = False
