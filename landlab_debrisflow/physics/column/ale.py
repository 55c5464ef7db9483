"""Columns that move with the base they erode: the arbitrary Lagrangian-Eulerian model."""

from ...core.parameters import declared, parameter
from ..contracts import ColumnForcing, ColumnState
from .profile import LOADING, advance_columns, bring_columns, scheme_of


@declared
class ALE:
    """Excess pore pressure of a column that grows at its base (Pastor et al., 2022, eq. 35).

    ``dp/dt + (e_R/h)(1 - xi) dp/dxi = (c_v/h^2) d2p/dxi2 + S``: a grain keeps its depth below the
    surface while the column erodes. At the base the bed prescribes the pressure of a column that
    erodes; it is impermeable to one that does not.

    Examples
    --------
    >>> ALE()
    ALE(levels=11, loading_source='overburden')
    >>> ALE(levels=2)
    Traceback (most recent call last):
        ...
    landlab_debrisflow.core.errors.ParameterError: ALE: levels must lie in [3, 1001], got 2
    """

    levels: int = parameter("-", "levels of a column, base and surface included", 11, (3, 1001), kind=int)
    loading_source: str = parameter(
        "-", "what a change of thickness does to the pressure", "overburden", choices=tuple(LOADING)
    )

    def advance(self, columns: ColumnState, forcing: ColumnForcing, dt: float, basal_pressure) -> None:
        """Advance the columns by ``dt`` seconds in place and write the pressure friction feels [Pa]."""
        advance_columns(columns, forcing, dt, basal_pressure, scheme_of(True, self.loading_source, self.levels))

    def synchronise(self, columns: ColumnState, forcing: ColumnForcing) -> None:
        """Bring every profile to the present in place."""
        bring_columns(columns, forcing, scheme_of(True, self.loading_source, self.levels))
