"""What node arrays were before something changed them, kept for the rows of the raster it may change.

A flow covers a small part of a large DEM; nothing may cost a copy of all of it.
"""

import numpy as np

MARGIN = 16
"""Rows kept beyond those asked for, so that a flow that moves on does not ask at every step."""


class Journal:
    """Copies of the rows `cover` was called for, made at that time.

    Parameters
    ----------
    arrays : sequence of ndarray, shape (nodes,)
        What is to be kept; changed by others after `cover`.
    columns : int
        Columns of the raster.

    Examples
    --------
    >>> depth = np.ones(200)
    >>> journal = Journal([depth], columns=2)
    >>> journal.cover(50, 52)
    >>> depth[100:102] = 0.25
    >>> journal.fall(0)
    1.5
    >>> journal.restore()
    >>> depth.min()
    np.float64(1.0)
    """

    def __init__(self, arrays, columns: int):
        self._arrays, self._columns = list(arrays), columns
        self._rows = arrays[0].size // columns if len(self._arrays) else 0
        self._first, self._last = 0, 0
        self._kept = []  # (slice of nodes, copies)

    @property
    def arrays(self) -> list:
        """What is kept."""
        return self._arrays

    @property
    def nodes(self) -> slice:
        """The nodes covered so far."""
        return slice(self._first * self._columns, self._last * self._columns)

    def cover(self, first: int, last: int) -> None:
        """Keep the rows from `first` up to but not including `last` as they are now, if they are not kept yet."""
        first, last = max(first, 0), min(last, self._rows)
        if first >= last or (self._first <= first and last <= self._last):
            return
        first, last = max(first - MARGIN, 0), min(last + MARGIN, self._rows)
        if self._first == self._last:
            self._first = self._last = first
        for a, b in ((first, self._first), (self._last, last)):
            if a < b:
                part = slice(a * self._columns, b * self._columns)
                self._kept.append((part, [array[part].copy() for array in self._arrays]))
        self._first, self._last = min(first, self._first), max(last, self._last)

    def fall(self, which: int, counted=None) -> float:
        """Return by how much the sum of one array has fallen, over nodes where `counted` (all by default) is True."""
        array, total = self._arrays[which], 0.0
        for part, copies in self._kept:
            here = slice(None) if counted is None else counted[part]  # what is not counted may be no number
            total += float(np.sum(copies[which][here] - array[part][here]))
        return total

    def again(self, arrays) -> "Journal":
        """Return a journal of some arrays over the same rows, as they are now."""
        other = Journal(arrays, self._columns)
        other._first, other._last = self._first, self._last
        if self._first < self._last:
            other._kept.append((self.nodes, [array[self.nodes].copy() for array in other._arrays]))
        return other

    def restore(self) -> None:
        """Put everything back."""
        for part, copies in self._kept:
            for array, copy in zip(self._arrays, copies, strict=True):
                array[part] = copy


class Spot:
    """Copies of node arrays at some nodes, made at once.

    Parameters
    ----------
    arrays : sequence of ndarray, shape (nodes,)
    nodes : slice or ndarray of int
    """

    def __init__(self, arrays, nodes):
        self._arrays, self._nodes = arrays, nodes
        self._kept = [array[nodes].copy() for array in arrays]

    def restore(self) -> None:
        """Put everything back."""
        for array, kept in zip(self._arrays, self._kept, strict=True):
            array[self._nodes] = kept
