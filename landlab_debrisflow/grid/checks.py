"""Refusals of a grid, its fields and of arguments: each says where, got, allowed and a remedy."""

import dataclasses
from numbers import Real

import numpy as np

from ..core.checks import in_range, require
from ..core.errors import InputError, ParameterError
from ..core.hints import did_you_mean, give_number, python_value
from ..core.values import NodeValues
from ..spatial.raster import CLOSED, FIXED_GRADIENT, LOOPED
from .fields import NODE_FIELDS
from .fill_values import LEAST_FILL, is_fill, replacement_remedy


def check_duration(value, name: str = "dt") -> float:
    """Return a duration in seconds, or raise InputError.

    `value` is a number >= 0 and finite [s]; `name` is that of the argument, for the message.
    """
    value = python_value(value)
    if isinstance(value, bool) or not isinstance(value, Real):
        raise InputError(f"{name} must be a number of seconds >= 0, got {value!r}{give_number(value)}")
    if not 0.0 <= value < np.inf:
        raise InputError(f"{name} must be a finite number of seconds >= 0, got {value!r}")
    return float(value)


def check_types(grid) -> None:
    """Refuse fields of another than the declared type or of several values per node.

    Depths added to integers would be rounded.
    """
    for field in NODE_FIELDS:
        if "in" in field.intent and field.name in grid.at_node:
            values, wanted = grid.at_node[field.name], np.dtype(field.dtype)
            if values.dtype != wanted:
                at = f"grid.at_node['{field.name}']"
                raise InputError(
                    f"{field.name} must have the dtype {wanted}, got {values.dtype}; convert it before anything else "
                    f"holds it: {at} = {at}.astype({field.dtype.__name__})"
                )
            if values.shape != (grid.number_of_nodes,):
                raise InputError(
                    f"{field.name} must have one value per node, the shape ({grid.number_of_nodes},), got "
                    f"{values.shape}; delete it with grid.delete_field('node', '{field.name}') and add one of them"
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


def check_bed(grid, soil, ratio, drained, saturation) -> None:
    """Refuse soil depths [m], pressure ratios [-], drains (0 or 1) and degrees of saturation [-] of a bed.

    Each is of shape (nodes,), or None.
    """
    if soil is not None:
        check_finite(grid, "soil__depth", soil, "close the node or set a depth >= 0")
        _check_range(grid, "soil__depth", soil, 0.0, np.inf, "m")
    if ratio is not None:
        _check_range(grid, "bed__excess_pore_pressure_ratio", ratio, 0.0, 1.0, "-")
    if saturation is not None:
        _check_range(grid, "bed__degree_of_saturation", saturation, 0.0, 1.0, "-")
    if drained is not None:
        bad = np.flatnonzero((drained != 0.0) & (drained != 1.0) & (grid.status_at_node != CLOSED))
        if bad.size:
            raise InputError(
                f"bed__drained must be 0 or 1, got {drained[bad[0]]:g} at {where(grid, bad[0])}; "
                "set 1 where a drain holds the excess pore pressure at 0"
            )


def check_loaded_bed(grid, ratio, pressure) -> None:
    """Refuse a ratio beside a pore pressure that follows the load of the bed, and pressures [Pa] out of range."""
    if ratio is not None:
        raise InputError(
            "bed__excess_pore_pressure_ratio is given, but with Material's bed_loading_coefficient > 0 the pressure of "
            "the bed follows from its load; delete the field, or set bed_loading_coefficient to 0"
        )
    _check_range(grid, "bed__excess_pore_pressure", pressure, 0.0, np.inf, "Pa")


def check_parameters(grid, laws) -> None:
    """Refuse parameters of `laws`, a mapping by kind, which vary in space but do not fit the nodes of this grid."""
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
            meta = field.metadata
            in_range(
                name, values, *meta["bounds"], meta["unit"], lambda bad: f" at {where(grid, bad[0])}", ignored=closed,
                error=ParameterError,
            )  # fmt: skip


def check_phases(setup) -> None:
    """Refuse materials in which the two phases of a flow law cannot be told apart."""
    material = setup.material
    if not setup.two_phases:
        return
    for name, allowed in (("water_density", "> 0"), ("porosity", "> 0"), ("water_table_ratio", "1")):
        value = getattr(material, name)
        if value == 0.0 or (name == "water_table_ratio" and value < 1.0):
            raise InputError(
                f"flow: two phases need a material whose {name} is {allowed}, got {value:g}; "
                "use flow='one_phase' for debris that is not saturated"
            )
    law = setup.flow
    derived = getattr(law, "drag", "") == "darcy" and law.hydraulic_conductivity is None
    if derived and (material.coefficient_of_consolidation == 0.0 or law.stiffness == 0.0):
        raise InputError(
            "flow: Darcy's drag follows from coefficient_of_consolidation and stiffness, of which one is 0; "
            "give hydraulic_conductivity [m s-1]"
        )


def check_observers(observers) -> tuple:
    """Return observers, given as one or several, as a tuple, or raise InputError if one cannot observe."""
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


def check_continued(earlier, grid, inflow) -> None:
    """Refuse to continue an earlier component that still moves, or one of another grid.

    Parameters
    ----------
    earlier : DebrisFlow
    grid : RasterModelGrid
        Grid of the component.
    inflow : Inflow
        Inflow of the component that is to continue: elapsed time goes on, and nothing may have entered before.

    Raises
    ------
    InputError
        If it cannot be continued; nothing was changed.
    """
    if earlier.grid is not grid:
        raise InputError("continues: the earlier DebrisFlow is on another grid; build the new one on earlier.grid")
    before = earlier._simulation
    if not before.inflow.over:
        raise InputError(
            f"continues: the inflow of the earlier DebrisFlow is not over, the next of it enters at "
            f"{before.inflow.next_time:.4g} s of its elapsed time; run it to its end first"
        )
    if before.particles.count:
        raise InputError(
            f"continues: the earlier DebrisFlow still carries {before.particles.volume.sum():.4g} m3 that have not "
            "settled; run_until_rest() and settle() it first"
        )
    if inflow.next_time < before.time:
        raise InputError(
            f"continues: the inflow begins at {inflow.next_time:.4g} s, but elapsed_time goes on from "
            f"{before.time:.4g} s; add that to its times"
        )


def check_finite(grid, name, values, remedy):
    """Refuse a field that is not finite at every node that is not closed.

    `name` is that of the field, `values` are its values, shape (nodes,), in any unit; `remedy` is the end of the
    message.
    """
    if np.isfinite(values).all():
        return
    good = np.isfinite(values) | (grid.status_at_node == CLOSED)
    place, allowed = _first_of_all(grid), "be finite at every node that is not closed"
    require(good, name, allowed, values, place, remedy, error=InputError)


def _check_range(grid, name, values, low, high, unit):
    most = min(high, LEAST_FILL) if unit == "m" else high
    if low <= values.min() and values.max() <= most:  # False for NaN
        return
    closed, fills = grid.status_at_node == CLOSED, (unit == "m") & is_fill(values)
    place = _first_of_all(grid, lambda node: replacement_remedy(name, values, values[node]))
    in_range(name, values, low, high, unit, place, ignored=closed, refused=fills, form="g", error=InputError)


def _first_of_all(grid, more=lambda node: ""):
    """Return a function that puts the first of some nodes, and how many they are, into words; `more` of the first.

    The function takes an array of int, the nodes; `more` takes one node and returns text.
    """
    return lambda bad: f" at {where(grid, bad[0])}, the first of {bad.size}{more(bad[0])}"


def where(grid, node) -> str:
    """Return a node in words."""
    row, column = divmod(int(node), grid.number_of_node_columns)
    return f"node {node} (row {row}, column {column})"
