"""Series at gauges, as of sensors over the bed."""

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from ..core.errors import InputError
from ..grid.fields import OUTPUT_PREFIX
from ..model.map_fields import SOLID_FRACTION
from ..spatial.raster import CORE
from .attributes import file_attributes, variable_attributes
from .follower import TimeRows, check_same_names
from .observers import check_interval
from .places import check_on_grid, named_places, point

MEANINGS = {
    "depth": ("m", "vertical depth of the flow"),
    "speed": ("m s-1", "speed along the bed"),
    "discharge_per_width": ("m2 s-1", "depth times speed"),
    "basal_excess_pore_pressure": ("Pa", "excess pore pressure at the base"),
    "solid_fraction": ("-", "volume of grains over that of the flow"),
    "bed_elevation": ("m", "elevation of the bed below the flow"),
}


class Gauges:
    """Depth, speed, discharge per width, basal pore pressure, solids and bed at points, against time.

    Depth and elevation are interpolated between the four nodes around a point (bilinear, without nodes that hold no
    flow); speed, pressure and solids are means weighted with the depth there, NaN while it is dry.

    Parameters
    ----------
    points : mapping of str to array_like, shape (2,), or iterable of pairs
        Map coordinates of each gauge, by name [m].
    interval : float
        Event time between two values [s].

    Raises
    ------
    InputError
        If a point is not two numbers, a name is there twice, the interval is not > 0; when the component is built, if a
        gauge is outside its grid or among nodes that hold no flow.
    """

    def __init__(self, points: Mapping[str, ArrayLike] | Iterable[Any], interval: float) -> None:
        self.interval = check_interval(interval, type(self).__name__)
        named = named_places("Gauges", points)
        self.points = {name: point(f"Gauges: {name!r}", place) for name, place in named.items()}
        self._rows = TimeRows()
        self._nodes, self._weights, self._setup = np.empty((0, 4), int), np.empty((0, 4)), None

    def prepare(self, grid: Any, setup: Any) -> None:
        """Find the nodes around each gauge.

        Parameters
        ----------
        grid : RasterModelGrid
            Grid of the component.
        setup : Setup
            Laws, material, numerics and inflow.

        Raises
        ------
        InputError
            If a gauge is outside the grid or among nodes that hold no flow.
        """
        found = [_around(grid, name, place) for name, place in self.points.items()]
        self._nodes, self._weights = (
            np.array([nodes for nodes, _ in found]),
            np.array([weights for _, weights in found]),
        )
        self._setup = setup

    def observe(self, flow: Any) -> None:
        """Read the gauges.

        Parameters
        ----------
        flow : DebrisFlow
            The component after a step.
        """
        at, weights = flow.grid.at_node, self._weights

        def around(name):
            return np.asarray(at[name])[self._nodes]

        depth = around(f"{OUTPUT_PREFIX}depth")
        mean_depth = np.sum(weights * depth, axis=1)

        def flow_mean(values):
            amount = np.sum(weights * depth * values, axis=1)
            return np.divide(amount, mean_depth, out=np.full(mean_depth.shape, np.nan), where=mean_depth > 0.0)

        speed = flow_mean(around(f"{OUTPUT_PREFIX}speed"))
        self._rows.add(
            flow.elapsed_time, depth=mean_depth, speed=speed,
            discharge_per_width=np.where(mean_depth > 0.0, mean_depth * speed, 0.0),
            basal_excess_pore_pressure=flow_mean(around(f"{OUTPUT_PREFIX}basal_excess_pore_pressure")),
            solid_fraction=flow_mean(_solid_fraction(self._setup, depth, around)),
            bed_elevation=np.sum(weights * around("topographic__elevation"), axis=1),
        )  # fmt: skip

    @property
    def dataset(self) -> xr.Dataset:
        """Series over ``time`` [s] and ``gauge``, with the map coordinates ``x`` and ``y`` of the gauges [m]."""
        rows, names = self._rows.arrays(), list(self.points)
        nothing, places = np.empty((0, len(names))), np.array(list(self.points.values()))
        data = {
            name: (("time", "gauge"), rows.get(name, nothing), variable_attributes(unit, words))
            for name, (unit, words) in MEANINGS.items()
        }
        coordinates = {
            "time": ("time", rows["time"], variable_attributes("s", "elapsed time")),
            "gauge": ("gauge", np.array(names, object), {"long_name": "name of the gauge"}),
            "x": ("gauge", places[:, 0], variable_attributes("m", "map coordinate of the grid")),
            "y": ("gauge", places[:, 1], variable_attributes("m", "map coordinate of the grid")),
        }
        return xr.Dataset(data, coordinates, file_attributes())

    def state(self) -> dict[str, Any]:
        """Return the series so far by name, for a checkpoint."""
        return self._rows.arrays() | {"names": "\n".join(self.points)}

    def restore(self, state: Mapping[str, Any]) -> None:
        """Go on after the series of a checkpoint.

        Parameters
        ----------
        state : mapping
            As `state` returned it.

        Raises
        ------
        InputError
            If it is of other gauges.
        """
        check_same_names("Gauges", state, self.points)
        self._rows.restore({name: values for name, values in state.items() if name != "names"})


def _solid_fraction(setup, depth, around):
    """Return the volume of grains over that of the flow at nodes, of the shape of `depth` [m] there [-].

    `around` returns the values of a field at these nodes, by its name.
    """
    if setup.has_dilatancy:
        return around(OUTPUT_PREFIX + SOLID_FRACTION)
    if setup.two_phases:
        grains = around(f"{OUTPUT_PREFIX}solid_depth")
        return np.divide(grains, depth, out=np.zeros(depth.shape), where=depth > 0.0)
    return np.full(depth.shape, 1.0 - setup.material.porosity)


def _around(grid, name, place):
    """Return the four nodes around a point, `place` (2,) [m], and their weights, 0 for nodes that hold no flow."""
    (rows, columns), spacing = grid.shape, np.array([grid.dx, grid.dy])
    check_on_grid(f"Gauges: {name!r}", place[None], grid)
    low = np.array(grid.xy_of_lower_left)
    column, row = np.minimum(((place - low) / spacing).astype(int), (columns - 2, rows - 2))
    x, y = (place - low) / spacing - (column, row)
    nodes = row * columns + column + np.array([0, 1, columns, columns + 1])
    weights = np.array([(1 - x) * (1 - y), x * (1 - y), (1 - x) * y, x * y])
    weights = np.where(np.asarray(grid.status_at_node)[nodes] == CORE, weights, 0.0)
    if (total := weights.sum()) <= 0.0:
        raise InputError(
            f"Gauges: {name!r} at ({place[0]:.10g}, {place[1]:.10g}) m is among closed or boundary nodes, which hold "
            "no flow; move it by a node spacing"
        )
    return nodes, weights / total
