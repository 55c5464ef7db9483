"""Columns that move with the base they erode: the arbitrary Lagrangian-Eulerian model."""

from typing import ClassVar

from ...core.parameters import declared
from .consolidating import Consolidating


@declared
class ALE(Consolidating):
    """dp/dt + (e_R/h)(1 - xi) dp/dxi = (c_v/h^2) d2p/dxi2 + S: a column that grows at its base.

    Symbols: p excess pore pressure [Pa]; t time [s]; xi height over thickness, 0 at the base [-]; h slope-normal
    thickness [m]; e_R slope-normal entrainment rate [m s-1]; c_v coefficient of consolidation [m2 s-1]; S [Pa s-1].

    A grain keeps its depth below the surface while the column erodes. At the base the bed prescribes the
    pressure of a column that erodes; the base of a column that does not erode is impermeable. S is the source
    by changes of the load.

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
