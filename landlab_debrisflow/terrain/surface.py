"""A C1 surface through the nodes of a raster: elevation, gradient and Hessian in one read.

Catmull-Rom cubic convolution (Keys 1981) on 4 x 4 nodes: it passes through the nodes, reproduces
quadratics exactly, and needs no global solve, so moving one node changes only its surroundings. At
cliffs its slopes are limited.
"""

from typing import NamedTuple

import numpy as np

from ..core.jit import inner, kernel
from ..core.lanes import DOUBLES, lane_doubles, lane_surroundings


class SurfaceSample(NamedTuple):
    """Elevation, slopes and curvatures of a surface at n points.

    Attributes
    ----------
    elevation : ndarray, shape (n,)
        Elevation z [m].
    slope_x : ndarray, shape (n,)
        Slope dz/dx [-].
    slope_y : ndarray, shape (n,)
        Slope dz/dy [-].
    curvature_xx : ndarray, shape (n,)
        Curvature d2z/dx2 [m-1].
    curvature_xy : ndarray, shape (n,)
        d2z/dxdy [m-1].
    curvature_yy : ndarray, shape (n,)
        Curvature d2z/dy2 [m-1].
    """

    elevation: np.ndarray
    slope_x: np.ndarray
    slope_y: np.ndarray
    curvature_xx: np.ndarray
    curvature_xy: np.ndarray
    curvature_yy: np.ndarray


class Surface:
    """Elevation of the bare bed, with a rim of one extrapolated node all round.

    Parameters
    ----------
    elevation : ndarray, shape (rows, columns)
        Node values [m]; those at `invalid` nodes are never read.
    spacing : tuple of float
        Node spacing (dx, dy) [m].
    invalid : ndarray of bool, shape (rows, columns), optional
        Closed and NODATA nodes; within two nodes of valid ones they are filled by extrapolation.
    """

    def __init__(self, elevation, spacing, invalid=None):
        self.dx, self.dy = map(float, spacing)
        rows, columns = elevation.shape
        self.values = np.empty((rows + 2, columns + 2))
        self.values[1:-1, 1:-1] = elevation if invalid is None or not invalid.any() else _fill(elevation, invalid)
        self.extend()

    def move_to(self, nodes, elevation):
        """Set the elevation [m] of nodes given by their flat index."""
        v = self.values
        if _set(v, nodes, elevation):
            self.extend()

    def extend(self) -> None:
        """Set the rim: linear beyond the edge."""
        v = self.values
        v[1:-1, 0], v[1:-1, -1] = 2.0 * v[1:-1, 1] - v[1:-1, 2], 2.0 * v[1:-1, -2] - v[1:-1, -3]
        v[0], v[-1] = 2.0 * v[1] - v[2], 2.0 * v[-2] - v[-3]

    def sample(self, x, y) -> SurfaceSample:
        """Read elevation, slopes and curvatures of the surface at points.

        Parameters
        ----------
        x, y : ndarray, shape (n,)
            From the lower left node [m].

        Returns
        -------
        SurfaceSample

        Examples
        --------
        >>> import numpy as np
        >>> yy, xx = np.mgrid[0.0:5.0, 0.0:6.0]
        >>> surface = Surface(xx**2 - 2.0 * xx * yy, (1.0, 1.0))
        >>> sample = surface.sample(np.array([2.5]), np.array([1.25]))
        >>> sample.slope_x, sample.slope_y, sample.curvature_xy
        (array([2.5]), array([-5.]), array([-2.]))
        """
        sample = tuple(np.empty((6, np.size(x))))
        self.sample_into(x, y, sample)
        return SurfaceSample(*sample)

    def sample_into(self, x, y, sample) -> None:
        """Write the `SurfaceSample` that `sample` returns into a plain tuple of arrays, shape (n,).

        `x` and `y` are points from the lower left node, shape (n,) [m]; `sample` has the fields of a `SurfaceSample`.
        """
        _sample(self.values, self.dx, self.dy, x, y, sample)

    def elevation_into(self, x, y, elevation) -> None:
        """Write the elevation [m] of points x, y, from the lower left node [m], into an array; each has shape (n,)."""
        _elevation(self.values, self.dx, self.dy, x, y, elevation)


def _fill(values, invalid):
    """Extrapolate linearly into invalid nodes from valid ones, two rings deep (all a read can reach).

    Nodes beyond are set to the mean of the valid nodes; no point reads these.
    """
    values, valid = np.array(values, float), ~invalid
    values[invalid] = values[valid].mean() if valid.any() else 0.0
    for _ in range(3):
        z, v = np.pad(values, 2), np.pad(valid, 2)
        total, count = np.zeros_like(values), np.zeros(values.shape)
        rows, columns = values.shape

        def shifted(a, r, c, rows=rows, columns=columns):
            return a[2 + r : 2 + r + rows, 2 + c : 2 + c + columns]

        for r, c in ((0, 1), (0, -1), (1, 0), (-1, 0), (1, 1), (1, -1), (-1, 1), (-1, -1)):
            one, two = shifted(v, r, c), shifted(v, 2 * r, 2 * c)
            z1, z2 = shifted(z, r, c), shifted(z, 2 * r, 2 * c)
            # a single node counts only where no line through two can be drawn
            weight = one * np.where(two, 1.0, 1e-30)
            total += np.where(one, weight * np.where(two, 2.0 * z1 - z2, z1), 0.0)
            count += weight
        new = ~valid & (count > 0)
        values[new] = total[new] / count[new]
        valid = valid | new
    return values


@inner
def set_node(values, node, elevation):
    """Set the elevation [m] of a node; return whether it lies so near the edge that the rim depends on it.

    `values`, shape (rows + 2, columns + 2), are elevations with one more node on every side [m].
    """
    rows, columns = values.shape[0] - 2, values.shape[1] - 2
    r, c = node // columns, node % columns
    values[r + 1, c + 1] = elevation
    return r < 2 or c < 2 or r > rows - 3 or c > columns - 3


@kernel
def _set(values, nodes, elevation):
    """Set nodes; return whether any lies so near the edge that the rim depends on it."""
    edge = False
    for k in range(nodes.size):
        edge |= set_node(values, nodes[k], elevation[k])
    return edge


@inner
def _tangent(before, after, most):
    """Return the slope per node at a node, from the differences to the nodes before and after.

    Their mean (Keys), where the surface bends by less than `most`. Sharper bends than that, 45 degrees, are
    cliffs: there the mean overshoots and builds a dam along the edge, 7 % of the cliff high. The slope goes over
    to that of a monotone surface (Fritsch & Carlson 1980) until the bend is twice as sharp.
    """
    mean, bend = 0.5 * (before + after), abs(after - before)
    steepest = 3.0 * min(abs(before), abs(after))
    limited = min(max(mean, -steepest), steepest) if before * after > 0.0 else 0.0
    sharp = min(bend / most - 1.0, 1.0)
    return mean if bend <= most else mean + sharp * (limited - mean)


@kernel
def _elevation(values, dx, dy, x, y, elevation):
    """Write the elevation of points [m], as `_sample` does; parameters as there."""
    s, t, around, z = lane_doubles(), lane_doubles(), lane_surroundings(), lane_doubles()
    for first in range(0, x.size, DOUBLES):
        count = _look_around_all(values, dx, dy, x, y, first, s, t, around)
        for lane in range(DOUBLES):
            (a0, _, _), (a1, _, _), (a2, _, _), (a3, _, _) = _along_rows(around, lane, s[lane], dx)
            v = t[lane]
            m1, k2, k3 = _cubic(a0, a1, a2, a3, dy)
            z[lane] = a1 + v * (m1 + v * (k2 + v * k3))
        for lane in range(count):
            elevation[first + lane] = z[lane]


@kernel
def _sample(values, dx, dy, x, y, sample):
    """Write the `SurfaceSample` of points x, y, shape (n,) [m], from node values with their rim [m].

    `values`, shape (rows + 2, columns + 2), are elevations with one more node on every side; `dx`, `dy` are node
    spacings [m]; `sample` is written.
    """
    elevation, slope_x, slope_y, curvature_xx, curvature_xy, curvature_yy = sample
    s, t, around = lane_doubles(), lane_doubles(), lane_surroundings()
    z, zx, zy, zxx, zxy, zyy = (
        lane_doubles(), lane_doubles(), lane_doubles(), lane_doubles(), lane_doubles(), lane_doubles(),
    )  # fmt: skip
    for first in range(0, x.size, DOUBLES):
        count = _look_around_all(values, dx, dy, x, y, first, s, t, around)
        for lane in range(DOUBLES):
            (a0, b0, c0), (a1, b1, c1), (a2, b2, c2), (a3, b3, c3) = _along_rows(around, lane, s[lane], dx)
            v = t[lane]
            m1, k2, k3 = _cubic(a0, a1, a2, a3, dy)
            z[lane] = a1 + v * (m1 + v * (k2 + v * k3))
            zy[lane] = (m1 + v * (2.0 * k2 + v * 3.0 * k3)) / dy
            zyy[lane] = (2.0 * k2 + v * 6.0 * k3) / (dy * dy)
            m1, k2, k3 = _smooth_cubic(b0, b1, b2, b3)
            zx[lane] = (b1 + v * (m1 + v * (k2 + v * k3))) / dx
            zxy[lane] = (m1 + v * (2.0 * k2 + v * 3.0 * k3)) / (dx * dy)
            m1, k2, k3 = _smooth_cubic(c0, c1, c2, c3)
            zxx[lane] = (c1 + v * (m1 + v * (k2 + v * k3))) / (dx * dx)
        for lane in range(count):
            i = first + lane
            elevation[i], slope_x[i], slope_y[i] = z[lane], zx[lane], zy[lane]
            curvature_xx[i], curvature_xy[i], curvature_yy[i] = zxx[lane], zxy[lane], zyy[lane]


@inner
def _look_around(values, dx, dy, x, y, lane, around):
    """Write the 4 x 4 nodes around a point into a lane; return its place between the middle ones, from 0 to 1."""
    rows, columns = values.shape[0] - 2, values.shape[1] - 2
    p, q = x / dx, y / dy
    c, r = min(max(int(np.floor(p)), 0), columns - 2), min(max(int(np.floor(q)), 0), rows - 2)
    south, west = np.uint64(r), np.uint64(c)  # of numbers without sign no index counts from the end
    for b in range(4):
        row = south + np.uint64(b)
        for a in range(4):
            around[(4 * b + a) * DOUBLES + lane] = values[row, west + np.uint64(a)]
    return p - c, q - r


@inner
def _look_around_all(values, dx, dy, x, y, first, s, t, around):
    """Write nodes and places of the points from the `first` on, one in a lane; return how many lanes hold a point."""
    count = min(DOUBLES, x.size - first)
    for lane in range(DOUBLES):
        i = first + min(lane, count - 1)  # lanes to spare repeat the last point
        s[lane], t[lane] = _look_around(values, dx, dy, x[i], y[i], lane, around)
    return count


@inner
def _along_rows(around, lane, s, dx):
    """Return value and derivatives along the four rows of a lane, from south to north, as `_along` for each."""
    return (
        _along(around, lane, 0, s, dx), _along(around, lane, 4, s, dx), _along(around, lane, 8, s, dx),
        _along(around, lane, 12, s, dx),
    )  # fmt: skip


@inner
def _along(around, lane, first, s, dx):
    """Return value [m] and first and second derivative per node, at `s`, along a row of four nodes from the `first`."""
    v0, v1 = around[first * DOUBLES + lane], around[(first + 1) * DOUBLES + lane]
    v2, v3 = around[(first + 2) * DOUBLES + lane], around[(first + 3) * DOUBLES + lane]
    m1, k2, k3 = _cubic(v0, v1, v2, v3, dx)
    return v1 + s * (m1 + s * (k2 + s * k3)), m1 + s * (2.0 * k2 + s * 3.0 * k3), 2.0 * k2 + s * 6.0 * k3


@inner
def _cubic(v0, v1, v2, v3, most):
    """Return the coefficients of the cubic between the middle ones of four values [m]; `most` as in `_tangent`."""
    rise = v2 - v1
    m1, m2 = _tangent(v1 - v0, rise, most), _tangent(rise, v3 - v2, most)
    return m1, 3.0 * rise - 2.0 * m1 - m2, m1 + m2 - 2.0 * rise


@inner
def _smooth_cubic(v0, v1, v2, v3):
    """Return the coefficients of the cubic between the middle ones of four derivatives: no slope is limited."""
    rise, m1, m2 = v2 - v1, 0.5 * (v2 - v0), 0.5 * (v3 - v1)
    return m1, 3.0 * rise - 2.0 * m1 - m2, m1 + m2 - 2.0 * rise


@inner
def slopes_at(values, dx, dy, x, y, around):
    """Return the slopes dz/dx and dz/dy at a point x, y [m]; parameters as in `_sample`, and scratch for one lane."""
    s, t = _look_around(values, dx, dy, x, y, 0, around)
    (a0, b0, _), (a1, b1, _), (a2, b2, _), (a3, b3, _) = _along_rows(around, 0, s, dx)
    m1, k2, k3 = _smooth_cubic(b0, b1, b2, b3)
    slope_x = (b1 + t * (m1 + t * (k2 + t * k3))) / dx
    m1, k2, k3 = _cubic(a0, a1, a2, a3, dy)
    return slope_x, (m1 + t * (2.0 * k2 + t * 3.0 * k3)) / dy
