"""Doubts about input that can be computed but is hardly meant: units, coordinates, names. Each is a sentence to log."""

import dataclasses
import difflib
from collections.abc import Iterator
from numbers import Real

import numpy as np
from scipy.ndimage import find_objects, label

from ..core.values import NodeValues, with_inner
from ..spatial.raster import CLOSED
from .checks import where
from .consolidation import FASTEST_CONSOLIDATION
from .fields import NODE_FIELDS
from .fill_values import HIGHEST, LOWEST, code_of, elevation_range

UPRIGHT = 10.0  # largest relief over extent of a whole DEM [-]
DEGREES_BELOW = 0.01  # node spacing below which coordinates may be degrees [m]
LEAST_ANGLE = 2.0  # [deg]
DENSITIES = 500.0, 8000.0  # [kg m-3]
LARGEST_GROWTH = 1.0  # [m-1]
FASTEST_RELEASE = 100.0  # speed of the fastest rock avalanches [m s-1]
LARGEST_PERMEABILITY = 1e-7
"""Permeability of gravel without fines [m2] (Bear, 1972, table 5.5.1)."""

LARGEST_COLLIDING = 3e-3
"""Grain diameter above which collisions liquefy sheared columns [m]."""


# ---- parameters ----


def parameter_doubts(grid, setup) -> Iterator[str]:
    """Yield doubts about parameters of laws and material; a 0 that means "none" is not doubted.

    `grid` is the RasterModelGrid, `setup` the `Setup`; a doubt is a sentence.
    """
    for kind in ("flow", "friction", "erosion", "column", "material"):
        for law in with_inner(getattr(setup, kind)):
            for field in dataclasses.fields(law) if dataclasses.is_dataclass(law) else ():
                values = _nonzero_values(grid, law, field)
                if values.size and (words := _parameter_doubt(kind, field, values)):
                    yield f"{kind}: {field.name} {words}"


def _nonzero_values(grid, law, field):
    """Return the values of a parameter at nodes in use, or its one value, without zeros, shape (n,).

    `field` is the declaration of the parameter of `law`; values are in its declared unit.
    """
    value, used = getattr(law, field.name), grid.status_at_node != CLOSED
    if isinstance(value, str) and field.metadata.get("varies"):
        value = grid.at_node[value][used]
    elif isinstance(value, NodeValues):
        value = value.values[used]
    elif isinstance(value, bool) or not isinstance(value, Real):
        return np.empty(0)
    values = np.atleast_1d(np.asarray(value, float))
    return values[values != 0.0]


def _parameter_doubt(kind, field, values) -> str:
    """Return the doubt about the non-zero values of a parameter of a `kind` of law, or an empty text."""
    unit, least, most = field.metadata.get("unit"), values.min(), values.max()
    if unit == "deg" and field.metadata["bounds"][0] == 0.0 and most < LEAST_ANGLE and np.any(values % 1.0):
        return f"is {most:g} degrees at most: was it meant in radians? {most:g} rad are {np.degrees(most):.3g} deg"
    if unit == "kg m-3" and (least < DENSITIES[0] or most > DENSITIES[1]):
        value = least if least < DENSITIES[0] else most
        return f"is {value:g} kg m-3: was it meant in g/cm3? Densities of grains and water lie between 500 and 8000"
    if field.name == "growth_rate" and most > LARGEST_GROWTH:
        return f"is {most:g} per metre of path: was it meant per km, or in %? Published rates lie around 1e-3 m-1"
    if field.name == "coefficient_of_consolidation" and most > FASTEST_CONSOLIDATION:
        return f"is {most:g} m2 s-1: was it meant per year? {most:g} m2 per year are {most / 3.156e7:.2g} m2 s-1"
    if field.name == "permeability" and most > LARGEST_PERMEABILITY:
        return f"is {most:g} m2, that of clean gravel or more: was it meant as a hydraulic conductivity in m s-1?"
    if kind == "column" and field.name == "grain_diameter" and most > LARGEST_COLLIDING:
        return (
            f"is {most:g} m: with grains above {LARGEST_COLLIDING:g} m collisions liquefy the whole column in ordinary "
            "flows; give the size of the sand between larger grains"
        )
    return ""


# ---- coordinates and elevations ----


def coordinate_doubts(grid) -> Iterator[str]:
    """Yield doubts about the coordinates of the grid: ground in degrees or km is upright when read in metres."""
    corner, spacing = np.array(grid.xy_of_lower_left), np.array([grid.dx, grid.dy])
    extent, (low, high) = spacing * (np.array(grid.shape[::-1]) - 1), elevation_range(grid)
    on_globe = bool(np.all(np.abs([corner, corner + extent]) <= [[360.0, 90.0]] * 2))
    fine, far = spacing.max() < DEGREES_BELOW, bool(np.any(np.abs(corner) > 10.0 * extent))
    upright = spacing.max() < 1.0 and high - low > UPRIGHT * extent.max() and low >= LOWEST and high <= HIGHEST
    named = any(str(unit).lower().startswith(("deg", "°")) for unit in grid.axis_units)
    if named or (on_globe and (upright or (fine and far))):
        yield (
            f"the coordinates of the grid look like degrees (nodes every {grid.dx:.3g} from {corner[0]:g}, "
            f"{corner[1]:g}): all lengths are in m; project the DEM, for instance to UTM, before it is read"
        )
    elif upright:
        yield (
            f"the ground falls by {high - low:.4g} m over {extent.max():.4g} m: are the coordinates of the grid in "
            "km? All lengths are in m"
        )


def elevation_doubts(grid) -> Iterator[str]:
    """Yield doubts about the height of the ground."""
    low, high = elevation_range(grid)
    if low < LOWEST or high > HIGHEST:
        yield (
            f"topographic__elevation goes from {low:g} to {high:g} m, which is nowhere on Earth: was it meant in "
            "another unit? All lengths are in m"
        )


# ---- names ----

RELEASE = "debris_flow__release_depth"
OUR_NAMES = tuple(field.name for field in NODE_FIELDS)
COMMON_WORDS = {"debris", "flow", "landslide", "initial", "depth", "thickness", "height", "m"}
"""Words of a field's name that say nothing about which field is meant."""

LEAST_SIMILARITY = 0.85
"""Similarity of two names without common words from which on one may stand for the other [-]."""


def name_doubts(grid, setup) -> Iterator[str]:
    """Yield doubts about fields whose names resemble inputs that are missing; the release may come later.

    `grid` is the RasterModelGrid, `setup` the `Setup`; a doubt is a sentence.
    """
    laws = (setup.friction, setup.erosion)
    read = {getattr(law, f.name) for law in laws if dataclasses.is_dataclass(law) for f in dataclasses.fields(law)}
    missing = [f.name for f in NODE_FIELDS if "in" in f.intent and f.name not in grid.at_node and f.name != RELEASE]
    for name in sorted(set(grid.at_node) - set(OUR_NAMES) - read):
        ours = max(missing, key=lambda ours: _similarity(name, ours), default="")
        if name in misnamed_fields(grid, ours):
            yield (
                f"the grid has no field {ours!r}, but one named {name!r}: was it meant? It is not read; "
                f"grid.add_field({ours!r}, grid.at_node[{name!r}], at='node')"
            )


def misnamed_fields(grid, ours: str) -> list[str]:
    """Return names of fields with values > 0 that resemble the name of an input.

    `grid` is the RasterModelGrid, `ours` the name of the input.
    """
    alike = [name for name in sorted(set(grid.at_node) - set(OUR_NAMES)) if _similarity(name, ours) >= LEAST_SIMILARITY]
    return [name for name in alike if np.any(np.nan_to_num(grid.at_node[name]) > 0)]


def _similarity(name: str, ours: str) -> float:
    """Return the similarity of two names, whole or without common words, from 0 to 1."""
    one, other = ([word for word in n.lower().replace("-", "_").split("_") if word] for n in (name, ours))
    pairs = (one, other), tuple([word for word in n if word not in COMMON_WORDS] for n in (one, other))
    return max((difflib.SequenceMatcher(None, *map("_".join, p)).ratio() for p in pairs if all(p)), default=0.0)


# ---- release ----


def missing_release_reason(grid, soil) -> str:
    """Return the likely reason why no release was found, as the end of a sentence.

    `grid` is the RasterModelGrid, `soil` the erodible depth, shape (nodes,) [m], or None.
    """
    if names := misnamed_fields(grid, RELEASE):
        return f"; {names[0]!r} is not read: was it meant? grid.at_node[{RELEASE!r}][:] = grid.at_node[{names[0]!r}]"
    ids = "mass__wasting_id"
    marked = np.count_nonzero(grid.at_node[ids] > 0) if ids in grid.at_node else 0
    if marked and soil is None:
        return f"; {ids} > 0 at {marked} nodes lets the soil fail there, but the grid has no soil__depth: add it"
    if marked:
        return f"; {ids} > 0 at {marked} nodes lets the soil fail there, but soil__depth is 0 at all of them"
    return ""


def velocity_doubts(velocity) -> Iterator[str]:
    """Yield a doubt about a release whose velocity over the map, shape (2, n) or None [m s-1], is hardly possible."""
    fastest = 0.0 if velocity is None else float(np.hypot(*velocity).max())
    if fastest > FASTEST_RELEASE:
        yield (
            f"a release moves at {fastest:.4g} m/s when it fails, faster than any landslide: was the velocity meant in "
            "km/h or cm/s? It is in m/s"
        )


def release_doubts(grid, nodes, depth) -> Iterator[str]:
    """Yield which site is deepest for its width, if deeper than wide; `depth` [m] fails at some nodes."""
    if nodes.size == 0 or depth.max() <= min(grid.dx, grid.dy):
        return
    failing = np.zeros(grid.number_of_nodes)
    failing[nodes] = depth
    failing = failing.reshape(grid.shape)
    sites, _ = label(failing > 0.0, np.ones((3, 3)))
    worst = 1.0
    for number, box in enumerate(find_objects(sites), 1):
        rows, columns = (side.stop - side.start for side in box)
        width = float(min(rows * grid.dy, columns * grid.dx))
        site = np.where(sites[box] == number, failing[box], 0.0)
        if site.max() > worst * width:
            worst = site.max() / width
            row, column = np.unravel_index(site.argmax(), site.shape)
            node = (box[0].start + row) * grid.number_of_node_columns + box[1].start + column
            deepest, narrow = site.max(), width
    if worst > 1.0 and not any(coordinate_doubts(grid)):  # a doubt about spacing explains this one as well
        yield (
            f"a release is deeper than it is wide, {code_of(round(float(deepest), 3))} m on {narrow:g} m around "
            f"{where(grid, node)}: was the depth meant in cm or mm? A flow of such a shape is not shallow"
        )
