"""Columns without advection by erosion: entrained soil spreads over the whole depth, as before the ALE model."""

from typing import ClassVar

from ...core.parameters import declared
from .consolidating import Consolidating


@declared
class Classical(Consolidating):
    """dp/dt = (c_v/h^2) d2p/dxi2 + S: a column without the advection by erosion, kept for comparison.

    Symbols: p excess pore pressure [Pa]; t time [s]; xi height over thickness [-]; h slope-normal thickness [m]; c_v
    coefficient of consolidation [m2 s-1]; S source by changes of the load [Pa s-1].

    Base and sources are as in `ALE`; a grain keeps its fraction of the depth while the column grows.

    References
    ----------
    Pastor et al. (2009, 2015); Pastor et al. (2022), eq. 19.

    Examples
    --------
    >>> Classical(loading_source="none").loading_source
    'none'
    """

    moves_with_grains: ClassVar[bool] = False
