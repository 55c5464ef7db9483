"""What objects were made of, to be put back: nobody has to know which of their attributes change."""

from copy import deepcopy


class Memento:
    """A deep copy of the attributes of some objects, which can be put back into these very objects, again and again.

    Parameters
    ----------
    objects : sequence
        Objects with attributes; they may refer to each other.
    shared : iterable
        What is not copied: it does not change, or others put it back.

    Examples
    --------
    >>> import numpy as np
    >>> from types import SimpleNamespace
    >>> flow = SimpleNamespace(time=0.0, depth=np.ones(2))
    >>> memento = Memento([flow])
    >>> flow.time, flow.depth[1], flow.speed = 2.0, 0.5, 3.0
    >>> memento.restore()
    >>> flow
    namespace(time=0.0, depth=array([1., 1.]))
    """

    def __init__(self, objects, shared=()):
        self._objects = list(objects)
        self._same = {id(same): same for same in (*self._objects, *shared)}
        self._kept = self._copied([vars(each) for each in self._objects])

    def restore(self) -> None:
        """Put everything back."""
        for each, kept in zip(self._objects, self._copied(self._kept), strict=True):
            vars(each).clear()
            vars(each).update(kept)

    def _copied(self, values):
        return deepcopy(values, dict(self._same))
