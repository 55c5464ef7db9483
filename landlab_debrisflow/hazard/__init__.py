"""Hazard: probabilities and quantiles over the members of an ensemble, with their sampling errors."""

from .errors import members_needed
from .maps import hazard_maps
from .scale import SWISS, HazardClass, HazardScale

__all__ = ["SWISS", "HazardClass", "HazardScale", "hazard_maps", "members_needed"]
