"""Laws of the flow itself: one phase."""

from .one_phase import OnePhase

__all__ = ["OnePhase"]
