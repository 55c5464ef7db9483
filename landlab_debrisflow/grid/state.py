"""State of the border: its whole memory of one component, so that undo is one assignment."""

from copy import copy
from dataclasses import dataclass, replace

import numpy as np

from ..model.peak_maps import PeakMaps
from ..terrain.bed import Bed
from .budget import VolumeBudget
from .grid_bed import GridBed


@dataclass
class GridState:
    """Memory of the border from step to step and from call to call.

    Arrays over nodes are changed in place and restored by rows (`row_backup`); everything else belongs to the state.
    """

    grid_bed: GridBed
    settled: np.ndarray  # (nodes,) depth laid down in all calls [m]
    budget: VolumeBudget
    written: slice  # nodes that calls may have written so far
    warned: tuple = ()  # kinds of doubt that have been logged
    bed: Bed | None = None  # of the call that runs
    peak_maps: PeakMaps | None = None  # of the call that runs

    def copy(self) -> "GridState":
        """Return a copy that shares arrays over nodes, except the accounts of a running call."""
        running = {} if self.bed is None else {"bed": self.bed.copy(), "peak_maps": copy(self.peak_maps)}
        return replace(self, grid_bed=self.grid_bed.copy(), budget=self.budget.copy(), **running)
