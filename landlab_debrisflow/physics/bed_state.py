"""The pore water of the bed as a law of erosion reads it."""

from typing import Any, NamedTuple

import numpy as np
from numpy import ndarray as Array


class BedState(NamedTuple):
    """Pore water of the bed under each of n particles: of the node nearest to it, found when it is asked for.

    Attributes
    ----------
    ratios : ndarray, shape (nodes,) or (1,); excess pore pressure over its liquefaction value [-]
    saturations : ndarray, shape (nodes,) or (1,); degree of saturation of the pores with water [-]
    drained : ndarray of bool, shape (nodes,), or None; where a drain holds the excess pore pressure at 0
    nodes : ndarray of int, shape (n,); node nearest to each particle
    """

    ratios: Array
    saturations: Array
    drained: Any
    nodes: Array

    @property
    def pressure_ratio(self) -> Array:
        """Excess pore pressure of the bed over its liquefaction value, shape (n,) or (1,) [-]."""
        ratio = self.ratios if self.ratios.size == 1 else self.ratios[self.nodes]
        return ratio if self.drained is None else np.where(self.drained[self.nodes], 0.0, ratio)

    @property
    def degree_of_saturation(self) -> Array:
        """Volume of water over volume of pores of the bed, shape (n,) or (1,) [-]."""
        return self.saturations if self.saturations.size == 1 else self.saturations[self.nodes]


SATURATED_BED = BedState(np.zeros(1), np.ones(1), None, np.zeros(1, np.int64))
"""Bed of hydrostatic pore pressure, for states of which no law reads the bed."""
