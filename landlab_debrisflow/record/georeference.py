"""Place of maps on the earth: the coordinate reference system in a Dataset, after the CF conventions."""

from typing import Any

import xarray as xr

from ..core.errors import InputError

GRID_MAPPING = "spatial_ref"
"""Name of the variable that holds the coordinate reference system: the one that rioxarray looks for."""


def grid_mapping_attributes(crs: str) -> dict[str, Any]:
    """Return the attributes of a grid mapping: the system as WKT, and after CF if pyproj is installed.

    Parameters
    ----------
    crs : str
        Coordinate reference system as WKT; with pyproj any text that it knows, such as ``"EPSG:32633"``.

    Returns
    -------
    dict

    Raises
    ------
    InputError
        If pyproj does not know the system.
    """
    if not isinstance(crs, str):
        raise InputError(f"crs must be a text, WKT or such as 'EPSG:32633', got {crs!r}")
    try:
        from pyproj import CRS
        from pyproj.exceptions import CRSError
    except ImportError:
        return {"crs_wkt": crs, "spatial_ref": crs}
    try:
        system = CRS.from_user_input(crs)
    except CRSError as error:
        raise InputError(f"crs: no such coordinate reference system, got {crs!r}; give WKT or 'EPSG:number'") from error
    wkt = system.to_wkt()
    return system.to_cf() | {"crs_wkt": wkt, "spatial_ref": wkt}  # GDAL reads the second attribute


def georeferenced(dataset: xr.Dataset, crs: str | None) -> xr.Dataset:
    """Return a Dataset over ``y`` and ``x`` with a grid mapping, which GIS programs and rioxarray read.

    Parameters
    ----------
    dataset : xarray.Dataset
        Maps; it is not changed.
    crs : str or None
        Coordinate reference system, see `grid_mapping_attributes`; None: the Dataset comes back as it is.

    Returns
    -------
    xarray.Dataset

    Raises
    ------
    InputError
        If the system is not known.

    Examples
    --------
    >>> maps = xr.Dataset({"depth": (("y", "x"), [[1.0, 2.0]])}, {"y": [0.0], "x": [0.0, 5.0]})
    >>> placed = georeferenced(maps, "EPSG:32633")
    >>> placed.depth.attrs["grid_mapping"], placed.spatial_ref.attrs["crs_wkt"][:7]
    ('spatial_ref', 'PROJCRS')
    """
    if crs is None:
        return dataset
    mapped = {
        name: data.assign_attrs(grid_mapping=GRID_MAPPING)
        for name, data in dataset.data_vars.items() if {"y", "x"} <= set(data.dims)
    }  # fmt: skip
    return dataset.assign(mapped).assign_coords({GRID_MAPPING: ((), 0, grid_mapping_attributes(crs))})


def crs_of(dataset: xr.Dataset) -> str | None:
    """Return the coordinate reference system of a Dataset as WKT, None if it holds none.

    Parameters
    ----------
    dataset : xarray.Dataset
        As `georeferenced` returns it, or as read from a file.

    Returns
    -------
    str or None
    """
    held = dataset.variables.get(GRID_MAPPING)
    return None if held is None else held.attrs.get("crs_wkt")
