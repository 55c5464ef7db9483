"""Polygons, lines and points from files or coordinates."""

import math
from collections.abc import Sequence
from numbers import Real
from pathlib import Path
from typing import Any, NamedTuple

from ..core.checks import in_range
from ..core.errors import InputError
from ..core.hints import did_you_mean, give_number, number_in, python_value, same_word
from .cover import covered_fraction
from .lattice import Bounds, extent
from .names import find_file, said
from .references import label_of, wkt_of
from .shape_checks import TYPES, check_features, inside_of, note_outside, note_overlaps
from .shape_files import read_features

__all__ = ["Shape", "covered_fraction", "read_shapes"]


class Shape(NamedTuple):
    """Shape on the map.

    Attributes
    ----------
    geometry : shapely geometry
        Valid, of two dimensions, in the coordinate reference system that was asked for [m].
    attributes : dict
        Values of the feature by name, without those that are not set.
    label : str
        File and number of the feature, for messages.
    feature : int
        Number of the feature in its file or list, from 1.
    """

    geometry: Any
    attributes: dict[str, Any]
    label: str
    feature: int = 1

    def number(
        self, name: str, default: float | None = None, low: float = -math.inf, high: float = math.inf, unit: str = "m",
    ) -> float | None:  # fmt: skip
        """Return a numeric attribute, whose name may be written in any case.

        Parameters
        ----------
        name : str
        default : float or None
            Result if the attribute is missing or not set.
        low, high : float
            Closed interval of allowed values.
        unit : str
            For messages.

        Raises
        ------
        InputError
            If the attribute is no number or not allowed.
        """
        known = same_word(name, self.attributes)
        if known is None:
            return default
        value = self.attributes[known]
        if isinstance(value, str) and number_in(value) is not None and "," not in value:
            value = number_in(value)  # Shapefiles and CSV often hold numbers as text
        if isinstance(value, bool) or not isinstance(value, Real):
            raise InputError(f"{self.label}: {name} must be a number [{unit}], got {value!r}{give_number(value)}")
        in_range(f"{self.label}: {name}", float(value), low, high, unit, error=InputError)
        return float(value)

    def lacks(self, name: str) -> InputError:
        """Return the refusal for an attribute that is needed and not there."""
        there = ", ".join(map(str, self.attributes)) or "none"
        return InputError(
            f"{self.label}: the attribute {name} is missing{did_you_mean(name, self.attributes)}; there are: {there}"
        )


def read_shapes(
    source: str | Path | Sequence[Any], crs: str | None = None, *, kind: str = "polygon", bounds: Bounds | None = None,
    notes: list[str] | None = None, only_inside: bool = False,
) -> list[Shape]:  # fmt: skip
    """Read the shapes of a vector file, or make them of coordinates.

    Outlines that cross themselves are mended, unless the area they mean is ambiguous. Heights (z) are dropped.

    Parameters
    ----------
    source : str, Path or sequence
        GeoPackage, GeoJSON, Shapefile, CSV (with x and y, or with WKT) or another format that GDAL reads, the layer
        after a colon; or a sequence of features, each a sequence of pairs x, y (a point is one pair).
    crs : str, optional
        Coordinate reference system of the result. A file that names none is taken to be in it, and if `crs` is not
        given, coordinates stay as they are.
    kind : {"polygon", "line", "point", "any"}
        Kind of geometry that is wanted.
    bounds : tuple of float, optional
        West, south, east, north of the DEM [m]; a shape wholly outside is refused.
    notes : list of str, optional
        Remarks for the user are appended to it.
    only_inside : bool
        Whether shapes wholly outside are left out, with a note, if another one is not.

    Returns
    -------
    list of Shape
        At least one; a feature of several polygons is one shape.

    Raises
    ------
    InputError
        If the file cannot be read or holds no shapes, or if a shape is of another kind, empty, not finite, ambiguous
        or outside.
    """
    if isinstance(source, str | Path):
        path, choice = find_file(source)
        geometries, records, own = _features(path, choice, notes)
        name = single = path.name
        each = f"{name} feature"
        geometries = _changed(geometries, own, crs, name, bounds, notes)
    else:
        geometries, name, single, each = _made(source, kind), f"{kind}s", f"the {kind}", kind
        records = [{} for _ in geometries]
    labels = [f"{each} {k + 1}" for k in range(len(geometries))] if len(geometries) > 1 else [single] * len(geometries)
    if not len(geometries):
        raise InputError(f"{name} holds no shapes; draw some, or choose another layer or file")
    geometries = check_features(geometries, labels, kind, notes)
    numbers = list(range(1, len(geometries) + 1))
    if bounds is not None:
        if only_inside and (inside := inside_of(geometries, bounds, name, notes)):
            columns = geometries, records, labels, numbers
            geometries, records, labels, numbers = ([each[k] for k in inside] for each in columns)
        note_outside(geometries, labels, bounds, notes)
    if kind == "polygon":
        note_overlaps(geometries, name, notes)
    return [Shape(*one) for one in zip(geometries, records, labels, numbers, strict=True)]


def _features(path: Path, choice: str | None, notes: list[str] | None):
    """Return geometries, attributes and coordinate reference system of a file."""
    frame = read_features(path, choice, notes)
    table = frame.drop(columns=frame.geometry.name)
    columns = {str(key): values.to_list() for key, values in table.items()}
    # not to_dict("records"), which before pandas 3.1 has no record of a row without attributes
    records = [
        {key: python_value(values[row]) for key, values in columns.items() if _is_set(values[row])}
        for row in range(len(table))
    ]
    own = frame.crs.to_wkt() if frame.crs is not None else None
    return frame.geometry.to_list(), records, own


def _is_set(value) -> bool:
    """Return whether an attribute has a value, which None, NaN and NaT are not."""
    try:
        return value is not None and bool(value == value)
    except (TypeError, ValueError):  # pandas.NA and lists have no truth value
        return hasattr(value, "__len__")


def _changed(geometries, own: str | None, crs: str | None, name: str, bounds: Bounds | None, notes):
    """Return geometries in another coordinate reference system."""
    if own is None and crs is not None:
        said(notes, f"{name}: no coordinate reference system is named; that of the DEM is taken")
    if own is not None and crs is None:
        import shapely

        if bounds is not None and not shapely.box(*bounds).intersects(shapely.box(*shapely.total_bounds(geometries))):
            found = tuple(float(value) for value in shapely.total_bounds(geometries))
            raise InputError(
                f"{name} is in {label_of(own)}, {extent(found)}; the DEM names no coordinate reference system and "
                f"covers {extent(bounds)}; give terrain: crs (`new`: --crs) the code of the system of the DEM"
            )
        said(notes, f"{name}: in {label_of(own)}, the DEM names none; coordinates are taken as they are")
    if own is None or crs is None or own == wkt_of(crs):
        return geometries
    import geopandas
    import pyproj

    try:
        moved = geopandas.GeoSeries(geometries, crs=own).to_crs(crs)
    except (pyproj.exceptions.ProjError, ValueError, RuntimeError) as error:
        raise InputError(f"{name}: no way from {label_of(own)} to {label_of(crs)} is known: {error}") from error
    return moved.to_list()


def _made(source: Sequence[Any], kind: str):
    """Return geometries of coordinates."""
    import shapely

    if kind not in TYPES or kind == "any":
        raise ValueError(f"coordinates need a kind of geometry, got {kind!r}")
    maker = {"polygon": shapely.Polygon, "line": shapely.LineString, "point": shapely.Point}[kind]
    try:
        return [maker(feature) for feature in source]
    except (shapely.errors.ShapelyError, ValueError, TypeError) as error:
        raise InputError(f"the coordinates make no {kind}: {error}; give a list of features of pairs [x, y]") from error
