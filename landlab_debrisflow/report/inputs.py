"""Input of a run for its report: terrain, extent, release, files with checksums."""

import re

import numpy as np
import xarray as xr

from ..record.georeference import crs_of
from ..record.measures import ELEVATION
from ..record.written_maps import ELEVATION_BEFORE, RELEASED_DEPTH
from ..run.record import RunRecord
from .blocks import Block, Sentences, Table
from .numbers import area, rounded, volume

UNKNOWN_CRS = "not known; coordinates are metres"


def input_blocks(record: RunRecord, maps: xr.Dataset | None) -> list[Block]:
    """Return tables of terrain, release and files.

    Parameters
    ----------
    record : RunRecord
    maps : xarray.Dataset or None
        Maps of the end; None of a run that has not come to it.

    Returns
    -------
    list of Block
    """
    blocks: list[Block] = []
    if maps is not None:
        blocks.append(Table(caption="Terrain", rows=_terrain_rows(record, maps)))
        if RELEASED_DEPTH in maps and bool((maps[RELEASED_DEPTH] > 0.0).any()):
            blocks.append(Table(caption="Release", rows=_release_rows(maps)))
    if record.inputs:
        rows = list(record.inputs.items())
        blocks.append(Table(caption="Files that the scene names", head=("file", "SHA-256"), rows=rows))
    else:
        blocks.append(Sentences(["The scene names no file."]))
    return blocks


def _terrain_rows(record: RunRecord, maps: xr.Dataset) -> list[tuple[str, str]]:
    x, y, z = maps.x.values, maps.y.values, _ground(maps)
    dx, dy = (x[-1] - x[0]) / (x.size - 1), (y[-1] - y[0]) / (y.size - 1)
    known = np.isfinite(z)
    spacing = rounded(dx, "m", 4) if np.isclose(dx, dy) else f"{rounded(dx, 'm', 4)} × {rounded(dy, 'm', 4)}"
    terrain = record.scene.get("terrain") or {}
    dem = maps.attrs.get("dem") or terrain.get("elevation") or f"built-in example: {terrain.get('example')}"
    rows = [
        ("elevation from", str(dem)),
        ("coordinate reference system", crs_label(crs_of(maps))),
        ("grid", f"{y.size} rows × {x.size} columns of nodes, {spacing} apart; {area(x.size * y.size * dx * dy)}"),
        (
            "extent",
            f"x {x[0] - dx / 2:.1f} to {x[-1] + dx / 2:.1f} m, y {y[0] - dy / 2:.1f} to {y[-1] + dy / 2:.1f} m",
        ),
        ("elevation", f"{np.nanmin(z):.2f} to {np.nanmax(z):.2f} m"),
    ]
    if not known.all():
        rows.append(("without data", f"{np.count_nonzero(~known)} nodes, closed"))
    if maps.attrs.get("dem_sha256"):
        rows.insert(1, ("its SHA-256", str(maps.attrs["dem_sha256"])))
    rows.append(("erodible soil", _soil_words(terrain)))
    edits = terrain.get("edits") or []
    if edits:
        kinds = [next((key for key in one if key in EDITS), "edit") for one in edits]
        rows.append(("changes of the ground", ", ".join(kinds)))
    return rows


EDITS = ("dam", "wall", "excavation", "buildings")


def _soil_words(terrain: dict) -> str:
    depth, zones = terrain.get("soil_depth"), terrain.get("zones")
    words = f"{rounded(depth, 'm')} deep" if isinstance(depth, float | int) else f"from {depth}" if depth else "none"
    words = "that of the built-in example" if depth is None and terrain.get("example") else words
    return f"{words}; other depths in zones" if zones else words


def _release_rows(maps: xr.Dataset) -> list[tuple[str, str]]:
    depth, x, y = maps[RELEASED_DEPTH].fillna(0.0).values, maps.x.values, maps.y.values
    cell = abs((x[1] - x[0]) * (y[1] - y[0]))
    east, north = np.meshgrid(x, y)
    centre = [np.average(axis, weights=depth) for axis in (east, north)]
    z = _ground(maps)[depth > 0.0]
    return [
        ("volume", volume(float(depth.sum() * cell))),
        ("area", f"{area(float((depth > 0.0).sum() * cell))}, {np.count_nonzero(depth > 0.0)} nodes"),
        ("depth", f"{rounded(depth.max(), 'm')} at most, {rounded(depth[depth > 0.0].mean(), 'm')} in the mean"),
        ("centre", f"x {centre[0]:.1f} m, y {centre[1]:.1f} m"),
        ("elevation", f"{np.nanmin(z):.1f} to {np.nanmax(z):.1f} m"),
    ]


def _ground(maps: xr.Dataset) -> np.ndarray:
    """Return the elevation before the event, or after it if the maps do not hold it [m], shape (rows, columns)."""
    return maps[ELEVATION_BEFORE if ELEVATION_BEFORE in maps else ELEVATION].values


def crs_label(wkt: str | None) -> str:
    """Return code and name of a coordinate reference system given as WKT.

    Examples
    --------
    >>> crs_label('PROJCRS["WGS 84 / UTM zone 32N",BASEGEOGCRS["WGS 84",ID["EPSG",4326]],ID["EPSG",32632]]')
    'WGS 84 / UTM zone 32N (EPSG:32632)'
    """
    if not wkt:
        return UNKNOWN_CRS
    name = re.match(r'\w+\["([^"]*)"', wkt)
    code = re.search(r'(?:ID|AUTHORITY)\["(\w+)","?(\d+)"?\]\s*\]\s*$', wkt)
    words = name[1] if name else "of another form"
    return f"{words} ({code[1]}:{code[2]})" if code else words
