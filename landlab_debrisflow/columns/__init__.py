"""Columns of excess pore pressure without a flow: ``solve_column``."""
