"""Columns that move with the base they erode: the arbitrary Lagrangian-Eulerian model."""

from typing import ClassVar

from ...core.errors import ParameterError
from ...core.parameters import declared, parameter
from ...core.variables import Variable
from ..column_contracts import DilatantBase
from .consolidating import Consolidating
from .dilatancy import Dilatancy
from .schemes.dilatant import COEFFICIENT, DILATANCY, FLUID

SOLID_FRACTION = Variable("solid_fraction", "-", "volume fraction of the grains in the column", per_level=True)


@declared
class ALE(Consolidating):
    """dp/dt + (e_R/h)(1 - xi) dp/dxi = (c_v/h^2) d2p/dxi2 + S: a column that grows at its base.

    Symbols: p excess pore pressure [Pa]; t time [s]; xi height over thickness, 0 at the base [-]; h slope-normal
    thickness [m]; e_R slope-normal entrainment rate [m s-1]; c_v coefficient of consolidation [m2 s-1]; S [Pa s-1].

    A grain keeps its depth below the surface while the column erodes. At the base the bed prescribes the
    pressure of a column that erodes; the base of a column that does not erode is impermeable. S is the source
    by changes of the load. With `dilatancy` the shear of the flow makes pressure, too, and c_v follows from it.

    References
    ----------
    Pastor et al. (2022), eq. 35.

    Examples
    --------
    >>> ALE().levels
    11
    >>> ALE(levels=2)
    Traceback (most recent call last):
        ...
    landlab_debrisflow.core.errors.ParameterError: ALE: levels must lie in [3, 1001], got 2
    """

    moves_with_grains: ClassVar[bool] = True

    dilatancy: Dilatancy | None = parameter(
        "-", "debris contracts or dilates as it is sheared; by default it does not", None, kind=Dilatancy
    )

    def _agree(self):
        super()._agree()
        if self.dilatancy is None:
            return
        for name, allowed in (("scheme", "default"), ("tolerance", None), ("source_includes_erosion", False)):
            if (value := getattr(self, name)) != allowed:
                raise ParameterError(
                    f"ALE: {name} must be left out with dilatancy, got {value!r}: every column is advanced in every "
                    "step by a scheme of its own; remove one of the two"
                )

    @property
    def variables(self) -> tuple[Variable, ...]:
        """Variables per particle beyond those of every column."""
        return () if self.dilatancy is None else (SOLID_FRACTION,)

    def at_base(self, memory) -> DilatantBase:
        """Return the debris at the base of columns with dilatancy, from their `memory`, shape (n, memory_size)."""
        return DilatantBase(memory[:, DILATANCY], memory[:, FLUID], memory[:, COEFFICIENT])
