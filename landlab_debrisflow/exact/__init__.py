"""Exact solutions in closed form: pore pressure in columns, and depth-averaged flows."""

from . import columns, flows

__all__ = ["columns", "flows"]
