"""Report of a run: one HTML page that needs nothing beside it, for people who decide and for those who check."""

from .write import write_report

__all__ = ["write_report"]
