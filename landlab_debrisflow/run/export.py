"""Export of the maps that a run wrote as it went."""

from collections.abc import Iterator
from pathlib import Path

import xarray as xr

from ..core.checks import require
from ..core.errors import InputError
from ..geo.geotiff import lattice_of, write_geotiff
from ..record.combine import combine_maps
from .directory import OutputDirectory
from .files import SERIES
from .results import Results

SUFFIX = {"netcdf": ".nc", "zarr": ".zarr"}


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
    require(to in (*SUFFIX, "geotiff"), "export: to", "be netcdf, zarr or geotiff", to, error=InputError)
    results = Results(Path(path))
    folder = results.directory / SERIES
    files = sorted(folder.glob("maps_*.nc"))
    if not files:
        raise InputError(
            f"{results.directory} holds no maps that were written as the run went; set output: interval in the scene "
            "and run it anew"
        )
    with OutputDirectory.claimed(results.directory) as directory:
        if to == "geotiff":
            directory.expect(f"{SERIES}/*.tif")
            return list(_geotiffs(files, results.maps))
        target = results.directory / f"{SERIES}{SUFFIX[to]}"
        directory.expect(target.name)
        return [combine_maps(folder, target)]


def _geotiffs(files: list[Path], whole: xr.Dataset) -> Iterator[Path]:
    """Write a GeoTIFF for each variable of files, over the grid of the maps of the end."""
    lattice = lattice_of(whole)
    for file in files:
        with xr.open_dataset(file, decode_coords="all") as maps:
            time = float(maps["time"])
            placed = maps.load().reindex(y=whole.y, x=whole.x, method="nearest", tolerance=1e-6, fill_value=0.0)
        for name, data in placed.data_vars.items():
            if set(data.dims) == {"y", "x"}:
                words = data.attrs.get("long_name", str(name)), data.attrs.get("units", "")
                target = file.parent / f"{name}_{time:010.2f}s.tif"
                tags = {"elapsed_time": f"{time:.6g} s"}
                yield write_geotiff(target, data.values, lattice, description=words[0], unit=words[1], tags=tags)
