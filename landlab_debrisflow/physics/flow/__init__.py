"""Laws of the flow itself: one phase or two."""

from .one_phase import OnePhase
from .two_phase import TwoPhase

__all__ = ["OnePhase", "TwoPhase"]
