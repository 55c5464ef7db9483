"""Footprints: the nodes on which particles lie, with weights (`transfer`)."""

from typing import NamedTuple

import numpy as np

from ..core.structs import struct


@struct
class Footprints(NamedTuple):
    """Nodes on which each of n particles lies, with weights: a sparse matrix by rows, with gaps between the rows.

    Sums over nodes need a place for each of the slots, as many as `node` has entries.

    Attributes
    ----------
    begin, end : ndarray of int, shape (n,)
        First entry of each particle, and the entry after its last one.
    slot : ndarray of int, shape (m,)
        Slots of nodes, core nodes all.
    weight : ndarray, shape (m,)
        Weights, which are > 0 and sum to 1 for every particle [-].
    node : ndarray of int, shape (slots,)
        Node of every slot in use.
    """

    begin: np.ndarray
    end: np.ndarray
    slot: np.ndarray
    weight: np.ndarray
    node: np.ndarray


def on_nodes(footprints: Footprints) -> Footprints:
    """Return footprints whose slots are the nodes themselves, for sums with a place for each node of the raster."""
    begin, end, slot, weight, node = footprints
    return Footprints(begin=begin, end=end, slot=node[slot], weight=weight, node=node)
