"""Rasters: GeoTIFF, ESRI ASCII grids, NetCDF, as elevation, soil or release of a scene."""

import warnings
from pathlib import Path
from typing import Any

import numpy as np
import rasterio
from affine import Affine

from . import ground, netcdf_files
from .odd import HOSTILE, NUMBERS, damaged, one
from .scenes import write_mapping

SUFFIXES = {"tiff": ".tif", "ascii": ".asc", "netcdf": ".nc"}


def write(rng: np.random.Generator, folder: Path, form: str) -> str:
    """Write a scene with a raster of some form; return the change as text."""
    ground.write_files(folder)
    kind = one(rng, ("tiff", "tiff", "ascii", "netcdf"))
    role = one(rng, ("elevation", "elevation", "elevation", "soil", "release"))
    name = "raster" + SUFFIXES[kind]
    terrain: dict[str, Any] = {"elevation": "dem.asc", "crs": f"EPSG:{ground.CODE}"}
    release: dict[str, Any] = {"polygons": [ground.block(3, 4)], "depth": 1.0}
    if role == "release":
        release = {"raster": name}
    else:
        terrain["elevation" if role == "elevation" else "soil_depth"] = name
    if role == "elevation" and rng.random() < 0.3:
        del terrain["crs"]
    values = ground.elevation() if role == "elevation" else np.full((ground.ROWS, ground.COLUMNS), 1.0)
    write_mapping(folder / "scene.yaml", {"terrain": terrain, "release": release, "numerics": {"particle_count": 60}})
    change = form == "one change"
    done = {"tiff": write_tiff, "ascii": write_ascii, "netcdf": netcdf_files.write}[kind](
        rng, folder / name, values, change
    )
    if form == "bytes":
        data, done = damaged(rng, (folder / name).read_bytes())
        (folder / name).write_bytes(data)
    return f"{kind} as {role}: {done}"


# ---- GeoTIFF ----


def write_tiff(rng: np.random.Generator, path: Path, values: np.ndarray, change: bool) -> str:
    """Write a GeoTIFF of varied layout, with one change of its content if asked for; return the change as text."""
    rows, columns = values.shape
    place = Affine(ground.SPACING, 0.0, ground.WEST, 0.0, -ground.SPACING, ground.SOUTH + rows * ground.SPACING)
    profile: dict[str, Any] = {
        "driver": "GTiff", "height": rows, "width": columns, "count": 1, "dtype": one(rng, ("float32", "float64")),
        "crs": f"EPSG:{ground.CODE}", "transform": place, "nodata": one(rng, (None, -9999.0, float("nan"))),
    }  # fmt: skip
    if rng.random() < 0.3:
        profile |= {"tiled": True, "blockxsize": 16, "blockysize": 16}
    if rng.random() < 0.3:
        profile |= {"compress": one(rng, ("lzw", "deflate", "zstd", "packbits")), "predictor": one(rng, (1, 2))}
    if rng.random() < 0.2:
        profile["BIGTIFF"] = "YES"
    band, done, after = values[::-1].copy(), "nothing", {}
    if change:
        done, profile, band, after = _changed_tiff(rng, profile, band)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            with rasterio.open(path, "w", **profile) as file:
                if band is not None:
                    with np.errstate(all="ignore"):
                        file.write(np.broadcast_to(band.astype(profile["dtype"]), (profile["count"], *band.shape)))
                for name, value in after.items():
                    _apply(file, name, value)
        except Exception as error:  # the library does not write all that is asked for
            return f"{done} (not written: {error})"
    return done


def _changed_tiff(rng: np.random.Generator, profile: dict[str, Any], band: np.ndarray):
    place, after, way = profile["transform"], {}, int(rng.integers(12))
    if way == 0:
        kinds = (
            "uint8", "int8", "int16", "uint16", "int32", "uint32", "int64", "uint64", "complex64", "complex128",
            "complex_int16", "float16",
        )  # fmt: skip
        profile["dtype"] = one(rng, kinds)
        profile["nodata"] = one(rng, (None, 0, 99))
        profile.pop("predictor", None)
        done = f"dtype {profile['dtype']}"
    elif way == 1:
        profile["nodata"] = one(rng, (0.0, 700.0, 1e20, -3.4028234663852886e38, float("inf"), -32768.0, 1e308, 1.0))
        done = f"nodata {profile['nodata']}"
    elif way in (2, 3):
        value, k = one(rng, NUMBERS), int(rng.integers(6))
        cells = (np.s_[0, 0], np.s_[:], np.s_[5, 5], np.s_[::2], np.s_[:, 3:6], np.s_[4:9, 2:9])[k]
        with np.errstate(all="ignore"):
            band[cells] = float(min(value, 1e300)) if isinstance(value, int) else value
        done = f"value {value!r:.30} at {k}"
    elif way in (4, 5):
        a, _, c, _, e, f = place[:6]
        choices = {
            "rotated": (a, 1.0, c, -1.0, e, f), "slightly rotated": (a, 1e-7, c, 1e-7, e, f),
            "south-up": (a, 0, c, 0, -e, f),
            "mirrored": (-a, 0, c, 0, e, f), "oblong": (a, 0, c, 0, 0.5 * e, f), "no width": (0, 0, c, 0, e, f),
            "huge": (1e9, 0, c, 0, -1e9, f), "tiny": (1e-9, 0, c, 0, -1e-9, f), "far": (a, 0, 1e15, 0, e, -1e15),
            "nan": (float("nan"), 0, c, 0, e, f), "inf": (a, 0, float("inf"), 0, e, f), "identity": (1, 0, 0, 0, 1, 0),
            "degrees": (5e-5, 0, 9.0, 0, -5e-5, 47.0), "moved": (a, 0, c + 0.3 * a, 0, e, f),
            "elsewhere": (a, 0, c + 1e5, 0, e, f),
            "coarser": (4 * a, 0, c, 0, 4 * e, f), "vertical": (0, a, c, e, 0, f), "vast": (1e300, 0, c, 0, -1e300, f),
        }  # fmt: skip
        done = one(rng, list(choices))
        profile["transform"] = Affine(*choices[done])
    elif way == 6:
        profile["crs"] = one(rng, (
            None, "EPSG:4326", "EPSG:2056", "EPSG:2263", "EPSG:6539", "EPSG:4978", "EPSG:3857", "EPSG:32632+5773",
            "EPSG:5773",
            'LOCAL_CS["here",UNIT["metre",1]]', 'LOCAL_CS["<b>[red]",UNIT["foot",0.3048]]', "EPSG:32760",
            "+proj=geos +h=35785831",
            "EPSG:32661", "EPSG:27700", "EPSG:2193", "OGC:CRS84", "ESRI:54009", "EPSG:4979",
        ))  # fmt: skip
        done = f"crs {profile['crs']}"
    elif way == 7:
        rows, columns = one(rng, ((1, 1), (1, 18), (14, 1), (2, 2), (3, 3), (4, 4), (200, 300)))
        profile |= {"height": rows, "width": columns}
        band = np.resize(band, (rows, columns))
        done = f"{rows} x {columns}"
    elif way == 8:
        rows = one(rng, (20_000, 60_000, 200_000, 2_000_000))
        profile |= {
            "height": rows,
            "width": rows,
            "SPARSE_OK": "TRUE",
            "tiled": True,
            "blockxsize": 512,
            "blockysize": 512,
        }
        profile.pop("compress", None)
        profile["BIGTIFF"] = "YES"
        band, done = None, f"{rows} x {rows}, empty"
    elif way == 9:
        profile["count"] = one(rng, (2, 3, 4, 50))
        done = f"{profile['count']} bands"
        if rng.random() < 0.5:
            profile |= {
                "dtype": "uint8",
                "nodata": None,
                "photometric": "RGB" if profile["count"] > 2 else "MINISBLACK",
            }
            profile.pop("predictor", None)
            done += ", a picture"
    elif way == 10:
        after["scale"] = one(rng, (0.0, float("nan"), 1e300, -1.0, 1e-300, 0.3048, float("inf")))
        done = f"scale {after['scale']}"
    else:
        name = one(rng, ("offset", "unit", "description", "tag", "mask", "colour"))
        after[name] = one(rng, NUMBERS) if name == "offset" else one(rng, ("ft", "feet", "cm", *HOSTILE))
        done = f"{name} {after[name]!r:.40}"
    return done, profile, band, after


def _apply(file: Any, name: str, value: Any) -> None:
    """Set what belongs to a file that is being written."""
    if name == "scale":
        file.scales = (value,) * file.count
    elif name == "offset":
        file.offsets = (float(value) if abs(value) < 1e300 else 1e300,) * file.count
    elif name == "unit":
        file.units = (value,) * file.count
    elif name == "description":
        file.descriptions = (value,) * file.count
    elif name == "tag":
        file.update_tags(AREA_OR_POINT="Point", name=value)
    elif name == "mask":
        file.write_mask(np.arange(file.width * file.height).reshape(file.height, file.width) % 3 > 0)
    else:
        file.colorinterp = (rasterio.enums.ColorInterp.alpha,) * file.count


# ---- ESRI ASCII ----

COUNTS = (
    "0",
    "-3",
    "1",
    "2",
    "17",
    "19",
    "1000000000",
    "99999999999999999999",
    "18.0",
    "18.5",
    "nan",
    "inf",
    "x",
    "",
    "1e1",
)
CELLS = (
    "nan",
    "inf",
    "-inf",
    "1e400",
    "-9999",
    "",
    "x",
    "1,5",
    "0x1p3",
    "1e-320",
    "1e30",
    "-1e30",
    "5 5",
    "*",
    "3.4028235e+38",
)


def write_ascii(rng: np.random.Generator, path: Path, values: np.ndarray, change: bool) -> str:
    """Write an ESRI ASCII grid of varied layout, with one change if asked for; return the change as text."""
    rows, columns = values.shape
    centre = rng.random() < 0.3
    where, shift = ("center", 0.5 * ground.SPACING) if centre else ("corner", 0.0)
    head = [
        ["ncols", f"{columns}"], ["nrows", f"{rows}"], [f"xll{where}", f"{ground.WEST + shift:.3f}"],
        [f"yll{where}", f"{ground.SOUTH + shift:.3f}"], ["cellsize", f"{ground.SPACING:g}"], ["NODATA_value", "-9999"],
    ]  # fmt: skip
    if rng.random() < 0.3:
        head = [[word.upper(), value] for word, value in head]
    cells = [[f"{v:.3f}" for v in row] for row in values[::-1]]
    end, done = one(rng, ("\n", "\r\n", " \n")), "nothing"
    if change:
        k, way = int(rng.integers(len(head))), int(rng.integers(8))
        if way < 3:
            head[k][1] = one(rng, COUNTS if k < 2 else (*COUNTS, "400000,5", "-5", "1e9", "5 m", "1e-9", "1e300"))
            done = f"{head[k][0]} = {head[k][1]!r}"
        elif way == 3:
            word = head[k][0]
            head[k][0] = one(rng, (f"{word}s", "", "dx", word[::-1], "\ufeff" + word, *HOSTILE))
            done = f"{word} named {head[k][0]!r:.40}"
        elif way == 4:
            done = one(rng, ("head line removed", "head line twice", "head backwards", "no head", "only head"))
            head = {"head line removed": head[:k] + head[k + 1 :], "head line twice": [*head, head[k]], "no head": [],
                    "head backwards": head[::-1], "only head": head}[done]  # fmt: skip
            cells = [] if done == "only head" else cells
        elif way < 7:
            row, column = int(rng.integers(rows)), int(rng.integers(columns))
            cells[row][column] = one(rng, CELLS)
            done = f"cell {row}, {column} = {cells[row][column]!r}"
        else:
            done = one(
                rng, ("row short", "row long", "row missing", "row more", "one line", "decimal comma", "projection")
            )
            if done == "row short":
                cells[k].pop()
            elif done == "row long":
                cells[k].append("1")
            elif done == "row missing":
                cells.pop()
            elif done == "row more":
                cells.append(cells[0])
            elif done == "one line":
                cells = [[cell for row in cells for cell in row]]
            elif done == "decimal comma":
                cells = [[cell.replace(".", ",") for cell in row] for row in cells]
            else:
                path.with_suffix(".prj").write_text(
                    one(rng, ("", 'GEOGCS["x"]', "Projection UTM", "EPSG:4326", *HOSTILE)).replace("\ud7ff", "x")
                )
    lines = [" ".join(line) for line in [*head, *cells]]
    path.write_bytes(end.join([*lines, ""]).encode())
    return done
