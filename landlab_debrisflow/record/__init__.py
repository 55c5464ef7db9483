"""Datasets, files, observers and measures. The modules here read the model, which imports none of them."""

from .budget_series import BudgetSeries
from .checkpoints import Checkpoints
from .combine import combine_maps
from .datasets import stack
from .files import check_writable, write_atomically, write_dataset
from .front import Front
from .gauges import Gauges
from .map_series import MapSeries
from .measures import quantile
from .monitor import Monitor
from .observers import Progress, Snapshots
from .sections import Sections
from .series import Series
from .tracks import MarkedColumns, Tracks
from .written_maps import mask_peaks, write_maps

__all__ = [
    "BudgetSeries",
    "Checkpoints",
    "Front",
    "Gauges",
    "MapSeries",
    "MarkedColumns",
    "Monitor",
    "Progress",
    "Sections",
    "Series",
    "Snapshots",
    "Tracks",
    "check_writable",
    "combine_maps",
    "mask_peaks",
    "quantile",
    "stack",
    "write_atomically",
    "write_dataset",
    "write_maps",
]
