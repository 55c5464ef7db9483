"""Every state variable, declared once: arrays, output files and Landlab's `_info` follow from here."""

from typing import NamedTuple

COLUMN_MEMORY = 31
"""Numbers a column law may keep per column from call to call."""


class Variable(NamedTuple):
    """One number per particle, three for a vector, or one per level of its column."""

    name: str
    unit: str
    long_name: str
    dtype: type = float
    initial: float = 0.0
    written: bool = True  # appears in output
    per_level: bool = False
    vector: bool = False
    width: int = 0  # numbers per particle, if more than one and no vector


PARTICLE_VARIABLES = (
    Variable("identity", "-", "number of the particle, in order of release", "i8", 0, written=False),
    Variable("x", "m", "map coordinate, from the lower left node of the grid"),
    Variable("y", "m", "map coordinate, from the lower left node of the grid"),
    Variable("z", "m", "elevation of the bed below"),
    Variable("lowest_z", "m", "lowest bed it has come over", initial=float("inf"), written=False),
    Variable("velocity", "m s-1", "depth-averaged velocity, tangent to the bed", vector=True),
    Variable("thrust", "m s-2", "acceleration by the pressure of the flow", vector=True, written=False),
    Variable("volume", "m3", "volume of debris carried"),
    Variable("phase", "-", "0: grains, in a flow of one phase with their pore water; 1: water", "i1", 0),
    Variable("share", "-", "part of the thickness that is of its own phase", initial=1.0, written=False),
    Variable("own_thickness", "m", "slope-normal thickness of its own phase", written=False),
    Variable("cross_term", "-", "grad-h term of the other phase", written=False),
    Variable("mean_excess_pore_pressure", "Pa", "its depth mean, in a flow of two phases", written=False),
    Variable("porosity", "-", "volume fraction of the pores"),
    Variable("porosity_before", "-", "before the flow of the step changed it", written=False),
    Variable("density", "kg m-3", "density of the mixture"),
    Variable("released_volume", "m3", "volume it was released with", written=False),
    Variable("first_erosion_time", "s", "time when it first eroded", initial=float("nan"), written=False),
    Variable("depth", "m", "vertical flow depth"),
    Variable("thickness", "m", "slope-normal flow thickness"),
    Variable("least_thickness", "m", "thickness below which the smoothing length stays", written=False),
    Variable("smoothing_length", "m", "SPH smoothing length"),
    Variable("next_smoothing_length", "m", "SPH smoothing length of the next step", written=False),
    Variable("light", "-", "whether it is much smaller than most of its release", bool, False, written=False),
    Variable("usual_length", "m", "smoothing length of the others in the thickest of the release", written=False),
    Variable("gradient_term", "-", "grad-h term Omega of the SPH sums", initial=1.0, written=False),
    Variable("thickening", "m s-1", "-h div v of the flow", written=False),
    Variable("anchor", "m", "position when it last counted as changed", vector=True, written=False),
    Variable("anchor_volume", "m3", "volume when it last counted as changed", written=False),
    Variable("still_steps", "-", "steps since it counted as changed", "i8", 0, written=False),
    Variable("asleep_since", "s", "time to which its column was advanced, if it sleeps", written=False),
    Variable("liquefaction_pressure", "Pa", "effective normal stress without excess pore pressure"),
    Variable("basal_excess_pore_pressure", "Pa", "excess pore pressure at the base"),
    Variable("entrainment_rate", "m s-1", "erosion rate granted by the bed, per map area"),
    Variable("basal_peclet_number", "-", "erosion rate times thickness over c_v, of the last erosion"),
    Variable("column_memory", "-", "what the column law remembers", written=False, width=COLUMN_MEMORY),
    Variable("column_clipped", "Pa m", "pressure taken off by the bounds times thickness"),
    Variable("inflow_row", "-", "row of the inflow it still moves with, -1: flows by itself", "i8", -1, written=False),
    Variable("origin", "-", "number among the released (release/origins.py), -1: flowed in", "i8", -1, written=False),
    Variable("body", "-", "number of the body it is of (model/rest.py), -1: not known yet", "i8", -1, written=False),
    Variable("arrested", "-", "1 if its body has come to rest", "i1", 0, written=False),
    Variable("rest_speed", "m s-1", "speed below which it comes to rest if friction holds it", written=False),
    Variable("touched_wall", "-", "1 if it ran against a closed node", "i1", 0, written=False),
    Variable("counted_at_wall", "-", "1 once that was counted", "i1", 0, written=False),
    Variable("excess_pore_pressure", "Pa", "excess pore pressure in the column", per_level=True),
)


class NodeField(NamedTuple):
    """One field of the grid, at nodes; `_info` of the component is made of these."""

    name: str
    intent: str
    unit: str
    doc: str
    optional: bool = False
    dtype: type = float
    start: float = 0.0  # of an output, where nothing has come

    @property
    def info(self) -> dict:
        """The entry of a Landlab component's `_info`."""
        return {
            "dtype": self.dtype, "intent": self.intent, "optional": self.optional,
            "units": self.unit, "mapping": "node", "doc": self.doc,
        }  # fmt: skip


OUTPUT_PREFIX = "debris_flow__"

NODE_FIELDS = (
    # the docs of shared names are Landlab's own
    NodeField("topographic__elevation", "inout", "m", "Land surface topographic elevation"),
    NodeField("soil__depth", "inout", "m", "Depth of soil or weathered bedrock", True),
    NodeField("debris_flow__release_depth", "inout", "m", "Thickness of ground that fails, 0 once taken", True),
    NodeField(
        "mass__wasting_id", "inout", "-",
        "integer or float id of each mass wasting area is assigned                 "  # a continued line there
        "to all nodes representing the mass wasting area.",
        True, int,
    ),
    NodeField(
        "bed__excess_pore_pressure_ratio", "in", "-",
        "Excess pore pressure of the bed over its liquefaction value", True,
    ),
    NodeField(
        "bed__excess_pore_pressure", "inout", "Pa",
        "Excess pore pressure of the bed, raised by the weight of the flow, drained in time", True,
    ),
    NodeField(
        "bed__drained", "in", "-", "1 where a drain holds the excess pore pressure at the base of a flow at 0", True
    ),
    NodeField("debris_flow__depth", "out", "m", "Vertical depth of moving mass"),
    NodeField("debris_flow__speed", "out", "m/s", "Speed of moving mass along the bed"),
    NodeField("debris_flow__solid_depth", "out", "m", "Volume of grains per map area, in a flow of two phases", True),
    NodeField("debris_flow__solid_speed", "out", "m/s", "Speed of the grains, in a flow of two phases", True),
    NodeField("debris_flow__water_speed", "out", "m/s", "Speed of the water, in a flow of two phases", True),
    # peaks are those of what counts as arrival, since the component or, if it was called, new_event() began
    NodeField("debris_flow__max_depth", "out", "m", "Largest depth so far"),
    NodeField("debris_flow__max_speed", "out", "m/s", "Largest speed so far"),
    NodeField(
        "debris_flow__max_impact_pressure", "out", "Pa",
        "Largest density times speed squared so far; on closed nodes with the speed towards their faces",
    ),
    NodeField(
        "debris_flow__max_run_up", "out", "m",
        "Largest height so far of the surface of moving mass above the lowest bed it came over; on closed nodes of "
        "what stood at their faces",
    ),
    NodeField(
        "debris_flow__arrival_time", "out", "s",
        "Elapsed time of the component at first arrival; -1 where nothing came", start=-1.0,
    ),
    NodeField("debris_flow__eroded_depth", "out", "m", "Cumulative erosion, without the release"),
    NodeField("debris_flow__deposit_depth", "out", "m", "Depth of mass at rest now plus what has settled"),
    NodeField(
        "debris_flow__basal_excess_pore_pressure", "out", "Pa",
        "Excess pore pressure at the base of the flow; after settling, the last value",
    ),
    NodeField(
        "debris_flow__max_basal_pressure_ratio", "out", "-",
        "Largest basal excess pore pressure over its liquefaction value so far",
    ),
    NodeField(
        "debris_flow__basal_peclet_number", "out", "-",
        "Erosion rate times thickness over coefficient of consolidation, of the last erosion",
    ),
    NodeField("debris_flow__max_basal_peclet_number", "out", "-", "Largest basal Peclet number so far"),
)  # fmt: skip
