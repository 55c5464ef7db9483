"""Rasters in NetCDF files."""

from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
from rasterio.crs import CRS

from . import ground
from .odd import HOSTILE, NUMBERS, one


def write(rng: np.random.Generator, path: Path, values: np.ndarray, change: bool) -> str:
    """Write a NetCDF file of varied layout, with one change if asked for; return the change as text."""
    rows, columns = values.shape
    layout: dict[str, Any] = {
        "x": ground.WEST + (np.arange(columns) + 0.5) * ground.SPACING,
        "y": ground.SOUTH + (np.arange(rows) + 0.5) * ground.SPACING,
        "names": ("y", "x"), "dtype": one(rng, ("f4", "f8")),
        "format": one(rng, ("NETCDF4", "NETCDF4", "NETCDF3_CLASSIC", "NETCDF3_64BIT_OFFSET")),
        "fill": one(rng, (None, -9999.0)), "units": {"x": "m", "y": "m", "z": one(rng, ("m", None, "metre"))},
        "attributes": {},
        "wkt": CRS.from_epsg(ground.CODE).to_wkt(), "name": one(rng, ("elevation", "Band1", "z")), "extra": None,
        "dimensions": 2, "axis_names": True,
    }  # fmt: skip
    if rng.random() < 0.4:
        layout["y"], values = layout["y"][::-1], values[::-1]
    done = _change(rng, layout, values := values.copy()) if change else "nothing"
    try:
        _write(path, layout, values)
    except Exception as error:  # the library does not write all that is asked for
        return f"{done} (not written: {error})"
    return done


def _change(rng: np.random.Generator, layout: dict[str, Any], values: np.ndarray) -> str:
    way = int(rng.integers(12))
    if way == 0:
        axis, k = one(rng, "xy"), int(rng.integers(6))
        edge = layout[axis].copy()
        layout[axis] = (
            edge[::-1], edge**1.01, np.zeros_like(edge), np.where(np.arange(edge.size) == 3, np.nan, edge),
            edge * 1e300,
            np.roll(edge, 1),
        )[k]  # fmt: skip
        return f"{axis} odd, {k}"
    if way == 1:
        layout["names"] = one(
            rng, (("lat", "lon"), ("northing", "easting"), ("Y", "X"), ("x", "y"), ("row", "column"), ("time", "x"))
        )
        return f"axes named {layout['names']}"
    if way == 2:
        layout["axis_names"] = False
        return "no coordinates"
    if way == 3:
        layout["dtype"] = one(rng, ("i1", "u1", "i2", "i4", "i8", "u8", "S1", str))
        layout["fill"] = None
        layout["format"] = "NETCDF4"
        return f"dtype {layout['dtype']}"
    if way == 4:
        layout["fill"] = one(rng, (0.0, float("nan"), 1e30, 700.0, 1.0))
        return f"fill {layout['fill']}"
    if way in (5, 6):
        name = one(
            rng,
            ("scale_factor", "add_offset", "valid_min", "valid_range", "missing_value", "grid_mapping", "coordinates"),
        )
        numeric = name not in ("grid_mapping", "coordinates") and rng.random() < 0.8
        layout["attributes"][name] = (
            float(np.clip(float(min(one(rng, NUMBERS), 1e300)), -1e300, 1e300)) if numeric else one(rng, HOSTILE[:12])
        )
        return f"{name} = {layout['attributes'][name]!r:.40}"
    if way == 7:
        axis = one(rng, "xyz")
        layout["units"][axis] = one(rng, ("feet", "degrees_east", "km", "1", "", "furlong", *HOSTILE[:8]))
        return f"units of {axis} = {layout['units'][axis]!r:.40}"
    if way == 8:
        layout["wkt"] = one(
            rng,
            (
                "",
                None,
                "EPSG:4326",
                CRS.from_epsg(4326).to_wkt(),
                CRS.from_epsg(2263).to_wkt(),
                layout["wkt"][:200],
                "nonsense",
            ),
        )
        return f"wkt {layout['wkt']!r:.40}"
    if way == 9:
        layout["dimensions"] = one(rng, (0, 1, 3, 4))
        return f"{layout['dimensions']} dimensions"
    if way == 10:
        layout["extra"] = one(rng, ("second", "group", "compound", "enum", "unlimited", "empty"))
        layout["format"] = "NETCDF4"
        return f"also {layout['extra']}"
    value = one(rng, NUMBERS)
    values[one(rng, (np.s_[0, 0], np.s_[:], np.s_[::2], np.s_[5, 5]))] = (
        float(max(min(value, 1e300), -1e300)) if isinstance(value, int) else value
    )
    return f"value {value!r:.30}"


def _write(path: Path, layout: dict[str, Any], values: np.ndarray) -> None:
    with netCDF4.Dataset(path, "w", format=layout["format"]) as file, np.errstate(all="ignore"):
        file.set_auto_maskandscale(False)
        extra, names = layout["extra"], layout["names"]
        for name, size in zip(names, values.shape, strict=True):
            file.createDimension(name, None if extra == "unlimited" and name == names[0] else size)
        for name, edge in zip(names, ("y", "x"), strict=True):
            if layout["axis_names"]:
                variable = file.createVariable(name, "f8", (name,))
                variable[:] = layout[edge]
                if layout["units"][edge] is not None:
                    variable.units = layout["units"][edge]
        dimensions: tuple[str, ...] = names[2 - min(layout["dimensions"], 2) :]
        for k in range(layout["dimensions"] - 2):
            file.createDimension(f"t{k}", 2)
            dimensions = (f"t{k}", *dimensions)
        if extra == "empty":
            file.createDimension("nothing", 0)
            dimensions = ("nothing", *dimensions)
        for name in (layout["name"], *(["second"] if extra == "second" else [])):
            variable = file.createVariable(name, layout["dtype"], dimensions, fill_value=layout["fill"])
            if layout["wkt"] is not None:
                variable.grid_mapping = "crs"
            for key, value in ({"units": layout["units"]["z"]} | layout["attributes"]).items():
                if value is not None:
                    variable.setncattr(key, value)
            shape = tuple(file.dimensions[one].size for one in dimensions)
            content = values if layout["dimensions"] > 1 else values[0]
            if layout["dtype"] is str:
                for at in np.ndindex(shape):
                    variable[at] = "1"
            elif layout["dtype"] == "S1":
                variable[:] = np.full(shape, b"1", "S1")
            else:
                variable[:] = np.broadcast_to(content, shape) if shape else content[0]
        if layout["wkt"] is not None:
            file.createVariable("crs", "i4").crs_wkt = layout["wkt"]
        if extra == "group":
            group = file.createGroup("inner")
            group.createVariable("deep", "f4", dimensions)[:] = values
        elif extra == "compound":
            kind = file.createCompoundType(np.dtype([("a", "f4"), ("b", "i4")]), "pair")
            file.createVariable("pairs", kind, dimensions)
        elif extra == "enum":
            kind = file.createEnumType(np.uint8, "colour", {"red": 0, "blue": 1})
            file.createVariable("colours", kind, dimensions, fill_value=0)
