"""Cells of a lattice under several shapes, from which the largest value of a map at each shape is taken."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ..ensemble import MemberResult


class ShapeCells(NamedTuple):
    """Cells of shapes, one shape after the other; each begins with a cell outside of the lattice.

    Attributes
    ----------
    rows, columns : ndarray of int, shape (n,)
    start : ndarray of int, shape (shapes,)
        Index of the first cell of each shape.
    """

    rows: np.ndarray
    columns: np.ndarray
    start: np.ndarray

    @classmethod
    def of(cls, cells: Sequence[tuple[np.ndarray, np.ndarray]]) -> "ShapeCells":
        """Return the cells of shapes from rows and columns of each."""
        rows = [np.concatenate([[-1], rows]) for rows, _ in cells]
        columns = [np.concatenate([[-1], columns]) for _, columns in cells]
        start = np.cumsum([0, *(one.size for one in rows[:-1])])
        return cls(np.concatenate(rows).astype(int), np.concatenate(columns).astype(int), start)

    def largest(self, member: MemberResult, values: np.ndarray) -> np.ndarray:
        """Return the largest value of a map at each shape, 0 where nothing came, shape (shapes,).

        Parameters
        ----------
        member : MemberResult
            Member whose window the map is over.
        values : ndarray, shape (rows, columns) of the window
        """
        return np.maximum.reduceat(self._taken(member, values, 0), self.start)

    def least(self, member: MemberResult, values: np.ndarray) -> np.ndarray:
        """Return the least value of a map at each shape, NaN where there is none, shape (shapes,)."""
        return np.fmin.reduceat(self._taken(member, values, np.nan), self.start)

    def _taken(self, member: MemberResult, values: np.ndarray, outside: float) -> np.ndarray:
        rows, columns = self.rows - member.rows.start, self.columns - member.columns.start
        inside = (rows >= 0) & (rows < values.shape[0]) & (columns >= 0) & (columns < values.shape[1])
        taken = np.full(rows.size, outside, values.dtype)
        taken[inside] = values[rows[inside], columns[inside]]
        return taken
