"""Columns that spread what they erode over their whole depth: the model before the ALE one."""

from ...core.parameters import declared, parameter
from ..contracts import ColumnForcing, ColumnState
from .profile import LOADING, advance_columns, bring_columns, scheme_of


@declared
class Classical:
    """Excess pore pressure without the advection by erosion (Pastor et al., 2009, 2015; eq. 19).

    ``dp/dt = (c_v/h^2) d2p/dxi2 + S``, with the same base and sources as `ALE`: a grain keeps its
    fraction of the depth while the column grows. Kept for comparison.

    Examples
    --------
    >>> Classical(loading_source="none")
    Classical(levels=11, loading_source='none')
    """

    levels: int = parameter("-", "levels of a column, base and surface included", 11, (3, 1001), kind=int)
    loading_source: str = parameter(
        "-", "what a change of thickness does to the pressure", "overburden", choices=tuple(LOADING)
    )

    def advance(self, columns: ColumnState, forcing: ColumnForcing, dt: float, basal_pressure) -> None:
        """Advance the columns by ``dt`` seconds in place and write the pressure friction feels [Pa]."""
        advance_columns(columns, forcing, dt, basal_pressure, scheme_of(False, self.loading_source, self.levels))

    def synchronise(self, columns: ColumnState, forcing: ColumnForcing) -> None:
        """Bring every profile to the present in place."""
        bring_columns(columns, forcing, scheme_of(False, self.loading_source, self.levels))
