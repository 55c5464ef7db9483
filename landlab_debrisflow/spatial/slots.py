"""Slots of the nodes that a flow has reached: sums over nodes have one place per slot, not per node.

A flow covers a small part of a large raster. Its nodes get slots in the order in which it reaches them, and keep them.
"""

import numpy as np

MOST_AT_START = 8192
"""Slots at the start, if there are so many nodes; their number is doubled when a flow needs more."""


class Slots:
    """Slots of the nodes of a raster.

    Parameters
    ----------
    nodes : int
        Number of nodes.

    Attributes
    ----------
    of_node : ndarray of int32, shape (nodes,)
        Slot of every node; 0: it has none, and slot 0 belongs to no node.
    node : ndarray of int, shape (slots,)
        Node of every slot in use.
    used : int
        Slots in use, slot 0 among them.

    Examples
    --------
    >>> slots = Slots(100)
    >>> slots.reach(np.array([40, 50])), slots.reach(np.array([50, 30]))
    (array([1, 2], dtype=int32), array([2, 3], dtype=int32))
    >>> slots.node[: slots.used]
    array([ 0, 40, 50, 30])
    """

    def __init__(self, nodes: int):
        self.of_node, self.used = np.zeros(nodes, np.int32), 1
        self.node = np.zeros(min(nodes + 1, MOST_AT_START), np.int64)

    @property
    def count(self) -> int:
        """Number of slots, in use or not."""
        return self.node.size

    def reach(self, nodes):
        """Return the slots of distinct nodes, int, shape (k,); nodes that have none get one."""
        new = nodes[self.of_node[nodes] == 0]
        while self.used + new.size > self.count:
            self.double()
        self.of_node[new] = self.used + np.arange(new.size)
        self.node[self.used : self.used + new.size] = new
        self.used += new.size
        return self.of_node[nodes]

    def double(self) -> None:
        """Double the number of slots; arrays given away before stay as they are."""
        self.node = with_places(self.node, 2 * self.count)


def with_places(values, slots: int):
    """Return `values`, shape (n, ...), with at least `slots` places, of which the new ones are 0."""
    if values.shape[0] >= slots:
        return values
    longer = np.zeros((slots, *values.shape[1:]), values.dtype)
    longer[: values.shape[0]] = values
    return longer
