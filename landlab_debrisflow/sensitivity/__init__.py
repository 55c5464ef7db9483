"""Sensitivity of the measures of an ensemble to its varied values: rank correlations, Sobol indices, a picture."""

from .indices import sobol_indices
from .picture import draw_sensitivity
from .rank import rank_correlations

__all__ = ["draw_sensitivity", "rank_correlations", "sobol_indices"]
