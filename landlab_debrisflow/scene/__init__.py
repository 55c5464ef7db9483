"""Setup of a run as a value, bodies that fail, and ready-made terrains."""

from .failure_surface import failure_surface
from .release import failing_depth, lay_on_top
from .setup import Setup
from .tsing_shan import NON_ERODIBLE_BELOW, tsing_shan_valley

__all__ = ["NON_ERODIBLE_BELOW", "Setup", "failing_depth", "failure_surface", "lay_on_top", "tsing_shan_valley"]
