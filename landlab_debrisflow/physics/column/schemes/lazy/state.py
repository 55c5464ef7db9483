"""State of a column between the calls of the default scheme: one record per column, its layout declared here.

An update is the moment in which a column was last advanced. ``eta`` is the depth below the surface over the
thickness, ``c_v t/h^2`` a time over that of consolidation.

====================  =====  ==================================================================================
member                unit   meaning
====================  =====  ==================================================================================
contact               -      `BaseContact` of the last step; BY_EROSION: at levels, not put on a base yet
load                  Pa     liquefaction pressure after the last step
diffusion             -      c_v t/h^2 since the update
source_gain           Pa     pressure made by a change of porosity since the update
base_pressure         Pa     pressure at the base at the update

in modes, over an impermeable base
base_rate             Pa     derivative of the pressure at the base by c_v t/h^2, at the update
base_curvature        Pa     half its second derivative
remainder             Pa     bound of the error of that parabola, over (c_v t/h^2)^3
load_gain             Pa     pressure over eta that loading has added since the update
load_scale            -      factor by which loading has scaled the pressure since the update
load_variation        Pa     sum of the changes of load and source since the update, all taken positive
lowest_pressure       Pa     bounds of the column at the update: constants that enclose the pressure,
highest_pressure      Pa
lowest_slope          Pa     and lines through the surface, p/eta, that enclose it
highest_slope         Pa

at levels
volume_at_update      m3
load_at_update        Pa     liquefaction pressure
bed_pressure          Pa     pressure of the bed after the last step, or of the soil that comes in
deferred_diffusion    -      c_v t/h^2 left over by the update, to come with the next one
volume_at_contact     m3     volume when this contact began
contact_is_new        -      1 until the first update over this contact
layer_jump            Pa     jump at the base of a boundary layer that levels do not resolve, at the end of a contact
layer_content         -      integral of that layer over jump and thickness

in modes, by bands of modes too short for the levels (`modes.Modes.bands`)
unresolved_bands      Pa     input by loading and by the slope at the base, as seen at the base
layer_bands           Pa     input by a boundary layer present when the base became impermeable, as seen at the base
====================  =====  ==================================================================================
"""

from typing import NamedTuple

import numpy as np

from .....core.structs import struct

BANDS = 4  # bands of modes too short for the levels: their sum at an impermeable base

ALWAYS = ("contact", "load", "diffusion", "source_gain", "base_pressure")
IN_MODES = (
    "base_rate", "base_curvature", "remainder", "load_gain", "load_scale", "load_variation", "lowest_pressure",
    "highest_pressure", "lowest_slope", "highest_slope",
)  # fmt: skip
AT_LEVELS = (
    "volume_at_update", "load_at_update", "bed_pressure", "deferred_diffusion", "volume_at_contact", "contact_is_new",
    "layer_jump", "layer_content",
)  # fmt: skip
IN_BANDS = ("unresolved_bands", "layer_bands")

MEMBERS = [(name, float) for name in ALWAYS + IN_MODES + AT_LEVELS] + [(name, float, (BANDS,)) for name in IN_BANDS]
LAYOUT = np.dtype((np.record, MEMBERS))  # np.record gives attributes in plain Python, too
SIZE = LAYOUT.itemsize // np.dtype(float).itemsize
"""Number of floats of a column in `ColumnState.memory`."""


@struct
class LazyColumns(NamedTuple):
    """The arrays of n columns, `ColumnState` with its memory as records.

    Attributes
    ----------
    profile : ndarray, shape (n, levels)
        Pressure at levels, or in all but the last the amplitudes of modes [Pa].
    state : ndarray of `LAYOUT`, shape (n,)
        Memory of each column.
    clipped : ndarray, shape (n,)
        Pressure above liquefaction taken off, times thickness, so far [Pa m].
    """

    profile: np.ndarray
    state: np.ndarray
    clipped: np.ndarray


@struct
class Present(NamedTuple):
    """Volume and load of n columns now."""

    volume: np.ndarray  # (n,) [m3]
    load: np.ndarray  # (n,) liquefaction pressure [Pa]


def records(memory) -> np.ndarray:
    """Return a view of `ColumnState.memory`, shape (n, `SIZE`), as records of `LAYOUT`, shape (n,)."""
    return np.ndarray(memory.shape[0], LAYOUT, memory)  # a sixth of the time of memory.view
