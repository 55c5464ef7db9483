"""Copies of the rows that may change: what is put back, and what is counted, however they were asked for."""

import numpy as np
import pytest

from landlab_debrisflow.grid.row_backup import MARGIN, RowBackup

ROWS, COLUMNS = 200, 3


@pytest.fixture
def arrays():
    rng = np.random.default_rng(1)
    return [rng.normal(0.0, 1.0, ROWS * COLUMNS), rng.integers(0, 9, ROWS * COLUMNS)]


def rows(first, last):
    return slice(first * COLUMNS, last * COLUMNS)


def test_what_was_covered_comes_back_and_nothing_else_is_touched(arrays):
    before = [array.copy() for array in arrays]
    backup = RowBackup(arrays, COLUMNS)
    backup.keep_rows(100, 103)
    for array in arrays:
        array[:] = 77
    backup.restore()
    kept = backup.nodes
    assert (kept.start, kept.stop) == ((100 - MARGIN) * COLUMNS, (103 + MARGIN) * COLUMNS)
    for array, old in zip(arrays, before, strict=True):
        np.testing.assert_array_equal(array[kept], old[kept])
        assert np.all(array[: kept.start] == 77) and np.all(array[kept.stop :] == 77)


@pytest.mark.parametrize("asked", [[(140, 150)], [(40, 50)], [(40, 150)], [(140, 150), (40, 50)], [(0, ROWS)]])
def test_rows_that_are_covered_later_are_kept_as_they_are_then(arrays, asked):
    """The flow moves on, to either side or both: rows kept before stay as they were first."""
    backup = RowBackup(arrays, COLUMNS)
    backup.keep_rows(100, 103)
    first, original = backup.nodes, arrays[0].copy()
    arrays[0][first] += 1.0
    for a, b in asked:
        backup.keep_rows(a, b)
        arrays[0][rows(a, b)] -= 0.25
    kept = backup.nodes
    assert kept.start <= min(first.start, min(asked)[0] * COLUMNS)
    assert kept.stop >= max(first.stop, max(b for _, b in asked) * COLUMNS)
    assert backup.decrease(0) == pytest.approx(np.sum(original - arrays[0]), abs=1e-12)
    backup.restore()
    np.testing.assert_array_equal(arrays[0], original)


def test_a_fall_counts_what_it_is_told_to(arrays):
    backup = RowBackup(arrays, COLUMNS)
    backup.keep_rows(10, 12)
    counted = np.zeros(ROWS * COLUMNS, bool)
    counted[30] = True
    arrays[0][30:36] -= 0.5
    arrays[1][33] -= 2
    assert backup.decrease(0) == pytest.approx(3.0) and backup.decrease(0, counted) == pytest.approx(0.5)
    assert backup.decrease(1) == 2.0


def test_rows_beyond_the_raster_are_none(arrays):
    backup = RowBackup(arrays, COLUMNS)
    for first, last in ((-9, 0), (ROWS, ROWS + 9), (50, 50), (60, 40)):
        backup.keep_rows(first, last)
        assert backup.nodes == slice(0, 0) and backup.decrease(0) == 0.0
    backup.keep_rows(-5, ROWS + 5)
    assert backup.nodes == slice(0, ROWS * COLUMNS)


def test_asking_again_costs_no_copy(arrays):
    backup = RowBackup(arrays, COLUMNS)
    backup.keep_rows(100, 103)
    for row in range(100 - MARGIN, 103 + MARGIN):
        backup.keep_rows(row, row + 1)
    assert len(backup._kept) == 1
