"""Places on the map that observers watch: points and lines with names, given in map coordinates."""

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..core.errors import InputError


def named_places(owner: str, places: Any) -> dict[str, Any]:
    """Return places by name.

    Parameters
    ----------
    owner : str
        Name of the observer, for messages.
    places : mapping of str, or iterable of pairs
        Name and coordinates of each.

    Returns
    -------
    dict

    Raises
    ------
    InputError
        If there is none, a name is there twice, or a name is no text.
    """
    pairs = list(places.items()) if isinstance(places, Mapping) else places
    if isinstance(pairs, str) or not isinstance(pairs, Iterable):
        raise InputError(f"{owner}: places must be a mapping of names to coordinates, got {places!r}")
    pairs = list(pairs)
    if not pairs or not all(isinstance(pair, tuple | list) and len(pair) == 2 for pair in pairs):
        raise InputError(f"{owner}: places must be a mapping of names to coordinates, at least one, got {places!r}")
    names = [name for name, _ in pairs]
    if wrong := [name for name in names if not isinstance(name, str) or not name.strip()]:
        raise InputError(f"{owner}: a name must be a text, got {wrong[0]!r}")
    if twice := [name for name in names if names.count(name) > 1]:
        raise InputError(f"{owner}: the name {twice[0]!r} is there twice; give each a name of its own")
    return dict(pairs)


def line(owner: str, coordinates: ArrayLike) -> np.ndarray:
    """Return the vertices of a line.

    Parameters
    ----------
    owner : str
        Name of the observer and the line, for messages.
    coordinates : array_like, shape (n, 2)
        Map coordinates x, y of at least two vertices [m].

    Returns
    -------
    ndarray, shape (n, 2)
        The vertices, without those that repeat the one before.

    Raises
    ------
    InputError
        If they are not finite or fewer than two are different.
    """
    vertices = _coordinates(owner, coordinates)
    if vertices.ndim != 2 or vertices.shape[1:] != (2,):
        raise InputError(f"{owner}: a line needs vertices of shape (n, 2), x and y each [m], got {vertices.shape}")
    new = np.r_[True, np.any(np.diff(vertices, axis=0) != 0.0, axis=1)] if len(vertices) else np.empty(0, bool)
    if (vertices := vertices[new]).shape[0] < 2:
        raise InputError(f"{owner}: a line needs at least two different vertices, got {len(vertices)}")
    return vertices


def point(owner: str, coordinates: ArrayLike) -> np.ndarray:
    """Return a point.

    Parameters
    ----------
    owner : str
        Name of the observer and the point, for messages.
    coordinates : array_like, shape (2,)
        Map coordinates x, y [m].

    Returns
    -------
    ndarray, shape (2,)

    Raises
    ------
    InputError
        If it is not two finite numbers.
    """
    place = _coordinates(owner, coordinates)
    if place.shape != (2,):
        raise InputError(f"{owner}: a point needs map coordinates x, y [m], got {coordinates!r}")
    return place


def check_on_grid(owner: str, vertices: np.ndarray, grid: Any) -> None:
    """Refuse points of which none lies on the grid, or a line that does not touch the grid.

    Parameters
    ----------
    owner : str
        Name of the observer and the place, for messages.
    vertices : ndarray, shape (n, 2)
        Map coordinates [m].
    grid : RasterModelGrid
        Grid of the component.

    Raises
    ------
    InputError
        If the rectangle around the vertices has nothing in common with that of the nodes.
    """
    low = np.array(grid.xy_of_lower_left)
    high = low + np.array([grid.dx, grid.dy]) * (np.array(grid.shape[::-1]) - 1)
    if np.any(vertices.max(axis=0) < low) or np.any(vertices.min(axis=0) > high):
        x, y = vertices[0]
        raise InputError(
            f"{owner}: ({x:.10g}, {y:.10g}) m is outside the grid, which goes from ({low[0]:.10g}, {low[1]:.10g}) to "
            f"({high[0]:.10g}, {high[1]:.10g}) m; are the coordinates in the system of the terrain?"
        )


def _coordinates(owner, coordinates):
    try:
        values = np.array(coordinates, float)
    except (TypeError, ValueError) as error:
        raise InputError(f"{owner}: coordinates must be numbers [m], got {coordinates!r}") from error
    if not np.all(np.isfinite(values)):
        raise InputError(f"{owner}: coordinates must be finite numbers [m], got {coordinates!r}")
    return values
