"""The sine waves in which the pressure of a column decays."""

from functools import lru_cache
from typing import NamedTuple

import numpy as np


class Modes(NamedTuple):
    """Modes of a column, [0] over an impermeable base and [1] over a prescribed one."""

    shapes: np.ndarray  # (2, cells, cells), at all levels but the surface: sin(wave eta), normalised
    mirror_rates: np.ndarray  # (cells,), of the next wave that looks the same at the levels, [0] only
    mirror: np.ndarray  # (cells,), what that wave adds to a unit slope at the base
    unseen: np.ndarray  # (cells,), what all waves that look the same add to it


@lru_cache(maxsize=8)
def column_modes(levels: int) -> Modes:
    """Return the modes of a column of ``levels`` levels, base and surface included.

    The Fourier coefficients of ``eta`` over an impermeable base are ``+-2/wave^2``; those that the
    levels see are ``+-2/(2 cells sin(wave/(2 cells)))^2``, the sum over all waves that look alike.
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
