"""Accounts of erodible soil at nodes: demand, grant and erosion."""

from typing import NamedTuple

import numpy as np

from ..core.arrays import value_at
from ..core.jit import allocating_kernel, kernel
from ..core.structs import struct
from .surface import set_node


@struct
class NodeAccounts(NamedTuple):
    """Accounts of soil at the nodes of a raster, changed in place.

    Attributes
    ----------
    soil : ndarray, shape (nodes,)
        Erodible depth [m].
    elevation : ndarray, shape (nodes,)
        Elevation of the bed [m].
    eroded_depth : ndarray, shape (nodes,)
        Depth eroded so far [m].
    taken : ndarray, shape (slots,)
        Depth eroded in this call [m].
    surface : ndarray, shape (rows + 2, columns + 2)
        Elevation with one more node on every side [m].
    before : ndarray, shape (slots, 3)
        Soil, elevation and eroded depth at the beginning of the call, of nodes that were lowered [m].
    pressure_ratio : ndarray, shape (nodes,) or (1,)
        Pore pressure ratio of the soil [-]; is read only.
    """

    soil: np.ndarray
    elevation: np.ndarray
    eroded_depth: np.ndarray
    taken: np.ndarray
    surface: np.ndarray
    before: np.ndarray
    pressure_ratio: np.ndarray


@struct
class Demand(NamedTuple):
    """Demand for soil at the nodes under a flow: scratch of an erosion.

    Attributes
    ----------
    volume : ndarray, shape (slots,)
        Soil asked for [m3]; 0 before and after.
    granted : ndarray, shape (slots, 2)
        Fraction of the demand that the soil can supply, and its pore pressure ratio [-].
    touched : ndarray of int, shape (slots,)
        Slots of nodes with a demand, as many as there are, in order of first touch.
    """

    volume: np.ndarray
    granted: np.ndarray
    touched: np.ndarray


@allocating_kernel
def taken_at(nodes, slot_of, taken):
    """Return the depth eroded in this call at some nodes, shape (n,) [m]; slots of nodes as in `slots.Slots`."""
    found = np.empty(nodes.size)
    for i in range(nodes.size):
        found[i] = taken[slot_of[nodes[i]]]
    return found


@kernel
def take_soil(footprints, demanded, area, accounts, demand, entrained, ratio):
    """Add up the demand for soil at every node, grant the part that the soil can supply, and lower the node.

    Parameters
    ----------
    footprints : Footprints
        Footprints of the n particles at least.
    demanded : ndarray, shape (n,)
        Volume asked for [m3].
    area : float
        Map area of a node [m2].
    accounts : NodeAccounts
        Soil at the nodes, changed in place.
    demand : Demand
        Scratch of an erosion.
    entrained, ratio : ndarray, shape (n,)
        Written: volume given to each particle [m3] and its pore pressure ratio [-].

    Returns
    -------
    count : int
        Number of slots touched.
    at_edge : bool
        Whether a node lies so near the edge that the rim of the surface depends on it.
    """
    soil, elevation, eroded_depth, taken, surface, before, pressure_ratio = accounts
    volume, granted, touched = demand
    begin, end, index, weight, nodes = footprints
    found, at_edge = 0, False
    for i in range(demanded.size):
        if demanded[i] > 0.0:
            for k in range(begin[i], end[i]):
                slot = index[k]
                if volume[slot] == 0.0:
                    touched[found] = slot
                    found += 1
                volume[slot] += weight[k] * demanded[i]
    for k in range(found):
        slot = touched[k]
        node = nodes[slot]
        if taken[slot] == 0.0:
            before[slot, 0], before[slot, 1], before[slot, 2] = soil[node], elevation[node], eroded_depth[node]
        supplied = min(1.0, (before[slot, 0] - taken[slot]) * area / volume[slot])
        granted[slot, 0], granted[slot, 1] = supplied, value_at(pressure_ratio, node)
        taken[slot] = min(taken[slot] + supplied * volume[slot] / area, before[slot, 0])
        soil[node] = before[slot, 0] - taken[slot]
        elevation[node] = before[slot, 1] - taken[slot]
        eroded_depth[node] = before[slot, 2] + taken[slot]
        at_edge |= set_node(surface, node, elevation[node])
        volume[slot] = 0.0
    for i in range(demanded.size):
        entrained[i] = ratio[i] = 0.0
        if demanded[i] > 0.0:
            fraction, pressure = 0.0, 0.0
            for k in range(begin[i], end[i]):
                given = weight[k] * granted[index[k], 0]
                fraction += given
                pressure += given * granted[index[k], 1]
            entrained[i] = demanded[i] * fraction
            ratio[i] = pressure / fraction if fraction > 0.0 else 0.0
    return found, at_edge
