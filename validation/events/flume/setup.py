"""Set-up of the USGS debris-flow flume: ground, release, sensors, and the runs of a set beside the measured series."""

from collections.abc import Iterator

import numpy as np
import xarray as xr
from landlab import RasterModelGrid
from scipy.interpolate import InterpolatedUnivariateSpline

from landlab_debrisflow import DebrisFlow

from ..sets import ParameterSet, read_set
from . import measured

GRAVITY = 9.81
SLOPE = np.radians(31.0)
"""Of the channel; thickness and pressure of the sensors are normal to it."""

TIMES = np.arange(601) * 0.05
"""Times of the series, from the moment at which the gate begins to open [s]."""

LONGEST = 60.0
"""Time at which a flow that still moves is left [s]."""

PAD_FROM = 76.0
"""Distance along the bed from which the deposit is kept; mapped deposits begin here [m]."""

STRAIGHT = (8.0, 77.0)
"""Distances between which the channel is straight and clear of the gate; a plug would stand there [m]."""

FIELDS = ("depth", "deposit_depth", "max_depth")
DEFAULT, PARTICLE_COUNT = "george_iverson_2014", 1000
BESIDE = ("measured_permeability", "no_dilatancy", "hydrostatic")
"""Sets whose runs are shown beside that of the default set."""

OTHER_START = 0.9
"""Start ratio of a second run of every set: the experiment had 0, a model without dilatancy has to be given it [-]."""


def run(parameters: ParameterSet, particle_count: int) -> xr.Dataset:
    """Compute a release with a set, with another start ratio, and with the sets shown beside the default one.

    Returns
    -------
    xarray.Dataset
        By ``run``: ``thickness`` [m] and ``pressure`` [Pa] over ``time`` [s] and ``station``; ``deposit``, vertical
        [m], over ``y`` and distance along the bed ``s``; ``largest_thickness`` in the straight channel [m], ``outflow``
        [m3], ``duration`` [s]. The measured series and deposits as `measured` returns them.
    """
    runs = {words: _run_one(each, particle_count) for words, each in _runs(parameters, particle_count)}
    names = xr.DataArray(list(runs), dims="run", name="run")
    found = xr.concat(list(runs.values()), names)
    return xr.merge([found, measured.read_series(TIMES), measured.read_deposits(found.s.values)], join="exact")


def _runs(parameters: ParameterSet, particle_count: int) -> Iterator[tuple[str, ParameterSet]]:
    """Yield words and sets; the set itself is first, and alone if it has a change."""
    yield parameters.name, parameters
    if parameters.change:
        return
    yield f"start ratio {OTHER_START}", parameters.changed("material", "initial_pressure_ratio", OTHER_START)
    if (parameters.name, particle_count) == (DEFAULT, PARTICLE_COUNT):
        for name in BESIDE:
            yield name, read_set(parameters.paths[0].parent, name)


def _run_one(parameters: ParameterSet, particle_count: int) -> xr.Dataset:
    """Compute a release; return its series, deposit and largest thickness."""
    grid = build_grid()
    along = distance_along_bed(grid.x_of_node[: grid.shape[1]])
    sensors, keywords = Sensors(along, grid.shape[0]), parameters.keywords()
    numerics = keywords.pop("numerics", {}) | {"particle_count": particle_count}
    flow = DebrisFlow(grid, **keywords, numerics=numerics, observers=[sensors])
    flow.run_until_rest(LONGEST)
    fields = {name: grid.at_node[f"debris_flow__{name}"].reshape(grid.shape) for name in FIELDS}
    pad, straight = along > PAD_FROM, (along > STRAIGHT[0]) & (along < STRAIGHT[1])
    cosine = 1.0 / np.gradient(along, grid.dx)
    y = grid.y_of_node.reshape(grid.shape)[:, 0]
    return xr.Dataset(
        sensors.series(parameters.plain("site")["gate_delay"]) | {
            "deposit": (("y", "s"), (fields["depth"] + fields["deposit_depth"])[:, pad], {"units": "m"}),
            "largest_thickness": ((), (fields["max_depth"] * cosine)[:, straight].max(), {"units": "m"}),
            "outflow": ((), flow.budget["outflow"], {"units": "m3"}),
            "duration": ((), flow.elapsed_time, {"units": "s"}),
        },
        {"time": ("time", TIMES, {"units": "s"}), "station": list(measured.STATIONS),
         "y": ("y", y, {"units": "m"}), "s": ("s", along[pad], {"units": "m"})},
    )  # fmt: skip


def build_grid() -> RasterModelGrid:
    """Build the flume: the prism on the bed behind the gate, side walls and the ground behind them closed."""
    grid = measured.read_raster("dem")
    bed, release = grid.at_node["dem"].astype(float), measured.read_raster("release_depth").at_node["release_depth"]
    release = np.where(bed == measured.NODATA, 0.0, release)
    # a release is taken out of the ground, and the file has the bed below it
    ground = np.where(bed == measured.NODATA, measured.NODATA, bed + release)
    grid.add_field("topographic__elevation", ground, at="node", units="m")
    grid.set_nodata_nodes_to_closed(bed, measured.NODATA)
    grid.add_field("soil__depth", release.copy(), at="node", units="m")
    grid.add_field("debris_flow__release_depth", release, at="node", units="m")
    return grid


def distance_along_bed(x: np.ndarray) -> np.ndarray:
    """Return the distance along the bed from the gate, s, of places on the map [m]; the end plane goes on."""
    table = measured.read_table("geometry")
    return InterpolatedUnivariateSpline(table["x_map_m"], table["s_m"], k=1)(x)


class Sensors:
    """Thickness and pore pressure at the stations against time.

    Mass at rest counts, unlike in `record.Gauges`: a laser does not ask whether the surface below it moves.
    """

    interval = float(TIMES[1])

    def __init__(self, along: np.ndarray, rows: int) -> None:
        at = np.interp(list(measured.STATIONS.values()), along, np.arange(along.size))
        column, self._right = np.divmod(at, 1.0)
        middle = along.size * np.array([rows // 2 - 1, rows // 2])  # the axis lies between two rows of nodes
        self._left_nodes = (middle[:, None] + column).astype(int)
        self._rows: list = []

    def _at_stations(self, values):
        left, right = (values[self._left_nodes + step].mean(axis=0) for step in (0, 1))
        return (1.0 - self._right) * left + self._right * right

    def observe(self, flow: DebrisFlow) -> None:
        """Read time [s], thickness [m] and total pore pressure at the base [Pa]."""
        at = flow.grid.at_node
        depth = at["debris_flow__depth"] + at["debris_flow__deposit_depth"]
        thickness = np.cos(SLOPE) * self._at_stations(depth)
        # weighted with the depth, because the pressure of a node without flow means nothing
        moment = np.cos(SLOPE) * self._at_stations(depth * at["debris_flow__basal_excess_pore_pressure"])
        excess = np.divide(moment, thickness, out=np.zeros_like(moment), where=thickness > 0.0)
        hydrostatic = flow.setup.material.water_density * GRAVITY * np.cos(SLOPE) * thickness
        self._rows.append((flow.elapsed_time, thickness, hydrostatic + excess))

    def series(self, delay: float) -> dict[str, tuple]:
        """Return ``thickness`` [m] and ``pressure`` [Pa] at `TIMES`, delayed by that of the gate [s]."""
        time, *columns = (np.array(each) for each in zip(*self._rows, strict=True))
        found = {}
        for name, unit, column in zip(("thickness", "pressure"), ("m", "Pa"), columns, strict=True):
            values = [np.interp(TIMES, time + delay, each, left=0.0) for each in column.T]
            found[name] = ("station", "time"), np.array(values), {"units": unit}
        return found
