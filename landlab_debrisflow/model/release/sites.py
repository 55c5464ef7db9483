"""Sites of a release: failing cells that touch along a side, each with its own volume and its own particles."""

from typing import NamedTuple

import numpy as np
from scipy import ndimage

from ...spatial.raster import Raster, nearest_line

NEIGHBOURS = tuple((r, c) for r in (-1, 0, 1) for c in (-1, 0, 1) if (r, c) != (0, 0))


class Sites(NamedTuple):
    """Failing cells of a raster by site; arrays over cells are in the order of their nodes.

    Attributes
    ----------
    label : ndarray, shape (rows, columns)
        Number of the site, -1 where nothing fails, with one such cell all round.
    depth : ndarray, shape (rows, columns)
        Vertical thickness that fails [m], with a rim of 0.
    corner : tuple of int
        Row and column in the raster of the cell at [0, 0].
    spacing : tuple of float
        Node spacing (dx, dy) [m].
    rows : ndarray, shape (cells,)
        Row of every failing cell, counted from the corner.
    columns : ndarray, shape (cells,)
        Column of every failing cell, counted from the corner.
    of_cell : ndarray of int, shape (cells,)
        Site of every failing cell.
    volume : ndarray, shape (sites,)
        Volume that fails [m3].
    thickest : ndarray, shape (sites,)
        Largest depth [m].
    """

    label: np.ndarray
    depth: np.ndarray
    corner: tuple[int, int]
    spacing: tuple[float, float]
    rows: np.ndarray
    columns: np.ndarray
    of_cell: np.ndarray
    volume: np.ndarray
    thickest: np.ndarray

    def at(self, x, y):
        """Return the site of points (from the centre of the corner cell [m]), shape (n,), and the depth there [m]."""
        rows = np.clip(nearest_line(y, self.spacing[1]).astype(int), 0, self.label.shape[0] - 1)
        columns = np.clip(nearest_line(x, self.spacing[0]).astype(int), 0, self.label.shape[1] - 1)
        return self.label[rows, columns], self.depth[rows, columns]


def find_sites(nodes, depth, raster: Raster) -> Sites:
    """Tell the sites of a release apart.

    Parameters
    ----------
    nodes : ndarray of int, shape (cells,)
        Where ground fails, sorted.
    depth : ndarray, shape (cells,)
        Vertical thickness that fails there, > 0 [m].
    raster : Raster
        Nodes, their statuses and spacing [m].

    Returns
    -------
    Sites

    Notes
    -----
    Cells that meet at a corner only are two sites: nothing could flow through a corner.
    """
    rows, columns = np.divmod(nodes, raster.columns)
    corner = int(rows.min()) - 1, int(columns.min()) - 1
    rows, columns = rows - corner[0], columns - corner[1]
    failing = np.zeros((rows.max() + 2, columns.max() + 2))
    failing[rows, columns] = depth
    label, count = ndimage.label(failing > 0.0)
    label -= 1
    of_cell = label[rows, columns]
    volume = np.bincount(of_cell, depth, count) * raster.area
    thickest = np.zeros(count)
    np.maximum.at(thickest, of_cell, depth)
    spacing = float(raster.dx), float(raster.dy)
    return Sites(label, failing, corner, spacing, rows, columns, of_cell, volume, thickest)


def share_particles(volume, particle_volume: float):
    """Return the number of particles of each site, shape (sites,): in proportion to its volume, and at least one.

    Examples
    --------
    >>> share_particles(np.array([400.0, 30.0, 1e-15]), 10.0)
    array([40,  3,  1])
    """
    return np.maximum(1, np.rint(volume / particle_volume)).astype(int)


def volume_below_lips(sites: Sites, nodes, depth, elevation, closed, raster: Raster) -> float:
    """Return the volume of a release that lies below the lowest ground beside its site [m3].

    This volume cannot leave the scar by itself: a release of uniform depth digs a pit, with a wall at its lower end.

    Parameters
    ----------
    sites : Sites
        Failing cells by site.
    nodes, depth : ndarray, shape (cells,)
        As for `find_sites`.
    elevation : ndarray, shape (nodes,)
        Elevation of the ground after the failure [m].
    closed : ndarray of bool, shape (nodes,)
        Nodes over which nothing can leave.
    raster : Raster
        Nodes, their statuses and spacing [m].
    """
    lip = np.full(sites.volume.size, np.inf)
    for down, along in NEIGHBOURS:
        r, c = sites.rows + down, sites.columns + along
        beside = sites.label[r, c] != sites.of_cell
        r, c = r + sites.corner[0], c + sites.corner[1]
        beside &= (r >= 0) & (r < raster.rows) & (c >= 0) & (c < raster.columns)
        there, site = (r * raster.columns + c)[beside], sites.of_cell[beside]
        usable = ~closed[there]
        np.minimum.at(lip, site[usable], elevation[there[usable]])
    lip = np.where(np.isfinite(lip), lip, -np.inf)[sites.of_cell]  # a site between closed nodes is no pit
    return float(np.clip(lip - elevation[nodes], 0.0, depth).sum() * raster.area)
