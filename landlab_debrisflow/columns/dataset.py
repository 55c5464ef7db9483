"""Solved columns as a Dataset, with units."""

import dataclasses
from numbers import Real
from typing import Any

import numpy as np
import xarray as xr

from ..physics.column.diagnostics import basal_peclet_number
from ..record.attributes import NO_FILL, file_attributes, quantity_attributes, variable_attributes
from .arguments import Inputs
from .declarations import NUMBERS, SINGLE_NUMBERS

VARIABLES = {
    "excess_pore_pressure": ("Pa", "excess pore pressure"),
    "thickness": ("m", "slope-normal thickness"),
    "basal_excess_pore_pressure": ("Pa", "excess pore pressure at the base, for friction"),
    "basal_peclet_number": ("-", "erosion rate times thickness over coefficient of consolidation"),
    "front_height": ("-", "height over thickness of the front between old soil and new"),
    "front_age": ("s", "time since the column first eroded"),
    "consolidation_time": ("s", "thickness squared over coefficient of consolidation"),
    "erosion_time": ("s", "thickness over erosion rate"),
    "clipped_pressure": ("Pa m", "pressure above liquefaction taken off, times thickness, so far"),
}

DILATANT_VARIABLES = {
    "solid_fraction": ("-", "volume fraction of the grains"),
    "dilatancy_angle": ("deg", "angle of dilatancy at the base, which adds to the friction angle"),
    "coefficient_of_consolidation": ("m2 s-1", "coefficient of consolidation at the base"),
}
"""Further variables of columns with dilatancy."""

PER_LEVEL = {"excess_pore_pressure", "solid_fraction"}


def dataset(
    inputs: Inputs, given: dict[str, Any], output: list[dict[str, np.ndarray]], coefficient: np.ndarray
) -> xr.Dataset:
    """Return the columns at all times of output as a Dataset.

    Parameters
    ----------
    inputs : Inputs
        Checked arguments of `solve_column`.
    given : dict
        Its arguments as they were given: numbers and words become attributes.
    output : list of dict
        For each time the arrays of `VARIABLES`, shape (column,) or (column, level); with dilatancy also those of
        `DILATANT_VARIABLES`.
    coefficient : ndarray, shape (column,)
        Coefficient of consolidation at time 0 [m2 s-1].
    """
    data: dict[str, Any] = {}
    written = VARIABLES | (DILATANT_VARIABLES if given["dilatancy"] is not None else {})
    for name, (unit, words) in written.items():
        dims = ("time", "column", "level") if name in PER_LEVEL else ("time", "column")
        data[name] = (dims, np.stack([values[name] for values in output]), variable_attributes(unit, words))
    start = basal_peclet_number(inputs.entrainment_rate.at(0.0), inputs.thickness, coefficient)
    data["initial_peclet_number"] = ("column", start, variable_attributes("-", "basal Peclet number at time 0"))
    height = "height above the base over thickness, 0 at the base, 1 at the surface"
    coordinates = {
        "time": ("time", inputs.times, variable_attributes("s", "time"), NO_FILL),
        "column": ("column", np.arange(inputs.thickness.size), variable_attributes("-", "number of the column")),
        "level": ("level", np.linspace(0.0, 1.0, given["levels"]), variable_attributes("-", height), NO_FILL),
    }
    attributes = file_attributes()
    units = {name: argument.metadata["unit"] for name, argument in (NUMBERS | SINGLE_NUMBERS).items()}
    for name, value in given.items():
        if isinstance(value, str | Real):
            attributes |= quantity_attributes(name, value, units.get(name, "-"))
    if (law := given["dilatancy"]) is not None:
        for field in dataclasses.fields(law):
            value = getattr(law, field.name)
            attributes |= quantity_attributes(f"dilatancy_{field.name}", value, field.metadata["unit"])
    return xr.Dataset(data, coordinates, attributes)
