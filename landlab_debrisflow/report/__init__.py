"""Report of a run or of an ensemble: one HTML page that needs no other file."""

from .ensemble import write_ensemble_report
from .write import write_report

__all__ = ["write_ensemble_report", "write_report"]
