"""Exact solutions in closed form, of columns and of flows."""
