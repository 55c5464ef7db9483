"""Parts of a component that know it without keeping it in memory."""

import weakref
from typing import Any


class OwnedByFlow:
    """Part of a component.

    A reference in both directions would keep a component that nobody uses until Python looks for cycles; its arrays
    over all nodes are large, and many runs in one process make one after the other.

    Parameters
    ----------
    flow : DebrisFlow
        Component that owns the part.
    """

    def __init__(self, flow: Any):
        self._owner = weakref.ref(flow)

    @property
    def flow(self) -> Any:
        """Component that owns the part; None once it is gone."""
        return self._owner()

    def __getstate__(self) -> dict[str, Any]:
        return self.__dict__ | {"_owner": self.flow}  # a weak reference cannot be pickled

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
        self._owner = weakref.ref(state["_owner"])
