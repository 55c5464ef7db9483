"""What is read from the grid, and refused: every refusal says where, got, allowed and what to do."""

import dataclasses
from numbers import Real

import numpy as np

from .core.errors import InputError
from .core.parameters import NodeValues, check_values

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


def check_elevation(grid, elevation) -> None:
    """Refuse elevations that cannot be computed with, at every node that is not closed."""
    used = grid.status_at_node != CLOSED
    nodata = np.flatnonzero(used & (elevation == NODATA))
    if nodata.size:
        raise InputError(
            f"topographic__elevation is NODATA ({NODATA:g}) at {nodata.size} nodes that are not closed, the first "
            f"is {_where(grid, nodata[0])}; close them: grid.set_nodata_nodes_to_closed("
            f"grid.at_node['topographic__elevation'], {NODATA:g})"
        )
    _check_finite(grid, "topographic__elevation", elevation, "close the node or mend the DEM")


def check_bed(grid, soil, ratio, drained) -> None:
    """Refuse likewise what the bed is made of; each is an array over nodes or None."""
    if soil is not None:
        _check_finite(grid, "soil__depth", soil, "close the node or set a depth >= 0")
        _check_range(grid, "soil__depth", soil, 0.0, np.inf, "m")
    if ratio is not None:
        _check_range(grid, "bed__excess_pore_pressure_ratio", ratio, 0.0, 1.0, "-")
    if drained is not None:
        bad = np.flatnonzero((drained != 0.0) & (drained != 1.0) & (grid.status_at_node != CLOSED))
        if bad.size:
            raise InputError(
                f"bed__drained must be 0 or 1, got {drained[bad[0]]:g} at {_where(grid, bad[0])}; "
                "set 1 where a drain holds the excess pore pressure at 0"
            )


def check_loaded_bed(grid, ratio, pressure) -> None:
    """Refuse likewise a bed whose pore pressure follows its load: its ratio, if given too, and its pressure [Pa]."""
    if ratio is not None:
        raise InputError(
            "bed__excess_pore_pressure_ratio is given, but with Material's bed_loading_coefficient > 0 the pressure of "
            "the bed follows from its load; delete the field, or set bed_loading_coefficient to 0"
        )
    _check_range(grid, "bed__excess_pore_pressure", pressure, 0.0, np.inf, "Pa")


def check_parameters(grid, laws) -> None:
    """Refuse parameters of laws, by kind, that vary in space but not over the nodes of this grid."""
    for kind, law in laws.items():
        for field in dataclasses.fields(law) if dataclasses.is_dataclass(law) else ():
            value, name = getattr(law, field.name), f"{kind}: {field.name}"
            if isinstance(value, NodeValues) and value.values.size != grid.number_of_nodes:
                raise InputError(
                    f"{name} has {value.values.size} values, the grid {grid.number_of_nodes} nodes; give one per node"
                )
            if not isinstance(value, str) or not field.metadata.get("varies"):
                continue
            if value not in grid.at_node:
                raise InputError(
                    f"{name} is to be read from the field {value!r}, which the grid does not have at its nodes; "
                    f"it has {', '.join(sorted(grid.at_node)) or 'none'}"
                )
            values = np.where(grid.status_at_node == CLOSED, field.metadata["bounds"][0], grid.at_node[value])
            check_values(f"{name}, from field {value!r},", values, field.metadata, lambda k: f"at {_where(grid, k)}")


def check_phases(physics) -> None:
    """Refuse materials in which the two phases of a flow law cannot be told apart."""
    material = physics.material
    if not physics.two_phases:
        return
    for name, allowed in (("water_density", "> 0"), ("porosity", "> 0"), ("water_table_ratio", "1")):
        value = getattr(material, name)
        if value == 0.0 or (name == "water_table_ratio" and value < 1.0):
            raise InputError(
                f"flow: two phases need a material whose {name} is {allowed}, got {value:g}; "
                "use flow='one_phase' for debris that is not saturated"
            )
    law = physics.flow
    derived = getattr(law, "drag", "") == "darcy" and law.hydraulic_conductivity is None
    if derived and (material.coefficient_of_consolidation == 0.0 or law.stiffness == 0.0):
        raise InputError(
            "flow: Darcy's drag follows from coefficient_of_consolidation and stiffness, of which one is 0; "
            "give hydraulic_conductivity [m s-1]"
        )


def check_observers(observers) -> tuple:
    """Return the observers, or raise InputError if one cannot observe."""
    for observer in observers:
        if not (getattr(observer, "interval", 0.0) > 0.0 and callable(getattr(observer, "observe", None))):
            raise InputError(f"an observer needs interval > 0 [s] and observe(flow), got {observer!r}")
    return tuple(observers)


def read_release(grid, soil):
    """Return the nodes that are to fail and the thickness there [m], from whichever field says so.

    Raises
    ------
    InputError
        If a thickness is negative, not on core nodes, or deeper than the soil.
    """
    name = "debris_flow__release_depth"
    nodes, depth = _nonzero(grid, grid.at_node[name])
    check_release(grid, name, nodes, depth, soil)
    if nodes.size == 0 and soil is not None and "mass__wasting_id" in grid.at_node:
        nodes = np.flatnonzero((grid.at_node["mass__wasting_id"] > 0) & (soil != 0.0))
        depth = soil[nodes]
        check_release(grid, "soil__depth where mass__wasting_id > 0", nodes, depth, soil)
    return nodes, depth


def _nonzero(grid, field):
    """Return the nodes where a field is not 0 (NaN is not), on closed ones > 0, and its values there."""
    nodes = np.flatnonzero(field)
    nodes = nodes[(grid.status_at_node[nodes] != CLOSED) | (field[nodes] > 0.0)]
    return nodes, field[nodes]


def lower_ground(grid, nodes, depth, soil) -> None:
    """Take what fails off elevation and soil; the fields that said so become 0 there."""
    grid.at_node["topographic__elevation"][nodes] -= depth  # in place: other components hold this very array
    if soil is not None:
        soil[nodes] -= depth
    grid.at_node["debris_flow__release_depth"][nodes] = 0.0
    if "mass__wasting_id" in grid.at_node:
        grid.at_node["mass__wasting_id"][nodes] = 0


def check_release(grid, name: str, nodes, depth, soil) -> None:
    """Refuse a release that is negative, not on core nodes, or deeper than the soil."""

    def first(bad):
        return (depth[bad][0], nodes[bad][0]) if bad.any() else None

    if found := first(~np.isfinite(depth)):
        raise InputError(
            f"{name} must be finite, got {found[0]} at {_where(grid, found[1])}; set 0 where nothing fails"
        )
    if found := first(depth < 0.0):
        raise InputError(
            f"{name} must be >= 0 m, got {found[0]:g} at {_where(grid, found[1])}; give the thickness that fails as "
            "a positive number and 0 elsewhere"
        )
    if found := first(grid.status_at_node[nodes] != 0):
        raise InputError(
            f"{name} is {found[0]:g} m on {_where(grid, found[1])}, a boundary or closed node; "
            "release only on core nodes: set 0 there, or use a larger DEM"
        )
    if soil is not None and (found := first(depth > soil[nodes])):
        raise InputError(
            f"{name} is deeper than soil__depth at {np.count_nonzero(depth > soil[nodes])} nodes, the first is "
            f"{_where(grid, found[1])}: {found[0]:g} m > {soil[found[1]]:g} m; raise soil__depth there, or clip the "
            "release with np.minimum"
        )


def _check_finite(grid, name, values, remedy):
    if np.isfinite(values).all():
        return
    bad = np.flatnonzero(~np.isfinite(values) & (grid.status_at_node != CLOSED))
    if bad.size:
        raise InputError(
            f"{name} must be finite at every node that is not closed, got {values[bad[0]]} at "
            f"{_where(grid, bad[0])}; {remedy}"
        )


def _check_range(grid, name, values, low, high, unit):
    if low <= values.min() and values.max() <= high:  # False for NaN
        return
    bad = np.flatnonzero(~((values >= low) & (values <= high)) & (grid.status_at_node != CLOSED))
    if bad.size:
        raise InputError(
            f"{name} must lie in [{low:g}, {high:g}] {unit}, got {values[bad[0]]:g} at {_where(grid, bad[0])}"
        )


def _where(grid, node):
    row, column = divmod(int(node), grid.number_of_node_columns)
    return f"node {node} (row {row}, column {column})"
