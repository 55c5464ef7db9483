"""Names of the files in the directory of an ensemble."""

HAZARD, LEVELS, EXPOSURE = "hazard.nc", "danger_level", "exposure"
"""Hazard maps, danger levels, and probabilities at exposed polygons, the latter two without suffix."""
