"""Set-up of the flume with an erodible bed: a control on rigid ground, a wet bed, a dry bed, and water contents."""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
import xarray as xr
from landlab import RasterModelGrid
from landlab.io import esri_ascii

from landlab_debrisflow import DebrisFlow

from ..data import find_file
from ..flume import measured
from ..flume.setup import SLOPE, TIMES, Sensors, distance_along_bed
from ..sets import ParameterSet

FOLDER = "flume_entrainment"
DEFAULT, PARTICLE_COUNT = "measured_pressure", 1000
LONGEST = 30.0
"""Time at which a flow that still moves is left: behind the deposit a tail creeps [s]."""

KINDS = ("control", "wet bed", "dry bed", "rigid bed of the same shape")
WATER_CONTENTS = (0.15, 0.17, 0.19, 0.21, 0.23, 0.25, 0.28)
"""Of beds by volume, over the range of the experiments, with which the default set is run, too [-]."""


class BedWater(NamedTuple):
    """Pore water of the bed of a run; None in `degree_of_saturation`: there is no erodible bed.

    Attributes
    ----------
    degree_of_saturation : float or None
        Water over pores [-].
    pressure_ratio : float
        Excess pore pressure over its liquefaction value [-].
    is_drain : bool
        Whether the bed takes the excess pressure out of the base of the flow.
    erodes : bool
        Whether the law of erosion of the set holds; else nothing erodes.
    """

    degree_of_saturation: float | None
    pressure_ratio: float = 0.0
    is_drain: bool = False
    erodes: bool = True


def run(parameters: ParameterSet, particle_count: int) -> xr.Dataset:
    """Compute the release without a bed, and over a wet, a dry and a rigid one; with the default set over more beds.

    Returns
    -------
    xarray.Dataset
        By ``run``: ``thickness`` [m] and ``pressure`` [Pa] over ``time`` [s] and ``station``; ``momentum`` [kg m/s] and
        ``eroded_volume`` [m3] over ``time``; ``eroded`` [m], normal to the bed, on the axis over ``time`` and distance
        along the bed ``s``; ``outflow`` [m3]. With the default set and its number of particles, by ``water_content``:
        ``thickness_by_content`` [m] and ``scour_by_content`` [m3].
    """
    beds = _beds(parameters, with_contents=particle_count == PARTICLE_COUNT)
    runs = {words: _run_one(parameters, particle_count, bed) for words, bed in beds}
    found = xr.concat([runs[words] for words in KINDS], xr.DataArray(list(KINDS), dims="run", name="run"))
    others = [words for words in runs if words not in KINDS]
    if not others:
        return found
    contents = xr.DataArray([float(words) for words in others], dims="water_content", name="water_content")
    series = xr.concat([runs[words] for words in others], contents)
    return found.assign(
        thickness_by_content=series.thickness, scour_by_content=series.eroded_volume.isel(time=-1, drop=True)
    )


def _beds(parameters: ParameterSet, with_contents: bool) -> Iterator[tuple[str, BedWater]]:
    """Yield the words of each run and the water of its bed."""
    site = parameters.plain("site")
    yield "control", BedWater(None)
    yield "wet bed", BedWater(site["wet_degree_of_saturation"], site["wet_pressure_ratio"])
    yield "dry bed", BedWater(site["dry_degree_of_saturation"], site["dry_pressure_ratio"], site["dry_bed_drains"] > 0)
    yield KINDS[3], BedWater(1.0, erodes=False)
    if with_contents and parameters.name == DEFAULT and not parameters.change:
        for content in WATER_CONTENTS:
            yield f"{content}", BedWater(content / site["saturated_water_content"], site["wet_pressure_ratio"])


def _run_one(parameters: ParameterSet, particle_count: int, bed: BedWater) -> xr.Dataset:
    """Compute a release over a bed; return its series."""
    grid = build_grid(bed)
    along = distance_along_bed(grid.x_of_node[: grid.shape[1]])
    sensors, meter, keywords = Sensors(along, grid.shape[0]), Meter(), parameters.keywords()
    numerics = keywords.pop("numerics", {}) | {"particle_count": particle_count}
    if not bed.erodes:
        keywords["erosion"] = "none"
    flow = DebrisFlow(grid, **keywords, numerics=numerics, observers=[sensors, meter])
    flow.run_until_rest(LONGEST)
    delay = parameters.plain("site")["gate_delay"]
    return xr.Dataset(
        sensors.series(delay) | meter.series(delay)
        | {"outflow": ((), flow.budget["outflow"], {"units": "m3"})},
        {"time": ("time", TIMES, {"units": "s"}), "station": list(measured.STATIONS),
         "s": ("s", along, {"units": "m"})},
    )  # fmt: skip


def build_grid(bed: BedWater) -> RasterModelGrid:
    """Build the flume with the prism behind the gate and, if it has water at all, the bed on the concrete."""
    grid = measured.read_raster("dem")
    concrete = grid.at_node["dem"].astype(float)
    flume = concrete != measured.NODATA
    release = np.where(flume, _read("release_depth"), 0.0)
    soil = np.where(flume & (bed.degree_of_saturation is not None), _read("soil_depth"), 0.0)
    grid.add_field("topographic__elevation", np.where(flume, concrete + soil + release, concrete), at="node", units="m")
    grid.set_nodata_nodes_to_closed(concrete, measured.NODATA)
    grid.add_field("soil__depth", soil + release, at="node", units="m")
    grid.add_field("debris_flow__release_depth", release, at="node", units="m")
    if bed.degree_of_saturation is not None:
        grid.add_full("bed__degree_of_saturation", bed.degree_of_saturation, at="node")
        grid.add_full("bed__excess_pore_pressure_ratio", bed.pressure_ratio, at="node")
        grid.add_field("bed__drained", (soil > 0.0) * float(bed.is_drain), at="node")
    return grid


def _read(name: str) -> np.ndarray:
    with open(find_file(FOLDER, f"{name}.asc"), encoding="utf-8") as stream:
        return esri_ascii.load(stream, at="node", name=name).at_node[name].astype(float)


class Meter:
    """Momentum of the flow and eroded depth on the axis of the channel against time."""

    interval = float(TIMES[1])

    def __init__(self) -> None:
        self._rows: list = []

    def observe(self, flow: DebrisFlow) -> None:
        """Read time [s], momentum [kg m/s], eroded volume [m3] and eroded depth on the axis, normal to the bed [m]."""
        p, grid = flow.particles, flow.grid
        speed = np.sqrt(p.velocity_x**2 + p.velocity_y**2 + p.velocity_z**2)
        eroded = grid.at_node["debris_flow__eroded_depth"].reshape(grid.shape)
        axis = grid.shape[0] // 2 + np.array([-1, 0])
        on_axis = np.cos(SLOPE) * eroded[axis].mean(axis=0)
        momentum = float((p.density * p.volume * speed).sum())
        self._rows.append((flow.elapsed_time, momentum, float(eroded.sum()) * grid.dx * grid.dy, on_axis))

    def series(self, delay: float) -> dict[str, tuple]:
        """Return the series at `TIMES`, delayed by that of the gate [s]."""
        time, momentum, volume, eroded = (np.array(each) for each in zip(*self._rows, strict=True))
        late = time + delay
        by_node = np.array([np.interp(TIMES, late, each, left=0.0) for each in eroded.T]).T
        return {
            "momentum": ("time", np.interp(TIMES, late, momentum, left=0.0), {"units": "kg m s-1"}),
            "eroded_volume": ("time", np.interp(TIMES, late, volume, left=0.0), {"units": "m3"}),
            "eroded": (("time", "s"), by_node, {"units": "m"}),
        }
