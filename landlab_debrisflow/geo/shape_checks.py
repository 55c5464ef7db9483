"""Check, mend and describe shapes."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from ..core.errors import InputError
from .lattice import FARTHEST, Bounds, extent
from .names import said

TYPES = {
    "polygon": ("Polygon", "MultiPolygon"), "line": ("LineString", "LinearRing", "MultiLineString"),
    "point": ("Point", "MultiPoint"),
    "any": ("Polygon", "MultiPolygon", "LineString", "LinearRing", "MultiLineString", "Point", "MultiPoint"),
}  # fmt: skip
"""Types of geometry by the kind that is wanted."""

AMBIGUOUS = 0.01
"""Change of area by mending, over the area, above which it is not clear which area the outline means [-]."""
OVERLAP = 1e-6
"""Overlap over the smaller area that is worth a note [-]; neighbours that share a side overlap by rounding."""
MOST_LISTED = 5


def check_features(geometries: Sequence[Any], labels: Sequence[str], kind: str, notes: list[str] | None) -> list[Any]:
    """Return geometries in two dimensions, mended; refuse unusable ones.

    Parameters
    ----------
    geometries : sequence of shapely geometries
    labels : sequence of str
        Label of each geometry, for messages.
    kind : str
        A key of `TYPES`.
    notes : list of str or None
        Remarks for the user are appended to it.

    Raises
    ------
    InputError
        If a geometry is empty, of another kind, not finite, or crosses itself so that its area is ambiguous.
    """
    import shapely

    checked = []
    for geometry, label in zip(geometries, labels, strict=True):
        if geometry is None or geometry.is_empty:
            raise InputError(f"{label} has no geometry; draw it or remove the feature")
        if geometry.geom_type not in TYPES[kind]:
            raise InputError(f"{label} is a {geometry.geom_type}, a {kind} is needed")
        geometry = shapely.force_2d(geometry)
        if not np.isfinite(shapely.get_coordinates(geometry)).all():
            raise InputError(f"{label} has coordinates that are not finite, or none in the system of the DEM")
        if np.abs(shapely.get_coordinates(geometry)).max() > FARTHEST:
            raise InputError(f"{label} has coordinates beyond {FARTHEST:g} m, where no map reaches; draw it anew")
        try:
            if kind == "polygon":
                geometry = _mended(geometry, label, notes)
            elif kind == "line":
                geometry = _joined(geometry, label)
        except shapely.errors.ShapelyError as error:
            raise InputError(f"{label} cannot be used: {error}; draw it anew") from error
        checked.append(geometry)
    return checked


def _mended(geometry, label: str, notes):
    """Return a valid polygon; refuse outlines that cross themselves like an 8."""
    import shapely

    if not geometry.is_valid:
        reason, drawn = shapely.is_valid_reason(geometry), geometry.area
        mended = shapely.make_valid(geometry)
        pieces = [part for part in shapely.get_parts(mended) if part.geom_type in TYPES["polygon"]]
        geometry = shapely.union_all(pieces) if pieces else shapely.Polygon()
        if abs(geometry.area - drawn) > AMBIGUOUS * max(geometry.area, drawn):
            raise InputError(
                f"{label} crosses itself ({reason}): its area may be {drawn:.6g} or {geometry.area:.6g} m2; draw its "
                "outline without crossings (in QGIS: Vector geometry, Fix geometries, then look at the result)"
            )
        said(notes, f"{label}: crossed itself ({reason}) and was mended, area {drawn:.6g} to {geometry.area:.6g} m2")
    if not geometry.area > 0.0:
        raise InputError(f"{label} is a polygon without area; draw it anew or remove the feature")
    return geometry


def _joined(geometry, label: str):
    """Return a line of one piece."""
    import shapely

    if geometry.geom_type == "MultiLineString":
        geometry = shapely.line_merge(geometry)
        if geometry.geom_type != "LineString":
            raise InputError(f"{label} is a line of {len(geometry.geoms)} pieces; join them, or make each a feature")
    if not geometry.length > 0.0:
        raise InputError(f"{label} is a line without length; draw it anew or remove the feature")
    return geometry


def inside_of(geometries: Sequence[Any], bounds: Bounds, name: str, notes: list[str] | None) -> list[int]:
    """Return the numbers of the shapes that touch a rectangle [m], and note how many features are left out."""
    import shapely

    inside = np.flatnonzero(shapely.intersects(shapely.box(*bounds), np.array(geometries, object))).tolist()
    if inside and (outside := len(geometries) - len(inside)):
        said(notes, f"{name}: {outside} of {len(geometries)} features lie wholly outside the DEM and are left out")
    return inside


def note_outside(geometries: Sequence[Any], labels: Sequence[str], bounds: Bounds, notes: list[str] | None) -> None:
    """Refuse shapes wholly outside a rectangle [m], and note the percentage of shapes that is outside.

    Raises
    ------
    InputError
        With the extents of both.
    """
    import shapely

    frame = shapely.box(*bounds)
    for geometry, label in zip(geometries, labels, strict=True):
        if not frame.intersects(geometry):
            raise InputError(
                f"{label} lies wholly outside the DEM: it covers {extent(geometry.bounds)}, the DEM {extent(bounds)}; "
                "are its coordinates in the same system?"
            )
        for measure in (geometry.area, geometry.length):
            if measure > 0.0:
                inside = shapely.intersection(geometry, frame)
                inside = inside.area if geometry.area > 0.0 else inside.length
                if inside < (1.0 - 1e-9) * measure:
                    said(notes, f"{label}: {100.0 * (1.0 - inside / measure):.3g} % lie outside the DEM")
                break


def note_overlaps(geometries: Sequence[Any], name: str, notes: list[str] | None) -> None:
    """Note which polygons overlap."""
    import shapely

    if len(geometries) < 2:
        return
    one, other = shapely.STRtree(geometries).query(geometries, predicate="intersects")
    one, other = one[one < other], other[one < other]
    shapes = np.array(geometries, object)
    areas = shapely.area(shapely.intersection(shapes[one], shapes[other]))
    smaller = np.minimum(shapely.area(shapes[one]), shapely.area(shapes[other]))
    pairs = [(i + 1, j + 1, a) for i, j, a in zip(one, other, areas, strict=True)]
    pairs = [pair for pair, worth in zip(pairs, areas > OVERLAP * smaller, strict=True) if worth]
    if pairs:
        listed = ", ".join(f"{i} and {j} ({a:.4g} m2)" for i, j, a in pairs[:MOST_LISTED])
        more = f", and {len(pairs) - MOST_LISTED} more pairs" if len(pairs) > MOST_LISTED else ""
        said(notes, f"{name}: features overlap: {listed}{more}")
