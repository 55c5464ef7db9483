"""The small valley of all fuzzed scenes: good files, and a good mapping that names them."""

import json
from pathlib import Path
from typing import Any

import numpy as np

from landlab_debrisflow.laws import LAWS

SURFACES = ("tapered", "sloping_local_base_level", "ellipsoid", "uniform")
ROWS, COLUMNS, SPACING = 14, 18, 5.0
WEST, SOUTH, CODE = 400000.0, 5200000.0, 32632
"""Corner of the first cell [m], and the coordinate reference system."""


def elevation() -> np.ndarray:
    """Return the elevation of a channel on a plane, first row southern, shape (ROWS, COLUMNS) [m]."""
    x, y = np.arange(COLUMNS) * SPACING, np.arange(ROWS)[:, None] * SPACING
    return 700.0 + 0.5 * (x[-1] - x) + 0.02 * (y - y.mean()) ** 2


def block(column: int, row: int, width: int = 4, height: int = 4) -> list[list[float]]:
    """Return the outline of a rectangle of cells [m]."""
    left, below = WEST + column * SPACING, SOUTH + row * SPACING
    right, above = left + width * SPACING, below + height * SPACING
    return [[left, below], [right, below], [right, above], [left, above], [left, below]]


def polygons(**attributes: Any) -> dict[str, Any]:
    """Return a GeoJSON of two polygons with a depth [m]."""
    features = [
        {"type": "Feature", "id": k,
         "properties": {"depth": 1.0 + k, "name": f"scar {k}", "soil_depth": 0.5} | attributes,
         "geometry": {"type": "Polygon", "coordinates": [block(2 + 5 * k, 4)]}}
        for k in range(2)
    ]  # fmt: skip
    crs = {"type": "name", "properties": {"name": f"urn:ogc:def:crs:EPSG::{CODE}"}}
    return {"type": "FeatureCollection", "crs": crs, "features": features}


def points() -> dict[str, Any]:
    """Return a GeoJSON of two points with a name."""
    found = polygons()
    for k, feature in enumerate(found["features"]):
        feature["properties"] = {"name": f"gauge {k}"}
        feature["geometry"] = {"type": "Point", "coordinates": [WEST + 30.0 + 20.0 * k, SOUTH + 35.0]}
    return found


def lines() -> dict[str, Any]:
    """Return a GeoJSON of a line with a name."""
    found = polygons()
    found["features"] = found["features"][:1]
    found["features"][0] |= {
        "properties": {"name": "bridge"},
        "geometry": {"type": "LineString", "coordinates": [[WEST + 60.0, SOUTH + 15.0], [WEST + 60.0, SOUTH + 55.0]]},
    }
    return found


HYDROGRAPH = "time [s],discharge [m3/s]\n0,0\n10,20\n60,5.5\n120,0\n"


def write_ascii(path: Path, values: np.ndarray) -> None:
    """Write an ESRI ASCII grid."""
    head = (
        f"ncols {COLUMNS}\nnrows {ROWS}\nxllcorner {WEST}\nyllcorner {SOUTH}\ncellsize {SPACING}\nNODATA_value -9999\n"
    )
    path.write_text(head + "\n".join(" ".join(f"{v:.3f}" for v in row) for row in values[::-1]) + "\n")


def write_files(folder: Path) -> None:
    """Write the good files that `mapping` names."""
    write_ascii(folder / "dem.asc", elevation())
    write_ascii(folder / "soil.asc", np.full((ROWS, COLUMNS), 1.5))
    for name, content in (("scars", polygons()), ("gauges", points()), ("bridge", lines())):
        (folder / f"{name}.geojson").write_text(json.dumps(content))
    (folder / "surge.csv").write_text(HYDROGRAPH)


def mapping(rng: np.random.Generator) -> dict[str, Any]:
    """Return the mapping of a good scene, drawn at random."""
    terrain = _terrain(rng)
    release = [
        {"polygons": "scars.geojson", "time": 0.0},
        {"polygons": [block(3, 4)[:4]], "depth": 1.2, "from": "above"},
        {"polygons": [block(3, 4)], "depth": 0.8, "failure_surface": _one(rng, SURFACES)},
        {"polygons": "scars.geojson", "failure_surface": _one(rng, SURFACES), "time": 3.0},
        {"polygons": [block(3, 4)[:4], block(9, 5)], "volume": 300.0, "failure_surface": "ellipsoid"},
        {"raster": "soil.asc", "time": 5.0},
        {"points": [[WEST + 20.0, SOUTH + 35.0]], "hydrograph": "surge.csv", "speed": 4.0, "width": 15.0},
        {"points": "gauges.geojson", "hydrograph": [[0, 0], [5, 10], [20, 0]], "speed": 3.0, "width": 10.0},
        {"polygons": [block(3, 4)], "depth": 1.0, "speed": 3.0},
        {"polygons": [block(3, 4)], "depth": 1.0, "velocity": [2.0, 0.5], "failure_surface": "uniform"},
    ]
    chosen = [release[k] for k in rng.permutation(len(release))[: rng.integers(1, 3)]]
    output = {
        "max_duration": 60.0, "interval": 5.0, "maps": ["max_depth"], "gauges": {"bridge": [WEST + 50.0, SOUTH + 35.0]},
        "sections": "bridge.geojson", "tracks": 3, "least_depth": 0.05, "exposure": "scars.geojson",
    }  # fmt: skip
    kept = [key for key in output if rng.random() < 0.5]
    if rng.random() < 0.05:
        terrain = {"example": "gully", "soil_depth": 2.0}
        chosen, kept = [{"polygons": [[[x + 30.0, y + 120.0] for x, y in block(0, 0)]], "depth": 1.0}], []
    found: dict[str, Any] = {
        "terrain": terrain,
        "release": chosen if len(chosen) > 1 or rng.random() < 0.5 else chosen[0],
    }
    found |= {"output": {key: output[key] for key in kept}} if kept else {}
    for kind, laws in LAWS.items():
        if rng.random() < 0.4:
            found[kind] = _one(rng, [name := _one(rng, list(laws)), {"law": name}])
    if rng.random() < 0.5:
        found["friction"] = {"law": "voellmy", "basal_friction_angle": 28.0, "turbulent_coefficient": 400.0}
    if rng.random() < 0.3:
        found["erosion"] = {"law": "growth", "growth_rate": 2e-3}
    if rng.random() < 0.1:
        found["friction"] = {"law": "coulomb", "basal_friction_angle": "soil.asc"}
    if rng.random() < 0.15:
        line = {"line_start": [WEST + 20.0, SOUTH + 25.0], "line_end": [WEST + 20.0, SOUTH + 45.0]}
        found["inflow"] = line | {"times": [0.0, 30.0], "discharge": [8.0, 2.0], "velocity": 3.0}
    if rng.random() < 0.5:
        found["material"] = {"solid_density": 2650.0, "porosity": 0.4}
    return found | {"numerics": {"particle_count": 60}}


def _terrain(rng: np.random.Generator) -> dict[str, Any]:
    """Return the mapping of the ground of a good scene, drawn at random."""
    terrain: dict[str, Any] = {
        "elevation": "dem.asc",
        "crs": f"EPSG:{CODE}",
        "soil_depth": _one(rng, [1.5, "soil.asc", 0.0]),
    }
    across = [[WEST + 70.0, SOUTH + 12.0], [WEST + 70.0, SOUTH + 58.0]]
    edits: list[dict[str, Any]] = [
        {"dam": [across], "crest_height": 3.0, "crest_width": 4.0},
        {"wall": "bridge.geojson", "crest_elevation": 715.0},
        {"excavation": [block(11, 5)], "depth": 1.0}, {"buildings": [block(12, 6)], "height": 6.0},
        {"buildings": [block(12, 3)]},
    ]  # fmt: skip
    zones: list[dict[str, Any]] = [
        {"polygons": "scars.geojson", "soil_depth": 0.5}, {"polygons": [block(9, 3)], "bed_pressure_ratio": 0.3},
        {"polygons": [block(9, 3)], "friction": {"cohesion": 100.0}},
    ]  # fmt: skip
    extras = {
        "window": _one(rng, ["reach", "all", [WEST + 5.0, SOUTH + 5.0, WEST + 85.0, SOUTH + 65.0]]),
        "travel_angle": 8.0,
        "spacing": _one(rng, [4.0, 5.0, 7.0]), "nodata": -1.0, "bed_pressure_ratio": 0.2, "zones": [_one(rng, zones)],
        "edits": [_one(rng, edits)],
    }  # fmt: skip
    return terrain | {key: value for key, value in extras.items() if rng.random() < 0.2}


def _one(rng: np.random.Generator, choices: list) -> Any:
    return choices[rng.integers(len(choices))]
