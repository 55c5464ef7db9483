"""Columns without excess pore pressure."""

from typing import ClassVar

from ...core.parameters import declared
from ..column_contracts import ColumnForcing, ColumnState


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

    stores_pressure: ClassVar[bool] = False  # sources of pressure have no effect
    memory_size: ClassVar[int] = 0

    @property
    def levels(self) -> int:
        """Number of levels of a column: base and surface."""
        return 2

    def advance(self, columns: ColumnState, forcing: ColumnForcing, dt: float, basal_pressure) -> None:
        """Write 0 into `basal_pressure`, shape (n,) [Pa], whatever `columns`, `forcing` and `dt`.

        Parameters
        ----------
        columns : ColumnState
            Columns of n particles.
        forcing : ColumnForcing
            Change of the columns in the step.
        dt : float
            Duration of the step [s].
        basal_pressure : ndarray, shape (n,)
            Written: excess pore pressure at the base, for friction [Pa].
        """
        basal_pressure[:] = 0.0

    def synchronise(self, columns: ColumnState, forcing: ColumnForcing) -> None:
        """Write 0 at all levels of `columns` [Pa], whatever the `forcing`.

        Parameters
        ----------
        columns : ColumnState
            Columns of n particles; the profiles are written [Pa].
        forcing : ColumnForcing
            Forcing of the last step.
        """
        columns.profile[:] = 0.0
