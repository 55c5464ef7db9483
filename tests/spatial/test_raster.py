"""Blocks of nodes near walls: none that a wall is near is left out, and few others are in."""

import numpy as np
import pytest

from landlab_debrisflow.spatial.raster import BLOCK, CLOSED, CORE, Raster, is_walled

SHAPE = 45, 70  # no multiples of the block


def walled_nodes(status):
    raster = Raster.from_status(status, (1.0, 1.0))
    rows, columns = status.shape
    return np.array([[is_walled(r, c, raster.walled, columns) for c in range(columns)] for r in range(rows)])


@pytest.mark.parametrize("closed", [(0, 0), (44, 69), (20, 31), (7, 8), (8, 7), (31, 64)])
def test_nodes_within_a_block_of_a_closed_one_are_marked(closed):
    status = np.full(SHAPE, CORE, np.uint8)
    status[closed] = CLOSED
    rows, columns = np.indices(SHAPE)
    away = np.maximum(abs(rows - closed[0]), abs(columns - closed[1]))
    marked = walled_nodes(status)
    assert marked[away <= BLOCK].all()
    assert not marked[away >= 2 * BLOCK].any()


def test_without_closed_nodes_nothing_is_marked():
    assert not walled_nodes(np.full(SHAPE, CORE, np.uint8)).any()
