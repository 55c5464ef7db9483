"""Features of vector files, as their libraries read them."""

import re
import warnings
from pathlib import Path
from typing import Any

from ..core.errors import InputError
from ..core.hints import did_you_mean
from .names import import_error, reason_of, said

FORMATS = "give a GeoPackage, GeoJSON or Shapefile"
TEXT = (".csv", ".txt", ".tsv")


def read_features(path: Path, choice: str | None, notes: list[str] | None) -> Any:
    """Return geometry and attributes of a layer as a GeoDataFrame.

    Parameters
    ----------
    path : Path
        A file, or the directory of a File Geodatabase.
    choice : str or None
        Name of the layer; needed if there are several with geometry.
    notes : list of str or None
        Remarks for the user are appended to it.

    Raises
    ------
    InputError
        If the file cannot be read or the layer is not there or not chosen.
    """
    try:
        import geopandas
        import pyogrio
        import pyproj
        import shapely
    except ImportError as error:
        raise import_error(error) from error
    failures = (
        pyogrio.errors.DataSourceError, pyogrio.errors.DataLayerError, pyogrio.errors.FieldError,
        pyogrio.errors.GeometryError, pyogrio.errors.FeatureError, pyogrio.errors.CRSError, shapely.errors.ShapelyError,
        pyproj.exceptions.ProjError, OSError, ValueError, RuntimeError, TypeError, KeyError, AttributeError, IndexError,
        OverflowError, MemoryError,
    )  # fmt: skip
    with warnings.catch_warnings(record=True) as warned:
        warnings.simplefilter("always")
        try:
            if path.suffix.lower() in TEXT:
                return _read_table(path)
            layer = _layer(path, choice, pyogrio.list_layers(path))
            frame = geopandas.read_file(path, layer=layer, engine="pyogrio")
        except InputError:
            raise
        except failures as error:
            remedy = _missing_companion(path) or FORMATS
            raise InputError(f"cannot read {path} as shapes: {reason_of(error)}; {remedy}") from error
    if not isinstance(frame, geopandas.GeoDataFrame):
        raise InputError(f"cannot read {path} as shapes: it is a table without geometry; {FORMATS}")
    for warning in warned:
        # warnings of GDAL become notes; warnings about versions of libraries do not
        if issubclass(warning.category, RuntimeWarning):
            said(notes, f"{path.name}: {' '.join(str(warning.message).split())}")
    return frame


def _layer(path: Path, choice: str | None, layers) -> str:
    """Return the name of the layer to read; `layers` has name and type of each."""
    names = [str(name) for name, kind in layers if kind is not None] or [str(name) for name, _ in layers]
    listed = ", ".join(names)
    if not names:
        raise InputError(f"cannot read {path} as shapes: it has no layer; {FORMATS}")
    if choice is None and len(names) > 1:
        raise InputError(f"{path} has several layers: {listed}; choose one, such as {path.name}:{names[0]}")
    if choice is not None and choice not in names:
        raise InputError(f"{path} has no layer {choice!r}{did_you_mean(choice, names)}; it has {listed}")
    return names[0] if choice is None else choice


def _missing_companion(path: Path) -> str:
    """Return a remedy for a Shapefile that lacks the file of its index, or an empty text."""
    beside = {other.suffix.lower() for other in path.parent.glob(f"{path.stem}.*")}
    missing = [suffix for suffix in (".shp", ".shx", ".dbf") if suffix not in beside]
    if path.suffix.lower() != ".shp" or not missing:
        return ""
    return f"a Shapefile is several files, copy {', '.join(path.stem + suffix for suffix in missing)} beside it"


def _read_table(path: Path):
    """Return the features of a text file with a column of WKT, or with columns x and y of points."""
    import geopandas
    import pandas
    import shapely

    table = pandas.read_csv(path, sep=None, engine="python", encoding="utf-8-sig")
    columns = {str(name).strip().lower(): name for name in table.columns}
    if wkt := next((columns[name] for name in ("wkt", "geometry", "geom") if name in columns), None):
        geometry = shapely.from_wkt([re.sub(r"^SRID=\d+;", "", str(text)) for text in table[wkt]])
        return geopandas.GeoDataFrame(table.drop(columns=wkt), geometry=list(geometry))
    if "x" not in columns or "y" not in columns:
        raise InputError(
            f"cannot read {path} as shapes: its columns are {', '.join(map(str, table.columns))[:200]}; points need "
            "the columns x and y, polygons and lines a column wkt"
        )
    x, y = table[columns["x"]].astype(float), table[columns["y"]].astype(float)
    return geopandas.GeoDataFrame(table.drop(columns=[columns["x"], columns["y"]]), geometry=list(shapely.points(x, y)))
