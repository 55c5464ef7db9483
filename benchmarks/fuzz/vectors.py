"""Vector files: GeoJSON, GeoPackage, Shapefile and tables, as release, gauges, sections or exposure of a scene."""

import copy
import json
from pathlib import Path
from typing import Any

import numpy as np

from . import binary_vectors, ground
from .odd import HOSTILE, NUMBERS, damaged, odd_value, one
from .scenes import change_value, write_mapping

ROLES = {
    "scars": ground.polygons, "gauges": ground.points, "bridge": ground.lines, "thalweg": ground.lines,
    "exposure": ground.polygons,
    "zone": ground.polygons, "dam": ground.lines, "excavation": ground.polygons, "buildings": ground.polygons,
    "points": ground.points,
    "soil": ground.polygons,
}  # fmt: skip
TYPES = (
    "Point",
    "MultiPoint",
    "LineString",
    "MultiLineString",
    "Polygon",
    "MultiPolygon",
    "GeometryCollection",
    "CircularString",
    "",
)


def write(rng: np.random.Generator, folder: Path, form: str) -> str:
    """Write a scene with a vector file of some form; return the change as text."""
    ground.write_files(folder)
    role = one(rng, ("scars", "scars", "scars", *ROLES))
    kind = one(rng, ("geojson", "geojson", "gpkg", "shp", "csv"))
    name = f"shapes.{kind}"
    release: dict[str, Any] = {
        "scars": {"polygons": name}, "points": {"points": name, "hydrograph": "surge.csv", "speed": 3.0, "width": 10.0},
    }.get(role, {"polygons": [ground.block(3, 4)], "depth": 1.0})  # fmt: skip
    keys = {"gauges": "gauges", "bridge": "sections", "thalweg": "thalweg", "exposure": "exposure"}
    output = {keys[role]: name} if role in keys else {}
    terrain: dict[str, Any] = {
        "elevation": "dem.asc",
        "crs": f"EPSG:{ground.CODE}",
        "soil_depth": name if role == "soil" else 1.0,
    }
    edits = {"dam": {"crest_height": 2.0, "crest_width": 3.0}, "excavation": {"depth": 1.0}, "buildings": {}}
    if role in edits:
        terrain["edits"] = [{role: name} | edits[role]]
    elif role == "zone":
        terrain["zones"] = [{"polygons": name, "soil_depth": 0.5}]
    scene = {"terrain": terrain, "release": release, "output": output, "numerics": {"particle_count": 60}}
    write_mapping(folder / "scene.yaml", {key: value for key, value in scene.items() if value})
    path, done = folder / name, "nothing"
    if kind in ("gpkg", "shp"):
        done = binary_vectors.write(rng, path, ROLES[role](), form)
    else:
        content = ROLES[role]()
        if form == "one change":
            done = change_shapes(rng, content)
        path.write_bytes(_text(content, kind).encode("utf-8", "surrogatepass"))
        if form == "bytes":
            data, done = damaged(rng, path.read_bytes())
            path.write_bytes(data)
    return f"{kind} as {role}: {done}"


def _text(content: Any, kind: str) -> str:
    if kind == "geojson":
        return json.dumps(content)
    features = content.get("features")
    features = [one for one in features if isinstance(one, dict)] if isinstance(features, list) else []
    tables = [one["properties"] if isinstance(one.get("properties"), dict) else {} for one in features]
    names = list(dict.fromkeys(str(name) for table in tables for name in table))
    rows = [
        [*(table.get(name, "") for name in names), _wkt(one.get("geometry"))]
        for one, table in zip(features, tables, strict=True)
    ]
    return "\n".join([",".join([*names, "wkt"]), *(",".join(f'"{value}"' for value in row) for row in rows), ""])


def _wkt(shape: Any) -> str:
    if not isinstance(shape, dict):
        return str(shape)
    return f"{str(shape.get('type')).upper()} {_nested(shape.get('coordinates'))}"


def _nested(value: Any) -> str:
    if isinstance(value, list) and value and not isinstance(value[0], list):
        return " ".join(map(str, value))
    if isinstance(value, list):
        return "(" + ", ".join(map(_nested, value)) + ")" if value else "EMPTY"
    return str(value)


def change_shapes(rng: np.random.Generator, content: dict[str, Any]) -> str:
    """Change one thing of a GeoJSON in place; return the change as text."""
    feature = one(rng, content["features"])
    shape, way = feature["geometry"], int(rng.integers(12))
    if way == 0:
        return change_value(rng, content)
    if way == 1:
        shape["type"] = one(rng, TYPES)
        return f"type {shape['type']!r}"
    if way == 2:
        feature["geometry"] = one(rng, (
            None, {}, [], {"type": "Polygon", "coordinates": []}, {"type": "GeometryCollection", "geometries": []},
            {"type": "GeometryCollection", "geometries": [copy.deepcopy(shape)] * 2},
        ))  # fmt: skip
        return f"geometry {feature['geometry']!r:.60}"
    if way in (3, 4):
        owner = shape["coordinates"]
        while isinstance(owner[0], list) and rng.random() < 0.8:
            owner = owner[int(rng.integers(len(owner)))]
        k = int(rng.integers(len(owner)))
        owner[k] = one(rng, (one(rng, NUMBERS), odd_value(rng), [one(rng, NUMBERS), ground.SOUTH + 30.0]))
        return f"coordinate = {owner[k]!r:.60}"
    if way == 5:
        shape["coordinates"], done = _moved(rng, shape["coordinates"])
        return done
    if way == 6 and shape["type"] == "Polygon":
        ring = shape["coordinates"][0]
        outlines = {
            "bow-tie": [ring[0], ring[2], ring[1], ring[3], ring[0]], "not closed": ring[:-1],
            "two corners": ring[:2], "a line": [ring[0], ring[1], ring[0]],
            "one corner": ring[:1], "clockwise": ring[::-1], "corner twice": [ring[0], *ring],
            "spike": [*ring[:3], [ring[2][0] + 50.0, ring[2][1]], *ring[2:]],
            "sliver": [ring[0], ring[1], [ring[1][0], ring[1][1] + 1e-9], ring[0]],
            "large": [[x + 1e4 * (x > ring[0][0]), y] for x, y in ring],
            "small": [[ring[0][0] + 1e-3 * (x > ring[0][0]), ring[0][1] + 1e-3 * (y > ring[0][1])] for x, y in ring],
            "long": ring[:-1] * 3000 + ring[:1],
        }  # fmt: skip
        done = one(rng, list(outlines))
        shape["coordinates"] = [outlines[done]]
        return done
    if way == 7 and shape["type"] == "Polygon":
        ring = shape["coordinates"][0]
        middle = np.mean(ring[:4], axis=0)
        scale, done = one(rng, ((0.5, "hole"), (1.0, "hole of all"), (2.0, "hole outside"), (0.0, "hole of a point")))
        shape["coordinates"].append((middle + scale * (np.array(ring) - middle)).tolist())
        return done
    if way == 8:
        content["features"] = one(
            rng, ([], None, content["features"] * 50, [feature, feature], {}, "features", [None], [feature, 5])
        )
        return f"features {content['features']!r:.40}"
    if way == 9:
        content["crs"] = one(
            rng,
            (
                None,
                {},
                5,
                {
                    "type": "name",
                    "properties": {"name": one(rng, ("EPSG:4326", "EPSG:2056", "nonsense", *HOSTILE[:6]))},
                },
            ),
        )
        return f"crs {content['crs']!r:.60}"
    attributes = feature["properties"]
    key = one(rng, ("depth", "name", "volume", "id"))
    attributes[key] = odd_value(rng)
    return f"{key} = {attributes[key]!r:.60}"


def _moved(rng: np.random.Generator, coordinates: Any) -> tuple[Any, str]:
    """Return coordinates elsewhere or of other dimensions, and the change as text."""
    name = one(rng, ("far", "a little", "degrees", "swapped", "z", "zm", "flat", "huge", "deeper"))
    if name == "deeper":
        return [coordinates], name

    def change(value):
        if isinstance(value[0], list):
            return [change(inner) for inner in value]
        x, y = value[:2]
        return {
            "far": [x + 1e5, y], "a little": [x + 40.0, y], "degrees": [9.0 + 1e-5 * (x % 1000), 47.0],
            "swapped": [y, x], "z": [x, y, 1.0],
            "zm": [x, y, 1.0, 2.0], "flat": [x, 5200030.0], "huge": [x * 1e300, y],
        }[name]  # fmt: skip

    return change(coordinates), name
