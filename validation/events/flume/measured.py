"""Measured series and deposits of the flume, from the files of flume_sgm; their README says where they come from."""

import numpy as np
import xarray as xr
from landlab import RasterModelGrid
from landlab.io import esri_ascii

from ..data import find_file

FOLDER = "flume_sgm"
NODATA = -9999.0
STATIONS = {"2 m": 2.0, "32 m": 32.0, "66 m": 66.0}
"""Sensors on the axis of the channel: distance along the bed from the gate [m]."""

SERIES = {"thickness": ("2 m", "32 m", "66 m"), "pressure": ("32 m", "66 m")}
"""Stations at which each was measured."""

FILES = {"thickness": ("thickness_{:02.0f}m", "h_{}_m", 1.0),
         "pressure": ("basal_pore_pressure_{:02.0f}m", "p_{}_kPa", 1e3)}  # fmt: skip
"""Name of the file, of its columns, and factor to SI units."""

BOUNDS = ("mean", "lower", "upper")
"""Mean of the eight runs; mean less and plus one standard deviation."""

DEPOSITS = ("2000-09-28", "2001-09-13", "2002-09-12", "2002-09-17")
"""Experiments whose deposit was mapped."""

LAST_TIME = 20.0
"""Up to which series are compared [s]; at the end some runs are missing from the mean."""


def read_raster(name: str) -> RasterModelGrid:
    """Return a grid with the raster `name` as a node field of that name."""
    with open(find_file(FOLDER, f"{name}.asc"), encoding="utf-8") as stream:
        return esri_ascii.load(stream, at="node", name=name)


def read_table(name: str) -> np.ndarray:
    """Return a table of numbers with named columns."""
    return np.genfromtxt(find_file(FOLDER, f"{name}.csv"), delimiter=",", names=True)


def read_series(times: np.ndarray) -> xr.Dataset:
    """Read the measured series at some times [s].

    Returns
    -------
    xarray.Dataset
        ``measured_thickness`` [m] and ``measured_pressure``, total pore pressure at the base [Pa], over ``station``,
        ``bound`` and ``time``; NaN where nothing was measured.
    """
    data = {}
    for name, (file, column, factor) in FILES.items():
        values = np.full((len(STATIONS), len(BOUNDS), times.size), np.nan)
        for place, (station, distance) in enumerate(STATIONS.items()):
            if station in SERIES[name]:
                table = read_table(file.format(distance))
                for row, bound in enumerate(BOUNDS):
                    series = factor * table[column.format(bound)]
                    values[place, row] = np.interp(times, table["t_s"], series, right=np.nan)
        values[..., times > LAST_TIME] = np.nan
        data[f"measured_{name}"] = ("station", "bound", "time"), values
    return xr.Dataset(data, {"station": list(STATIONS), "bound": list(BOUNDS), "time": times})


def read_deposits(along: np.ndarray) -> xr.Dataset:
    """Read the mapped deposits on the last columns of the raster.

    Parameters
    ----------
    along : ndarray, shape (columns,)
        Distance along the bed of these columns [m].

    Returns
    -------
    xarray.Dataset
        ``mapped_deposit``, 1 where there was some, over ``experiment``, ``y`` and ``s``.
    """
    rasters = []
    for date in DEPOSITS:
        grid = read_raster(f"deposit_extent_{date}")
        rasters.append(grid.at_node[f"deposit_extent_{date}"].reshape(grid.shape)[:, -along.size :] > 0)
    y = grid.y_of_node.reshape(grid.shape)[:, 0]
    mapped = ("experiment", "y", "s"), np.array(rasters).astype("i1")
    return xr.Dataset({"mapped_deposit": mapped}, {"experiment": list(DEPOSITS), "y": y, "s": along})
