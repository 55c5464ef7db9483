"""Extents of maps: the part of the ground that is shown, and the size of the panel for it."""

from typing import NamedTuple

import numpy as np
import xarray as xr

SLENDEREST = 3.5
"""Longest side of a map over its shortest one: more ground is shown beside a flow down a straight valley."""

NARROWEST = 6.0
"""The same of a map of a grid that is more slender itself: the page stays white beside it."""

MARGIN = 0.06
"""Ground shown around the flow, over the longer side of its extent [-]."""


class Extent(NamedTuple):
    """Rectangle of the map, in map coordinates [m]."""

    west: float
    east: float
    south: float
    north: float

    @property
    def width(self) -> float:
        """Length from west to east [m]."""
        return self.east - self.west

    @property
    def height(self) -> float:
        """Length from south to north [m]."""
        return self.north - self.south


def cell_edges(relief: xr.DataArray) -> Extent:
    """Return the outer edges of the cells around the nodes of a raster over ``y`` and ``x``.

    Examples
    --------
    >>> import xarray as xr
    >>> x, y = [400005.0, 400015.0], [5200005.0, 5200015.0, 5200025.0]
    >>> cell_edges(xr.DataArray(np.zeros((3, 2)), {"y": y, "x": x}, ("y", "x")))
    Extent(west=400000.0, east=400020.0, south=5200000.0, north=5200030.0)
    """
    x, y = relief.x.values, relief.y.values
    half_x, half_y = 0.5 * (x[1] - x[0]), 0.5 * (y[1] - y[0])
    return Extent(*(float(v) for v in (x[0] - half_x, x[-1] + half_x, y[0] - half_y, y[-1] + half_y)))


def extent_around(shown: np.ndarray, relief: xr.DataArray, margin: float | None = None) -> Extent:
    """Return the extent of the nodes that are shown, with a margin, within the raster.

    Parameters
    ----------
    shown : ndarray of bool, shape (rows, columns)
        Nodes that must be in it; if there are none, it is the whole raster.
    relief : xarray.DataArray
        Over ``y`` and ``x``.
    margin : float, optional
        Width of the ground around them [m]; by default a part of their extent, and as much as a slender one needs.

    Returns
    -------
    Extent
    """
    whole = cell_edges(relief)
    if not shown.any():
        return _widened(whole)
    columns, rows = np.flatnonzero(shown.any(axis=0)), np.flatnonzero(shown.any(axis=1))
    x, y = relief.x.values, relief.y.values
    half_x, half_y = 0.5 * (x[1] - x[0]), 0.5 * (y[1] - y[0])
    part = Extent(
        float(x[columns[0]] - half_x), float(x[columns[-1]] + half_x),
        float(y[rows[0]] - half_y), float(y[rows[-1]] + half_y),
    )  # fmt: skip
    longest = max(part.width, part.height)
    beside = MARGIN * longest + 2.0 * float(relief.x[1] - relief.x[0]) if margin is None else margin
    around_x = around_y = beside
    if margin is None:
        around_x = max(beside, 0.5 * (longest / SLENDEREST - part.width))
        around_y = max(beside, 0.5 * (longest / SLENDEREST - part.height))
    shown_part = Extent(
        max(part.west - around_x, whole.west), min(part.east + around_x, whole.east),
        max(part.south - around_y, whole.south), min(part.north + around_y, whole.north),
    )  # fmt: skip
    return shown_part if margin is not None else _widened(shown_part)


def within(relief: xr.DataArray, extent: Extent) -> xr.DataArray:
    """Return the nodes of a raster whose cells touch an extent, and one node more around them."""
    kept = {}
    for axis, low, high in (("x", extent.west, extent.east), ("y", extent.south, extent.north)):
        place = relief[axis].values
        first, last = np.searchsorted(place, (low, high))
        kept[axis] = slice(max(int(first) - 2, 0), max(int(last) + 2, 3))
    part = relief.isel(kept)
    return part if min(part.shape) >= 2 else relief


def panel_size(extent: Extent, largest: tuple[float, float]) -> tuple[float, float]:
    """Return width and height of a panel for an extent, as large as a rectangle allows [inch].

    Parameters
    ----------
    extent : Extent
    largest : tuple of float
        Width and height of the rectangle [inch].

    Returns
    -------
    tuple of float
    """
    width, height = largest
    aspect = extent.width / extent.height
    return (width, width / aspect) if width / aspect <= height else (height * aspect, height)


def emptiest_corner(shown: np.ndarray) -> str:
    """Return the corner of a panel in which fewest nodes are shown: "lower left", "upper right" and so on.

    Parameters
    ----------
    shown : ndarray of bool, shape (rows, columns)
        Nodes of the panel, the first row in the south.

    Returns
    -------
    str

    Examples
    --------
    >>> shown = np.zeros((20, 20), bool)
    >>> shown[:10, :10] = shown[10:, 5:] = True
    >>> emptiest_corner(shown)
    'lower right'
    """
    rows, columns = max(1, shown.shape[0] // 5), max(1, int(0.4 * shown.shape[1]))
    corners = {
        "lower left": shown[:rows, :columns], "lower right": shown[:rows, -columns:],
        "upper left": shown[-rows:, :columns], "upper right": shown[-rows:, -columns:],
    }  # fmt: skip
    return min(corners, key=lambda corner: int(corners[corner].sum()))


def _widened(extent: Extent) -> Extent:
    """Return an extent that is no more slender than a picture may be."""
    longest = max(extent.width, extent.height) / NARROWEST
    beside_x, beside_y = (0.5 * max(0.0, longest - side) for side in (extent.width, extent.height))
    return Extent(extent.west - beside_x, extent.east + beside_x, extent.south - beside_y, extent.north + beside_y)
