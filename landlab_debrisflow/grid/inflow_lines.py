"""Refusals of inflow lines through which nothing can flow in."""

import numpy as np

from ..core.errors import InputError
from ..model.inflow.inflow import Inflow
from ..spatial.raster import CLOSED, CORE, FIXED_VALUE, nearest_line

STATUS_WORDS = {FIXED_VALUE: "open (fixed-value)", CLOSED: "closed"}


def check_lines(terrain, inflow: Inflow) -> None:
    """Refuse lines that are not on core nodes of a `Terrain`, if something has yet to flow in."""
    for source in () if inflow.over else inflow.sources:
        _check_points(terrain, source.hydrograph, _line(terrain, source), "the line", "")


def check_strips(terrain, inflow: Inflow) -> None:
    """Refuse strips of prescribed flow that are not on core nodes of a `Terrain`; their direction must be known."""
    for source, direction in () if inflow.over else zip(inflow.sources, inflow.directions, strict=True):
        length = min(source.strip, _farthest(terrain))
        steps = np.append(np.arange(0.0, length, 0.25 * min(terrain.spacing)), length)
        strip = _line(terrain, source)[:, :, None] + direction[:, None, None] * steps
        name = f"the strip of {source.strip:.3g} m behind it, in which the flow is prescribed,"
        remedy = "; more particles make it shorter"
        _check_points(terrain, source.hydrograph, strip.reshape(2, -1), f"the line and {name}", remedy)


def _line(terrain, source):
    """Return points on the line from the lower left node, a quarter of a node spacing apart, shape (2, n) [m].

    `terrain` is a `Terrain`, `source` the source of an inflow.
    """
    along = source.end - source.start
    count = 2 + int(4.0 * min(np.hypot(*along), _farthest(terrain)) / min(terrain.spacing))
    return source.start[:, None] + np.linspace(0.0, 1.0, count) * along[:, None]


def _farthest(terrain) -> float:
    """Return the length [m] from which on any line from a core node of a `Terrain` ends outside."""
    rows, columns = terrain.shape
    return 2.0 * float(np.hypot(columns * terrain.spacing[0], rows * terrain.spacing[1]))


def _check_points(terrain, hydrograph, points, name, remedy):
    rows, columns = terrain.shape
    column, row = (nearest_line(p, d).astype(int) for p, d in zip(points, terrain.spacing, strict=True))
    outside = (row < 0) | (row >= rows) | (column < 0) | (column >= columns)
    node = row.clip(0, rows - 1) * columns + column.clip(0, columns - 1)
    status = terrain.status[node]
    bad = np.flatnonzero(outside | (status != CORE))
    if bad.size == 0:
        return
    k, line = bad[0], f"from {hydrograph.line_start} to {hydrograph.line_end} m"
    x, y = points[:, k] + terrain.lower_left
    where = "outside the grid"
    if not outside[k]:
        kind = STATUS_WORDS.get(int(status[k]), "not core")
        where = f"nearest to node {node[k]} (row {row[k]}, column {column[k]}), which is {kind}"
    raise InputError(
        f"inflow {line}: {name} must lie on core nodes, but ({x:.6g}, {y:.6g}) m is {where}; keep it half a node "
        f"spacing inside the boundary, flowing inwards{remedy}"
    )
