"""Doubts about a scene that can be computed but is hardly meant; each is a sentence."""

import dataclasses
import math
from collections.abc import Iterator
from numbers import Real
from typing import Any

import numpy as np
from scipy.ndimage import binary_dilation, minimum_filter

from ..physics.erosion import NoErosion
from ..scene.terrain import SOIL

LEAST_ANGLE = 2.0
"""Angle of friction below which hardly any flow stops [deg]."""

LARGEST_PART = 0.05
"""Part of a release that may lie below the lip of its scar without a doubt [-]."""

COARSEST, FINEST = 3.0, 0.2
"""Spacing of particles over that of nodes, beyond which terrain or particles are not resolved [-]."""


def scene_doubts(scene: Any) -> Iterator[str]:
    """Yield doubts about angles, releases and resolution of a scene."""
    yield from _angle_doubts(scene.setup)
    erosion = scene.setup.erosion
    if SOIL not in scene.terrain and not isinstance(erosion, NoErosion):
        yield (
            f"nothing erodes, though the law of erosion is {type(erosion).__name__}: terrain: soil_depth is not set; "
            "set it, or erosion: none"
        )
    lattice_area = _cell_area(scene)
    for number, release in enumerate(scene.releases, 1):
        if not np.any(release.depth > 0.0):
            yield f"release {number} has no volume on the grid"
            continue
        yield from (f"release {number}: {doubt}" for doubt in _release_doubts(scene, release, lattice_area))
    if late := [one.time for one in scene.releases if one.time >= scene.output_keys.max_duration]:
        yield (
            f"a release at {late[0]:g} s comes after max_duration, {scene.output_keys.max_duration:g} s: it will not "
            "be released; raise output: max_duration"
        )


def _angle_doubts(setup) -> Iterator[str]:
    for kind in ("friction", "flow"):
        law = getattr(setup, kind)
        for field in dataclasses.fields(law) if dataclasses.is_dataclass(law) else ():
            value = getattr(law, field.name)
            number = isinstance(value, Real) and not isinstance(value, bool)
            if number and field.metadata.get("unit") == "deg" and 0.0 < value < LEAST_ANGLE:
                yield (
                    f"{kind}: {field.name} is {value:g} deg: below {LEAST_ANGLE:g} deg hardly any flow stops; was it "
                    f"meant in radians ({value:g} rad are {math.degrees(value):.3g} deg), or as a coefficient "
                    f"({value:g} is the tangent of {math.degrees(math.atan(value)):.3g} deg)?"
                )


def _release_doubts(scene: Any, release, cell: float) -> Iterator[str]:
    depth = release.depth
    failing = depth > 0.0
    count, volume = int(failing.sum()), float(depth.sum()) * cell
    spacing = math.sqrt(count * cell / scene.setup.numerics.count_for(count * cell))
    ratio = spacing / math.sqrt(cell)
    if ratio > COARSEST:
        yield (
            f"its particles are {spacing:.3g} m apart, nodes {math.sqrt(cell):.3g} m: the flow does not see the "
            f"terrain as fine as it is; numerics: particle_count of {math.ceil(count / COARSEST**2)} or more would"
        )
    if ratio < FINEST:
        yield (
            f"its particles are {spacing:.3g} m apart, nodes {math.sqrt(cell):.3g} m: more particles than the "
            "terrain has detail for; fewer are as good and faster"
        )
    thickness = volume / (count * cell)
    if thickness > spacing * 4.0 or thickness > 0.5 * math.sqrt(count * cell):
        yield (
            f"it is {thickness:.3g} m thick over {math.sqrt(count * cell):.3g} m, particles {spacing:.3g} m apart: "
            "a flow is shallow only if it is much wider than thick"
        )
    if getattr(release, "source", "ground") == "ground":
        below, deepest = below_lip(scene.terrain["topographic__elevation"].values, depth)
        if below * cell > LARGEST_PART * volume:
            yield (
                f"{below * cell:.0f} m3 of {volume:.0f} m3 lie below the lip of the scar, up to {deepest:.2g} m, and "
                "cannot leave it; use another failure_surface, less depth, or from: above"
            )


def below_lip(elevation: np.ndarray, depth: np.ndarray) -> tuple[float, float]:
    """Return the depth of a release that lies in pits of the ground below.

    The ground without the release is filled up to the level at which water would run out of it, by repeated minima
    over neighbours (Planchon & Darboux, 2001), and the filling counted where the release is and the ground had no pit.

    Parameters
    ----------
    elevation : ndarray, shape (rows, columns)
        Ground with the release, NaN where there are no data [m].
    depth : ndarray, shape (rows, columns)
        Depth that fails [m].

    Returns
    -------
    sum : float
        Sum of the filling over nodes [m].
    deepest : float
        Largest filling [m].

    References
    ----------
    Planchon & Darboux (2001).

    Examples
    --------
    >>> ground = np.add.outer(np.zeros(5), np.arange(7.0))  # falls by 1 m per node
    >>> box = np.zeros((5, 7))
    >>> box[1:4, 2:5] = 3.0
    >>> below_lip(ground, box)  # bottoms of -1, 0 and 1 m in three rows, the lip at 1 m: 2 m + 1 m
    (9.0, 2.0)
    """
    around = binary_dilation(depth > 0.0, iterations=2)
    rows, columns = (np.flatnonzero(around.any(axis=axis)) for axis in (1, 0))
    window = np.s_[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1]
    ground = np.where(np.isnan(elevation[window]), np.inf, elevation[window])
    bed = ground - depth[window]
    known = np.isfinite(ground)
    pits = np.where(known, _filled(ground) - np.where(known, ground, 0.0), 0.0)
    filling = np.where(known, _filled(bed) - np.where(known, bed, 0.0), 0.0) - pits
    filling = np.clip(filling, 0.0, depth[window])
    return float(filling.sum()), float(filling.max())


def _filled(bed: np.ndarray) -> np.ndarray:
    """Return a ground filled up to where water runs over the edge of the array."""
    water = np.full(bed.shape, np.inf)
    for edge in (np.s_[0], np.s_[-1], np.s_[:, 0], np.s_[:, -1]):
        water[edge] = bed[edge]
    while True:
        lower = np.minimum(water, np.maximum(bed, minimum_filter(water, 3, mode="nearest")))
        if np.array_equal(lower, water):
            return np.where(np.isfinite(water), water, bed)
        water = lower


def _cell_area(scene: Any) -> float:
    x, y = scene.terrain.x.values, scene.terrain.y.values
    return float(abs((x[1] - x[0]) * (y[1] - y[0])))
