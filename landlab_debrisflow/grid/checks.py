"""What is read from the grid, and refused: every refusal says where, got, allowed and what to do."""

import dataclasses
from contextlib import contextmanager
from numbers import Real

import numpy as np

from ..core.errors import InputError
from ..core.hints import did_you_mean, give_number, plain
from ..core.parameters import NodeValues, check_values
from .fields import NODE_FIELDS
from .fills import LEAST_FILL, is_fill, replace_them

FIXED_GRADIENT, LOOPED, CLOSED = 2, 3, 4  # node statuses of Landlab


def check_duration(value, name: str = "dt") -> float:
    """Return a duration in seconds, or raise InputError."""
    value = plain(value)
    if isinstance(value, bool) or not isinstance(value, Real):
        raise InputError(f"{name} must be a number of seconds >= 0, got {value!r}{give_number(value)}")
    if not 0.0 <= value < np.inf:
        raise InputError(f"{name} must be a finite number of seconds >= 0, got {value!r}")
    return float(value)


@contextmanager
def no_new_fields(grid):
    """Take the fields that were added to a grid away again if anything is refused inside."""
    before = set(grid.at_node)
    try:
        yield
    except BaseException:
        for name in set(grid.at_node) - before:
            grid.delete_field("node", name)
        raise


def check_types(grid) -> None:
    """Refuse fields whose numbers are not of the declared type: what is added to them would be lost or rounded."""
    for field in NODE_FIELDS:
        if "in" in field.intent and field.name in grid.at_node:
            values, wanted = grid.at_node[field.name], np.dtype(field.dtype)
            if values.dtype != wanted:
                at = f"grid.at_node['{field.name}']"
                raise InputError(
                    f"{field.name} must have the dtype {wanted}, got {values.dtype}; convert it before anything else "
                    f"holds it: {at} = {at}.astype({field.dtype.__name__})"
                )


def check_boundaries(grid) -> None:
    """Refuse kinds of boundary that mean nothing for a flow of debris."""
    for status, word in ((FIXED_GRADIENT, "fixed-gradient"), (LOOPED, "looped")):
        nodes = np.flatnonzero(grid.status_at_node == status)
        if nodes.size:
            raise InputError(
                f"{nodes.size} {word} boundary nodes, the first is {where(grid, nodes[0])}; "
                "use open (fixed-value) or closed boundaries"
            )


def check_bed(grid, soil, ratio, drained) -> None:
    """Refuse likewise what the bed is made of; each is an array over nodes or None."""
    if soil is not None:
        check_finite(grid, "soil__depth", soil, "close the node or set a depth >= 0")
        _check_range(grid, "soil__depth", soil, 0.0, np.inf, "m")
    if ratio is not None:
        _check_range(grid, "bed__excess_pore_pressure_ratio", ratio, 0.0, 1.0, "-")
    if drained is not None:
        bad = np.flatnonzero((drained != 0.0) & (drained != 1.0) & (grid.status_at_node != CLOSED))
        if bad.size:
            raise InputError(
                f"bed__drained must be 0 or 1, got {drained[bad[0]]:g} at {where(grid, bad[0])}; "
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
    closed = grid.status_at_node == CLOSED
    for kind, law in laws.items():
        for field in dataclasses.fields(law) if dataclasses.is_dataclass(law) else ():
            value, name = getattr(law, field.name), f"{kind}: {field.name}"
            if isinstance(value, NodeValues):
                values = value.values
                if values.size != grid.number_of_nodes:
                    raise InputError(
                        f"{name} has {values.size} values, the grid {grid.number_of_nodes} nodes; give one per node"
                    )
            elif isinstance(value, str) and field.metadata.get("varies"):
                if value not in grid.at_node:
                    raise InputError(
                        f"{name} is to be read from the field {value!r}, which the grid does not have at its nodes"
                        f"{did_you_mean(value, grid.at_node)}; it has {', '.join(sorted(grid.at_node)) or 'none'}"
                    )
                values, name = grid.at_node[value], f"{name}, from field {value!r},"
            else:
                continue
            check_values(name, values, field.metadata, closed, lambda k: f"at {where(grid, k)}")


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
    """Return the observers, of which one may come by itself, or raise InputError if one cannot observe."""
    if callable(getattr(observers, "observe", None)) or not hasattr(observers, "__iter__"):
        observers = (observers,)
    observers = tuple(observers)
    for observer in observers:
        interval = getattr(observer, "interval", 0.0)
        if isinstance(observer, type) or not callable(getattr(observer, "observe", None)):
            hint = f"; give {observer.__name__}(...), not the class" if isinstance(observer, type) else ""
            raise InputError(f"an observer needs interval > 0 [s] and observe(flow), got {observer!r}{hint}")
        if not (isinstance(interval, Real) and interval > 0.0):
            raise InputError(f"an observer needs interval > 0 [s] and observe(flow), got {interval!r} of {observer!r}")
    return observers


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
        ids = grid.at_node["mass__wasting_id"]
        nodes = np.flatnonzero((ids > 0) & (soil != 0.0))
        if (fills := nodes[is_fill(ids[nodes])]).size:
            raise InputError(
                f"mass__wasting_id is {ids[fills[0]]} at {where(grid, fills[0])}, and the whole soil would fail there"
                f"{replace_them('mass__wasting_id', ids, ids[fills[0]])}"
            )
        depth = soil[nodes]
        check_release(grid, "soil__depth where mass__wasting_id > 0", nodes, depth, soil)
    return nodes, depth


def _nonzero(grid, field):
    """Return the nodes where a field is not 0 (NaN is not), on closed ones a thickness, and its values there."""
    nodes = np.flatnonzero(field)
    nodes = nodes[(grid.status_at_node[nodes] != CLOSED) | ((field[nodes] > 0.0) & ~is_fill(field[nodes]))]
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
        raise InputError(f"{name} must be finite, got {found[0]} at {where(grid, found[1])}; set 0 where nothing fails")
    if found := first((depth < 0.0) | is_fill(depth)):
        allowed = ">= 0 m" if found[0] < 0.0 else "a thickness"
        raise InputError(
            f"{name} must be {allowed}, got {found[0]:g} at {where(grid, found[1])}; give the thickness that fails as "
            f"a positive number and 0 elsewhere{replace_them(name, depth, found[0])}"
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


def check_finite(grid, name, values, remedy):
    """Refuse a field that is not finite at every node that is not closed."""
    if np.isfinite(values).all():
        return
    bad = np.flatnonzero(~np.isfinite(values) & (grid.status_at_node != CLOSED))
    if bad.size:
        raise InputError(
            f"{name} must be finite at every node that is not closed, got {values[bad[0]]} at "
            f"{where(grid, bad[0])}, the first of {bad.size}; {remedy}"
        )


def _check_range(grid, name, values, low, high, unit):
    most = min(high, LEAST_FILL) if unit == "m" else high
    if low <= values.min() and values.max() <= most:  # False for NaN
        return
    good = (values >= low) & (values <= high) & ~((unit == "m") & is_fill(values))
    bad = np.flatnonzero(~good & (grid.status_at_node != CLOSED))
    if bad.size:
        value = values[bad[0]]
        raise InputError(
            f"{name} must lie in [{low:g}, {high:g}] {unit}, got {value:g} at {where(grid, bad[0])}, the first of "
            f"{bad.size}{replace_them(name, values, value)}"
        )


def where(grid, node) -> str:
    """Return a node in words."""
    row, column = divmod(int(node), grid.number_of_node_columns)
    return f"node {node} (row {row}, column {column})"
