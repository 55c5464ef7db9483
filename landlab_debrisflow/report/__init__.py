"""Report of a run: one HTML page without further files, for decisions and for checks."""

from .write import write_report

__all__ = ["write_report"]
