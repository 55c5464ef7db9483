"""Shapes that a scene names as a file or writes as coordinates."""

from pathlib import Path
from typing import Any

from ..core.errors import InputError
from ..geo.lattice import Lattice
from ..geo.shapes import Shape, read_shapes


def shapes_of(
    value: Any, kind: str, lattice: Lattice, folder: Path, notes: list[str] | None = None, *, named: bool = False,
    only_inside: bool = False,
) -> list[Shape]:  # fmt: skip
    """Return the shapes that the value of a key stands for.

    Parameters
    ----------
    value : str or tuple
        Name of a file, or checked coordinates.
    kind : {"point", "line", "polygon"}
        Kind of shape.
    lattice : Lattice
        Lattice whose coordinate reference system the shapes get; shapes outside are refused.
    folder : Path
        Directory to which names of files are relative.
    notes : list of str, optional
        Remarks for the user are appended to it.
    named : bool
        Whether coordinates have names; these become the attribute ``name``.
    only_inside : bool
        Whether shapes of a file that lie wholly outside are left out, with a note, if another one does not.

    Returns
    -------
    list of Shape

    Raises
    ------
    InputError
        If a file cannot be read, or a shape is of another kind, not valid or outside.
    """
    if isinstance(value, str):
        return read_shapes(
            folder / value, lattice.crs, kind=kind, bounds=lattice.bounds, notes=notes, only_inside=only_inside
        )
    if not named:
        return read_shapes(list(value), lattice.crs, kind=kind, bounds=lattice.bounds, notes=notes)
    shapes = []
    for name, feature in value:
        try:
            (shape,) = read_shapes([feature], lattice.crs, kind=kind, bounds=lattice.bounds, notes=notes)
        except InputError as error:
            raise InputError(f"{name}: {error}") from error
        shapes.append(shape._replace(attributes={"name": name}, label=name))
    return shapes
