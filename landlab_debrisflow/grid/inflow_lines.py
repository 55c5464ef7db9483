"""Hydrographs as a user gives them, and whether their lines lie where something can flow in."""

from collections.abc import Mapping

import numpy as np

from ..core.errors import InputError, ParameterError
from ..model.inflow.hydrograph import Hydrograph
from ..model.inflow.source import Inflow
from ..physics.registry import build_declared

STATUS_WORDS = {1: "open (fixed-value)", 4: "closed"}


def read_hydrographs(inflow) -> tuple[Hydrograph, ...]:
    """Return what the keyword `inflow` stands for: none, a Hydrograph, a mapping, or several of them.

    Raises
    ------
    ParameterError
        If it is something else, or a value is refused.
    """
    if inflow is None:
        return ()
    if isinstance(inflow, Hydrograph | Mapping):
        inflow = (inflow,)
    if isinstance(inflow, str) or not hasattr(inflow, "__iter__"):
        raise ParameterError(f"inflow must be a Hydrograph, a mapping, or a list of them, got {inflow!r}")
    return tuple(build_declared(Hydrograph, one, "inflow") for one in inflow)


def check_lines(grid, inflow: Inflow) -> None:
    """Refuse lines that are not on core nodes, if something has yet to flow in."""
    for source in () if inflow.over else inflow.sources:
        _check_points(grid, source.hydrograph, _line(grid, source), "the line", "")


def check_strips(grid, inflow: Inflow) -> None:
    """Refuse likewise the strips in which the flow is prescribed, of a known direction."""
    for source, direction in () if inflow.over else zip(inflow.sources, inflow.directions, strict=True):
        steps = np.append(np.arange(0.0, source.strip, 0.25 * min(grid.dx, grid.dy)), source.strip)
        strip = _line(grid, source)[:, :, None] + direction[:, None, None] * steps
        what = f"the strip of {source.strip:.3g} m behind it, in which the flow is prescribed,"
        remedy = "; more particles make it shorter"
        _check_points(grid, source.hydrograph, strip.reshape(2, -1), f"the line and {what}", remedy)


def _line(grid, source):
    """Return points on the line from the lower left node, a quarter of a node spacing apart, shape (2, n) [m]."""
    along = source.end - source.start
    count = 2 + int(4.0 * np.hypot(*along) / min(grid.dx, grid.dy))
    return source.start[:, None] + np.linspace(0.0, 1.0, count) * along[:, None]


def _check_points(grid, hydrograph, points, what, remedy):
    rows, columns = grid.shape
    column, row = (np.floor(p / d + 0.5).astype(int) for p, d in zip(points, (grid.dx, grid.dy), strict=True))
    outside = (row < 0) | (row >= rows) | (column < 0) | (column >= columns)
    node = row.clip(0, rows - 1) * columns + column.clip(0, columns - 1)
    status = grid.status_at_node[node]
    bad = np.flatnonzero(outside | (status != grid.BC_NODE_IS_CORE))
    if bad.size == 0:
        return
    k, line = bad[0], f"from {hydrograph.line_start} to {hydrograph.line_end} m"
    x, y = points[:, k] + grid.xy_of_lower_left
    where = "outside the grid"
    if not outside[k]:
        kind = STATUS_WORDS.get(int(status[k]), "not core")
        where = f"nearest to node {node[k]} (row {row[k]}, column {column[k]}), which is {kind}"
    raise InputError(
        f"inflow {line}: {what} must lie on core nodes, but ({x:.6g}, {y:.6g}) m is {where}; keep it half a node "
        f"spacing inside the boundary, flowing inwards{remedy}"
    )
