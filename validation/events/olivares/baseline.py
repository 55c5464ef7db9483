"""Extent of a flow without dynamics: the steepest paths from the cells of the source, widened."""

import warnings

import numpy as np
from landlab import RasterModelGrid
from landlab.components import FlowAccumulator, LakeMapperBarnes
from scipy.ndimage import distance_transform_edt

from .measures import farthest
from .setup import FLOWS, Observed


def steepest_paths(observed: Observed) -> dict[int, list[np.ndarray]]:
    """Return the steepest paths from all cells of each source to the edge of the map, by flow.

    Every node passes to the lowest of its eight neighbours, pits of the DEM being filled first.

    Returns
    -------
    dict
        Lists of paths: row and column of their nodes, each of shape (n, 2).
    """
    grid = RasterModelGrid(observed.elevation.shape, observed.spacing)
    elevation = grid.add_field("topographic__elevation", observed.elevation.ravel().copy(), at="node")
    FlowAccumulator(grid, flow_director="FlowDirectorD8").run_one_step()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        LakeMapperBarnes(
            grid, surface="topographic__elevation", fill_surface=elevation, method="D8", fill_flat=False,
            redirect_flow_steepest_descent=True, track_lakes=True, ignore_overfill=True,
        ).run_one_step()  # fmt: skip
    receiver = grid.at_node["flow__receiver_node"]

    def path_from(node: int) -> np.ndarray:
        nodes = [node]
        while receiver[nodes[-1]] != nodes[-1]:
            nodes.append(int(receiver[nodes[-1]]))
        return np.column_stack(np.unravel_index(nodes, grid.shape))

    return {flow: [path_from(int(node)) for node in np.flatnonzero(observed.source == flow)] for flow in FLOWS}


def outline_size(observed: Observed, flow: int) -> tuple[float, float, float]:
    """Return the reach [m], the mean width [m] and the fall over reach [-] of a mapped flow, from the source point."""
    mapped = observed.flow == flow
    toe = farthest(mapped, observed, flow)
    reach = float(np.hypot(*np.subtract(toe, observed.points[flow])))
    column, row = np.rint((np.array([toe, observed.points[flow]]) - observed.corner) / observed.spacing).astype(int).T
    bottom, top = observed.elevation[row, column]
    return reach, float(mapped.sum()) * observed.spacing**2 / reach, float(top - bottom) / reach


def widened_paths(observed: Observed, flow: int, paths: list[np.ndarray], *, others: bool) -> np.ndarray:
    """Return the cells of the baseline, shape (rows, columns).

    Parameters
    ----------
    observed : Observed
    flow : int
    paths : list of ndarray, shape (n, 2)
        Its steepest paths.
    others : bool
        True: paths end where they meet the line that falls from the source point with the median fall over reach of
        the five other flows, and have their median width; of the flow itself only the source is known, as by a model.
        False: they end at the reach of the flow itself and have its width, which no model knows.
    """
    column, row = (np.array(observed.points[flow]) - observed.corner) / observed.spacing
    reach, width, _ = outline_size(observed, flow)
    top = observed.elevation[int(np.rint(row)), int(np.rint(column))]
    if others:
        sizes = np.array([outline_size(observed, each) for each in FLOWS if each != flow])
        _, width, slope = np.median(sizes, axis=0)
    away = np.ones(observed.elevation.shape, bool)
    for path in paths:
        distance = observed.spacing * np.hypot(path[:, 0] - row, path[:, 1] - column)
        beyond = distance >= reach
        if others:
            fall = top - observed.elevation[path[:, 0], path[:, 1]]
            beyond = (fall < slope * distance) & (distance > width)  # the first steps may be flatter than the whole way
        end = int(np.argmax(beyond)) + 1 if beyond.any() else len(path)
        away[path[:end, 0], path[:end, 1]] = False
    return observed.spacing * distance_transform_edt(away) <= 0.5 * width
