"""The accounts of volume: every term is measured on its own, none is the rest of the others."""

import numpy as np


class Ledger:
    """Volumes taken from and given to the ground, measured as differences of its fields.

    Parameters
    ----------
    area : float
        Map area of a node [m2].
    """

    def __init__(self, area: float):
        self._area = area
        self.released = self.deposited = 0.0
        self._eroded = 0.0  # in earlier calls
        self._core = self._soil = self._soil_before = None

    def watch_soil(self, core, soil) -> None:
        """Measure erosion as the fall of a field of soil depth, shape (nodes,) [m], from now on; None: no field."""
        self._eroded = self.eroded
        self._core, self._soil = core, soil
        self._soil_before = None if soil is None else soil[core]

    @property
    def eroded(self) -> float:
        """Volume eroded so far [m3], also in the middle of a call."""
        if self._soil is None:
            return self._eroded
        return self._eroded + float(np.sum(self._soil_before - self._soil[self._core]) * self._area)

    def deposit(self, core, elevation, lay_down):
        """Call `lay_down()` and count by how much volume `elevation`, shape (nodes,) [m], rises."""
        self.watch_soil(None, None)
        before = elevation[core]
        result = lay_down()
        self.deposited += float(np.sum(elevation[core] - before) * self._area)
        return result

    def budget(self, simulation) -> dict[str, float]:
        """Return all terms and the residual [m3]: released + inflow + eroded - moving - deposited - outflow."""
        moving = float(simulation.particles.volume.sum())
        inflow, outflow = simulation.inflow.volume, float(sum(simulation.outflow.values()))
        return {
            "released": self.released, "inflow": inflow, "eroded": self.eroded, "moving": moving,
            "deposited": self.deposited, "outflow": outflow,
            "residual": self.released + inflow + self.eroded - moving - self.deposited - outflow,
        }  # fmt: skip

    def snapshot(self):
        """Return what `restore` needs."""
        return self.released, self.eroded, self.deposited

    def restore(self, snapshot) -> None:
        """Go back to a snapshot."""
        self.released, self._eroded, self.deposited = snapshot
        self._soil = None
