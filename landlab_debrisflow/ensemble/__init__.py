"""Ensembles: many runs of a scene whose values are drawn from distributions."""

from .ensemble import Ensemble
from .result import MemberResult
from .results import EnsembleResults

__all__ = ["Ensemble", "EnsembleResults", "MemberResult"]
