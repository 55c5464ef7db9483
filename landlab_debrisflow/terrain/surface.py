"""A C1 surface through the nodes of a raster: elevation, gradient and Hessian in one read.

Catmull-Rom cubic convolution (Keys 1981) on 4 x 4 nodes: it passes through the nodes, reproduces
quadratics exactly, and needs no global solve, so moving one node changes only its surroundings.
"""

import numpy as np

from ..core.jit import kernel


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
        values = np.array(elevation, float)
        if invalid is not None and invalid.any():
            values = _fill(values, invalid)
        self.values = np.pad(values, 1, mode="reflect", reflect_type="odd")  # linear beyond the edge

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

    def read_elevation(self, x, y, z) -> None:
        """Write the elevation [m] at points [m from the lower left node] to the first places of `z`."""
        _elevation(self.values, self.dx, self.dy, x, y, z)

    def sample(self, x, y):
        """Read the surface at points [m from the lower left node].

        Returns
        -------
        ndarray, shape (6, n)
            z, dz/dx, dz/dy, d2z/dx2, d2z/dxdy, d2z/dy2.

        Examples
        --------
        >>> import numpy as np
        >>> yy, xx = np.mgrid[0.0:5.0, 0.0:6.0]
        >>> surface = Surface(xx**2 - 2.0 * xx * yy, (1.0, 1.0))
        >>> surface.sample(np.array([2.5]), np.array([1.25])).ravel()
        array([ 0. ,  2.5, -5. ,  2. , -2. ,  0. ])
        """
        out = np.empty((6, np.size(x)))
        _sample(self.values, self.dx, self.dy, x, y, out)
        return out


def _fill(values, invalid):
    """Extrapolate linearly into invalid nodes from valid ones, two rings deep (all a read can reach).

    What lies beyond is set to the mean of the valid nodes; nothing ever reads it.
    """
    values, valid = values.copy(), ~invalid
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


@kernel
def _elevation(values, dx, dy, x, y, z):
    rows, columns = values.shape[0] - 2, values.shape[1] - 2
    for i in range(x.size):
        p, q = x[i] / dx, y[i] / dy
        c, r = min(max(int(np.floor(p)), 0), columns - 2), min(max(int(np.floor(q)), 0), rows - 2)
        s, t = p - c, q - r
        # weights of the four nodes -1, 0, 1, 2, as below
        a0, a3 = s * (-0.5 + s * (1.0 - 0.5 * s)), s * s * (-0.5 + 0.5 * s)
        a1, a2 = 1.0 + s * s * (-2.5 + 1.5 * s), s * (0.5 + s * (2.0 - 1.5 * s))
        b0, b3 = t * (-0.5 + t * (1.0 - 0.5 * t)), t * t * (-0.5 + 0.5 * t)
        b1, b2 = 1.0 + t * t * (-2.5 + 1.5 * t), t * (0.5 + t * (2.0 - 1.5 * t))
        total = 0.0
        for k in range(4):
            b = b0 if k == 0 else b1 if k == 1 else b2 if k == 2 else b3
            row = r + k
            total += b * (
                a0 * values[row, c] + a1 * values[row, c + 1] + a2 * values[row, c + 2] + a3 * values[row, c + 3]
            )
        z[i] = total


@kernel
def _sample(values, dx, dy, x, y, out):
    rows, columns = values.shape[0] - 2, values.shape[1] - 2
    w, d, s = np.empty((2, 4)), np.empty((2, 4)), np.empty((2, 4))
    for i in range(x.size):
        p, q = x[i] / dx, y[i] / dy
        c, r = min(max(int(np.floor(p)), 0), columns - 2), min(max(int(np.floor(q)), 0), rows - 2)
        for axis in range(2):
            t = p - c if axis == 0 else q - r
            # weights of the four nodes -1, 0, 1, 2 (Keys, a = -1/2), their first and second derivatives
            w[axis, 0] = t * (-0.5 + t * (1.0 - 0.5 * t))
            w[axis, 1] = 1.0 + t * t * (-2.5 + 1.5 * t)
            w[axis, 2] = t * (0.5 + t * (2.0 - 1.5 * t))
            w[axis, 3] = t * t * (-0.5 + 0.5 * t)
            d[axis, 0] = -0.5 + t * (2.0 - 1.5 * t)
            d[axis, 1] = t * (-5.0 + 4.5 * t)
            d[axis, 2] = 0.5 + t * (4.0 - 4.5 * t)
            d[axis, 3] = t * (-1.0 + 1.5 * t)
            s[axis, 0] = 2.0 - 3.0 * t
            s[axis, 1] = -5.0 + 9.0 * t
            s[axis, 2] = 4.0 - 9.0 * t
            s[axis, 3] = -1.0 + 3.0 * t
        z, zx, zy, zxx, zxy, zyy = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
        for b in range(4):
            f, fx, fxx = 0.0, 0.0, 0.0
            for a in range(4):
                v = values[r + b, c + a]
                f += w[0, a] * v
                fx += d[0, a] * v
                fxx += s[0, a] * v
            z += w[1, b] * f
            zx += w[1, b] * fx
            zxx += w[1, b] * fxx
            zy += d[1, b] * f
            zxy += d[1, b] * fx
            zyy += s[1, b] * f
        out[0, i], out[1, i], out[2, i] = z, zx / dx, zy / dy
        out[3, i], out[4, i], out[5, i] = zxx / (dx * dx), zxy / (dx * dy), zyy / (dy * dy)
