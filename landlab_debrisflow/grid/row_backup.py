"""Copies of node arrays before a change, to undo it: rows of the raster that may change, or some nodes."""

import numpy as np

MARGIN = 16
"""Rows kept on either side of the requested ones, so that a flow that advances does not ask at every step."""


class RowBackup:
    """Copies of rows of node arrays, each made when `keep_rows` was first called for it.

    Parameters
    ----------
    arrays : sequence of ndarray, shape (nodes,)
        Arrays to be changed after a call of `keep_rows`.
    columns : int
        Columns of the raster.

    Examples
    --------
    >>> depth = np.ones(200)
    >>> backup = RowBackup([depth], columns=2)
    >>> backup.keep_rows(50, 52)
    >>> depth[100:102] = 0.25
    >>> backup.decrease(0)
    1.5
    >>> backup.restore()
    >>> depth.min()
    np.float64(1.0)
    """

    def __init__(self, arrays, columns: int):
        self._arrays, self._columns = list(arrays), columns
        self._rows = arrays[0].size // columns if len(self._arrays) else 0
        self._first, self._last = 0, 0
        self._kept = []  # (slice of nodes, copies)

    @property
    def nodes(self) -> slice:
        """Nodes of which copies have been kept so far, as a slice of whole rows."""
        return slice(self._first * self._columns, self._last * self._columns)

    def keep_rows(self, first: int, last: int) -> None:
        """Copy the rows from `first` up to but not including `last` as they are now, if they are not kept yet."""
        first, last = max(first, 0), min(last, self._rows)
        if first >= last or (self._first <= first and last <= self._last):
            return
        first, last = max(first - MARGIN, 0), min(last + MARGIN, self._rows)
        if self._first == self._last:
            self._first = self._last = first
        for a, b in ((first, self._first), (self._last, last)):
            if a < b:
                nodes = slice(a * self._columns, b * self._columns)
                self._kept.append((nodes, [array[nodes].copy() for array in self._arrays]))
        self._first, self._last = min(first, self._first), max(last, self._last)

    def decrease(self, which: int, counted=None) -> float:
        """Return the decrease of the sum of one array since it was kept, in the unit of the array.

        Parameters
        ----------
        which : int
            Position of the array.
        counted : ndarray of bool, shape (nodes,), optional
            Nodes that count; values elsewhere may be NaN. None: all nodes.
        """
        array, total = self._arrays[which], 0.0
        for nodes, copies in self._kept:
            here = slice(None) if counted is None else counted[nodes]
            total += float(np.sum(copies[which][here] - array[nodes][here]))
        return total

    def variables(self) -> dict:
        """Return stretches of nodes, in the order in which they were kept, and the copies: dimensions and values."""
        stretches = [(nodes.start, nodes.stop) for nodes, _ in self._kept]
        copies = [np.concatenate(parts) for parts in zip(*(copies for _, copies in self._kept), strict=True)]
        return {
            "stretches": (("stretch", "begin_and_end"), np.array(stretches, np.int64).reshape(-1, 2)),
            "copies": (("backed_up", "kept"), np.reshape(copies, (len(self._arrays), -1))),
        }  # fmt: skip

    def set_variables(self, variables) -> None:
        """Replace all copies by values that `variables` returned, by name."""
        stretches, copies, self._kept, first = variables["stretches"], variables["copies"], [], 0
        for begin, end in stretches.tolist():
            last = first + end - begin
            self._kept.append((slice(begin, end), [np.array(copy[first:last]) for copy in copies]))
            first = last
        self._first, self._last = 0, 0
        if len(stretches):
            self._first, self._last = int(stretches.min()) // self._columns, int(stretches.max()) // self._columns

    def keep_nodes(self, nodes: slice) -> None:
        """Replace all copies by the present values at some nodes, a slice of whole rows."""
        self._first, self._last = nodes.start // self._columns, nodes.stop // self._columns
        self._kept = [(nodes, [array[nodes].copy() for array in self._arrays])] if nodes.start < nodes.stop else []

    def renewed(self, arrays) -> "RowBackup":
        """Return a backup of some arrays as they are now, of the same rows."""
        other = RowBackup(arrays, self._columns)
        other.keep_nodes(self.nodes)
        return other

    def copy(self) -> "RowBackup":
        """Return a backup of the same arrays that holds the same rows and keeps further ones on its own."""
        other = RowBackup(self._arrays, self._columns)
        other._first, other._last, other._kept = self._first, self._last, list(self._kept)
        return other

    def restore(self) -> None:
        """Write all kept rows back."""
        for nodes, copies in self._kept:
            for array, copy in zip(self._arrays, copies, strict=True):
                array[nodes] = copy


class NodeBackup:
    """Copies of node arrays at some nodes, made at once.

    Parameters
    ----------
    arrays : sequence of ndarray, shape (nodes,)
        Arrays to be changed, in any unit.
    nodes : slice or ndarray of int
        Nodes of which values are copied.
    """

    def __init__(self, arrays, nodes):
        self._arrays, self._nodes = arrays, nodes
        self._kept = [array[nodes].copy() for array in arrays]

    def restore(self) -> None:
        """Write all kept values back."""
        for array, kept in zip(self._arrays, self._kept, strict=True):
            array[self._nodes] = kept
