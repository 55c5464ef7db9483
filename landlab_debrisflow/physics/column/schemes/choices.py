"""The choices of a law in the form that kernels read."""

from typing import NamedTuple

OVERBURDEN, PROPORTIONAL, UNLOADED = 0, 1, 2
LOADING = {"overburden": OVERBURDEN, "proportional": PROPORTIONAL, "none": UNLOADED}
BED_CONTACT = ("dirichlet", "flux")


class Scheme(NamedTuple):
    """Choices of a column law as kernels read them, numbers in place of words.

    Attributes
    ----------
    levels : int
        Levels of a column, base and surface included.
    moves_with_grains : bool
        Grains keep their depth (ALE); else they keep their fraction of it (classical).
    loading : int
        A value of LOADING.
    loads_by_erosion : bool
        Also load old grains by the soil that comes in below them (eqs. 19 and 38 to the letter).
    flux : bool
        New soil brings its own pressure and no more; else the bed prescribes that of the base.
    tolerance : float
        Error of the pressure over the load that skipping aims at [-]; 0: no skipping.
    """

    levels: int
    moves_with_grains: bool
    loading: int
    loads_by_erosion: bool
    flux: bool
    tolerance: float


LEVELS_ERROR = 0.3
"""Error of the pressure that levels make, over the load, times the square of their number (benchmarks/column.py)."""


def scheme_of(law) -> Scheme:
    """Return the choices of a law as kernels read them."""
    tolerance = LEVELS_ERROR / (law.levels - 1) ** 2 if law.tolerance is None else law.tolerance
    return Scheme(
        levels=law.levels,
        moves_with_grains=law.moves_with_grains,
        loading=LOADING[law.loading_source],
        loads_by_erosion=law.source_includes_erosion,
        flux=law.bed_contact == "flux",
        tolerance=tolerance,
    )
