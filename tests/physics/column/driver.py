"""Drive a column law with a history of volume and thickness, as the flow would."""

import numpy as np

from landlab_debrisflow.physics.column.schemes.lazy.state import MEMORY_SIZE
from landlab_debrisflow.physics.contracts import ColumnForcing, ColumnState

WATER_TO_BUOYANT = 1000.0 / 990.0
LOAD_PER_METRE = 990.0 * 9.81


class Columns:
    """One or more columns of a law, with the state a particle would carry.

    Parameters
    ----------
    law : ColumnLaw
    profile : array_like, shape (n, levels)
        At the start [Pa].
    thickness : array_like, shape (n,)
        At the start [m]; the volume is the same number, as if on one square metre.
    load : array_like, shape (n,), optional
        Liquefaction pressure [Pa]; `LOAD_PER_METRE` times the thickness if absent.
    coefficient_of_consolidation : float, optional
        [m2 s-1].
    bounded : bool, optional
        Whether the law holds the pressure between suction and liquefaction.
    """

    def __init__(self, law, profile, thickness, load=None, coefficient_of_consolidation=0.0, bounded=True):
        self.law, self.coefficient = law, coefficient_of_consolidation
        self.volume = np.array(thickness, dtype=float)
        self.thickness = self.volume.copy()
        self.load = LOAD_PER_METRE * self.volume if load is None else np.array(load, dtype=float)
        count = self.volume.size
        self.state = ColumnState(np.array(profile, dtype=float), np.zeros((count, MEMORY_SIZE)), np.zeros(count))
        self.base, self.bed = np.zeros(count), np.zeros(count)
        self.standing, self.source, self.bounded = np.zeros(1, np.int8), np.zeros(1), bounded
        self.law.advance(self.state, self.forcing(), 0.0, self.base)

    def step(self, dt, entrained=0.0, strain=0.0, ratio=0.65, load=None):
        """Let the base give ``entrained`` [m3] and the flow thicken by a factor 1 + ``strain``."""
        before = self.volume.copy()
        self.volume = before + entrained
        self.thickness = self.thickness * (self.volume / before) * (1.0 + strain)
        self.load = LOAD_PER_METRE * self.thickness if load is None else np.broadcast_to(load, before.shape).copy()
        self.bed = ratio * self.load
        entrained = np.broadcast_to(entrained, before.shape).astype(float)
        self.law.advance(self.state, self.forcing(entrained), dt, self.base)
        return self.base.copy()

    def forcing(self, entrained=None):
        """Return what the law is told, as of now."""
        entrained = np.zeros_like(self.volume) if entrained is None else entrained
        arrays = self.volume, self.thickness, self.load, entrained, self.bed, self.standing, self.source
        return ColumnForcing(*arrays, np.array([self.coefficient]), WATER_TO_BUOYANT, self.bounded)

    def profile(self):
        """Return the profiles brought to the present, without touching the columns [Pa]."""
        copy = ColumnState(*(array.copy() for array in self.state))
        self.law.synchronise(copy, self.forcing())
        return copy.profile

    def content(self):
        """Return the pressure integrated over the thickness [Pa m]."""
        return depth_mean(self.profile()) * self.thickness


def depth_mean(profile):
    """Return the mean of profiles, trapezoidal as the laws count it [Pa]."""
    return (profile[:, 1:-1].sum(axis=1) + 0.5 * (profile[:, 0] + profile[:, -1])) / (profile.shape[1] - 1)


def eta(levels):
    """Return the fraction of the depth below the surface at the levels."""
    return np.linspace(1.0, 0.0, levels)
