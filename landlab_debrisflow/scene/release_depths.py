"""Depth over nodes of the bodies of a release: from polygons with a depth or volume, or from a raster."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from ..core.errors import InputError
from ..core.hints import did_you_mean, python_value
from ..geo.cover import covered_fraction
from ..geo.lattice import Lattice, extent
from ..geo.resampling import read_onto
from ..geo.shapes import Shape
from .failure_surface import failure_surface
from .keys import ReleaseKeys
from .shapes import shapes_of
from .terrain import lattice_of

MOST_DEPTH = 1000.0
"""Largest depth that is accepted [m]: no landslide is deeper, so that the unit must be wrong."""


class Ground(NamedTuple):
    """Ground below releases.

    Attributes
    ----------
    lattice : Lattice
        Place of the nodes on the map.
    elevation : ndarray, shape (rows, columns)
        Elevation, NaN where there are no data [m].
    soil : ndarray, shape (rows, columns), or None
        Depth of erodible soil [m].
    core : ndarray of bool, shape (rows, columns)
        Nodes that may hold mass: neither closed nor on the edge of the grid.
    """

    lattice: Lattice
    elevation: np.ndarray
    soil: np.ndarray | None
    core: np.ndarray

    @classmethod
    def of(cls, terrain: xr.Dataset) -> "Ground":
        """Return the ground of a terrain."""
        elevation = terrain["topographic__elevation"].values
        core = np.isfinite(elevation)
        if "closed" in terrain:
            core &= ~terrain["closed"].values
        core[[0, -1], :] = core[:, [0, -1]] = False
        soil = terrain["soil__depth"].values if "soil__depth" in terrain else None
        return cls(lattice_of(terrain), elevation, soil, core)

    def plane_slope(self, nodes: np.ndarray) -> np.ndarray:
        """Return the rise towards east and north of the plane fitted to the ground at some nodes, shape (2,) [-].

        Fewer than three nodes get the nodes around them.

        Parameters
        ----------
        nodes : ndarray of bool, shape (rows, columns)
        """
        rows, columns = np.nonzero(nodes)
        if rows.size == 0:
            return np.zeros(2)
        if np.ptp(rows) < 2 or np.ptp(columns) < 2:
            near = slice(max(0, rows.min() - 1), rows.max() + 2), slice(max(0, columns.min() - 1), columns.max() + 2)
            wider = np.zeros_like(nodes)
            wider[near] = np.isfinite(self.elevation[near])
            rows, columns = np.nonzero(wider)
        dx, dy = self.lattice.spacing
        x, y, z = columns * dx, rows * dy, self.elevation[rows, columns]
        plane, *_ = np.linalg.lstsq(np.column_stack([x - x.mean(), y - y.mean()]), z - z.mean(), rcond=None)
        return plane


class Body(NamedTuple):
    """Connected mass of a release.

    Attributes
    ----------
    depth : ndarray, shape (rows, columns)
        Vertical depth [m].
    notes : list of str
        Remarks for the user.
    """

    depth: np.ndarray
    notes: list[str]


def polygon_depths(keys: ReleaseKeys, ground: Ground, folder: Path) -> Iterator[Body]:
    """Yield the bodies below the polygons of a release.

    Parameters
    ----------
    keys : ReleaseKeys
    ground : Ground
    folder : Path
        Directory to which names of files are relative.

    Yields
    ------
    Body

    Raises
    ------
    InputError
        If a polygon has neither depth nor volume, or one out of bounds, or lies outside of the terrain, or if no body
        of that size could leave it.
    """
    notes: list[str] = []
    for shape in shapes_of(keys.polygons, "polygon", ground.lattice, folder, notes):
        body = _polygon_body(keys, shape, ground)
        yield Body(body.depth, [*notes, *body.notes])
        notes = []


def _polygon_body(keys: ReleaseKeys, shape: Shape, ground: Ground) -> Body:
    amount = _amount(keys, shape)
    fraction, notes = covered_fraction(shape.geometry, ground.lattice), []
    whole = float(shape.geometry.area)
    usable = np.where(ground.core, fraction, 0.0)
    inside = float(usable.sum()) * ground.lattice.area
    if inside <= 0.0:
        raise InputError(
            f"{shape.label} covers no node of the terrain that may hold mass: all of it, "
            f"{extent(shape.geometry.bounds)}, lies on the edge of the grid or without elevation; "
            "use a larger DEM, or move the polygon"
        )
    if inside < 0.999 * whole:
        kept = "the volume is kept" if "volume" in amount else "the part there is left out"
        notes.append(
            f"{shape.label}: {100.0 * (1.0 - inside / whole):.3g} % of it lie outside, on the edge of the grid or "
            f"without elevation; {kept}"
        )
    if keys.from_ == "above" or keys.failure_surface == "uniform":
        (name, value), *_ = amount.items()
        return Body(usable * (value / inside if name == "volume" else value), notes)
    return Body(_failing_depth(keys, usable, amount, ground, shape.label), notes)


def _failing_depth(
    keys: ReleaseKeys, usable: np.ndarray, amount: dict[str, float], ground: Ground, label: str
) -> np.ndarray:
    """Return the depth of the body that fails within an outline [m]; only the nodes around it are read.

    `usable` is the fraction of each cell inside [-], shape (rows, columns); `amount` as `_amount` returns it.
    """
    rows, columns = np.nonzero(usable)
    # no release on the edge of the grid
    near = slice(rows.min() - 1, rows.max() + 2), slice(columns.min() - 1, columns.max() + 2)
    depth, kind = np.zeros_like(usable), keys.failure_surface or "tapered"
    try:
        depth[near] = failure_surface(
            usable[near],
            ground.elevation[near],
            ground.lattice.spacing,
            kind=kind,
            **amount,
        )
    except InputError as error:
        raise InputError(f"{label}: {error}; in a scene that is from: above") from error
    return depth


AMOUNTS = {"depth": "mean_depth", "largest_depth": "largest_depth", "volume": "volume"}
"""Attributes and keys for the size of the body in a polygon, and the arguments of `failure_surface` that they
become."""


def _amount(keys: ReleaseKeys, shape: Shape) -> dict[str, float]:
    """Return the size of the body in a polygon by name: mean depth [m], largest depth [m] or volume [m3]."""
    attributes = {str(name).lower(): value for name, value in shape.attributes.items()}
    found = {name: number for name in AMOUNTS if (number := _number(name, attributes, shape)) is not None}
    if len(found) > 1:
        raise InputError(f"{shape.label} has both a {' and a '.join(found)}; keep the one that counts")
    if not found:
        found = {name: getattr(keys, name) for name in AMOUNTS if getattr(keys, name) is not None}
    if not found:
        names = list(shape.attributes)
        near = "".join(did_you_mean(name, AMOUNTS) for name in names)
        told = f"attributes are {', '.join(map(str, names))}{near}" if names else "it has no attribute with a value"
        raise InputError(
            f"{shape.label} has neither an attribute depth [m] nor volume [m3] with a value; {told}; add one, or the "
            "key depth or volume to the release"
        )
    (name, value), *_ = found.items()
    if name != "volume" and value > MOST_DEPTH:
        raise InputError(f"{shape.label}: {name} must be at most {MOST_DEPTH:g} m, got {value:g}; give metres")
    return {AMOUNTS[name]: value}


def _number(name: str, attributes: dict[str, Any], shape: Shape) -> float | None:
    """Return the number of an attribute, or None if the feature has none."""
    value = python_value(attributes.get(name))
    if value is None or value == "" or value != value:
        return None
    try:
        number = float(value)
    except (TypeError, ValueError):
        raise InputError(
            f"{shape.label}: {name} must be a number, got {value!r:.60}; write it with a decimal point and without "
            "unit, or give the attribute a numeric type"
        ) from None
    if isinstance(value, bool) or not 0.0 < number < np.inf:
        raise InputError(f"{shape.label}: {name} must be a number more than 0, got {value!r:.60}")
    return number


def raster_depth(keys: ReleaseKeys, ground: Ground, folder: Path) -> list[Body]:
    """Return the body that a raster of depths describes.

    Parameters
    ----------
    keys : ReleaseKeys
    ground : Ground
    folder : Path
        Directory to which names of files are relative.

    Returns
    -------
    list of Body
        One.

    Raises
    ------
    InputError
        If the raster does not reach the terrain, has values of both signs, or has no depth on core nodes.
    """
    notes: list[str] = []
    path = folder / str(keys.raster)
    depth = np.nan_to_num(read_onto(path, ground.lattice, notes=notes))
    if depth.min() < 0.0 and depth.max() <= 0.0:
        depth = -depth
        notes.append(f"{path.name}: no value is > 0, they are taken as losses of elevation, up to {depth.max():.4g} m")
    if depth.min() < 0.0:
        raise InputError(
            f"{path.name}: depths must all be 0 m or more, or all be losses of elevation of 0 m or less, got "
            f"{depth.min():g} to {depth.max():g} m; cut out the deposit"
        )
    if depth.max() > MOST_DEPTH:
        raise InputError(f"{path.name}: depths must be at most {MOST_DEPTH:g} m, got {depth.max():g}; give metres")
    fails = depth > 0.0
    if np.count_nonzero(fails) > 1 and (depth[fails] == 1.0).all():
        notes.append(
            f"{path.name}: every depth is exactly 1 m; if the raster marks where ground fails, not how deep, "
            "multiply it by the depth, or turn it into polygons"
        )
    usable = np.where(ground.core, depth, 0.0)
    if usable.max() <= 0.0:
        raise InputError(
            f"{path.name} has no depth > 0 where the terrain may hold mass; check its values and its place"
        )
    if lost := float((depth - usable).sum()) * ground.lattice.area:
        notes.append(f"{path.name}: {lost:.4g} m3 on the edge of the grid or without elevation are left out")
    return [Body(usable, notes)]
