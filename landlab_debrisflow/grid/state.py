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

    Attributes
    ----------
    grid_bed : GridBed
        Ground of the component.
    settled : ndarray, shape (nodes,)
        Depth laid down in all calls [m].
    budget : VolumeBudget
        Volumes taken and given so far.
    written : slice
        Nodes that calls may have written so far.
    warned : tuple of str
        Kinds of doubt that have been logged.
    bed : Bed or None
        Bed of the call that runs; None between calls.
    peak_maps : PeakMaps or None
        Peak maps of the call that runs; None between calls.
    """

    grid_bed: GridBed
    settled: np.ndarray
    budget: VolumeBudget
    written: slice
    warned: tuple = ()
    bed: Bed | None = None
    peak_maps: PeakMaps | None = None

    def copy(self) -> "GridState":
        """Return a copy that shares arrays over nodes, except the accounts of a running call."""
        running = {} if self.bed is None else {"bed": self.bed.copy(), "peak_maps": copy(self.peak_maps)}
        return replace(self, grid_bed=self.grid_bed.copy(), budget=self.budget.copy(), **running)
