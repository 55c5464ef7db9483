"""The state as xarray Datasets with units, after the CF conventions."""

import numpy as np
import xarray as xr

from ..core.parameters import describe
from ..core.variables import NODE_FIELDS, OUTPUT_PREFIX, PARTICLE_VARIABLES
from ..physics.column.peclet import consolidation_time, erosion_time


def particles_dataset(particles, lower_left, time: float) -> xr.Dataset:
    """Return the particles over ``particle``; x and y are map coordinates of the grid [m]."""
    data, order = {}, np.argsort(particles.identity)
    for variable in PARTICLE_VARIABLES:
        if not variable.written or variable.per_level:
            continue
        values, attributes = getattr(particles, variable.name), _attributes(variable.unit, variable.long_name)
        if variable.vector:
            for axis, part in zip("xyz", values, strict=True):
                words = f"{variable.long_name}, {axis} component"
                data[f"{variable.name}_{axis}"] = ("particle", part[order], _attributes(variable.unit, words))
        else:
            data[variable.name] = ("particle", values[order], attributes)
    data["x"] = ("particle", particles.x[order] + lower_left[0], _attributes("m", "map coordinate of the grid"))
    data["y"] = ("particle", particles.y[order] + lower_left[1], _attributes("m", "map coordinate of the grid"))
    return xr.Dataset(data, {"particle": particles.identity[order]}, {"elapsed_time [s]": time})


def columns_dataset(profile, particles, coefficient_of_consolidation, time: float) -> xr.Dataset:
    """Return the columns over ``particle`` and ``level``; `profile` has shape (n, levels) [Pa], c_v (n,) or (1,)."""
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
        "clipped_pressure": (p.column_clipped, "Pa m", "pressure taken off by the bounds times thickness"),
    }  # fmt: skip
    level = xr.DataArray(
        np.linspace(0.0, 1.0, levels), dims="level",
        attrs=_attributes("-", "height above the base over thickness, 0 at the base, 1 at the surface"),
    )  # fmt: skip
    words = _attributes("Pa", "excess pore pressure")
    return xr.Dataset(
        {"excess_pore_pressure": (("particle", "level"), profile[order], words)}
        | {name: ("particle", values[order], _attributes(unit, text)) for name, (values, unit, text) in data.items()},
        {"particle": p.identity[order], "level": level},
        {"elapsed_time [s]": time},
    )


def maps_dataset(grid, physics, numerics, budget, time: float, hydrographs=()) -> xr.Dataset:
    """Return elevation, soil and all fields of the flow over ``y`` and ``x``, with all parameters."""
    data = {}
    for field in NODE_FIELDS:
        shown = field.name.startswith(OUTPUT_PREFIX) or field.name in ("topographic__elevation", "soil__depth")
        if shown and field.name in grid.at_node:
            values = grid.at_node[field.name].reshape(grid.shape).copy()
            data[field.name] = (("y", "x"), values, _attributes(field.unit, field.doc))
    west, south = grid.xy_of_lower_left
    x = west + grid.dx * np.arange(grid.number_of_node_columns)
    y = south + grid.dy * np.arange(grid.number_of_node_rows)
    coordinates = {
        "x": ("x", x, {"units": "m", "long_name": "x", "axis": "X"}),
        "y": ("y", y, {"units": "m", "long_name": "y", "axis": "Y"}),
    }
    attributes = {"Conventions": "CF-1.10", "source": "landlab_debrisflow", "elapsed_time [s]": time}
    attributes |= {f"budget {name} [m3]": value for name, value in budget.items()}
    for kind in ("flow", "friction", "erosion", "column", "material"):
        law = getattr(physics, kind)
        attributes[kind] = type(law).__name__
        attributes |= {f"{kind} {key}": _plain(value) for key, value in describe(law).items()}
    attributes |= {f"numerics {key}": _plain(value) for key, value in describe(numerics).items()}
    for k, hydrograph in enumerate(hydrographs):
        attributes |= {f"inflow {k} {key}": value for key, value in describe(hydrograph).items()}
    return xr.Dataset(data, coordinates, attributes)


def _attributes(unit: str, long_name: str) -> dict[str, str]:
    return {"units": "1" if unit == "-" else unit, "long_name": long_name}


def _plain(value):
    return int(value) if isinstance(value, bool) else value  # netCDF has no booleans
