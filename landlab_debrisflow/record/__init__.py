"""Datasets, files, observers and measures. Reads the model, is never imported by it."""

from .checkpoints import Checkpoints
from .combine import combine_maps
from .datasets import stack
from .files import check_writable, write_atomically, write_dataset
from .map_series import MapSeries
from .measures import quantile
from .observers import Progress, Snapshots
from .series import Series
from .written_maps import mask_peaks, write_maps

__all__ = [
    "Checkpoints",
    "MapSeries",
    "Progress",
    "Series",
    "Snapshots",
    "check_writable",
    "combine_maps",
    "mask_peaks",
    "quantile",
    "stack",
    "write_atomically",
    "write_dataset",
    "write_maps",
]
