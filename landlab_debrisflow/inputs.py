"""What is read from the grid, and refused: every refusal says where, got, allowed and what to do."""

from numbers import Real

import numpy as np

from .core.errors import InputError

NODATA = -9999.0
FIXED_GRADIENT, LOOPED, CLOSED = 2, 3, 4  # node statuses of Landlab


def check_duration(value, name: str = "dt") -> float:
    """Return a duration in seconds, or raise InputError."""
    if isinstance(value, bool) or not isinstance(value, Real):
        raise InputError(f"{name} must be a number of seconds >= 0, got {value!r}")
    if not 0.0 <= value < np.inf:
        raise InputError(f"{name} must be a finite number of seconds >= 0, got {value!r}")
    return float(value)


def check_boundaries(grid) -> None:
    """Refuse kinds of boundary that mean nothing for a flow of debris."""
    for status, word in ((FIXED_GRADIENT, "fixed-gradient"), (LOOPED, "looped")):
        nodes = np.flatnonzero(grid.status_at_node == status)
        if nodes.size:
            raise InputError(
                f"{nodes.size} {word} boundary nodes, the first is {_where(grid, nodes[0])}; "
                "use open (fixed-value) or closed boundaries"
            )


def check_terrain(grid, elevation, soil, ratio, drained=None) -> None:
    """Refuse values that cannot be computed with, at every node that is not closed."""
    used = grid.status_at_node != CLOSED
    nodata = np.flatnonzero(used & (elevation == NODATA))
    if nodata.size:
        raise InputError(
            f"topographic__elevation is NODATA ({NODATA:g}) at {nodata.size} nodes that are not closed, the first "
            f"is {_where(grid, nodata[0])}; close them: grid.set_nodata_nodes_to_closed("
            f"grid.at_node['topographic__elevation'], {NODATA:g})"
        )
    _check_finite(grid, "topographic__elevation", elevation, used, "close the node or mend the DEM")
    if soil is not None:
        _check_finite(grid, "soil__depth", soil, used, "close the node or set a depth >= 0")
        _check_range(grid, "soil__depth", soil, used, 0.0, np.inf, "m")
    _check_range(grid, "bed__excess_pore_pressure_ratio", ratio, used, 0.0, 1.0, "-")
    if drained is not None:
        bad = np.flatnonzero(used & (drained != 0.0) & (drained != 1.0))
        if bad.size:
            raise InputError(
                f"bed__drained must be 0 or 1, got {drained[bad[0]]:g} at {_where(grid, bad[0])}; "
                "set 1 where a drain holds the excess pore pressure at 0"
            )


def read_bed(grid, ratio: float):
    """Read and check what the flow runs over.

    Parameters
    ----------
    grid : RasterModelGrid
    ratio : float
        Excess pore pressure of the bed over its liquefaction value where no field says so [-].

    Returns
    -------
    elevation, soil : ndarray, shape (nodes,)
        The very fields [m]; `soil` is None if there is none.
    ratio : ndarray, shape (nodes,)
    drained : ndarray of bool, shape (nodes,), or None
    """
    fields = ("topographic__elevation", "soil__depth", "bed__excess_pore_pressure_ratio", "bed__drained")
    present = set(grid.at_node)  # its get() is a dict's and knows nothing of the fields
    elevation, soil, ratios, drained = (grid.at_node[name] if name in present else None for name in fields)
    ratios = np.full(grid.number_of_nodes, ratio) if ratios is None else np.array(ratios, float)
    check_terrain(grid, elevation, soil, ratios, drained)
    return elevation, soil, ratios, None if drained is None else drained > 0.0


def check_observers(observers) -> tuple:
    """Return the observers, or raise InputError if one cannot observe."""
    for observer in observers:
        if not (getattr(observer, "interval", 0.0) > 0.0 and callable(getattr(observer, "observe", None))):
            raise InputError(f"an observer needs interval > 0 [s] and observe(flow), got {observer!r}")
    return tuple(observers)


def read_release(grid, soil):
    """Return the thickness that is to fail, shape (nodes,) [m], from whichever field says so.

    Raises
    ------
    InputError
        If it is negative, not on core nodes, or deeper than the soil.
    """
    name = "debris_flow__release_depth"
    field = grid.at_node[name]
    check_release(grid, name, field, soil)
    depth = np.where((field > 0.0) & (grid.status_at_node != CLOSED), field, 0.0)
    if not depth.any() and soil is not None and "mass__wasting_id" in grid.at_node:
        depth = np.where(grid.at_node["mass__wasting_id"] > 0, soil, 0.0)
        check_release(grid, "soil__depth where mass__wasting_id > 0", depth, soil)
    return depth


def lower_ground(grid, release, soil) -> None:
    """Take what fails, shape (nodes,) [m], off elevation and soil; the fields that said so become 0 there."""
    elevation = grid.at_node["topographic__elevation"]
    elevation -= release  # in place: other components hold this very array
    if soil is not None:
        soil -= release
    grid.at_node["debris_flow__release_depth"][release > 0.0] = 0.0
    if "mass__wasting_id" in grid.at_node:
        grid.at_node["mass__wasting_id"][release > 0.0] = 0


def check_release(grid, name: str, depth, soil) -> None:
    """Refuse a release that is negative, not on core nodes, or deeper than the soil."""
    bad = np.flatnonzero(~np.isfinite(depth) & (grid.status_at_node != CLOSED))
    if bad.size:
        raise InputError(
            f"{name} must be finite, got {depth[bad[0]]} at {_where(grid, bad[0])}; set 0 where nothing fails"
        )
    bad = np.flatnonzero((depth < 0.0) & (grid.status_at_node != CLOSED))
    if bad.size:
        raise InputError(
            f"{name} must be >= 0 m, got {depth[bad[0]]:g} at {_where(grid, bad[0])}; give the thickness that fails as "
            "a positive number and 0 elsewhere"
        )
    bad = np.flatnonzero((depth > 0.0) & (grid.status_at_node != 0))
    if bad.size:
        raise InputError(
            f"{name} is {depth[bad[0]]:g} m on {_where(grid, bad[0])}, a boundary or closed node; "
            "release only on core nodes: set 0 there, or use a larger DEM"
        )
    if soil is not None:
        bad = np.flatnonzero(depth > soil)
        bad = bad[depth[bad] > 0.0]
        if bad.size:
            n = bad[0]
            raise InputError(
                f"{name} is deeper than soil__depth at {bad.size} nodes, the first is {_where(grid, n)}: "
                f"{depth[n]:g} m > {soil[n]:g} m; raise soil__depth there, or clip the release with np.minimum"
            )


def _check_finite(grid, name, values, used, remedy):
    bad = np.flatnonzero(used & ~np.isfinite(values))
    if bad.size:
        raise InputError(
            f"{name} must be finite at every node that is not closed, got {values[bad[0]]} at "
            f"{_where(grid, bad[0])}; {remedy}"
        )


def _check_range(grid, name, values, used, low, high, unit):
    bad = np.flatnonzero(used & ~((values >= low) & (values <= high)))
    if bad.size:
        raise InputError(
            f"{name} must lie in [{low:g}, {high:g}] {unit}, got {values[bad[0]]:g} at {_where(grid, bad[0])}"
        )


def _where(grid, node):
    row, column = divmod(int(node), grid.number_of_node_columns)
    return f"node {node} (row {row}, column {column})"
