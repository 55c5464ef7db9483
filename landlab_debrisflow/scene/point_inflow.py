"""Releases at points: hydrographs that flow in across a short line over each point, down the slope."""

from collections.abc import Iterable
from pathlib import Path

import numpy as np
import xarray as xr

from ..core.errors import InputError
from ..geo.lattice import extent
from ..model.inflow.hydrograph import Hydrograph
from .hydrograph_file import read_hydrograph
from .keys import ReleaseKeys
from .location import located
from .read_yaml import YamlFile
from .release_depths import Ground
from .shapes import shapes_of


def point_hydrographs(
    releases: Iterable[ReleaseKeys], terrain: xr.Dataset, folder: Path, file: YamlFile | None = None
) -> tuple[Hydrograph, ...]:
    """Return the inflow of the releases at points.

    The line of a point lies across the steepest descent of the plane that is fitted to the ground within its width.

    Parameters
    ----------
    releases : iterable of ReleaseKeys
        Releases of the scene, of which those at points count.
    terrain : xarray.Dataset
        As `build_terrain` returns it.
    folder : Path
        Directory to which names of files are relative.
    file : YamlFile, optional
        Scene file, to name lines.

    Returns
    -------
    tuple of Hydrograph

    Raises
    ------
    InputError
        If a file cannot be used, a point lies outside or on level ground.
    """
    ground, found = Ground.of(terrain), []
    for k, keys in enumerate(releases):
        if keys.kind != "points":
            continue
        path = ("release", k) if file is None or ("release", k) in file.lines else ("release",)
        with located(file, *path):
            table = read_hydrograph(folder / keys.hydrograph) if isinstance(keys.hydrograph, str) else keys.hydrograph
            for shape in shapes_of(keys.points, "point", ground.lattice, folder):
                for point in getattr(shape.geometry, "geoms", [shape.geometry]):
                    found.append(_hydrograph(keys, table, np.array([point.x, point.y]), ground, shape.label))
    return tuple(found)


def _hydrograph(keys: ReleaseKeys, table, point: np.ndarray, ground: Ground, label: str) -> Hydrograph:
    width, speed = float(keys.width or 0.0), float(keys.speed or 0.0)  # the checks of the keys ensure that both are set
    (dx, dy), (rows, columns) = ground.lattice.spacing, ground.lattice.shape
    column, row = (point - ground.lattice.lower_left) / (dx, dy)
    if not (0.5 <= column <= columns - 1.5 and 0.5 <= row <= rows - 1.5):
        raise InputError(
            f"{label} at {point[0]:.10g}, {point[1]:.10g} lies on the edge of the terrain, "
            f"{extent(ground.lattice.bounds)}; the line of the inflow needs ground around it"
        )
    x, y = np.arange(columns) * dx, np.arange(rows) * dy
    radius = max(0.5 * width, 1.5 * max(dx, dy))
    near = np.hypot(x - column * dx, (y - row * dy)[:, None]) <= radius
    near &= np.isfinite(ground.elevation)
    slope = ground.plane_slope(near)
    steepness = np.hypot(*slope)
    if steepness < 1e-3:
        raise InputError(
            f"{label} lies on level ground: where the flow goes is not known; give inflow with a line and a direction"
        )
    across = 0.5 * width * np.array([-slope[1], slope[0]]) / steepness
    times, discharge = np.array(table, dtype=float).T
    return Hydrograph(
        line_start=tuple(point - across), line_end=tuple(point + across), times=tuple(times + keys.time),
        discharge=tuple(discharge), velocity=(speed,),
        direction=float(np.degrees(np.arctan2(-slope[1], -slope[0]))),
    )  # fmt: skip
