"""Excess pore pressure under a particle: one law per file."""

from .ale import ALE
from .classical import Classical
from .constant_ratio import ConstantRatio
from .none import NoExcessPressure

__all__ = ["ALE", "Classical", "ConstantRatio", "NoExcessPressure"]
