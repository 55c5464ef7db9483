"""Input of a run for its report: terrain, extent, soil, release, files with checksums."""

import re

import numpy as np
import xarray as xr

from ..record.georeference import crs_of
from ..record.measures import ELEVATION, RELEASE
from ..run.record import RunRecord
from .blocks import Block, Sentences, Table
from .numbers import area, rounded, volume

SOIL = "soil__depth"
UNKNOWN_CRS = "not known; coordinates are metres"


def input_blocks(record: RunRecord, ground: xr.Dataset | None, attributes: dict) -> list[Block]:
    """Return tables of terrain, release and files.

    Parameters
    ----------
    record : RunRecord
    ground : xarray.Dataset or None
        Ground before the event, or else the maps of the end.
    attributes : dict
        Of the maps: name and checksum of the DEM.

    Returns
    -------
    list of Block
    """
    blocks: list[Block] = []
    if ground is not None:
        blocks.append(Table(caption="Terrain", rows=_terrain_rows(record, ground, attributes)))
    if ground is not None and RELEASE in ground and bool((ground[RELEASE] > 0.0).any()):
        blocks.append(Table(caption="Release", rows=_release_rows(record, ground)))
    if record.inputs:
        rows = list(record.inputs.items())
        blocks.append(Table(caption="Files that the scene names", head=("file", "SHA-256"), rows=rows))
    else:
        blocks.append(Sentences(["The scene names no file."]))
    return blocks


def _terrain_rows(record: RunRecord, ground: xr.Dataset, attributes: dict) -> list[tuple[str, str]]:
    x, y, z = ground.x.values, ground.y.values, ground[ELEVATION].values
    dx, dy = (x[-1] - x[0]) / (x.size - 1), (y[-1] - y[0]) / (y.size - 1)
    known = np.isfinite(z)
    spacing = rounded(dx, "m", 4) if np.isclose(dx, dy) else f"{rounded(dx, 'm', 4)} × {rounded(dy, 'm', 4)}"
    terrain = record.scene.get("terrain") or {}
    dem = attributes.get("dem") or terrain.get("elevation") or f"built-in example: {terrain.get('example')}"
    rows = [
        ("elevation from", str(dem)),
        ("coordinate reference system", crs_label(crs_of(ground))),
        ("grid", f"{y.size} rows × {x.size} columns of nodes, {spacing} apart; {area(x.size * y.size * dx * dy)}"),
        (
            "extent",
            f"x {x[0] - dx / 2:.10g} to {x[-1] + dx / 2:.10g} m, y {y[0] - dy / 2:.10g} to {y[-1] + dy / 2:.10g} m",
        ),
        ("elevation", f"{np.nanmin(z):.2f} to {np.nanmax(z):.2f} m"),
    ]
    if not known.all():
        rows.append(("without data", f"{np.count_nonzero(~known)} nodes, closed"))
    if attributes.get("dem_sha256"):
        rows.insert(1, ("its SHA-256", str(attributes["dem_sha256"])))
    rows.append(("erodible soil", _soil_words(ground)))
    edits = terrain.get("edits") or []
    if edits:
        kinds = [next((key for key in one if key in EDITS), "edit") for one in edits]
        rows.append(("changes of the ground", ", ".join(kinds)))
    return rows


EDITS = ("dam", "wall", "excavation", "buildings")


def _soil_words(ground: xr.Dataset) -> str:
    if SOIL not in ground:
        return "none"
    soil = ground[SOIL].values
    least, most = np.nanmin(soil), np.nanmax(soil)
    return f"{most:.3g} m deep" if least == most else f"{least:.3g} to {most:.3g} m deep"


def _release_rows(record: RunRecord, ground: xr.Dataset) -> list[tuple[str, str]]:
    depth, x, y = ground[RELEASE].fillna(0.0).values, ground.x.values, ground.y.values
    cell = abs((x[1] - x[0]) * (y[1] - y[0]))
    centre = [
        np.average(axis, weights=depth)
        for axis in (np.broadcast_to(x, depth.shape), np.repeat(y, x.size).reshape(depth.shape))
    ]
    z = ground[ELEVATION].values[depth > 0.0]
    return [
        ("volume", volume(float(depth.sum() * cell))),
        ("area", f"{area(float((depth > 0.0).sum() * cell))}, {np.count_nonzero(depth > 0.0)} nodes"),
        ("depth", f"{rounded(depth.max(), 'm')} at most, {rounded(depth[depth > 0.0].mean(), 'm')} in the mean"),
        ("centre", f"x {centre[0]:.10g} m, y {centre[1]:.10g} m"),
        ("elevation", f"{np.nanmin(z):.1f} to {np.nanmax(z):.1f} m"),
    ]


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
