"""Export of the maps that a run wrote as it went."""

import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import xarray as xr

from ..core.checks import require
from ..core.errors import InputError
from ..geo.geotiff import lattice_of, write_geotiff
from ..record.combine import combine_maps
from .directory import OutputDirectory
from .files import SERIES, SERIES_SUFFIX
from .results import Results


def export(path: str | Path, to: str = "netcdf") -> list[Path]:
    """Make one NetCDF file, one Zarr store, or GeoTIFFs of the maps that a run wrote as it went.

    Parameters
    ----------
    path : str or Path
        Directory of the results of a scene.
    to : {"netcdf", "zarr", "geotiff"}
        ``series.nc``, ``series.zarr``, or in the directory ``series`` a GeoTIFF for each variable and time, whose name
        ends with the time in seconds.

    Returns
    -------
    list of Path
        Files or the store, in the directory of the results.

    Raises
    ------
    InputError
        If there are no maps, or the format is not known.
    OutputError, OSError
        If a file cannot be written.
    """
    require(to in (*SERIES_SUFFIX, "geotiff"), "export: to", "be netcdf, zarr or geotiff", to, error=InputError)
    results = Results(Path(path))
    with OutputDirectory.claimed(results.directory) as directory:
        singles = any((directory.path / SERIES).glob("maps_*.nc"))
        if to == "geotiff":
            (directory.path / SERIES).mkdir(exist_ok=True)
            directory.expect(f"{SERIES}/*.tif")
            with _series(directory.path) as maps:
                return list(_geotiffs(directory.path / SERIES, maps, results.maps))
        name = f"{SERIES}{SERIES_SUFFIX[to]}"
        if singles:
            directory.publish(lambda folder: combine_maps(directory.path / SERIES, folder / name))
        elif not (directory.path / name).exists():
            with _series(directory.path) as maps:
                directory.publish(lambda folder: _convert(maps, folder / name))
        return [directory.path / name]


@contextmanager
def _series(directory: Path) -> Iterator[xr.Dataset]:
    """Open the maps over time in a directory; time steps are read one by one."""
    singles = directory / SERIES
    combined = [path for suffix in SERIES_SUFFIX.values() if (path := directory / f"{SERIES}{suffix}").exists()]
    if not combined and any(singles.glob("maps_*.nc")):
        combined = [combine_maps(singles, directory / f"{SERIES}.nc")]
    if not combined:
        raise InputError(
            f"{directory} holds no maps that were written as the run went; set output: interval in the scene and "
            "run it anew"
        )
    engine = "zarr" if combined[0].suffix == ".zarr" else "netcdf4"
    with xr.open_dataset(combined[0], engine=engine, decode_coords="all", chunks=None) as maps:
        yield maps


def _convert(maps: xr.Dataset, path: Path) -> None:
    """Write maps over time to a Zarr store, or to a NetCDF file."""
    for data in maps.variables.values():
        data.encoding = {}
    if path.suffix == ".nc":
        encoding = {name: {"zlib": True, "complevel": 1} for name, data in maps.items() if "time" in data.dims}
        maps.to_netcdf(path, engine="netcdf4", encoding=encoding)
        return
    for k in range(maps.sizes["time"]):
        kept = maps.isel(time=[k]) if k == 0 else maps.isel(time=[k]).drop_vars(_timeless(maps))
        kept.to_zarr(path, mode="w" if k == 0 else "a", append_dim="time" if k else None, consolidated=False)
    import zarr

    with warnings.catch_warnings():  # xarray looks for it first, zarr says that it is no part of its standard
        warnings.simplefilter("ignore")
        zarr.consolidate_metadata(path)


def _timeless(maps: xr.Dataset) -> list:
    return [name for name, data in maps.variables.items() if "time" not in data.dims and name not in maps.dims]


def _geotiffs(folder: Path, maps: xr.Dataset, whole: xr.Dataset) -> Iterator[Path]:
    """Write a GeoTIFF for each variable and time, over the grid of the maps of the end."""
    lattice = lattice_of(whole)
    rows, columns = (np.searchsorted(whole[axis], maps[axis].values - 1e-6) for axis in "yx")
    for k, time in enumerate(maps["time"].values):
        for name, data in maps.data_vars.items():
            if set(data.dims) == {"time", "y", "x"}:
                values = np.zeros(lattice.shape)
                values[np.ix_(rows, columns)] = data.isel(time=k).values
                words = data.attrs.get("long_name", str(name)), data.attrs.get("units", "")
                tags = {"elapsed_time": f"{time:.6g} s"}
                path = folder / f"{name}_{time:010.2f}s.tif"
                yield write_geotiff(path, values, lattice, description=words[0], unit=words[1], tags=tags)
