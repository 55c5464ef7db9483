"""Places of output of a scene as plain coordinates."""

from pathlib import Path
from typing import NamedTuple

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
    """

    gauges: dict[str, np.ndarray]
    sections: dict[str, np.ndarray]
    thalweg: np.ndarray | None
    exposure: dict[str, Shape]


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
        If a file cannot be used, a place lies outside of the terrain, a name is there twice, or a line has parts.
    """
    with located(file, "output"):
        gauges = _named(keys, "gauges", "points", lattice, folder)
        sections = _named(keys, "sections", "lines", lattice, folder)
        exposure = _named(keys, "exposure", "polygons", lattice, folder)
        thalweg = None
        if keys.thalweg is not None:
            lines = shapes_of(keys.thalweg, "lines", lattice, folder, "thalweg")
            if len(lines) != 1:
                raise InputError(f"thalweg must be one line, got {len(lines)} in {keys.thalweg}")
            thalweg = _coordinates("thalweg", lines[0])
        return OutputPlaces(
            {name: _coordinates(f"gauges: {name}", shape)[0] for name, shape in gauges.items()},
            {name: _coordinates(f"sections: {name}", shape) for name, shape in sections.items()},
            thalweg,
            exposure,
        )


def _named(keys: OutputKeys, key: str, form: str, lattice: Lattice, folder: Path) -> dict[str, Shape]:
    value = getattr(keys, key)
    if value is None:
        return {}
    found: dict[str, Shape] = {}
    for k, shape in enumerate(shapes_of(value, form, lattice, folder, key, named=True), 1):
        attributes = {str(name).lower(): one for name, one in shape.attributes.items()}
        name = next((_text(attributes[one]) for one in NAMES if _text(attributes.get(one))), str(k))
        if name in found:
            raise InputError(f"{key}: {found[name].label} and {shape.label} are both named {name!r}; rename one")
        _check_inside(key, name, shape, lattice)
        found[name] = shape
    if not found:
        raise InputError(f"{key}: {value} holds no {form}")
    return found


def _text(value) -> str:
    if value is None or value != value:
        return ""
    return f"{value:g}" if isinstance(value, float) else str(value).strip()


def _check_inside(key: str, name: str, shape: Shape, lattice: Lattice):
    west, south, east, north = lattice.bounds
    left, below, right, above = shape.geometry.bounds
    outside = right < west or left > east or above < south or below > north
    if outside or (key == "gauges" and not (west <= left <= east and south <= below <= north)):
        raise InputError(
            f"{key}: {name} at {0.5 * (left + right):.10g}, {0.5 * (below + above):.10g} lies outside of the terrain "
            f"[{west:.10g}, {south:.10g}, {east:.10g}, {north:.10g}] (west, south, east, north) [m]; compare their "
            "coordinate systems"
        )


def _coordinates(name: str, shape: Shape) -> np.ndarray:
    """Return the coordinates of a point or line, shape (n, 2) [m]."""
    parts = list(getattr(shape.geometry, "geoms", [shape.geometry]))
    if len(parts) != 1:
        raise InputError(f"{name}: {shape.label} has {len(parts)} parts; give each a feature of its own")
    return np.array(parts[0].coords)[:, :2]
