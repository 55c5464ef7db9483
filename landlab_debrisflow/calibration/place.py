"""Place of an event: nodes of the maps, release and folder, to which observations are brought."""

from pathlib import Path
from typing import NamedTuple

import numpy as np

from ..core.errors import InputError
from ..core.hints import did_you_mean
from ..ensemble.basis import Basis
from ..geo.lattice import Lattice, extent
from ..grid.fields import NODE_FIELDS, OUTPUT_PREFIX
from ..scene.output_keys import MAPS


class Place(NamedTuple):
    """Nodes of an event, and its release.

    Attributes
    ----------
    lattice : Lattice
    folder : Path
        Directory to which names of files are relative.
    released : ndarray, shape (rows, columns)
        Depth that the scene releases out of the ground [m].
    volume : float
        Volume that the scene releases, out of the ground or from above [m3].
    closed : ndarray of bool, shape (rows, columns)
        Nodes without ground, where nothing flows.
    centre : tuple of float
        Centre of the release by volume, from where run-out is counted, x and y on the map [m]; NaN without release.
    """

    lattice: Lattice
    folder: Path
    released: np.ndarray
    volume: float
    closed: np.ndarray
    centre: tuple[float, float]

    @classmethod
    def of_basis(cls, basis: Basis) -> "Place":
        """Return the place of the ground and the releases that members share."""
        lattice = basis.lattice
        depth, released, volume = np.zeros(lattice.shape), np.zeros(lattice.shape), 0.0
        for one in basis.releases:
            if one is not None:
                depth = depth + (one.depth if one.time == 0.0 else 0.0)
                released = released + (one.depth if one.source == "ground" else 0.0)
                volume += float(one.depth.sum()) * lattice.area
        centre = float("nan"), float("nan")
        if depth.any():
            x, y = np.meshgrid(lattice.x, lattice.y)
            centre = float(np.average(x, weights=depth)), float(np.average(y, weights=depth))
        closed = np.isnan(basis.terrain["topographic__elevation"].values)
        return cls(lattice, basis.folder, released, volume, closed, centre)

    def node_at(self, label: str, x: float, y: float) -> tuple[int, int]:
        """Return row and column of the cell at a point of the map.

        Parameters
        ----------
        label : str
            Name of the observation, for messages.
        x, y : float
            Map coordinates [m].

        Returns
        -------
        tuple of int

        Raises
        ------
        InputError
            If no cell with ground lies there.
        """
        (dx, dy), (x0, y0) = self.lattice.spacing, self.lattice.lower_left
        row, column = round((y - y0) / dy), round((x - x0) / dx)
        if not (0 <= row < self.lattice.shape[0] and 0 <= column < self.lattice.shape[1]):
            raise InputError(
                f"calibration: {label} lies outside of the grid, {extent(self.lattice.bounds)}; is the point in the "
                "coordinate reference system of the DEM?"
            )
        if self.closed[row, column]:
            raise InputError(f"calibration: {label} lies where the DEM has no data; give a point on the ground")
        return row, column


def check_map(label: str, name: str) -> None:
    """Refuse the name of a map that members do not have.

    Parameters
    ----------
    label : str
        Name of the observation, for messages.
    name : str

    Raises
    ------
    InputError
    """
    if name not in MAPS:
        raise InputError(
            f"calibration: {label}: no map {name!r}{did_you_mean(name, MAPS)}; there are {', '.join(MAPS)}"
        )


def unit_of(name: str) -> str:
    """Return the unit of a map of the members.

    Examples
    --------
    >>> unit_of("max_depth")
    'm'
    """
    return next(field.unit for field in NODE_FIELDS if field.name == OUTPUT_PREFIX + name)
