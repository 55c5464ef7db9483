"""Setup of a run as a value, and ready-made terrains."""

from .setup import Setup
from .tsing_shan import NON_ERODIBLE_BELOW, tsing_shan_valley

__all__ = ["NON_ERODIBLE_BELOW", "Setup", "tsing_shan_valley"]
