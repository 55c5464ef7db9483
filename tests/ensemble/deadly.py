"""A law of erosion that ends its process, as one does that runs out of memory."""

import os

from landlab_debrisflow.laws import BasalState, declared, parameter


@declared
class Deadly:
    """e_R = 0, unless the process ends: nothing is eroded."""

    deadly: float = parameter("-", "1: the process ends", 0.0, (0.0, 1.0))

    def entrainment_rate(self, state: BasalState, out) -> None:
        """Write the erosion rate asked for [m s-1]."""
        if self.deadly == 1.0:
            os._exit(1)
        out[:] = 0.0
