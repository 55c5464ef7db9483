"""Laws of entrainment: how fast the flow asks soil from the bed."""

from .growth import Growth
from .liquefied_bed import LiquefiedBed
from .none import NoErosion
from .shear_excess import ShearExcess

__all__ = ["Growth", "LiquefiedBed", "NoErosion", "ShearExcess"]
