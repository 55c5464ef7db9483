"""Observations of an event that are maps: change of elevation, outline of the deposit."""

import dataclasses
import math
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
import xarray as xr

from ..core.checks import in_range
from ..core.errors import InputError
from ..geo.cover import covered_fraction
from ..geo.lattice import Lattice, extent
from ..geo.references import label_of, same_place
from ..geo.resampling import read_onto
from ..record.georeference import crs_of
from .bound import Bound, check_error, plain_error, stated_error
from .model_error import ModelError
from .place import Place
from .shapes import polygon_of

FEWEST = 12
"""Least number of cells with an observed change of elevation."""


@dataclasses.dataclass(frozen=True, eq=False)
class ElevationChange:
    """Observed change of elevation, the difference of two surveys, compared with deposit less erosion.

    Errors of a survey are correlated: the n cells of area A count as 5 A / (pi L^2) independent ones, at least one and
    at most n, where L is the range of a spherical variogram (Rolstad, Haug & Denby 2009).

    Parameters
    ----------
    raster : DataArray, str or Path
        Change over ``y`` and ``x`` [m], NaN where it is not known; or a raster file.
    sd : float, optional
        Standard deviation of the error of a cell [m]; None: not stated.
    correlation_length : float
        Distance from which on errors are independent, the range of their variogram [m]; 0: every cell is independent.
    mask : polygon, file or coordinates, optional
        Polygon outside which nothing is compared.
    source : bool
        Whether the cells of the release are compared, too: their lowering is the depth that the scene releases, times
        the released volume of the member over that of the scene. By default they are left out, because their depth is
        given and not simulated.
    threshold : float
        Least change that counts in scores, such as the critical success index [m].
    model_error : float or ModelError, optional
        Scale of the error of the model [m]; by default the model is taken to be right.
    """

    raster: Any
    sd: float | None = None
    correlation_length: float = 0.0
    mask: Any = None
    source: bool = False
    threshold: float = 0.2
    model_error: ModelError | float | None = None
    maps: ClassVar[tuple[str, ...]] = ("deposit_depth", "depth", "eroded_depth")

    def __post_init__(self):
        in_range("calibration: elevation change: correlation_length", self.correlation_length, 0.0, unit="m",
                 error=InputError)  # fmt: skip
        check_error("elevation change", self.sd, self.model_error, "m")

    def observed(self, place: Place) -> np.ndarray:
        """Return the observed change at the nodes of an event, shape (rows, columns) [m]; NaN where not compared."""
        values = self._on(place)
        if self.mask is not None:
            inside = covered_fraction(polygon_of(self.mask, "mask of elevation change", place), place.lattice) >= 0.5
            values = np.where(inside, values, np.nan)
        values = np.where(place.closed, np.nan, values)
        cells = int(np.isfinite(values).sum())
        if cells < FEWEST:
            raise InputError(
                f"calibration: elevation change: only {cells} cells have values; are mask and raster right?"
            )
        return values

    def compared(self, place: Place) -> tuple[np.ndarray, np.ndarray]:
        """Return the observed change at the nodes of an event [m], and which nodes are compared; 0 m elsewhere."""
        observed = self.observed(place)
        compared = np.isfinite(observed) if self.source else np.isfinite(observed) & (place.released == 0.0)
        if (total := int(compared.sum())) < FEWEST:
            raise InputError(
                f"calibration: elevation change: {total} cells lie outside of the release; give source=True"
            )
        return np.where(compared, observed, 0.0), compared

    def at(self, place: Place) -> Bound:
        """Return the observation at the nodes of an event."""
        known, compared = self.compared(place)
        total = int(compared.sum())
        count = float(total)
        if self.correlation_length > 0.0:
            count = min(count, 5.0 * total * place.lattice.area / (math.pi * self.correlation_length**2))

        def misfit(one):
            off = change_of(one, place, self.source) - known
            return math.sqrt(float(np.sum(off[compared] ** 2)) / total)

        size = math.sqrt(float(np.sum(known**2)) / total)
        stated = stated_error(self.sd, max(1.0, count), size, self.model_error)
        label = "elevation change" if self.source else "elevation change outside of the release"
        return Bound(label, "m", misfit, stated, (known, compared, *plain_error(stated)))

    def _on(self, place: Place) -> np.ndarray:
        if isinstance(self.raster, str | Path):
            return read_onto(place.folder / self.raster, place.lattice, whole=False)
        if not isinstance(self.raster, xr.DataArray) or set(self.raster.dims) != {"y", "x"}:
            raise InputError(
                f"calibration: elevation change: a DataArray over y and x or a raster file is needed, got "
                f"{type(self.raster).__name__}"
            )
        values = self.raster.transpose("y", "x").sortby(["y", "x"])
        x, y, lattice = values.x.values, values.y.values, place.lattice
        own = crs_of(self.raster.to_dataset(name="change"))
        if not same_place(lattice.crs, own, lattice.bounds, 0.01 * min(lattice.spacing)):
            raise InputError(
                f"calibration: elevation change is in {label_of(own)}, the maps are in {label_of(lattice.crs)}; give "
                "it as a raster file, which is brought into their system"
            )
        if values.shape != lattice.shape or not (
            np.allclose(x, lattice.x, atol=0.01 * lattice.spacing[0], rtol=0.0)
            and np.allclose(y, lattice.y, atol=0.01 * lattice.spacing[1], rtol=0.0)
        ):
            raise InputError(
                f"calibration: elevation change has {values.shape} nodes, {_span(x, y)}; the maps have "
                f"{lattice.shape}, {_extent(lattice)}: give it at their nodes, or as a raster file, which is resampled"
            )
        return values.values.astype(float)


@dataclasses.dataclass(frozen=True, eq=False)
class DepositOutline:
    """Observed outline of the deposit.

    The misfit is a mean distance: the area in which outline and deposit differ over the length of the outline.

    Parameters
    ----------
    polygon : polygon, file or coordinates
        Outline on the map [m].
    sd : float, optional
        Standard deviation of the position of the outline [m]; None: not stated.
    threshold : float
        Least depth that counts as deposit [m].
    model_error : float or ModelError, optional
        Scale of the error of the model [m].
    """

    polygon: Any
    sd: float | None = None
    threshold: float = 0.1
    model_error: ModelError | float | None = None
    maps: ClassVar[tuple[str, ...]] = ("deposit_depth", "depth")

    def __post_init__(self):
        in_range("calibration: outline: threshold", self.threshold, 0.0, unit="m", error=InputError)
        check_error("outline", self.sd, self.model_error, "m")

    def inside(self, place: Place) -> np.ndarray:
        """Return the part of each cell of an event that lies inside the outline, shape (rows, columns) [-]."""
        return covered_fraction(self._on(place), place.lattice)

    def at(self, place: Place) -> Bound:
        """Return the observation at the nodes of an event."""
        polygon, inside = self._on(place), self.inside(place)
        perimeter = float(polygon.length)

        def misfit(one):
            covered = np.zeros(place.lattice.shape)
            covered[one.rows, one.columns] = one.maps["deposit_depth"] + one.maps["depth"] > self.threshold
            return float(np.sum(abs(covered - inside))) * place.lattice.area / perimeter

        stated = stated_error(self.sd, 1.0, math.sqrt(polygon.area), self.model_error)
        content = (inside, perimeter, self.threshold, *plain_error(stated))
        return Bound("outline of the deposit", "m", misfit, stated, content)

    def _on(self, place: Place) -> Any:
        return polygon_of(self.polygon, "outline of the deposit", place)


def change_of(one: Any, place: Place, source: bool = True) -> np.ndarray:
    """Return the simulated change of elevation of a member, shape (rows, columns) [m].

    Parameters
    ----------
    one : MemberResult
        With the maps of `ElevationChange`.
    place : Place
    source : bool
        Whether the depth that was released is taken off.

    Returns
    -------
    ndarray
        Deposit, with mass that still moves, less erosion.
    """
    change = np.zeros(place.lattice.shape)
    window = change[one.rows, one.columns]
    window += one.maps["deposit_depth"].astype(float) + one.maps["depth"] - one.maps["eroded_depth"]
    if source and place.released.any():
        change -= place.released * (one.measures["budget_released"] / place.volume)
    return change


def _span(x: np.ndarray, y: np.ndarray) -> str:
    return f"x {x[0]:.10g} to {x[-1]:.10g} m, y {y[0]:.10g} to {y[-1]:.10g} m"


def _extent(lattice: Lattice) -> str:
    return f"nodes {_span(lattice.x, lattice.y)} (cells {extent(lattice.bounds)})"
