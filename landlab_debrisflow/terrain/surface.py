"""A C1 surface through the nodes of a raster: elevation, gradient and Hessian in one read.

Catmull-Rom cubic convolution (Keys 1981) on 4 x 4 nodes: it passes through the nodes, reproduces
quadratics exactly, and needs no global solve, so moving one node changes only its surroundings. At
cliffs its slopes are limited.
"""

from typing import NamedTuple

import numpy as np

from ..core.jit import inner, kernel


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
        self._extend()

    def move_to(self, nodes, elevation):
        """Set the elevation [m] of nodes given by their flat index."""
        v = self.values
        if _set(v, nodes, elevation):
            self._extend()

    def _extend(self) -> None:
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


@kernel
def _set(values, nodes, elevation):
    """Set nodes; return whether any lies so near the edge that the rim depends on it."""
    rows, columns = values.shape[0] - 2, values.shape[1] - 2
    edge = False
    for k in range(nodes.size):
        r, c = nodes[k] // columns, nodes[k] % columns
        values[r + 1, c + 1] = elevation[k]
        edge |= r < 2 or c < 2 or r > rows - 3 or c > columns - 3
    return edge


@inner
def _tangent(before, after, most):
    """Return the slope per node at a node, from the differences to the nodes before and after.

    Their mean (Keys), where the surface bends by less than `most`. Sharper bends than that, 45 degrees, are
    cliffs: there the mean overshoots and builds a dam along the edge, 7 % of the cliff high. The slope goes over
    to that of a monotone surface (Fritsch & Carlson 1980) until the bend is twice as sharp.
    """
    mean, bend = 0.5 * (before + after), abs(after - before)
    if bend <= most:
        return mean
    limited = 0.0
    if before * after > 0.0:
        steepest = 3.0 * min(abs(before), abs(after))
        limited = min(max(mean, -steepest), steepest)
    sharp = min(bend / most - 1.0, 1.0)
    return mean + sharp * (limited - mean)


@inner
def _between(v0, v1, v2, v3, s, most):
    """Return the value at `s` between the middle ones of four values in a row [m]; `most` as in `_tangent`."""
    rise = v2 - v1
    m1, m2 = _tangent(v1 - v0, rise, most), _tangent(rise, v3 - v2, most)
    k2, k3 = 3.0 * rise - 2.0 * m1 - m2, m1 + m2 - 2.0 * rise
    return v1 + s * (m1 + s * (k2 + s * k3))


@kernel
def _elevation(values, dx, dy, x, y, elevation):
    """Write the elevation of points [m], as `_sample` does; parameters as there."""
    rows, columns = values.shape[0] - 2, values.shape[1] - 2
    v = np.empty(4)  # on four rows
    for i in range(x.size):
        p, q = x[i] / dx, y[i] / dy
        c, r = min(max(int(np.floor(p)), 0), columns - 2), min(max(int(np.floor(q)), 0), rows - 2)
        for b in range(4):
            v[b] = _between(
                values[r + b, c], values[r + b, c + 1], values[r + b, c + 2], values[r + b, c + 3], p - c, dx
            )  # fmt: skip
        elevation[i] = _between(v[0], v[1], v[2], v[3], q - r, dy)


@kernel
def _sample(values, dx, dy, x, y, sample):
    """Write the `SurfaceSample` of points x, y, shape (n,) [m], from node values with their rim [m].

    `values`, shape (rows + 2, columns + 2), are elevations with one more node on every side; `dx`, `dy` are node
    spacings [m]; `sample` is written.
    """
    elevation, slope_x, slope_y, curvature_xx, curvature_xy, curvature_yy = sample
    f = np.empty((3, 4))
    for i in range(x.size):
        z, zx, zy, zxx, zxy, zyy = read_point(values, dx, dy, x[i], y[i], f)
        elevation[i], slope_x[i], slope_y[i] = z, zx, zy
        curvature_xx[i], curvature_xy[i], curvature_yy[i] = zxx, zxy, zyy


@inner
def read_point(values, dx, dy, x, y, f):
    """Return elevation [m], slopes [-] along x and y, and curvatures [m-1] along xx, xy and yy at a point x, y [m].

    `values`, `dx`, `dy` as in `_sample`; `f`, shape (3, 4), is scratch. What a caller does not use is not computed.
    """
    rows, columns = values.shape[0] - 2, values.shape[1] - 2
    p, q = x / dx, y / dy
    c, r = min(max(int(np.floor(p)), 0), columns - 2), min(max(int(np.floor(q)), 0), rows - 2)
    s, t = p - c, q - r
    for b in range(4):  # on four rows: value, first and second derivative along x, per node
        v0, v1, v2, v3 = values[r + b, c], values[r + b, c + 1], values[r + b, c + 2], values[r + b, c + 3]
        rise = v2 - v1
        m1, m2 = _tangent(v1 - v0, rise, dx), _tangent(rise, v3 - v2, dx)
        k2, k3 = 3.0 * rise - 2.0 * m1 - m2, m1 + m2 - 2.0 * rise
        f[0, b] = v1 + s * (m1 + s * (k2 + s * k3))
        f[1, b] = m1 + s * (2.0 * k2 + s * 3.0 * k3)
        f[2, b] = 2.0 * k2 + s * 6.0 * k3
    rise = f[0, 2] - f[0, 1]
    m1, m2 = _tangent(f[0, 1] - f[0, 0], rise, dy), _tangent(rise, f[0, 3] - f[0, 2], dy)
    k2, k3 = 3.0 * rise - 2.0 * m1 - m2, m1 + m2 - 2.0 * rise
    z = f[0, 1] + t * (m1 + t * (k2 + t * k3))
    zy, zyy = (m1 + t * (2.0 * k2 + t * 3.0 * k3)) / dy, (2.0 * k2 + t * 6.0 * k3) / (dy * dy)
    rise, m1, m2 = f[1, 2] - f[1, 1], 0.5 * (f[1, 2] - f[1, 0]), 0.5 * (f[1, 3] - f[1, 1])
    k2, k3 = 3.0 * rise - 2.0 * m1 - m2, m1 + m2 - 2.0 * rise
    zx = (f[1, 1] + t * (m1 + t * (k2 + t * k3))) / dx
    zxy = (m1 + t * (2.0 * k2 + t * 3.0 * k3)) / (dx * dy)
    rise, m1, m2 = f[2, 2] - f[2, 1], 0.5 * (f[2, 2] - f[2, 0]), 0.5 * (f[2, 3] - f[2, 1])
    k2, k3 = 3.0 * rise - 2.0 * m1 - m2, m1 + m2 - 2.0 * rise
    zxx = (f[2, 1] + t * (m1 + t * (k2 + t * k3))) / (dx * dx)
    return z, zx, zy, zxx, zxy, zyy
