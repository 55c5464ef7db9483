"""Report of a run: one HTML page that needs no other file."""

from .write import write_report

__all__ = ["write_report"]
