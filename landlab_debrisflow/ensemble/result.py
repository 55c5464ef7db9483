"""Result of one run of an ensemble."""

from collections.abc import Iterable, Mapping
from typing import NamedTuple

import numpy as np

ARRIVAL = "arrival_time"


class MemberResult(NamedTuple):
    """Result of one run of an ensemble, or its failure.

    Attributes
    ----------
    member : int
        Number of the member, from 0.
    values : dict of str to object
        Varied values of the member by dotted name, in the units of the parameters.
    measures : dict of str to float
        Measures of the run by name, as `landlab_debrisflow.measures` and `at_rest` (1 or 0); empty after a failure.
    rows, columns : slice
        Window of the nodes that the flow touched, of the lattice of the ensemble; empty if it touched none.
    maps : dict of str to ndarray, shape (rows, columns) of the window
        Maps in float32 by name; 0 where nothing came, the arrival time NaN.
    error : str
        Error that ended the run; empty where the run came to its end.
    """

    member: int
    values: dict[str, object]
    measures: dict[str, float]
    rows: slice
    columns: slice
    maps: dict[str, np.ndarray]
    error: str = ""

    def on_lattice(self, name: str, shape: tuple[int, int]) -> np.ndarray:
        """Return a map over all nodes of the lattice.

        Parameters
        ----------
        name : str
            Name of a map.
        shape : tuple of int
            Rows and columns of the lattice.

        Returns
        -------
        ndarray, shape (rows, columns)
            In float32; outside the window 0, the arrival time NaN.
        """
        whole = np.full(shape, outside(name), np.float32)
        whole[self.rows, self.columns] = self.maps[name]
        return whole


def outside(name: str) -> float:
    """Return the value of a map where nothing came: NaN of the arrival time, else 0."""
    return np.nan if name == ARRIVAL else 0.0


def touched_window(maps: Mapping[str, np.ndarray]) -> tuple[slice, slice]:
    """Return rows and columns of the smallest window outside which all maps are 0 or NaN.

    Parameters
    ----------
    maps : mapping of str to ndarray, shape (rows, columns)

    Returns
    -------
    tuple of slice
        Both empty if no value is left.

    Examples
    --------
    >>> touched_window({"max_depth": np.array([[0.0, 0.0, 0.0], [0.0, 2.0, 1.0]])})
    (slice(1, 2, None), slice(1, 3, None))
    """
    touched = np.any([_is_inside(name, values) for name, values in maps.items()], axis=0)
    spans = [np.flatnonzero(touched.any(axis=axis)) for axis in (1, 0)]
    if not spans[0].size:
        return slice(0, 0), slice(0, 0)
    rows, columns = (slice(int(span[0]), int(span[-1]) + 1) for span in spans)
    return rows, columns


def common_window(results: Iterable[MemberResult]) -> tuple[slice, slice]:
    """Return rows and columns of the smallest window that holds the windows of some results; empty without any."""
    touched = [one for one in results if one.rows.stop > one.rows.start]
    spans = [[one.rows for one in touched], [one.columns for one in touched]]
    rows, columns = (
        slice(min((one.start for one in span), default=0), max((one.stop for one in span), default=0)) for span in spans
    )
    return rows, columns


def _is_inside(name: str, values: np.ndarray) -> np.ndarray:
    return ~np.isnan(values) if name == ARRIVAL else values != 0.0
