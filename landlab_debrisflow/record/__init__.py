"""Datasets, files, observers and measures. Reads the model, is never imported by it."""

from .datasets import stack
from .files import check_writable, write_atomically, write_dataset
from .measures import quantile
from .observers import Progress, Series, Snapshots

__all__ = [
    "Progress",
    "Series",
    "Snapshots",
    "check_writable",
    "quantile",
    "stack",
    "write_atomically",
    "write_dataset",
]
