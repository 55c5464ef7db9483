"""Columns without excess pore pressure."""

from typing import ClassVar

from ...core.parameters import declared
from ..contracts import ColumnForcing, ColumnState


@declared
class NoExcessPressure:
    """p = 0: dry debris, or debris so permeable that its pore water stays hydrostatic.

    References
    ----------
    Terzaghi (1943), effective stress of drained soil.

    Examples
    --------
    >>> NoExcessPressure()
    NoExcessPressure()
    """

    stores_pressure: ClassVar[bool] = False  # sources come to nothing
    memory_size: ClassVar[int] = 0

    @property
    def levels(self) -> int:
        """Number of levels of a column: base and surface."""
        return 2

    def advance(self, columns: ColumnState, forcing: ColumnForcing, dt: float, basal_pressure) -> None:
        """Write no pressure at the base [Pa]."""
        basal_pressure[:] = 0.0

    def synchronise(self, columns: ColumnState, forcing: ColumnForcing) -> None:
        """Write no pressure at any level [Pa]."""
        columns.profile[:] = 0.0
