"""The way back to what there was before a call, or between two of its steps."""

from ..core.memento import Memento
from .ground import Ground
from .row_backup import Journal, Spot


class Moment:
    """Grid and model as they are now.

    Parameters
    ----------
    objects : sequence
        All whose attributes a call changes.
    ground : Ground
        One of them.
    rows : Journal
        Of the node arrays that a call changes; goes on covering rows.
    drained : sequence of ndarray, shape (nodes,)
        What may change everywhere.
    shared : iterable
        What else is not copied, because it stays as it is.
    """

    def __init__(self, objects, ground: Ground, rows: Journal, drained, shared):
        self.rows, self._ground, self._drained = rows, ground, Spot(drained, slice(None))
        self._model = Memento(objects, (*rows.arrays, *shared))

    def restore(self) -> None:
        """Go back, as often as wanted."""
        self._drained.restore()
        self.rows.restore()
        self._ground.follow(self.rows.nodes)
        self._model.restore()
