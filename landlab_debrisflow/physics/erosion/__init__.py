"""Laws of entrainment: the rate at which the flow erodes the bed."""

from .excess_traction import ExcessTraction
from .growth import Growth
from .liquefied_bed import LiquefiedBed
from .none import NoErosion
from .shear_excess import ShearExcess

__all__ = ["ExcessTraction", "Growth", "LiquefiedBed", "NoErosion", "ShearExcess"]
