"""Particles found by their identity: arrays of particles are sorted anew in every step."""

import numpy as np

LARGEST_TABLE = 10_000_000
"""Highest identity up to which a table of all of them is made: it is faster than a search."""


def places_of(wanted: np.ndarray, identity: np.ndarray) -> np.ndarray:
    """Return the place of each wanted particle in an array of identities, -1 where it is not there.

    Parameters
    ----------
    wanted, identity : ndarray of int, shapes (n,) and (m,)
        Identities >= 0, each once in `identity`.

    Returns
    -------
    ndarray of int, shape (n,)

    Examples
    --------
    >>> places_of(np.array([8, 3]), np.array([7, 3])), places_of(np.array([2**60, 3]), np.array([2**62, 2**60]))
    (array([-1,  1]), array([ 1, -1]))
    """
    highest = max(int(values.max(initial=-1)) for values in (wanted, identity))
    if highest <= LARGEST_TABLE:
        table = np.full(highest + 1, -1)
        table[identity] = np.arange(identity.size)
        return table[wanted]
    order = np.argsort(identity)
    near = np.minimum(np.searchsorted(identity, wanted, sorter=order), max(identity.size - 1, 0))
    found = order[near] if identity.size else np.full(wanted.shape, -1)
    return np.where(identity[found] == wanted, found, -1) if identity.size else found
