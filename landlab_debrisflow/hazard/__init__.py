"""Hazard: probabilities and quantiles over the members of an ensemble, with their sampling errors."""

from .errors import members_needed
from .exposure import exposure_probabilities
from .maps import hazard_maps
from .matrix import SWISS_LEVELS, HazardMatrix, hazard_matrix
from .scale import SWISS, HazardClass, HazardScale
from .summary import hazard_summary
from .write import write_danger_levels, write_hazard

__all__ = [
    "SWISS",
    "SWISS_LEVELS",
    "HazardClass",
    "HazardMatrix",
    "HazardScale",
    "exposure_probabilities",
    "hazard_maps",
    "hazard_matrix",
    "hazard_summary",
    "members_needed",
    "write_danger_levels",
    "write_hazard",
]
