"""Shapes that a scene names as a file or writes as coordinates."""

from pathlib import Path
from typing import Any

from ..core.errors import InputError
from ..geo.lattice import Lattice
from ..geo.shapes import Shape, read_shapes

KIND_OF = {"points": "Point", "lines": "LineString", "polygons": "Polygon"}
"""Type of geometry of each form of coordinates."""


def shapes_of(value: Any, form: str, lattice: Lattice, folder: Path, name: str, named: bool = False) -> list[Shape]:
    """Return the shapes that the value of a key stands for.

    Parameters
    ----------
    value : str or tuple
        Name of a file, or checked coordinates.
    form : {"points", "lines", "polygons"}
        Kind of shape.
    lattice : Lattice
        Whose coordinate reference system the shapes get.
    folder : Path
        Directory to which names of files are relative.
    name : str
        Key, for messages.
    named : bool
        Whether the coordinates have names; these become the attribute ``name``.

    Returns
    -------
    list of Shape

    Raises
    ------
    InputError
        If a file cannot be read, or a shape is of another kind or not valid.
    """
    import shapely

    if isinstance(value, str):
        shapes = read_shapes(folder / value, lattice.crs, kind=form.removesuffix("s"))
    else:
        entries = value if named else tuple((str(k), one) for k, one in enumerate(value))
        make = getattr(shapely, KIND_OF[form])
        shapes = [Shape(make(one), {"name": key} if named else {}, f"{name} {key}") for key, one in entries]
    for shape in shapes:
        _check(shape, form, name)
    return shapes


def _check(shape: Shape, form: str, name: str):
    import shapely

    geometry, kind = shape.geometry, KIND_OF[form]
    if geometry is None or geometry.is_empty:
        raise InputError(f"{name}: {shape.label} has no geometry; remove it, or draw it again")
    if geometry.geom_type not in (kind, f"Multi{kind}"):
        raise InputError(f"{name}: {shape.label} must be one of {form}, got a {geometry.geom_type}")
    if not geometry.is_valid:
        reason = shapely.is_valid_reason(geometry)
        raise InputError(f"{name}: {shape.label} is not valid ({reason}); repair it, in QGIS with Fix geometries")
    if (form == "polygons" and geometry.area == 0.0) or (form == "lines" and geometry.length == 0.0):
        raise InputError(f"{name}: {shape.label} has no {'area' if form == 'polygons' else 'length'}; draw it again")
