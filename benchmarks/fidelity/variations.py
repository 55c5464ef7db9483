"""Variations of a run, in words joined by "+": what is done otherwise than the scene says.

fast          the cheap steps: Courant number 1, one node per step, rest at 1e-3 of the peak energy
coarse        every second node of the grid
more=PERCENT  so many particles more, or fewer
column=LAW    another law of the column, its levels after a slash: column=ale/21
flow=LAW      one phase or two
"""

import numpy as np
from landlab import RasterModelGrid

from .ground import RELEASE, SOIL


def vary(scene, particles: int, variation: str):
    """Return grid, keywords without numerics, and numerics of a variation of a `Scene`.

    Raises
    ------
    ValueError
        If a word is unknown.
    """
    grid, keywords, numerics = scene.grid, dict(scene.keywords), {"particle_count": particles}
    for word in filter(None, variation.split("+")):
        key, _, value = word.partition("=")
        if word == "fast":
            numerics["preset"] = "fast"
        elif word == "coarse":
            grid = every_second_node(grid)
        elif key == "more":
            numerics["particle_count"] = round(particles * (1.0 + float(value) / 100.0))
        elif key == "column":
            law, _, levels = value.partition("/")
            keywords["column"] = {"law": law} | ({"levels": int(levels)} if levels else {})
        elif key == "flow":
            keywords["flow"] = value
        else:
            raise ValueError(f"unknown variation {word!r}; there are fast, coarse, more=, column=, flow=")
    return grid, keywords, numerics


def every_second_node(grid):
    """Return the grid with every second row and column, from the first on; the volume released is kept."""
    keep = np.zeros(grid.shape, bool)
    keep[::2, ::2] = True
    rows, columns = keep.any(axis=1).sum(), keep.any(axis=0).sum()
    coarse = RasterModelGrid(
        (int(rows), int(columns)), xy_spacing=(2.0 * grid.dx, 2.0 * grid.dy), xy_of_lower_left=grid.xy_of_lower_left
    )
    for name in grid.at_node:
        coarse.add_field(name, grid.at_node[name][keep.ravel()].copy(), at="node")
    # the corner of an odd grid keeps its side; a wall narrower than two nodes may be lost, which is the error meant
    inside = coarse.status_at_node == 0
    status = grid.status_at_node[keep.ravel()]
    coarse.status_at_node[inside] = status[inside]
    coarse.status_at_node[status == grid.BC_NODE_IS_CLOSED] = grid.BC_NODE_IS_CLOSED
    if RELEASE in grid.at_node and coarse.at_node[RELEASE].any():
        coarse.at_node[RELEASE] *= grid.at_node[RELEASE].sum() / (4.0 * coarse.at_node[RELEASE].sum())
        if SOIL in coarse.at_node:
            np.maximum(coarse.at_node[SOIL], coarse.at_node[RELEASE], out=coarse.at_node[SOIL])
    return coarse
