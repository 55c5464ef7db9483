"""Exact solutions in closed form: pore pressure in columns, debris that dilates, and depth-averaged flows."""

from . import columns, dilatancy, flows

__all__ = ["columns", "dilatancy", "flows"]
