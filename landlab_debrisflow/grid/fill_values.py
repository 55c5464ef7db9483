"""Numbers that stand in rasters where there are no data, and how to get rid of them."""

import numpy as np

from ..spatial.raster import CLOSED

LOWEST, HIGHEST = -12000.0, 9000.0
"""Lowest and highest ground on Earth [m]."""

FILL_VALUES = (
    -9999.0, -32768.0, -32767.0, 32767.0, 65535.0, -99999.0, 99999.0, -999999.0, 999999.0,
    -2147483648.0, -2147483647.0, 2147483647.0, 4294967295.0,
)  # fmt: skip
"""Numbers by which programs and integer formats mark missing data, and which no field of the grid has by chance."""

LEAST_FILL = 32766.0
"""Magnitude below which only negative numbers are fill values."""

HUGE = 1e15
"""Magnitude that no measured value has, from which on all numbers are fill values: 1e20 and 9.97e36 of climate data,
the largest floats of GIS."""


def is_fill(values):
    """Return which values mark missing data, as an array of bool."""
    return np.isin(values, FILL_VALUES) | (np.abs(values) >= HUGE)


def code_of(value) -> str:
    """Return a number as it is written in code, without loss.

    Examples
    --------
    >>> code_of(-32768.0), code_of(np.float32(1e20)), code_of(0.25)
    ('-32768', '1.0000000200408773e+20', '0.25')
    """
    value = float(value)
    return repr(int(value)) if value.is_integer() and abs(value) < HUGE else repr(value)


def closing_call(name: str, value) -> str:
    """Return the call that closes all nodes at which a field has some value."""
    return f"grid.set_nodata_nodes_to_closed(grid.at_node['{name}'], {code_of(value)})"


def replacement_remedy(name: str, values, value) -> str:
    """Return a remedy for a fill value in a field, as the end of a refusal; an empty text for any other value.

    `values` are those of the field `name`, shape (nodes,); `value` is the number refused.
    """
    if not is_fill(value):
        return ""
    field, count = f"grid.at_node['{name}']", np.count_nonzero(values == value)
    return f"; {code_of(value)} marks missing data, at {count} nodes: {field}[{field} == {code_of(value)}] = 0"


def elevation_range(grid) -> tuple[float, float]:
    """Return the lowest and the highest elevation at nodes in use [m], without values that reading would refuse."""
    z = grid.at_node["topographic__elevation"]
    ground = (grid.status_at_node != CLOSED) & np.isfinite(z)
    if np.any((z < LOWEST) | (z > HIGHEST), where=ground):
        ground &= ~is_fill(z)
    return (float(z.min(where=ground, initial=np.inf)), float(z.max(where=ground, initial=-np.inf)))
