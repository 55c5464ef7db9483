"""Laws by class, and the names that the author of a new law needs (CONTRIBUTING.md).

Examples
--------
>>> from landlab_debrisflow.laws import Voellmy
>>> Voellmy(turbulent_coefficient=500.0).turbulent_coefficient
500.0
"""

from .core.jit import allocating_kernel as kernel
from .core.jit import inner
from .core.parameters import declared, on_nodes, parameter
from .core.variables import Variable
from .physics.bed_state import BedState
from .physics.column import ALE, Classical, ConstantRatio, NoExcessPressure
from .physics.column.dilatancy import Dilatancy
from .physics.column_contracts import BaseContact, ColumnForcing, ColumnLaw, ColumnState
from .physics.consolidation import Consolidation
from .physics.contracts import BasalState, ErosionLaw, FlowLaw, FlowState, FrictionLaw
from .physics.erosion import ExcessTraction, Growth, LiquefiedBed, NoErosion, ShearExcess
from .physics.flow import OnePhase, TwoPhase
from .physics.friction import Bingham, Coulomb, HerschelBulkley, MuI, Voellmy
from .physics.registry import LAWS

__all__ = [
    "ALE",
    "LAWS",
    "BasalState",
    "BaseContact",
    "BedState",
    "Bingham",
    "Classical",
    "ColumnForcing",
    "ColumnLaw",
    "ColumnState",
    "Consolidation",
    "ConstantRatio",
    "Coulomb",
    "Dilatancy",
    "ErosionLaw",
    "ExcessTraction",
    "FlowLaw",
    "FlowState",
    "FrictionLaw",
    "Growth",
    "HerschelBulkley",
    "LiquefiedBed",
    "MuI",
    "NoErosion",
    "NoExcessPressure",
    "OnePhase",
    "ShearExcess",
    "TwoPhase",
    "Variable",
    "Voellmy",
    "declared",
    "inner",
    "kernel",
    "on_nodes",
    "parameter",
]
