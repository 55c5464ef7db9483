"""Outline of a landslide on the ground: checked arrays, and the fall of the ground from each node to its exit."""

from typing import Any, NamedTuple

import numpy as np

from ..core.checks import in_range, require
from ..core.errors import InputError
from .fall_lines import fall_to_exit

TALLEST = 1e5
"""Largest relief of the ground [m]; a larger one means that some values mark missing data."""

CALLER = "failure_surface: "


class Outline(NamedTuple):
    """Outline of a landslide; arrays have shape (rows, columns).

    Attributes
    ----------
    inside : ndarray of bool
        Nodes of which a part lies inside.
    fraction : ndarray
        Part of each cell that lies inside [-].
    elevation : ndarray
        Elevation of the ground before the failure [m]; NaN where nothing can leave.
    fall : ndarray
        Fall of the ground from each node to where its fall line leaves the outline, 0 outside [m].
    spacing : tuple of float
        Distance of columns and of rows [m].
    """

    inside: np.ndarray
    fraction: np.ndarray
    elevation: np.ndarray
    fall: np.ndarray
    spacing: tuple[float, float]

    @property
    def cell_area(self) -> float:
        """Map area of a cell [m2]."""
        return self.spacing[0] * self.spacing[1]

    @property
    def area(self) -> float:
        """Map area of the outline [m2]."""
        return float(self.fraction.sum()) * self.cell_area


def read_outline(inside: Any, elevation: Any, spacing: Any) -> Outline:
    """Return the outline of a landslide that arguments of `failure_surface` describe.

    Raises
    ------
    InputError
        If an argument is not usable.
    """
    fraction, ground = np.asarray(inside, float), np.array(elevation, float)
    require(fraction.ndim == 2, f"{CALLER}inside", "have shape (rows, columns)", fraction.shape, error=InputError)
    require(
        ground.shape == fraction.shape, f"{CALLER}elevation", f"have the shape of inside, {fraction.shape}",
        ground.shape, error=InputError,
    )  # fmt: skip
    columns = fraction.shape[1]

    def place(bad):
        return f" at row {bad[0] // columns}, column {bad[0] % columns}"

    in_range(
        f"{CALLER}inside", fraction, 0.0, 1.0, where=place, form="g", error=InputError,
        remedy="give bool, or the fraction of every cell that lies inside",
    )  # fmt: skip
    failing = fraction > 0.0
    require(
        failing.any(), f"{CALLER}inside", "hold at least one node", "none", error=InputError,
        remedy="does the outline lie beside the grid, or between its nodes?",
    )  # fmt: skip
    edge = np.ones(failing.shape, bool)
    edge[1:-1, 1:-1] = False
    require(
        ~(failing & edge), f"{CALLER}inside", "leave out the outermost rows and columns", fraction, place,
        "use a larger DEM, or cut the outline", "g", InputError,
    )  # fmt: skip
    require(
        ~failing | np.isfinite(ground), f"{CALLER}elevation", "be finite inside the outline", ground, place,
        "cut the outline where there are no data", "g", InputError,
    )  # fmt: skip
    ground[~np.isfinite(ground)] = np.nan
    relief = float(np.nanmax(ground) - np.nanmin(ground))
    if not relief <= TALLEST:
        raise InputError(
            f"{CALLER}elevation has a relief of {relief:.4g} m, more than any mountain; is it in m, and are missing "
            "values NaN?"
        )
    steps = np.broadcast_to(np.asarray(spacing, float), 2) if np.size(spacing) in (1, 2) else np.full(2, np.nan)
    require(
        np.all(np.isfinite(steps) & (steps > 0.0)), f"{CALLER}spacing", "be one or two lengths > 0 m", spacing,
        error=InputError,
    )  # fmt: skip
    spacing = float(steps[0]), float(steps[1])
    return Outline(failing, fraction, ground, fall_to_exit(failing, ground, spacing), spacing)
