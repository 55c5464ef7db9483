"""Front of the flow against time, along a thalweg."""

from itertools import pairwise
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from ..core.checks import in_range
from ..core.errors import InputError
from .attributes import file_attributes, variable_attributes
from .follower import Follower
from .measures import quantile
from .places import check_on_grid, line


class Front(Follower):
    """Distance of the front along a thalweg against time.

    The distance of a particle is that of the nearest point of the thalweg; beyond an end of the thalweg it is the
    distance of that end. The front is the distance behind which a fraction of the volume lies, as in `measures`, so
    that single particles far ahead do not count.

    Parameters
    ----------
    thalweg : array_like, shape (n, 2)
        Map coordinates of its vertices, from the top down [m].
    interval : float
        Event time between two values [s].
    fraction : float
        Part of the volume that lies behind the front [-], in (0, 1].

    Raises
    ------
    InputError
        If the thalweg has no two vertices, the interval is not > 0 or the fraction is out of bounds; when the component
        is built, if the thalweg is outside its grid.
    """

    def __init__(self, thalweg: ArrayLike, interval: float, fraction: float = 0.99) -> None:
        super().__init__(interval)
        self.thalweg = line("Front: thalweg", thalweg)
        in_range("Front: fraction", fraction, 0.0, 1.0, open_ends=(True, False), error=InputError)
        self.fraction = float(fraction)

    def prepare(self, grid: Any, setup: Any) -> None:
        """Note the place of the grid on the map.

        Parameters
        ----------
        grid : RasterModelGrid
            Grid of the component.
        setup : Setup
            Laws, material, numerics and inflow.

        Raises
        ------
        InputError
            If the thalweg is outside the grid.
        """
        super().prepare(grid, setup)
        check_on_grid("Front: thalweg", self.thalweg, grid)

    def sample(self, particles: Any, time: float) -> None:
        """Find the front.

        Parameters
        ----------
        particles : Particles
            The particles now, at least one.
        time : float
            Elapsed time [s].
        """
        x0, y0 = self._lower_left
        distance = distance_along(self.thalweg, particles.x + x0, particles.y + y0)
        front, farthest = quantile(distance, particles.volume, self.fraction), int(np.argmax(distance))
        at_front = int(np.argmin(abs(distance - front)))
        self._rows.add(
            time, front_distance=front, farthest_distance=distance[farthest], front_elevation=particles.z[at_front]
        )

    @property
    def dataset(self) -> xr.Dataset:
        """Front over ``time`` [s]: ``front_distance``, ``farthest_distance`` [m], ``front_elevation`` [m].

        ``thalweg_x`` and ``thalweg_y`` over ``vertex`` are the line [m].
        """
        rows = self._rows.arrays()
        meanings = {
            "front_distance": f"distance along the thalweg behind which {100.0 * self.fraction:g} % of the volume lies",
            "farthest_distance": "distance along the thalweg of the farthest particle",
            "front_elevation": "elevation of the bed at the front",
        }
        data = {
            name: ("time", rows.get(name, np.empty(0)), variable_attributes("m", meanings[name])) for name in meanings
        }
        data |= {
            f"thalweg_{axis}": ("vertex", values, variable_attributes("m", f"{axis} of the thalweg, from the top down"))
            for axis, values in zip("xy", self.thalweg.T, strict=True)
        }
        return xr.Dataset(
            data, {"time": ("time", rows["time"], variable_attributes("s", "elapsed time"))}, file_attributes()
        )


def distance_along(thalweg: np.ndarray, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return the distance along a line of the point on it that is nearest to each of some points.

    Parameters
    ----------
    thalweg : ndarray, shape (m, 2)
        Vertices [m].
    x, y : ndarray, shape (n,)
        Points [m].

    Returns
    -------
    ndarray, shape (n,)
        Distance from the first vertex [m].

    Examples
    --------
    >>> distance_along(np.array([[0.0, 0.0], [3.0, 0.0], [3.0, 4.0]]), np.array([1.0, 5.0]), np.array([1.0, 2.0]))
    array([1., 5.])
    """
    nearest, distance, passed = np.full(x.size, np.inf), np.zeros(x.size), 0.0
    for first, last in pairwise(thalweg):
        along = last - first
        length = float(np.hypot(*along))
        dx, dy = x - first[0], y - first[1]
        way = np.clip((dx * along[0] + dy * along[1]) / length, 0.0, length)
        off = (dx - way * along[0] / length) ** 2 + (dy - way * along[1] / length) ** 2
        nearer = off < nearest
        nearest[nearer], distance[nearer] = off[nearer], passed + way[nearer]
        passed += length
    return distance
