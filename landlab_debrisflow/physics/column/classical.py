"""Columns that spread what they erode over their whole depth: the model before the ALE one."""

from typing import ClassVar

from ...core.parameters import declared, parameter
from ..contracts import ColumnForcing, ColumnState
from .schemes.choices import BED_CONTACT, LOADING
from .schemes.lazy.state import MEMORY_SIZE
from .schemes.registry import ADVANCE, advance, check_scheme, synchronise


@declared
class Classical:
    """dp/dt = (c_v/h^2) d2p/dxi2 + S: a column without the advection by erosion, kept for comparison.

    Base and sources are those of `ALE`; a grain keeps its fraction of the depth while the column grows.

    References
    ----------
    Pastor et al. (2009, 2015); Pastor et al. (2022), eq. 19.

    Examples
    --------
    >>> Classical(loading_source="none").loading_source
    'none'
    """

    levels: int = parameter("-", "levels of a column, base and surface included", 11, (3, 1001), kind=int)
    loading_source: str = parameter(
        "-", "what a change of thickness does to the pressure", "overburden", choices=tuple(LOADING)
    )
    scheme: str = parameter("-", "how the equation is solved", "default", choices=tuple(ADVANCE))
    bed_contact: str = parameter(
        "-", "whether the bed prescribes the pressure of a base that erodes, or what flows in", "dirichlet",
        choices=BED_CONTACT,
    )  # fmt: skip
    tolerance: float = parameter(
        "-", "error over the load aimed at when columns are left alone, 0: never; by default 0.3/(levels - 1)^2",
        None, (0.0, 0.1),
    )  # fmt: skip
    source_includes_erosion: bool = parameter(
        "-", "load grains by soil that comes in below them, to replicate eqs. 19 and 38", False, kind=bool
    )

    stores_pressure: ClassVar[bool] = True
    memory_size: ClassVar[int] = MEMORY_SIZE

    def _agree(self):
        check_scheme(self)

    def advance(self, columns: ColumnState, forcing: ColumnForcing, dt: float, basal_pressure) -> None:
        """Advance the columns by ``dt`` seconds in place and write the pressure friction feels [Pa]."""
        advance(self, False, columns, forcing, dt, basal_pressure)

    def synchronise(self, columns: ColumnState, forcing: ColumnForcing) -> None:
        """Bring every profile to the present in place."""
        synchronise(self, False, columns, forcing)
