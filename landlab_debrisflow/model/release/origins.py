"""Origins of released particles, by node: a particle that never moved settles exactly where it was released."""

import numpy as np


class Origins:
    """Place of every released particle, and the volume that it took from each node.

    The arrays are never changed in place.

    Examples
    --------
    Two particles, of which the first stands for node 7 and half of node 8:

    >>> origins = Origins()
    >>> x, y, particle = np.array([35.0, 41.0]), np.zeros(2), np.array([0, 0, 1])
    >>> origins.add(x, y, particle, np.array([7, 8, 8]), np.array([2.0, 1.0, 1.0]))
    array([0, 1])
    >>> origins.returned(np.array([0]), np.array([3.0]))
    (array([7, 8]), array([2., 1.]))
    """

    def __init__(self):
        self._x, self._y, self._volume = np.zeros((3, 0))
        self._owner, self._node = np.zeros((2, 0), np.int64)
        self._part = np.zeros(0)
        self.span = ()  # first and last node from which soil was taken

    def copy(self) -> "Origins":
        """Return an independent copy."""
        other = Origins()
        vars(other).update(vars(self))
        return other

    def add(self, x, y, particle, node, part):
        """Note a release and return the numbers of its particles here, shape (n,).

        Parameters
        ----------
        x, y : ndarray, shape (n,)
            Where the particles start [m].
        particle, node : ndarray of int, shape (m,)
            Particle and node of every pair of which the particle took a volume from the node.
        part : ndarray, shape (m,)
            [m3]
        """
        first, count = self._x.size, x.size
        self._x, self._y = np.concatenate([self._x, x]), np.concatenate([self._y, y])
        self._volume = np.concatenate([self._volume, np.bincount(particle, part, count)])
        self._owner = np.concatenate([self._owner, first + particle])
        self._node, self._part = np.concatenate([self._node, node]), np.concatenate([self._part, part])
        self.span = int(self._node.min()), int(self._node.max())
        return first + np.arange(count)

    def unmoved(self, origin, x, y, spacing, core):
        """Return the fraction of a particle that returns to its origin, shape (n,) [-]: 1 unmoved, 0 from a spacing on.

        Parameters
        ----------
        origin : ndarray of int, shape (n,)
            Numbers that `add` returned; < 0 for particles that were not released.
        x, y, spacing : ndarray, shape (n,)
            Position and spacing of the particles now [m].
        core : ndarray of bool, shape (nodes,)
            Nodes that may receive anything.
        """
        usable = np.ones(self._x.size, bool)
        usable[self._owner[~core[self._node]]] = False
        known = np.flatnonzero(origin >= 0)
        known = known[usable[origin[known]]]
        way = np.hypot(x[known] - self._x[origin[known]], y[known] - self._y[origin[known]])
        part = np.zeros(origin.size)
        part[known] = np.maximum(0.0, 1.0 - way / spacing[known])
        return part

    def returned(self, origin, volume):
        """Return the nodes to which some particles go back, and the volume that each receives [m3], both (k,).

        Parameters
        ----------
        origin : ndarray of int, shape (n,)
        volume : ndarray, shape (n,)
            Volume of each particle that returns [m3]; it is divided among the nodes as it was taken.
        """
        back = np.bincount(origin, volume, self._x.size)
        got = back[self._owner] > 0.0
        owner = self._owner[got]
        nodes, place = np.unique(self._node[got], return_inverse=True)
        return nodes, np.bincount(place, back[owner] / self._volume[owner] * self._part[got], nodes.size)
