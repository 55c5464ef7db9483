"""GeoPackages and Shapefiles, changed in their tables and bytes."""

import functools
import sqlite3
import struct
import tempfile
import warnings
from pathlib import Path
from typing import Any

import geopandas
import numpy as np

from . import ground
from .odd import HOSTILE, NUMBERS, damaged, one

PARTS = (".shp", ".shx", ".dbf", ".prj", ".cpg")


def write(rng: np.random.Generator, path: Path, content: dict[str, Any], form: str) -> str:
    """Write a GeoPackage or Shapefile of some form; return the change as text."""
    kind = path.suffix
    files = dict(
        _good(
            kind,
            content["features"][0]["geometry"]["type"],
            len(content["features"]),
            str(content["features"][0]["properties"]),
        )
    )
    done = "nothing"
    if form == "bytes":
        suffix = one(rng, list(files))
        files[suffix], done = damaged(rng, files[suffix])
        done = f"{suffix} {done}"
    elif form == "one change" and kind == ".shp":
        done = _change_shapefile(rng, files)
    for suffix, data in files.items():
        path.with_suffix(suffix).write_bytes(data)
    if form == "one change" and kind == ".gpkg":
        try:
            done = _change_tables(rng, path)
        except sqlite3.Error as error:
            done = f"nothing ({error})"
    return done


@functools.cache
def _good(kind: str, shape: str, count: int, attributes: str) -> dict[str, bytes]:
    """Return the bytes of the files of good shapes, by their endings."""
    content = {"Polygon": ground.polygons, "Point": ground.points, "LineString": ground.lines}[shape]()
    with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        path = Path(folder) / f"shapes{kind}"
        frame = geopandas.GeoDataFrame.from_features(content["features"], crs=f"EPSG:{ground.CODE}")
        frame.to_file(path, **({"layer": "shapes"} if kind == ".gpkg" else {}))
        return {suffix: path.with_suffix(suffix).read_bytes() for suffix in (PARTS if kind == ".shp" else (kind,))}


def prepare() -> None:
    """Write the good files once, before the process is copied."""
    for make in (ground.polygons, ground.points, ground.lines):
        features = make()["features"]
        for kind in (".gpkg", ".shp"):
            _good(kind, features[0]["geometry"]["type"], len(features), str(features[0]["properties"]))


def _change_tables(rng: np.random.Generator, path: Path) -> str:
    """Change one row, table or geometry of a GeoPackage."""
    base = sqlite3.connect(path)
    base.execute("PRAGMA synchronous=OFF")
    base.execute("PRAGMA journal_mode=MEMORY")
    for (name,) in base.execute("SELECT name FROM sqlite_master WHERE type='trigger'").fetchall():
        base.execute(f'DROP TRIGGER "{name}"')  # they call functions that only GDAL has
    try:
        number, text, way = one(rng, NUMBERS), one(rng, HOSTILE), int(rng.integers(11))
        number = max(min(number, 2**62), -(2**62)) if isinstance(number, int) else number
        text = text.replace("\ud7ff", "x")
        if way in (0, 1, 2):
            (blob,) = base.execute("SELECT geom FROM shapes").fetchone()
            new, done = _geometry(rng, blob)
            base.execute("UPDATE shapes SET geom=? WHERE fid=1", (new,))
        elif way in (3, 4):
            column = one(
                rng, [row[1] for row in base.execute("PRAGMA table_info(shapes)") if row[1] not in ("fid", "geom")]
            )
            value = one(rng, (number, text, None, b"\x00\x01"))
            base.execute(f'UPDATE shapes SET "{column}"=? WHERE fid=1', (value,))
            done = f"{column} = {value!r:.40}"
        elif way == 5:
            table, column = one(rng, (
                ("gpkg_geometry_columns", "srs_id"), ("gpkg_geometry_columns", "geometry_type_name"),
                ("gpkg_geometry_columns", "column_name"),
                ("gpkg_geometry_columns", "z"), ("gpkg_contents", "data_type"), ("gpkg_contents", "identifier"),
                ("gpkg_contents", "min_x"),
                ("gpkg_contents", "srs_id"), ("gpkg_spatial_ref_sys", "definition"),
                ("gpkg_spatial_ref_sys", "organization"),
            ))  # fmt: skip
            value = one(rng, (number, text, None))
            base.execute(f"UPDATE OR REPLACE {table} SET {column}=?", (value,))
            done = f"{table}.{column} = {value!r:.40}"
        elif way == 6:
            table = one(
                rng,
                (
                    "gpkg_geometry_columns",
                    "gpkg_contents",
                    "gpkg_spatial_ref_sys",
                    "shapes",
                    "gpkg_extensions",
                    "gpkg_ogr_contents",
                ),
            )
            base.execute(f"DROP TABLE {table}")
            done = f"no table {table}"
        elif way == 7:
            name = one(rng, ("second", "layer:2", "[red]", "a b"))
            for table in ("gpkg_contents", "gpkg_geometry_columns"):
                columns = [row[1] for row in base.execute(f"PRAGMA table_info({table})")]
                changed = [f"'{name}'" if c in ("table_name", "identifier") else c for c in columns]
                base.execute(f"INSERT INTO {table} SELECT {', '.join(changed)} FROM {table}")
            if rng.random() < 0.7:
                base.execute(f'CREATE TABLE "{name}" AS SELECT * FROM shapes')
            done = f"layer {name}"
        elif way == 8:
            done = "layer is a view" + one(rng, ("", " without end"))
            base.execute("ALTER TABLE shapes RENAME TO rows_of_it")
            endless = "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i+1 FROM n) " if done.endswith("end") else ""
            rows = "rows_of_it, n" if endless else "rows_of_it"
            base.execute(f"CREATE VIEW shapes AS {endless}SELECT * FROM {rows}")
        elif way == 9:
            pragma = one(rng, ("application_id", "user_version"))
            value = one(rng, (0, 1, 2**31 - 1, -1))
            base.execute(f"PRAGMA {pragma}={value}")
            done = f"{pragma} {value}"
        else:
            done = one(rng, ("no rows", "wal"))
            base.execute("DELETE FROM shapes" if done == "no rows" else "PRAGMA journal_mode=WAL")
        base.commit()
        return done
    finally:
        base.close()


def _geometry(rng: np.random.Generator, blob: bytes) -> tuple[Any, str]:
    """Return a geometry of a GeoPackage with one change, and the change as text; a head has 40 bytes, of a point 8."""
    head = 8 + {0: 0, 1: 32, 2: 48, 3: 48, 4: 64}[(blob[3] >> 1) & 7]
    where, width = one(rng, (
        ("magic", (0, 2)), ("version", (2, 3)), ("flags", (3, 4)), ("srs_id", (4, 8)), ("envelope", (8, 16)),
        ("byte order", (head, head + 1)),
        ("type", (head + 1, head + 5)), ("rings", (head + 5, head + 9)), ("points", (head + 9, head + 13)),
        ("coordinate", (head + 13, head + 21)),
        ("end", (len(blob) - 8, len(blob))),
    ))  # fmt: skip
    begin, end = width
    if where == "coordinate":
        new = struct.pack("<d", float(max(min(one(rng, NUMBERS), 1e300), -1e300)))
    elif where == "end":
        return blob[: int(rng.integers(len(blob)))], "geometry cut"
    else:
        new = one(rng, (b"\xff" * 8, b"\x00" * 8, rng.bytes(8), struct.pack("<Q", int(rng.integers(30)))))[
            : end - begin
        ]
    return blob[:begin] + new + blob[end:], f"{where} {new.hex()}"


def _change_shapefile(rng: np.random.Generator, files: dict[str, bytes]) -> str:
    """Change one field of the heads or records of a Shapefile, or leave a part out."""
    way = int(rng.integers(4))
    if way == 0:
        suffix = one(rng, PARTS)
        if rng.random() < 0.5:
            del files[suffix]
            return f"no {suffix}"
        files[suffix] = b""
        return f"{suffix} empty"
    if way == 1:
        suffix = one(rng, (".prj", ".cpg"))
        files[suffix] = one(rng, HOSTILE).encode()
        return f"{suffix} {files[suffix]!r:.40}"
    if way == 2:
        data = bytearray(files[".dbf"])
        at = int(rng.integers(4, min(len(data), 110)))
        data[at] = int(rng.integers(256))
        files[".dbf"] = bytes(data)
        return f".dbf byte {at} = {data[at]}"
    suffix = one(rng, (".shp", ".shx"))
    data = bytearray(files[suffix])
    form, at = one(rng, (
        ("<i", 32), (">i", 24), ("<d", 36), ("<d", 60), (">i", 100), (">i", 104), ("<i", 108), ("<d", 112), ("<i", 144),
        ("<i", 148), ("<i", 152), ("<d", 156),
    ))  # fmt: skip
    if at + struct.calcsize(form) > len(data):
        at = 36
        form = "<d"
    value: Any = one(rng, NUMBERS)
    value = (
        float(max(min(value, 1e300), -1e300))
        if form == "<d"
        else one(rng, (0, -1, 1, 2**31 - 1, 15, 5, 3, 31, 1000, 100_000_000))
    )
    struct.pack_into(form, data, at, value)
    files[suffix] = bytes(data)
    return f"{suffix} at {at} = {value!r}"
