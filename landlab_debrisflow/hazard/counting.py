"""Integer counts over the members of an ensemble, at every node: equal in whatever order members come."""

from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from ..ensemble import MemberResult
from ..grid.fields import OUTPUT_PREFIX
from ..model.map_fields import PEAKS
from ..record.datasets import ON_WALLS
from .bins import bin_edges
from .questions import ARRIVAL, DEPTH

Values = Mapping[str, np.ndarray]
"""Maps of a member by name, each over the nodes of its window."""


class Event(NamedTuple):
    """Event at a node, such as a depth above a threshold.

    Attributes
    ----------
    name : str
    came : callable
        Returns where the event came, from the maps of a member by name.
    """

    name: str
    came: Callable[[Values], np.ndarray]


def above(name: str, threshold: float) -> Event:
    """Return the event that a map exceeds a threshold."""
    return Event(name, lambda values: values[name] > threshold)


REACHED = Event("reached", lambda values: values[DEPTH] > 0.0)
"""Event that the flow came, as deep as the least depth."""


def without_films(member: MemberResult, least_depth: float) -> dict[str, np.ndarray]:
    """Return the maps of a member over its window, its peaks where the flow came as deep as a least depth.

    Elsewhere peaks are 0 and the arrival time is NaN. Walls, at which no depth is known, keep impact pressure and
    run-up.

    Parameters
    ----------
    member : MemberResult
    least_depth : float
        [m]

    Returns
    -------
    dict of str to ndarray, shape (rows, columns) of the window
    """
    depth = member.maps[DEPTH]
    reached = (depth > 0.0) & (depth >= least_depth)
    values = dict(member.maps)
    for name in (one for one in member.maps if one in PEAKS):
        kept = reached | (depth == 0.0) if OUTPUT_PREFIX + name in ON_WALLS else reached
        values[name] = np.where(kept, member.maps[name], np.float32(np.nan if name == ARRIVAL else 0.0))
    return values


def count_type(members: int) -> np.dtype:
    """Return the type of counts of members: 16 bits, so that few members need no less memory than thousands."""
    return np.promote_types(np.uint16, np.min_scalar_type(members))


class EventCounts:
    """Members of each replicate in which events came, at every node.

    Parameters
    ----------
    events : sequence of Event
    shape : tuple of int
        Rows and columns.
    groups : int
        Number of replicates.
    members : int
        Number of members.

    Attributes
    ----------
    events : tuple of Event
    counts : ndarray of int, shape (groups, events, rows, columns)
    """

    def __init__(self, events: Sequence[Event], shape: tuple[int, int], groups: int, members: int):
        self.events = tuple(events)
        self.counts = np.zeros((groups, len(self.events), *shape), count_type(members))

    def add(self, group: int, member: MemberResult, values: Values) -> None:
        """Count a member.

        Parameters
        ----------
        group : int
            Number of its replicate.
        member : MemberResult
        values : mapping of str to ndarray
            Its maps, as `without_films` returns them.
        """
        for k, event in enumerate(self.events):
            self.counts[group, k, member.rows, member.columns] += event.came(values)


class Histogram:
    """Members by the bin in which the value of a map lies, at every node; nodes outside of a window are not counted.

    Parameters
    ----------
    name : str
        Name of the map.
    shape : tuple of int
        Rows and columns.
    members : int
        Number of members.

    Attributes
    ----------
    counts : ndarray of int, shape (rows, columns, bins)
        Members in each bin of `bin_values`; values of 0 and of NaN are in none.
    """

    def __init__(self, name: str, shape: tuple[int, int], members: int):
        self.name, self.edges = name, bin_edges(name)
        # bins last: the system gives memory only to pages that are written, of nodes that a flow touched
        self.counts = np.zeros((*shape, self.edges.size + 1), count_type(members))

    def add(self, member: MemberResult, values: Values) -> None:
        """Count a member.

        Parameters
        ----------
        member : MemberResult
        values : mapping of str to ndarray
            Its maps, as `without_films` returns them.
        """
        given = values[self.name]
        rows, columns = np.nonzero(np.isfinite(given) if self.name == ARRIVAL else given > 0.0)
        self.count(rows + member.rows.start, columns + member.columns.start, given[rows, columns])

    def count(self, rows: np.ndarray, columns: np.ndarray, values: np.ndarray) -> None:
        """Count values of a member at nodes, each once.

        Parameters
        ----------
        rows, columns : ndarray of int, shape (n,)
        values : ndarray, shape (n,)
        """
        bins = np.searchsorted(self.edges, values.astype(float), side="right")
        self.counts[rows, columns, bins] += 1
