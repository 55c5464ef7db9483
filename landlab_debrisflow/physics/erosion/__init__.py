"""Laws of entrainment: how fast the flow asks soil from the bed."""

from .growth import Growth
from .none import NoErosion

__all__ = ["Growth", "NoErosion"]
