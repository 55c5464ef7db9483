"""The ground that fails: read from the grid, checked, taken off elevation and soil."""

from typing import NamedTuple

import numpy as np

from ..core.errors import InputError
from ..spatial.raster import CLOSED
from .checks import where
from .fill_values import is_fill, replacement_remedy

RELEASE_DEPTH, MASS_WASTING_ID = "debris_flow__release_depth", "mass__wasting_id"
RELEASE_VELOCITY = ("debris_flow__release_velocity_x", "debris_flow__release_velocity_y")


class Release(NamedTuple):
    """Ground that is about to fail.

    Attributes
    ----------
    nodes : ndarray of int, shape (n,)
        Nodes that fail.
    depth : ndarray, shape (n,)
        Vertical thickness [m].
    volume : float
        Volume of all of them [m3].
    requests : tuple of ndarray, shape (nodes,)
        Fields that ask for the release; 0 once it has been taken.
    velocity : ndarray, shape (2, n), or None
        Velocity over the map along x and y with which it fails [m s-1]; None: the release starts from rest.
    """

    nodes: np.ndarray
    depth: np.ndarray
    volume: float
    requests: tuple
    velocity: np.ndarray | None = None


NO_RELEASE = Release(np.zeros(0, int), np.zeros(0), 0.0, ())


def read_release(grid, soil) -> Release:
    """Return the release that the fields of a grid ask for; nothing is changed.

    Parameters
    ----------
    grid : RasterModelGrid
        Grid of the component.
    soil : ndarray, shape (nodes,), or None
        Depth of the soil [m].

    Raises
    ------
    InputError
        If a thickness is negative, not on core nodes, or deeper than the soil, or if a velocity is not finite or where
        nothing fails.
    """
    at = grid.at_node
    nodes, depth = _nonzero(grid, np.asarray(at[RELEASE_DEPTH]))
    check_release(grid, RELEASE_DEPTH, nodes, depth, soil)
    if nodes.size == 0 and soil is not None and MASS_WASTING_ID in at:
        ids = np.asarray(at[MASS_WASTING_ID])
        nodes = np.flatnonzero((ids > 0) & (soil != 0.0))
        if (fills := nodes[is_fill(ids[nodes])]).size:
            raise InputError(
                f"{MASS_WASTING_ID} is {ids[fills[0]]} at {where(grid, fills[0])}, and the whole soil would fail there"
                f"{replacement_remedy(MASS_WASTING_ID, ids, ids[fills[0]])}"
            )
        depth = soil[nodes]
        check_release(grid, f"soil__depth where {MASS_WASTING_ID} > 0", nodes, depth, soil)
    requests = tuple(np.asarray(at[name]) for name in (RELEASE_DEPTH, MASS_WASTING_ID, *RELEASE_VELOCITY) if name in at)
    return Release(nodes, depth, float(depth.sum() * grid.dx * grid.dy), requests, read_velocity(grid, nodes))


def read_velocity(grid, nodes):
    """Return the velocity over the map with which some nodes fail, shape (2, n) [m s-1]; None if all fail at rest.

    Parameters
    ----------
    grid : RasterModelGrid
        Grid of the component; of both fields one may be missing, which is then 0.
    nodes : ndarray of int, shape (n,)
        Nodes that fail, sorted.

    Raises
    ------
    InputError
        If a velocity is not finite, or given where nothing fails.
    """
    velocity = np.zeros((2, nodes.size))
    for component, name in zip(velocity, RELEASE_VELOCITY, strict=True):
        if name not in grid.at_node:
            continue
        values = np.asarray(grid.at_node[name])
        moving = np.flatnonzero(values)
        moving = moving[grid.status_at_node[moving] != CLOSED]
        if (bad := moving[~np.isfinite(values[moving]) | is_fill(values[moving])]).size:
            raise InputError(
                f"{name} must be finite, in m/s, got {values[bad[0]]:g} at {where(grid, bad[0])}; set 0 where "
                f"nothing fails, or fails at rest{replacement_remedy(name, values, values[bad[0]])}"
            )
        if (alone := np.setdiff1d(moving, nodes, assume_unique=True)).size:
            raise InputError(
                f"{name} is {values[alone[0]]:g} m/s at {where(grid, alone[0])}, the first of {alone.size} nodes where "
                f"nothing fails; set it to 0 where {RELEASE_DEPTH} is 0"
            )
        component[:] = values[nodes]
    return velocity if velocity.any() else None


def take_off(release: Release, elevation, soil) -> None:
    """Take a release off elevation and soil [m] and set the fields that demanded it to 0 there, in place.

    Parameters
    ----------
    release : Release
    elevation, soil : ndarray, shape (nodes,)
        Changed; the soil may be None.
    """
    elevation[release.nodes] -= release.depth
    if soil is not None:
        soil[release.nodes] -= release.depth
    for request in release.requests:
        request[release.nodes] = 0


def check_release(grid, name: str, nodes, depth, soil) -> None:
    """Refuse a release that is negative, not on core nodes, or deeper than the soil.

    `name` is that of the field, for the message; `nodes`, int, and `depth` [m] have shape (n,); `soil` is the erodible
    depth [m], shape (nodes,), or None.
    """

    def first(bad):
        return (depth[bad][0], nodes[bad][0]) if bad.any() else None

    if found := first(~np.isfinite(depth)):
        raise InputError(f"{name} must be finite, got {found[0]} at {where(grid, found[1])}; set 0 where nothing fails")
    if found := first((depth < 0.0) | is_fill(depth)):
        allowed = ">= 0 m" if found[0] < 0.0 else "a thickness"
        raise InputError(
            f"{name} must be {allowed}, got {found[0]:g} at {where(grid, found[1])}; give the thickness that fails as "
            f"a positive number and 0 elsewhere{replacement_remedy(name, depth, found[0])}"
        )
    if found := first(grid.status_at_node[nodes] != 0):
        raise InputError(
            f"{name} is {found[0]:g} m on {where(grid, found[1])}, a boundary or closed node; "
            "release only on core nodes: set 0 there, or use a larger DEM"
        )
    if soil is not None and (found := first(depth > soil[nodes])):
        raise InputError(
            f"{name} is deeper than soil__depth at {np.count_nonzero(depth > soil[nodes])} nodes, the first is "
            f"{where(grid, found[1])}: {found[0]:g} m > {soil[found[1]]:g} m; raise soil__depth there, or clip the "
            "release with np.minimum"
        )


def _nonzero(grid, field):
    """Return the nodes where a field is not 0 (NaN is not), on closed ones a thickness, and its values there."""
    nodes = np.flatnonzero(field)
    nodes = nodes[(grid.status_at_node[nodes] != CLOSED) | ((field[nodes] > 0.0) & ~is_fill(field[nodes]))]
    return nodes, field[nodes]
