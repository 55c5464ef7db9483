"""Laws of basal friction."""

from .bingham import Bingham
from .coulomb import Coulomb
from .herschel_bulkley import HerschelBulkley
from .mu_i import MuI
from .voellmy import Voellmy

__all__ = ["Bingham", "Coulomb", "HerschelBulkley", "MuI", "Voellmy"]
