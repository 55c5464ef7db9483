"""Places of output of a scene as plain coordinates."""

from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from ..core.errors import InputError
from ..geo.lattice import Lattice
from ..geo.shapes import Shape
from .keys import OutputKeys
from .location import located
from .read_yaml import YamlFile
from .shapes import shapes_of

NAMES = ("name", "id", "fid", "label")
"""Attributes that may name a feature, the first that is there."""


class OutputPlaces(NamedTuple):
    """Places of output on the map.

    Attributes
    ----------
    gauges : dict of str to ndarray, shape (2,)
        Points by name [m].
    sections : dict of str to ndarray, shape (n, 2)
        Lines by name [m].
    thalweg : ndarray, shape (n, 2), or None
        Line along which the front is followed [m].
    exposure : dict of str to Shape
        Polygons by id.
    notes : tuple of str
        Remarks on the files.
    """

    gauges: dict[str, np.ndarray]
    sections: dict[str, np.ndarray]
    thalweg: np.ndarray | None
    exposure: dict[str, Shape]
    notes: tuple[str, ...] = ()


def output_places(keys: OutputKeys, lattice: Lattice, folder: Path, file: YamlFile | None = None) -> OutputPlaces:
    """Return the places that the output of a scene names.

    Parameters
    ----------
    keys : OutputKeys
    lattice : Lattice
        Nodes of the terrain.
    folder : Path
        Directory to which names of files are relative.
    file : YamlFile, optional
        Scene file, to name lines.

    Returns
    -------
    OutputPlaces

    Raises
    ------
    InputError
        If a file cannot be used, a gauge, a section or all polygons lie outside of the terrain, a name is there twice,
        or a line has parts.
    """
    notes: list[str] = []
    with located(file, "output", "exposure"):
        exposure = _named(keys.exposure, "polygon", lattice, folder, notes)
    with located(file, "output", "gauges"):
        points = _named(keys.gauges, "point", lattice, folder, notes)
        gauges = {name: _coordinates(shape)[0] for name, shape in points.items()}
    with located(file, "output", "sections"):
        lines = _named(keys.sections, "line", lattice, folder, notes)
        sections = {name: _coordinates(shape) for name, shape in lines.items()}
    with located(file, "output", "thalweg"):
        thalweg = None if keys.thalweg is None else _only_line(shapes_of(keys.thalweg, "line", lattice, folder, notes))
    return OutputPlaces(gauges, sections, thalweg, exposure, tuple(notes))


def _only_line(shapes: list[Shape]) -> np.ndarray:
    if len(shapes) != 1:
        raise InputError(f"one line is wanted, got {len(shapes)}; keep one in a file of its own")
    return _coordinates(shapes[0])


def _named(value: Any, kind: str, lattice: Lattice, folder: Path, notes: list[str]) -> dict[str, Shape]:
    if value is None:
        return {}
    found: dict[str, Shape] = {}
    layer = kind == "polygon"  # of all buildings of a region perhaps; gauges and sections are few, and each is missed
    for shape in shapes_of(value, kind, lattice, folder, notes, named=True, only_inside=layer):
        attributes = {str(name).lower(): one for name, one in shape.attributes.items()}
        name = next((_text(attributes[one]) for one in NAMES if _text(attributes.get(one))), str(shape.feature))
        if name in found:
            raise InputError(f"{found[name].label} and {shape.label} are both named {name!r}; rename one")
        found[name] = shape
    return found


def _text(value) -> str:
    if value is None or value != value:
        return ""
    return f"{value:g}" if isinstance(value, float) else str(value).strip()


def _coordinates(shape: Shape) -> np.ndarray:
    """Return the coordinates of a point or line, shape (n, 2) [m]."""
    parts = list(getattr(shape.geometry, "geoms", [shape.geometry]))
    if len(parts) != 1:
        raise InputError(f"{shape.label} has {len(parts)} parts; give each a feature of its own")
    return np.array(parts[0].coords)[:, :2]
