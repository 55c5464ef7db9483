"""Columns whose basal pressure is a constant fraction of the load."""

from typing import ClassVar

import numpy as np

from ...core.parameters import declared, parameter
from ..column_contracts import ColumnForcing, ColumnState


@declared
class ConstantRatio:
    """p = r rho' g h cos(theta) (1 - xi): excess pore pressure proportional to the overburden at every depth, for ever.

    Symbols: p excess pore pressure [Pa]; r, the parameter `ratio` [-]; rho' buoyant density [kg m-3]; g gravity
    [m s-2]; h slope-normal thickness [m]; theta slope of the bed; xi height over thickness [-].

    The limit of tight debris whose bed has its own ratio.

    References
    ----------
    Hungr (1995), friction with a constant ratio of pore pressure.

    Examples
    --------
    >>> ConstantRatio()
    ConstantRatio(ratio=0.65)
    """

    ratio: float = parameter("-", "excess pore pressure over its liquefaction value", 0.65, (0.0, 1.0))

    stores_pressure: ClassVar[bool] = False  # sources of pressure have no effect
    memory_size: ClassVar[int] = 0

    @property
    def levels(self) -> int:
        """Number of levels of a column: base and surface, the profile is linear."""
        return 2

    def advance(self, columns: ColumnState, forcing: ColumnForcing, dt: float, basal_pressure) -> None:
        """Write r times the load of `forcing` into `basal_pressure`, shape (n,) [Pa], whatever `columns` and `dt`.

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
        np.multiply(forcing.liquefaction_pressure, self.ratio, out=basal_pressure)

    def synchronise(self, columns: ColumnState, forcing: ColumnForcing) -> None:
        """Write r times the load of `forcing`, linear over the levels, into the profiles of `columns` [Pa].

        Parameters
        ----------
        columns : ColumnState
            Columns of n particles; the profiles are written [Pa].
        forcing : ColumnForcing
            Forcing of the last step.
        """
        eta = np.linspace(1.0, 0.0, columns.profile.shape[1])
        columns.profile[:] = self.ratio * forcing.liquefaction_pressure[:, None] * eta
