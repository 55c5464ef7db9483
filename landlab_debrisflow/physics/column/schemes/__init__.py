"""Schemes that solve the equation of the column."""
