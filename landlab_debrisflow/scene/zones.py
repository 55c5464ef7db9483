"""Parameters of laws that differ from place to place: by zones, or by rasters."""

import dataclasses
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from ..core.checks import in_range
from ..core.errors import InputError, ParameterError
from ..core.hints import did_you_mean
from ..core.values import NodeValues, checked
from ..geo.cover import nodes_inside
from ..geo.lattice import Lattice
from ..geo.names import said
from ..geo.resampling import read_onto
from ..geo.shapes import Shape, read_shapes
from .setup import Setup, is_declared
from .terrain_keys import Zone

KINDS = ("friction", "erosion")
"""Laws whose parameters may vary in space."""
RASTERS = (".tif", ".tiff", ".asc", ".nc", ".nc4", ".vrt", ".img", ".bil", ".flt", ".grd", ".sdat", ".txt")
VECTORS = (".gpkg", ".geojson", ".json", ".shp", ".gdb", ".fgb", ".kml", ".gml", ".csv", ".sqlite")


class VaryingParameter(NamedTuple):
    """Parameter of a law that has a value at every node.

    Attributes
    ----------
    kind : str
        Kind of the law, such as "friction".
    name : str
        Name of the parameter.
    base : float or str
        Value outside of zones [unit of the parameter], or the file of a raster of values.
    fallback : float
        Value where this raster has no data.
    bounds : tuple of float
        Least and largest value allowed.
    unit : str
        Unit as declared.
    values : tuple of float or None
        Value in each zone of the scene, None where the zone gives none.
    """

    kind: str
    name: str
    base: float | str
    fallback: float
    bounds: tuple[float, float]
    unit: str
    values: tuple[float | None, ...]

    @property
    def field(self) -> str:
        """Name of the field of the grid that holds its values."""
        return f"{self.kind}__{self.name}"


def has_suffix(name: Any, suffixes: Sequence[str]) -> bool:
    """Return whether a value is the name of a file of some kind, with or without a layer after a colon."""
    if not isinstance(name, str):
        return False
    path = Path(name)
    return path.suffix.lower() in suffixes or Path(path.name.rpartition(":")[0]).suffix.lower() in suffixes


def varying_parameters(setup: Setup, zones: Iterable[Zone]) -> tuple[VaryingParameter, ...]:
    """Return the parameters that vary by zones or rasters, without reading a file.

    Parameters
    ----------
    setup : Setup
        Setup written in the scene.
    zones : iterable of Zone

    Returns
    -------
    tuple of VaryingParameter

    Raises
    ------
    ParameterError
        If a zone names a parameter that the law does not have or that may not vary, or a value is not allowed.
    """
    found, zones = [], tuple(zones)
    for kind in KINDS:
        law = getattr(setup, kind)
        fields = {field.name: field for field in dataclasses.fields(law)} if is_declared(law) else {}
        varies = [name for name, field in fields.items() if field.metadata["varies"]]
        given = [getattr(zone, kind) or {} for zone in zones]
        for k, values in enumerate(given):
            for name in values:
                if name not in varies:
                    reason = "may not vary in space" if name in fields else f"is no parameter of {type(law).__name__}"
                    raise ParameterError(
                        f"zones[{k}]: {kind}: {name} {reason}{did_you_mean(name, varies)}; allowed: "
                        f"{', '.join(varies) or 'none'}"
                    )
        for name in varies:
            field, base = fields[name], getattr(law, name)
            if any(name in values for values in given) or has_suffix(base, RASTERS):
                found.append(_varying(kind, field, base, given))
    return tuple(found)


def _varying(kind: str, field, base: Any, given: Sequence[Mapping[str, Any]]) -> VaryingParameter:
    name, meta = field.name, field.metadata
    if base is None or isinstance(base, NodeValues) or (isinstance(base, str) and not has_suffix(base, RASTERS)):
        raise ParameterError(
            f"{kind}: {name} must be a number [{meta['unit']}] or a raster, because zones change it, got {base!r}"
        )
    values = []
    for k, zone in enumerate(given):
        value = checked(f"zones[{k}]: {kind}", name, field, zone[name]) if name in zone else None
        if value is not None and not isinstance(value, float | int):
            raise ParameterError(f"zones[{k}]: {kind}: {name} must be a number [{meta['unit']}], got {zone[name]!r}")
        values.append(value)
    fallback = field.default if isinstance(field.default, float | int) else meta["bounds"][0]
    return VaryingParameter(kind, name, base, fallback, meta["bounds"], meta["unit"], tuple(values))


def with_fields(setup: Setup, parameters: Iterable[VaryingParameter]) -> Setup:
    """Return a setup whose laws read varying parameters from the fields of the grid that `parameter_fields` makes."""
    laws = {kind: getattr(setup, kind) for kind in KINDS}
    for one in parameters:
        laws[one.kind] = dataclasses.replace(laws[one.kind], **{one.name: one.field})
    return dataclasses.replace(setup, **laws)


def parameter_fields(
    parameters: Iterable[VaryingParameter],
    zones: Sequence[np.ndarray],
    lattice: Lattice,
    folder: Path,
    notes: list[str],
) -> dict[str, np.ndarray]:
    """Return the values of varying parameters at nodes.

    Parameters
    ----------
    parameters : iterable of VaryingParameter
    zones : sequence of ndarray
        Numbers of the nodes of each zone, as `zone_nodes` returns them; of two zones over a node the later one counts.
    lattice : Lattice
    folder : Path
        Directory to which names of files are relative.
    notes : list of str
        Remarks for the user are appended to it.

    Returns
    -------
    dict of str to ndarray, shape (rows, columns)
        By the name of the field, in the unit of the parameter.

    Raises
    ------
    InputError
        If a raster cannot be used or has values that are not allowed.
    """
    fields = {}
    for one in parameters:
        if isinstance(one.base, str):
            values = read_onto(folder / one.base, lattice, lengths=False, notes=notes)
            missing = np.isnan(values)
            if missing.any():
                said(
                    notes,
                    f"{one.base}: {one.kind}: {one.name} is {one.fallback:g} at {missing.sum()} nodes without data",
                )
            values[missing] = one.fallback
            in_range(f"{folder / one.base}: {one.name}", values, *one.bounds, one.unit, form="g", error=InputError)
        else:
            values = np.full(lattice.shape, float(one.base))
        for nodes, value in zip(zones, one.values, strict=True):
            if value is not None:
                values.reshape(-1)[nodes] = value
        fields[one.field] = values
    return fields


def zone_nodes(
    zones: Iterable[Zone], lattice: Lattice, extent: Lattice, folder: Path, notes: list[str]
) -> list[np.ndarray]:
    """Return the numbers of the nodes in each zone.

    Parameters
    ----------
    zones : iterable of Zone
    lattice : Lattice
        Nodes of the terrain.
    extent : Lattice
        Extent of the whole DEM, in which polygons have to lie.
    folder : Path
        Directory to which names of files are relative.
    notes : list of str
        Remarks for the user are appended to it.
    """
    found = []
    for k, zone in enumerate(zones):
        shapes = polygons_of(zone.polygons, extent, folder, notes)
        nodes = [nodes_inside(shape.geometry, lattice) for shape in shapes]
        found.append(np.unique(np.concatenate(nodes)))
        if found[-1].size == 0:
            said(notes, f"zones[{k}]: no node of the terrain lies inside")
    return found


def polygons_of(value: Any, extent: Lattice, folder: Path, notes: list[str]) -> list[Shape]:
    """Return the polygons that a key names as a file or holds as coordinates."""
    source = folder / value if isinstance(value, str) else value
    return read_shapes(source, extent.crs, kind="polygon", bounds=extent.bounds, notes=notes)
