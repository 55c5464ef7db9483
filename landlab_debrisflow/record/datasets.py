"""The state as xarray Datasets with units, after the CF conventions."""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr

from ..grid.fields import NODE_FIELDS
from ..physics.agreement import CONSOLIDATION
from ..physics.column.diagnostics import consolidation_time, erosion_time
from ..spatial.raster import CLOSED
from .attributes import (  # fmt: skip
    NO_FILL,
    OF_A_MOMENT,
    axis_attributes,
    date_created,
    file_attributes,
    law_attributes,
    moment_attributes,
    node_parameters,
    parameter_attributes,
    variable_attributes,
)

ON_WALLS = ("debris_flow__max_impact_pressure", "debris_flow__max_run_up")
"""Maps with values at closed nodes, too: peaks of the flow against their faces, 0 without any."""

FIELDS = {field.name: field for field in NODE_FIELDS}


def particles_dataset(particles: Any, lower_left: Sequence[float], setup: Any, time: float) -> xr.Dataset:
    """Return the particles over ``particle``; x and y are map coordinates of the grid [m].

    `particles` are those of a simulation; `lower_left` is x, y of the first node [m]; `setup` and `time` [s] are for
    the attributes.
    """
    data, order = {}, np.argsort(particles.identity)
    for variable in particles.variables:
        if not variable.written or variable.per_level:
            continue
        values, attributes = getattr(particles, variable.name), variable_attributes(variable.unit, variable.long_name)
        if variable.components:
            for axis, part in zip("xyz", values, strict=True):
                words = f"{variable.long_name}, {axis} component"
                data[f"{variable.name}_{axis}"] = ("particle", part[order], variable_attributes(variable.unit, words))
        else:
            data[variable.name] = ("particle", values[order], attributes)
    data["x"] = ("particle", particles.x[order] + lower_left[0], variable_attributes("m", "map coordinate of the grid"))
    data["y"] = ("particle", particles.y[order] + lower_left[1], variable_attributes("m", "map coordinate of the grid"))
    # without a date, so that equal particles make identical Datasets
    attributes = file_attributes() | moment_attributes(time, particles) | law_attributes(setup)
    return xr.Dataset(data, {"particle": _numbers(particles.identity[order])}, attributes)


def columns_dataset(
    profile: np.ndarray, particles: Any, coefficient_of_consolidation: np.ndarray, setup: Any, time: float
) -> xr.Dataset:
    """Return the columns over ``particle`` and ``level``; `profile` has shape (n, levels) [Pa], c_v (n,) or (1,).

    `particles` are those of a simulation; c_v is in m2 s-1; `setup` and `time` [s] are for the attributes.
    """
    levels = profile.shape[1]
    order = np.argsort(particles.identity)
    p, grown = particles, particles.volume / particles.released_volume
    data = {
        "thickness": (p.thickness, "m", "slope-normal thickness"),
        "consolidation_time": (
            consolidation_time(p.thickness, coefficient_of_consolidation), "s",
            "thickness squared over coefficient of consolidation",
        ),
        "erosion_time": (erosion_time(p.depth, p.entrainment_rate), "s", "thickness over erosion rate"),
        "basal_peclet_number": (
            p.basal_peclet_number, "-", "consolidation time over erosion time, of the last erosion",
        ),
        "initial_peclet_number": (p.basal_peclet_number / grown, "-", "the same with the thickness before any erosion"),
        "front_height": (1.0 - 1.0 / grown, "-", "height over thickness of the front between released and eroded soil"),
        "front_age": (time - p.first_erosion_time, "s", "time since the first erosion, NaN if there was none"),
        "clipped_pressure": (p.column_clipped, "Pa m", "pressure above liquefaction taken off, times thickness"),
    }  # fmt: skip
    words = variable_attributes("-", "height above the base over thickness, 0 at the base, 1 at the surface")
    level = xr.Variable("level", np.linspace(0.0, 1.0, levels), words, NO_FILL)
    words = variable_attributes("Pa", "excess pore pressure")
    at_levels = {"excess_pore_pressure": (("particle", "level"), profile[order], words)}
    if hasattr(p, "solid_fraction"):
        words = variable_attributes("-", "volume fraction of the grains")
        at_levels["solid_fraction"] = (("particle", "level"), p.solid_fraction[order], words)
    return xr.Dataset(
        at_levels
        | {
            name: ("particle", values[order], variable_attributes(unit, text))
            for name, (values, unit, text) in data.items()
        },
        {"particle": _numbers(p.identity[order]), "level": level},
        file_attributes() | moment_attributes(time, particles) | law_attributes(setup),
    )


def _numbers(identity):
    return xr.Variable("particle", identity, variable_attributes("-", "number of the particle, in order of release"))


def maps_dataset(grid: Any, shown: Mapping[str, np.ndarray], setup: Any, moment: Mapping[str, Any]) -> xr.Dataset:
    """Return the output fields over ``y`` and ``x``, NaN at closed nodes, with all parameters.

    Parameters
    ----------
    grid : RasterModelGrid
        Grid of the component.
    shown : mapping of str to ndarray, shape (nodes,)
        By the names of fields.
    setup : Setup
        A parameter that varies in space becomes a map with the name that its attribute would have. A parameter given at
        all nodes is also kept as it was given, under a name with two underscores that `Setup.from_dataset` reads.
    moment : mapping
        Attributes: see `attributes.moment_attributes`.

    Returns
    -------
    xarray.Dataset
    """
    closed = np.asarray(grid.status_at_node) == CLOSED
    data, encoding = {}, {"_FillValue": np.nan}
    for name, values in shown.items():
        field, missing = FIELDS[name], closed
        if field.intent == "out":  # the budget counts debris left there before the nodes were closed, too
            missing = closed & (values == field.start) & (name not in ON_WALLS)
        values = np.where(missing, np.nan, values).reshape(grid.shape)
        data[name] = (("y", "x"), values, variable_attributes(field.unit, field.doc), encoding)
    attributes: dict[str, Any] = {}
    for kind in ("flow", "friction", "erosion", "column", "material"):
        law = getattr(setup, kind)
        attributes |= parameter_attributes(kind, law)
        for name, values, words in node_parameters(kind, law, grid.at_node, closed.size):
            data[name] = (("y", "x"), np.where(closed, np.nan, values).reshape(grid.shape), words, encoding)
    if setup.has_dilatancy:
        attributes = {name: value for name, value in attributes.items() if CONSOLIDATION not in name}
    for name, array in setup.node_arrays().items():
        words = variable_attributes(array.unit, f"{array.meaning}, as given, also at closed nodes")
        data[name] = (("y", "x"), array.values.reshape(grid.shape), words, encoding)
    attributes |= parameter_attributes("numerics", setup.numerics)
    for k, hydrograph in enumerate(setup.inflow):
        attributes |= parameter_attributes(f"inflow_{k}", hydrograph)
    attributes |= setup.to_attributes() | law_attributes(setup)
    return xr.Dataset(data, _axes(grid), file_attributes() | date_created() | dict(moment) | attributes)


def _axes(grid):
    """Return the map coordinates of columns and rows."""
    axes = {}
    spacings = grid.dx, grid.dy
    for axis, first, spacing, count in zip("xy", grid.xy_of_lower_left, spacings, grid.shape[::-1], strict=True):
        axes[axis] = xr.Variable(axis, first + spacing * np.arange(count), axis_attributes(axis), NO_FILL)
    return axes


def stack(maps: Sequence[xr.Dataset], dimension: str, labels: Iterable[Any], **words: str) -> xr.Dataset:
    """Stack maps of several moments or runs side by side along a new dimension.

    A parameter over nodes that is equal in all maps is kept once, without the new dimension. Attributes are kept if
    they are equal in all maps and hold at more than one moment. A variable that some maps lack is NaN there.

    Parameters
    ----------
    maps : sequence of xarray.Dataset
        All of one grid.
    dimension : str
        Name of the new dimension.
    labels : array_like, shape (len(maps),)
        Its coordinate.
    **words
        Attributes of the coordinate.

    Returns
    -------
    xarray.Dataset
    """
    along = xr.DataArray(list(labels), dims=dimension, name=dimension, attrs=words)
    first, names = maps[0], dict.fromkeys(name for one in maps for name in one)
    once = [
        name for name in names
        if name not in FIELDS and all(name in one and one[name].identical(first[name]) for one in maps)
    ]  # fmt: skip
    joined = xr.concat(
        [one.drop_vars(once) for one in maps], along,
        data_vars="all", combine_attrs="drop_conflicts", join="exact", coords="minimal", compat="equals",
    ).assign({name: first[name] for name in once})  # fmt: skip
    shared = [name for name in joined.attrs if all(name in one.attrs for one in maps)]
    kept = [name for name in shared if name.removesuffix("_units") in shared and not name.startswith(OF_A_MOMENT)]
    joined.attrs = {name: joined.attrs[name] for name in kept} | date_created()
    for axis in joined.coords.values():
        axis.encoding |= NO_FILL
    return joined
