"""The sine waves in which the pressure of a column decays."""

from functools import lru_cache
from typing import NamedTuple

import numpy as np


class Modes(NamedTuple):
    """Modes of a column, and what they need to let a slope at an impermeable base relax."""

    shapes: np.ndarray  # (2, cells, cells): sin(wave eta), normalised, for either base
    mirror_rates: np.ndarray  # (cells,), decay of the next wave that looks the same at the levels
    mirror: np.ndarray  # (cells,), what that wave has in a slope of 1
    unseen: np.ndarray  # (cells,), what all shorter waves that look the same have in it


@lru_cache(maxsize=8)
def column_modes(levels: int) -> Modes:
    """Return the modes of a column.

    Parameters
    ----------
    levels : int
        Number of levels, base and surface included.

    Returns
    -------
    Modes
        Shapes [0] belong to an impermeable base, waves ``(j + 1/2) pi``; [1] to a prescribed one,
        ``(j + 1) pi``. They are given at all levels but the surface, where they vanish.

    Notes
    -----
    ``eta`` has the Fourier coefficients ``+-2/wave^2`` over an impermeable base. The levels cannot
    tell waves ``wave + 2 pi cells l`` apart; summed over them it is ``+-2/(2 cells sin(wave/(2 cells)))^2``
    (the partial fractions of the cosecant squared).
    """
    cells = levels - 1
    index = np.arange(cells)
    eta = 1.0 - index / cells
    waves = np.array([(index + 0.5) * np.pi, (index + 1.0) * np.pi])
    shapes = np.sqrt(2.0 / cells) * np.sin(waves[:, :, None] * eta)
    shapes[1, :, 0] = 0.0  # sin(j pi), exactly
    shapes[1, -1, :] = 0.0  # the mode that the levels cannot see
    mirror_rates = (2.0 * np.pi * cells - waves[0]) ** 2
    seen = 1.0 / (2.0 * cells * np.sin(waves[0] / (2.0 * cells))) ** 2
    return Modes(shapes, mirror_rates, cells / mirror_rates, cells * (seen - 1.0 / waves[0] ** 2))
