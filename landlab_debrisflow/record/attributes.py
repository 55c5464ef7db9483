"""Attributes of files beside the numbers: names that CF allows, values that NetCDF can hold.

A quantity stands under its name, in letters, digits and underscores, and its unit, if it has one, under the name with
``_units`` behind it. Parameters that are not set (None) are left out.
"""

import dataclasses
from collections.abc import Iterator, Mapping
from datetime import UTC, datetime
from numbers import Integral, Real
from typing import Any

import numpy as np

from ..core.names import legal_name
from ..core.values import NodeValues
from ..core.version import __version__
from ..physics.registry import LAWS, law_name

OF_A_MOMENT = ("budget_", "elapsed_time", "date_created")
"""Beginnings of the names of attributes that belong to one moment of one run."""

CF_UNITS = {"-": "1", "deg": "degree"}
"""Names in files of units that have another name in the package."""

NO_FILL = {"_FillValue": None}
"""Encoding of coordinates: they have no fill value."""

LARGEST_INTEGER = 2**63 - 1
"""Largest integer that a file can hold."""


def file_attributes() -> dict[str, str]:
    """Return the attributes of every file: conventions, software and its version."""
    return {"Conventions": "CF-1.10", "source": f"landlab_debrisflow {__version__}", "version": __version__}


def date_created() -> dict[str, str]:
    """Return the present time: ISO 8601, UTC."""
    return {"date_created": datetime.now(UTC).strftime("%Y-%m-%dT%H:%M:%SZ")}


def moment_attributes(time: float, particles: Any, budget: Mapping[str, float] | tuple[()] = ()) -> dict[str, Any]:
    """Return elapsed time [s], number of particles so far and the terms of a budget [m3], if there is one."""
    attributes = quantity_attributes("elapsed_time", time, "s")
    attributes |= quantity_attributes("number_of_particles", particles.ever)
    for name, volume in dict(budget).items():
        attributes |= quantity_attributes(f"budget_{name}", volume, "m3")
    return attributes


def variable_attributes(unit: str, long_name: str) -> dict[str, str]:
    """Return the attributes of a variable: its `unit`, given as Landlab writes it, as CF does, and its `long_name`."""
    return {"units": CF_UNITS.get(unit, unit), "long_name": long_name}


def axis_attributes(axis: str) -> dict[str, str]:
    """Return the attributes of the map coordinates along an axis, "x" or "y"."""
    words = {"standard_name": f"projection_{axis}_coordinate", "axis": axis.upper()}
    return variable_attributes("m", axis) | words


def quantity_attributes(name: str, value: Any, unit: str = "-") -> dict[str, Any]:
    """Return the attributes of a quantity; an empty mapping for a value that is not set or cannot be written.

    `name` is made a legal name of an attribute; `unit` is as Landlab writes it, "-" for none.

    Examples
    --------
    >>> quantity_attributes("inflow_0_velocity", (4.0,), "m s-1")
    {'inflow_0_velocity': 4.0, 'inflow_0_velocity_units': 'm s-1'}
    >>> quantity_attributes("numerics_settle", True), quantity_attributes("friction_drag π", 2.5)
    ({'numerics_settle': 1}, {'friction_dragu20u3c0': 2.5})
    """
    name, value = legal_name(name), file_value(value)
    if value is None:
        return {}
    has_unit = unit != "-" and not isinstance(value, str)
    return {name: value} | ({f"{name}_units": CF_UNITS.get(unit, unit)} if has_unit else {})


def file_value(value: Any) -> str | int | float | tuple[float, ...] | None:
    """Return a value as number, text or tuple of numbers, which files give back equal; None for another type."""
    if isinstance(value, str):
        return str(value)
    if isinstance(value, NodeValues):
        return repr(value).strip("<>")
    if isinstance(value, Integral | np.bool_):  # files hold true and false as 1 and 0
        return int(value) if abs(int(value)) <= LARGEST_INTEGER else str(value)
    if isinstance(value, Real):
        return float(value)
    if isinstance(value, tuple | list) and value and all(isinstance(one, str) for one in value):
        return ", ".join(value)
    if isinstance(value, tuple | list) and value and all(isinstance(one, Real) for one in value):
        return file_value(value[0]) if len(value) == 1 else tuple(float(one) for one in value)
    return None


def parameters_of(obj: Any) -> Iterator[tuple[str, Any, Mapping[str, Any]]]:
    """Yield name, value and declaration (a mapping) of all parameters of an object.

    An object that declares none, a law from outside perhaps, has its public attributes.
    """
    if dataclasses.is_dataclass(obj):
        for field in dataclasses.fields(obj):
            value = getattr(obj, field.name, None)
            if dataclasses.is_dataclass(value):
                inner = parameters_of(value)
                yield from ((f"{field.name}_{name}", one, declaration) for name, one, declaration in inner)
            else:
                yield field.name, value, field.metadata
    else:
        public = {name: value for name, value in getattr(obj, "__dict__", {}).items() if not name.startswith("_")}
        yield from ((name, value, {}) for name, value in public.items())


def parameter_attributes(kind: str, obj: Any) -> dict[str, Any]:
    """Return the attributes of all parameters of `obj`, a law, material or numerics; `kind` begins their names."""
    attributes: dict[str, Any] = {}
    for name, value, declaration in parameters_of(obj):
        attributes |= quantity_attributes(f"{kind}_{name}", value, declaration.get("unit", "-"))
    return attributes


def law_attributes(setup: Any) -> dict[str, str]:
    """Return the class of every law under its kind, and its name, or its module if it has none."""
    attributes: dict[str, str] = {}
    for kind in LAWS:
        law = getattr(setup, kind)
        attributes |= {kind: type(law).__name__, f"{kind}_law": law_name(kind, law)}
    return attributes


def node_parameters(
    kind: str, obj: Any, fields: Mapping[str, np.ndarray], count: int
) -> Iterator[tuple[str, np.ndarray, dict[str, str]]]:
    """Yield name, values over `count` nodes and attributes of every parameter that is given at all of them.

    `kind` begins the names; `obj` is a law, the material or the numerics.

    `fields` are the fields of the grid at nodes, by name: a parameter may be given as such a name.
    """
    for name, value, declaration in parameters_of(obj):
        if isinstance(value, str) and declaration.get("varies") and value in fields:
            value = fields[value]
        if isinstance(value, NodeValues):
            value = value.values
        if isinstance(value, np.ndarray) and value.shape == (count,) and value.dtype.kind in "biuf":
            words = (
                variable_attributes(declaration["unit"], declaration["meaning"]) if declaration else {"long_name": name}
            )
            yield legal_name(f"{kind}_{name}"), value.astype(float), words
