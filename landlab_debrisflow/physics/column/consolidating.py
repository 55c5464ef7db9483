"""Parameters and methods shared by the laws of consolidating columns."""

import functools
from typing import ClassVar

from ...core.parameters import declared, parameter
from ..column_contracts import ColumnForcing, ColumnState
from .schemes.choices import BED_CONTACT, LOADING, Scheme, scheme_of
from .schemes.registry import MEMORY_SIZE, advance, check_scheme, memory_size, synchronise


@declared
class Consolidating:
    """Columns whose excess pore pressure diffuses and is loaded by changes of thickness and porosity."""

    levels: int = parameter("-", "levels of a column, base and surface included", 11, (3, 1001), kind=int)
    loading_source: str = parameter(
        "-", "change of the pressure by a change of thickness", "overburden", choices=tuple(LOADING)
    )
    scheme: str = parameter("-", "how the equation is solved", "default", choices=tuple(MEMORY_SIZE))
    bed_contact: str = parameter(
        "-", "whether the bed prescribes the pressure of a base that erodes, or only that of the soil that flows in",
        "dirichlet", choices=BED_CONTACT,
    )  # fmt: skip
    tolerance: float = parameter(
        "-", "error over the load aimed at when columns are left alone, 0: never; by default 0.3/(levels - 1)^2",
        None, (0.0, 0.1),
    )  # fmt: skip
    source_includes_erosion: bool = parameter(
        "-", "load grains by soil that comes in below them, to replicate eqs. 19 and 38", False, kind=bool
    )

    stores_pressure: ClassVar[bool] = True
    # True: grains keep their depth below the surface; False: their fraction of the depth
    moves_with_grains: ClassVar[bool]

    def _agree(self):
        check_scheme(self)

    @property
    def memory_size(self) -> int:
        """Number of floats of a column in `ColumnState.memory`."""
        return memory_size(self)

    @functools.cached_property
    def choices(self) -> Scheme:
        """The parameters as kernels read them."""
        return scheme_of(self)

    def advance(self, columns: ColumnState, forcing: ColumnForcing, dt: float, basal_pressure) -> None:
        """Advance the `columns` by `dt` [s] in place under a `forcing`; write `basal_pressure`, shape (n,) [Pa].

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
        advance(self, columns, forcing, dt, basal_pressure)

    def synchronise(self, columns: ColumnState, forcing: ColumnForcing) -> None:
        """Turn every profile of `columns` into the pressures at levels now [Pa], in place; `forcing` is the last.

        Parameters
        ----------
        columns : ColumnState
            Columns of n particles; the profiles are written [Pa].
        forcing : ColumnForcing
            Forcing of the last step.
        """
        synchronise(self, columns, forcing)
