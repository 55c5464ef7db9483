"""Changes of the ground: dams, walls, excavations, buildings."""

import math
from collections.abc import Iterable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from scipy.ndimage import binary_erosion, map_coordinates

from ..core.errors import InputError
from ..geo.cover import nodes_inside, nodes_near
from ..geo.lattice import Lattice
from ..geo.names import said
from ..geo.shapes import Shape, read_shapes
from .terrain_keys import Edit

FEWEST_ACROSS = 3
"""Least width of an obstacle in nodes: sums over neighbours reach through a thinner one."""
CREST_WIDTH = 3.0
"""Default width of the crest of a dam [m]."""
SLOPES = {"dam": math.degrees(math.atan(2.0 / 3.0)), "excavation": 45.0}
"""Default angle of the sides [deg]."""
FARTHEST = 100.0
"""Length of a line over the diagonal of the terrain above which it is refused [-]."""
FAR = 4.0
"""Width of a side over its width on level ground, from which on a note says so [-]."""
SQUARE = np.ones((FEWEST_ACROSS, FEWEST_ACROSS), bool)


class Ground(NamedTuple):
    """Ground that edits change in place.

    Attributes
    ----------
    elevation : ndarray, shape (rows, columns)
        NaN where there are no data [m].
    soil : ndarray, shape (rows, columns), or None
        Depth of erodible soil [m].
    closed : ndarray of bool, shape (rows, columns)
        Nodes that no flow enters.
    lattice : Lattice
        Place of the nodes on the map.
    """

    elevation: np.ndarray
    soil: np.ndarray | None
    closed: np.ndarray
    lattice: Lattice


def edit_ground(edits: Iterable[Edit], ground: Ground, extent: Lattice, folder: Path, notes: list[str]) -> None:
    """Change a ground in place, one edit after the other.

    Built things hold no erodible soil: dams, walls and raised buildings cover it. An excavation takes soil first.

    Parameters
    ----------
    edits : iterable of Edit
    ground : Ground
    extent : Lattice
        Extent of the whole DEM, in which shapes have to lie.
    folder : Path
        Directory to which names of files are relative.
    notes : list of str
        Remarks for the user are appended to it.

    Raises
    ------
    InputError
        If a file cannot be used, an obstacle is thinner than three nodes, or an edit changes nothing.
    """
    for k, edit in enumerate(edits):
        value, kind = getattr(edit, edit.kind), "line" if edit.kind in ("dam", "wall") else "polygon"
        source = folder / value if isinstance(value, str) else value
        try:
            shapes = read_shapes(source, extent.crs, kind=kind, bounds=extent.bounds, notes=notes)
            if edit.kind == "buildings":
                told = _build(edit, shapes, ground)
            else:
                change = _dig if edit.kind == "excavation" else _raise_crest
                told = "; ".join(filter(None, (change(edit, shape, ground) for shape in shapes)))
        except InputError as error:
            raise InputError(f"edits[{k}]: {edit.kind}: {error}") from error
        said(notes, f"edits[{k}]: {edit.kind}: {told or 'lies outside of the window, nothing is changed'}")


def _raise_crest(edit: Edit, shape: Shape, ground: Ground) -> str:
    """Raise the ground along a line to a crest, with sloping sides or upright ones; return a note.

    Every node within half a diagonal of a cell from the line gets the crest, so that it has no gap between nodes.
    """
    lattice, (dx, dy) = ground.lattice, ground.lattice.spacing
    upright = edit.kind == "wall"
    least = FEWEST_ACROSS * max(dx, dy)
    width = edit.crest_width or (least if upright else CREST_WIDTH)
    if upright and width < least * (1.0 - 1e-9):
        raise InputError(
            f"{shape.label} is {width:g} m thick, less than {FEWEST_ACROSS} nodes of {max(dx, dy):g} m: sums over "
            f"particles would reach through it; give a spacing of at most {_rounded_down(width / FEWEST_ACROSS)} m, "
            "or a thicker wall by crest_width"
        )
    half = max(0.5 * width, 0.5 * math.hypot(dx, dy))
    stations, profile = _crest(edit, shape, ground)
    steepness = math.tan(math.radians(edit.slope or SLOPES["dam"])) if not upright else math.inf
    reach = half
    if not upright and steepness < 1e6:
        reach += max(0.0, float(np.nanmax(profile)) - float(np.nanmin(ground.elevation, initial=np.inf))) / steepness
    near = nodes_near(shape.geometry, lattice, reach * (1.0 + 1e-9))
    if near.nodes.size == 0:
        return ""
    crest = np.interp(near.station, stations, profile)
    beside = np.maximum(near.distance - half, 0.0)
    beside[beside < 1e-6 * half] = 0.0
    body = np.where(beside == 0.0, crest, crest - beside * steepness if math.isfinite(steepness) else -np.inf)
    before = ground.elevation.reshape(-1)[near.nodes]
    raised = body > before  # nodes without data stay without
    if not raised.any():
        raise InputError(
            f"{shape.label}: no node is raised, the crest ({profile.min():g} to {profile.max():g} m) lies below the "
            f"ground ({np.nanmin(before):g} to {np.nanmax(before):g} m); heights are in m"
        )
    nodes = near.nodes[raised]
    if not upright:
        _check_thickness(shape, nodes, ground, width, float((body - before)[raised].max()), steepness)
    gain = (body - before)[raised]
    ground.elevation.reshape(-1)[nodes] = body[raised]
    _cover_soil(ground, nodes)
    wider = f", crest widened from {width:g} to {2.0 * half:.3g} m to have no gap" if half > 0.5 * width + 1e-9 else ""
    if not upright and beside[raised].max() > FAR * gain[beside[raised] == 0.0].max(initial=0.0) / steepness:
        wider += "; its sides are hardly steeper than the ground, so that it reaches far down: give a steeper slope"
    return (
        f"{shape.label}: {_volume(gain, lattice)} on {nodes.size} nodes, crest at {crest.min():.6g} to "
        f"{crest.max():.6g} m, up to {gain.max():.3g} m above the ground{wider}"
    )


def _crest(edit: Edit, shape: Shape, ground: Ground) -> tuple[np.ndarray, np.ndarray]:
    """Return stations along a line and the elevation of the crest there [m]."""
    line, lattice = shape.geometry, ground.lattice
    if edit.crest_elevation is not None:
        return np.array([0.0, line.length]), np.full(2, edit.crest_elevation)
    rows, columns = lattice.shape
    extent = math.hypot(rows * lattice.spacing[1], columns * lattice.spacing[0])
    if line.length > FARTHEST * extent:
        raise InputError(
            f"{shape.label} is {line.length:.4g} m long, the terrain has {extent:.4g} m from corner to corner; draw "
            "the line where the terrain is"
        )
    count = math.ceil(line.length / (0.5 * min(lattice.spacing))) + 1
    stations = np.linspace(0.0, line.length, count)
    points = np.array([line.interpolate(station).coords[0][:2] for station in stations])
    x, y = ((points - lattice.lower_left) / lattice.spacing).T
    level = map_coordinates(ground.elevation, [y, x], order=1, mode="nearest")
    inside = (x > -0.5) & (y > -0.5) & (x < lattice.shape[1] - 0.5) & (y < lattice.shape[0] - 0.5) & np.isfinite(level)
    if not inside.any():
        return stations, np.full(count, np.nan_to_num(np.nanmin(ground.elevation)) + edit.crest_height)
    return stations, np.interp(stations, stations[inside], level[inside]) + edit.crest_height


def _check_thickness(shape: Shape, nodes: np.ndarray, ground: Ground, width: float, height: float, steepness: float):
    """Refuse a dam of which no part is three nodes thick."""
    if not _thick(nodes, ground.lattice.shape):
        base = width + 2.0 * height / steepness
        raise InputError(
            f"{shape.label} is nowhere {FEWEST_ACROSS} nodes thick ({base:.3g} m at its base, nodes every "
            f"{max(ground.lattice.spacing):g} m): sums over particles would reach through it; give a spacing of "
            f"at most {_spacing_for(base)} m, or a wider crest by crest_width"
        )


def _dig(edit: Edit, shape: Shape, ground: Ground) -> str:
    """Dig out a polygon to a depth or to the elevation of a floor, with sloping sides inside; return a note."""
    lattice = ground.lattice
    nodes = nodes_inside(shape.geometry, lattice)
    if nodes.size == 0:
        if _in_window(shape, lattice):
            raise InputError(
                f"{shape.label}: no node lies inside, nodes are {max(lattice.spacing):g} m apart; give a finer spacing"
            )
        return ""
    import shapely

    x0, y0 = lattice.lower_left
    rim = shapely.transform(shape.geometry, lambda points: points - (x0, y0)).boundary
    rows, columns = np.divmod(nodes, lattice.shape[1])
    inward = shapely.distance(rim, shapely.points(columns * lattice.spacing[0], rows * lattice.spacing[1]))
    elevation = ground.elevation.reshape(-1)
    before = elevation[nodes]
    slope = edit.slope or SLOPES["excavation"]
    sides = np.full(nodes.size, np.inf) if slope >= 90.0 else inward * math.tan(math.radians(slope))
    cut = np.minimum(sides, edit.depth if edit.depth is not None else before - edit.floor_elevation)
    cut = np.maximum(np.nan_to_num(cut, nan=0.0), 0.0)
    if not cut.any():
        raise InputError(
            f"{shape.label}: nothing is dug, the floor ({edit.floor_elevation} m) lies above the ground "
            f"({np.nanmin(before):g} to {np.nanmax(before):g} m)"
        )
    elevation[nodes] = before - cut
    if ground.soil is not None:
        soil = ground.soil.reshape(-1)
        soil[nodes] = np.maximum(soil[nodes] - cut, 0.0)
    return f"{shape.label}: {_volume(cut, lattice)} dug out, up to {cut.max():.3g} m deep"


def _build(edit: Edit, shapes: list[Shape], ground: Ground) -> str:
    """Close the nodes of buildings, or raise them by a height; return a note."""
    lattice = ground.lattice
    raised, closed, thin = 0, 0, []
    for shape in shapes:
        nodes = nodes_inside(shape.geometry, lattice)
        if not _thick(nodes, lattice.shape):
            if _in_window(shape, lattice):
                thin.append(shape)
            continue
        height = shape.number("height", edit.height, low=0.0)
        if height is None:
            ground.closed.reshape(-1)[nodes] = True
            closed += 1
        else:
            elevation = ground.elevation.reshape(-1)
            if np.isfinite(elevation[nodes]).any():  # a flat roof
                elevation[nodes] = np.where(np.isnan(elevation[nodes]), np.nan, np.nanmax(elevation[nodes]) + height)
            raised += 1
        _cover_soil(ground, nodes)
    if thin and edit.thin == "refuse":
        widths = [_width(shape.geometry) for shape in thin]
        raise InputError(
            f"{len(thin)} of {len(shapes)} buildings, the first {thin[0].label}, are not {FEWEST_ACROSS} nodes thick, "
            f"nodes are {max(lattice.spacing):g} m apart: sums over particles would reach through it; a spacing of "
            f"{_spacing_for(min(widths))} m would do for all of them, {_spacing_for(float(np.median(widths)))} m for "
            "half; or leave them out by thin: leave_out"
        )
    told = [f"{closed} are closed nodes"] * bool(closed) + [f"{raised} are raised ground"] * bool(raised)
    told += [f"{len(thin)} thinner than {FEWEST_ACROSS} nodes are left out"] * bool(thin)
    return ", ".join(told)


def _volume(depths: np.ndarray, lattice: Lattice) -> str:
    volume = float(depths.sum()) * lattice.area
    return f"{volume:.0f} m3" if volume >= 1000.0 else f"{volume:.4g} m3"


def _cover_soil(ground: Ground, nodes: np.ndarray) -> None:
    if ground.soil is not None:
        ground.soil.reshape(-1)[nodes] = 0.0


def _thick(nodes: np.ndarray, shape: tuple[int, int]) -> bool:
    """Return whether some nodes hold a square of three by three."""
    if nodes.size < FEWEST_ACROSS**2:
        return False
    rows, columns = np.divmod(nodes, shape[1])
    mask = np.zeros((np.ptp(rows) + 1, np.ptp(columns) + 1), bool)
    mask[rows - rows.min(), columns - columns.min()] = True
    return bool(binary_erosion(mask, SQUARE).any())


def _in_window(shape: Shape, lattice: Lattice) -> bool:
    return min(lattice.window_around(shape.geometry.bounds).shape) > 0


def _width(polygon: Any) -> float:
    """Return the shorter side of the smallest rectangle around a polygon [m]."""
    ring = np.array(polygon.minimum_rotated_rectangle.exterior.coords)
    return float(np.hypot(*np.diff(ring[:3], axis=0).T).min())


def _spacing_for(width: float) -> str:
    """Return the spacing at which a strip of some width holds three by three nodes, however it lies [m]."""
    # the diagonal of the square of three cells
    return _rounded_down(width / (FEWEST_ACROSS * math.sqrt(2.0)))


def _rounded_down(value: float) -> str:
    """Return a length rounded down to two digits."""
    unit = 10.0 ** (math.floor(math.log10(value)) - 1)
    return f"{math.floor(value / unit + 1e-9) * unit:.2g}"
