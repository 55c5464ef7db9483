"""Drive a column law with a history of volume and thickness, as the flow would."""

import numpy as np

from landlab_debrisflow.physics.column import driver
from landlab_debrisflow.physics.column.driver import depth_mean

WATER_TO_BUOYANT = 1000.0 / 990.0
LOAD_PER_METRE = 990.0 * 9.81

__all__ = ["LOAD_PER_METRE", "WATER_TO_BUOYANT", "Columns", "depth_mean", "eta"]


class Columns(driver.Columns):
    """Columns on one square metre, over a bed of constant ratio.

    Parameters
    ----------
    law, profile, thickness
        As of `driver.Columns`.
    load : array_like, shape (n,), optional
        Liquefaction pressure [Pa]; `LOAD_PER_METRE` times the thickness if absent.
    coefficient_of_consolidation : float, optional
        [m2 s-1].
    bounded : bool, optional
        Whether the law keeps the pressure between suction and liquefaction.
    """

    def __init__(self, law, profile, thickness, load=None, coefficient_of_consolidation=0.0, bounded=True):
        load = LOAD_PER_METRE * np.array(thickness, dtype=float) if load is None else load
        super().__init__(
            law, profile, thickness, liquefaction_pressure=load, water_to_buoyant=WATER_TO_BUOYANT, bounded=bounded,
            coefficient_of_consolidation=coefficient_of_consolidation,
        )  # fmt: skip

    def step(self, dt, entrained=0.0, strain=0.0, ratio=0.65, load=None):
        """Let the base give ``entrained`` [m3] and the flow thicken by a factor 1 + ``strain``."""
        before = self.forcing.volume
        thickness = self.forcing.thickness * ((before + entrained) / before) * (1.0 + strain)
        load = np.broadcast_to(LOAD_PER_METRE * thickness if load is None else load, before.shape)
        return super().step(dt, entrained, thickness=thickness, liquefaction_pressure=load, bed_pressure=ratio * load)

    @property
    def base(self):
        """Excess pore pressure at the base, for friction [Pa]."""
        return self.basal_pressure

    @property
    def volume(self):
        """Volume [m3]."""
        return self.forcing.volume

    @property
    def thickness(self):
        """Thickness [m]."""
        return self.forcing.thickness

    @property
    def load(self):
        """Liquefaction pressure [Pa]."""
        return self.forcing.liquefaction_pressure

    @property
    def bed(self):
        """Pressure of the bed [Pa]."""
        return self.forcing.bed_pressure


def eta(levels):
    """Return the fraction of the depth below the surface at the levels."""
    return np.linspace(1.0, 0.0, levels)
