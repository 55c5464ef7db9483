"""Quantities of maps: names, units in figures, colours and scales."""

from typing import NamedTuple

import numpy as np
import xarray as xr
from matplotlib.colors import Normalize

from ..core.errors import InputError
from ..core.hints import did_you_mean
from ..grid.fields import OUTPUT_PREFIX
from ..record.written_maps import LEAST_DEPTH, PEAK_DEPTH, mask_peaks
from .colours import linear_norm, log_norm
from .ground import elevation_change, on_increasing_axes

CHANGE = "elevation_change"
"""Name of the map that is made of several."""

LINEAR, DIVERGING, LOGARITHMIC, RATIO, TIME, PLAIN = "linear", "diverging", "logarithmic", "ratio", "time", "plain"
"""Scales: from 0, about 0, of powers of ten, from 0 to 1, of time, and from the smallest value."""


class Quantity(NamedTuple):
    """Quantity of a map: words, unit, colours and scale.

    Attributes
    ----------
    words : str
        Name in titles, with a capital letter.
    unit : str
        Unit in figures.
    colours : str
        Name of a matplotlib colour map.
    factor : float
        Factor by which values of the map are multiplied.
    scale : str
        ``linear`` from 0, ``diverging`` about 0, ``logarithmic``, ``ratio`` from 0 to 1, ``time``, or ``plain``.
    least : float
        Values of smaller magnitude are not shown, in the unit of the map.
    """

    words: str
    unit: str
    colours: str
    factor: float = 1.0
    scale: str = LINEAR
    least: float = 0.0


QUANTITIES = {
    "max_depth": Quantity("Peak depth", "m", "YlGnBu"),
    "max_speed": Quantity("Peak speed", "m/s", "YlOrRd"),
    "arrival_time": Quantity("Arrival", "s", "BuPu_r", scale=TIME),
    CHANGE: Quantity("Change of elevation", "m", "RdBu", scale=DIVERGING, least=LEAST_DEPTH),
    "max_basal_pressure_ratio": Quantity("Peak basal pressure ratio", "–", "BuGn", scale=RATIO),
    "max_basal_peclet_number": Quantity("Peak basal Péclet number", "–", "PuRd", scale=LOGARITHMIC),
    "eroded_depth": Quantity("Erosion", "m", "YlOrBr", least=LEAST_DEPTH),
    "deposit_depth": Quantity("Deposit", "m", "PuBu", least=LEAST_DEPTH),
    "max_impact_pressure": Quantity("Peak impact pressure", "kPa", "YlOrRd", 1e-3),
    "max_run_up": Quantity("Peak run-up", "m", "YlGnBu"),
    "depth": Quantity("Depth of the flow", "m", "YlGnBu", least=0.01),
    "speed": Quantity("Speed of the flow", "m/s", "YlOrRd", least=0.01),
    "solid_depth": Quantity("Depth of grains", "m", "YlOrBr", least=0.01),
    "solid_speed": Quantity("Speed of grains", "m/s", "YlOrRd", least=0.01),
    "water_speed": Quantity("Speed of water", "m/s", "YlGnBu", least=0.01),
    "basal_excess_pore_pressure": Quantity("Basal excess pore pressure", "kPa", "RdBu_r", 1e-3, DIVERGING, 10.0),
    "basal_peclet_number": Quantity("Basal Péclet number, last erosion", "–", "PuRd", scale=LOGARITHMIC),
    "release_depth": Quantity("Release", "m", "YlOrBr", least=0.01),
    "released_depth": Quantity("Release", "m", "YlOrBr", least=0.01),
    "soil__depth": Quantity("Depth of soil", "m", "YlGn", scale=PLAIN),
    "topographic__elevation": Quantity("Elevation of the ground", "m", "cividis", scale=PLAIN),
    "topographic__elevation_before": Quantity("Elevation of the ground before", "m", "cividis", scale=PLAIN),
}
"""Quantities by name, without ``debris_flow__``; other maps are shown by their attributes."""

OVERVIEW = "max_depth", "max_speed", "arrival_time", CHANGE, "max_basal_pressure_ratio", "max_basal_peclet_number"
"""Maps of an overview."""


class ShownMap(NamedTuple):
    """Values of a map as they are drawn.

    Attributes
    ----------
    name : str
        Name without ``debris_flow__``.
    values : xarray.DataArray
        Over ``y`` and ``x``, in `unit`; NaN where nothing is to be shown.
    quantity : Quantity
        Words, unit, colours and scale.
    """

    name: str
    values: xr.DataArray
    quantity: Quantity

    def norm(self, scar: xr.DataArray | None = None) -> Normalize:
        """Return the scale of the colours; the scar sets that of elevation changes only if all changes lie in it."""
        values, scale = [self.values.values], self.quantity.scale
        if self.name == CHANGE and scar is not None and np.isfinite(beyond := np.where(scar, np.nan, values[0])).any():
            values = [beyond]
        if scale == LOGARITHMIC:
            return log_norm(values)
        norm = linear_norm(values, diverging=scale == DIVERGING, from_zero=scale not in (TIME, PLAIN))
        if scale == RATIO and norm.vmax is not None and norm.vmax <= 1.0:
            norm.vmax = 1.0
        return norm


def map_names(maps: xr.Dataset) -> list[str]:
    """Return the names of all maps of a Dataset that can be drawn, maps of an overview first.

    Parameters
    ----------
    maps : xarray.Dataset
        As `DebrisFlow.maps` returns them, or read from their file.

    Returns
    -------
    list of str
        Without ``debris_flow__``.
    """
    own = [str(name).removeprefix(OUTPUT_PREFIX) for name, data in maps.items() if set(data.dims) == {"y", "x"}]
    made = [CHANGE] if {"eroded_depth", "deposit_depth"} & set(own) else []
    return list(dict.fromkeys([name for name in OVERVIEW if name in (*own, *made)] + own))


def shown_map(
    maps: xr.Dataset, name: str, *, before: xr.Dataset | xr.DataArray | None = None, least_depth: float = LEAST_DEPTH
) -> ShownMap:
    """Return a map as it is drawn: in its unit in figures, missing where there is nothing to show.

    Parameters
    ----------
    maps : xarray.Dataset
        As `DebrisFlow.maps` returns them, or read from their file.
    name : str
        Name of a map, with or without ``debris_flow__``, or ``elevation_change``.
    before : xarray.Dataset or xarray.DataArray, optional
        Maps or elevation before the event [m], for ``elevation_change``.
    least_depth : float
        Peaks and arrival are missing where the peak depth stayed below [m].

    Returns
    -------
    ShownMap

    Raises
    ------
    InputError
        If there is no such map, or it is not over ``y`` and ``x`` alone.
    """
    short = str(name).removeprefix(OUTPUT_PREFIX)
    names = map_names(maps)
    if short == CHANGE and short in names:
        values = elevation_change(maps, before)
    else:
        values = _of_name(maps, short, names, least_depth)
    quantity = QUANTITIES.get(short) or _declared(short, values)
    values = values.where(np.isfinite(values))
    if quantity.scale == DIVERGING and short != CHANGE and float(values.min()) > -0.01 * float(abs(values).max()):
        quantity = quantity._replace(scale=LINEAR, colours="BuGn")
    if quantity.scale == LOGARITHMIC:
        values = values.where(values > 0.0)
    elif quantity.scale == TIME:
        values = values.where(values >= 0.0)
    elif quantity.scale != PLAIN:
        values = values.where((abs(values) >= quantity.least) & (values != 0.0))
    if quantity.scale == TIME and float(values.max()) > LONG_TIME:
        quantity = quantity._replace(unit="min", factor=1.0 / 60.0)
    return ShownMap(short, values * quantity.factor, quantity)


def reached_nodes(maps: xr.Dataset, least_depth: float = LEAST_DEPTH) -> np.ndarray | None:
    """Return the nodes that a flow reached with a least depth [m], of bool, shape (rows, columns).

    None if there is none, or the maps have no peak depth.
    """
    if PEAK_DEPTH not in maps or set(maps[PEAK_DEPTH].dims) != {"y", "x"}:
        return None
    depth = on_increasing_axes(maps[PEAK_DEPTH]).values
    reached = (depth >= least_depth) & (depth > 0.0)
    return reached if reached.any() else None


LONG_TIME = 1200.0
"""Time above which arrival is told in minutes [s]."""


def _of_name(maps: xr.Dataset, short: str, names: list[str], least_depth: float) -> xr.DataArray:
    full = next((full for full in (OUTPUT_PREFIX + short, short) if full in maps), None)
    if full is None:
        raise InputError(f"plots: no map {short!r}{did_you_mean(short, names)}; there are {', '.join(names) or 'none'}")
    values = maps[full]
    if set(values.dims) != {"y", "x"}:
        further = ", ".join(str(dim) for dim in values.dims if dim not in ("y", "x")) or "no dimension"
        raise InputError(
            f"plots: a map is over y and x alone, {short} has {further}, too; choose one, such as "
            f"maps.isel({values.dims[0]}=-1)"
        )
    if PEAK_DEPTH in maps and "peaks_masked_below" not in maps.attrs:
        values = mask_peaks(maps[[PEAK_DEPTH] if full == PEAK_DEPTH else [PEAK_DEPTH, full]], least_depth)[full]
    return on_increasing_axes(values)


def _declared(short: str, values: xr.DataArray) -> Quantity:
    words = values.attrs.get("long_name") or short.replace("_", " ").strip()
    return Quantity(f"{words[:1].upper()}{words[1:]}", values.attrs.get("units", ""), "viridis", scale=PLAIN)
