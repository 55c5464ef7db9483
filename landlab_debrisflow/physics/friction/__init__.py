"""Laws of basal friction."""

from .coulomb import Coulomb
from .voellmy import Voellmy

__all__ = ["Coulomb", "Voellmy"]
