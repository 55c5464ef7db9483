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
        self.released = self.eroded = self.deposited = 0.0
        self._reference = None

    def open(self, core, values) -> None:
        """Remember field values, shape (nodes,) [m], to which the next entry is compared; None: no field."""
        self._core = core
        self._reference = None if values is None else values[core]

    def change(self, values) -> float:
        """Return by how much volume the field has risen since `open` [m3]."""
        return 0.0 if values is None else float(np.sum(values[self._core] - self._reference) * self._area)

    def budget(self, simulation) -> dict[str, float]:
        """Return all terms and the residual [m3]: released + eroded - moving - deposited - outflow."""
        moving = float(simulation.particles.volume.sum())
        outflow = float(sum(simulation.outflow.values()))
        return {
            "released": self.released, "eroded": self.eroded, "moving": moving, "deposited": self.deposited,
            "outflow": outflow,
            "residual": self.released + self.eroded - moving - self.deposited - outflow,
        }  # fmt: skip

    def snapshot(self):
        """Return what `restore` needs."""
        return self.released, self.eroded, self.deposited

    def restore(self, snapshot) -> None:
        """Go back to a snapshot."""
        self.released, self.eroded, self.deposited = snapshot
