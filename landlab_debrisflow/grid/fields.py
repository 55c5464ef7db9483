"""Every field of the grid, declared once: `_info` of the component, maps and files follow from here."""

from contextlib import contextmanager
from typing import NamedTuple

from ..model.map_fields import PHASES, SOLID_FRACTION


class NodeField(NamedTuple):
    """One field of the grid, at nodes; `_info` of the component is made of these.

    Attributes
    ----------
    name : str
        Name of the field on the grid.
    intent : str
        "in", "out" or "inout".
    unit : str
        Unit as Landlab writes it, such as "m s-1".
    doc : str
        Meaning in a few words.
    optional : bool
        Whether the component does without it.
    dtype : type
        Type of a value.
    start : float
        Value of an output where nothing has come [unit].
    """

    name: str
    intent: str
    unit: str
    doc: str
    optional: bool = False
    dtype: type = float
    start: float = 0.0

    @property
    def info(self) -> dict:
        """The entry of a Landlab component's `_info`."""
        return {
            "dtype": self.dtype, "intent": self.intent, "optional": self.optional,
            "units": self.unit, "mapping": "node", "doc": self.doc,
        }  # fmt: skip


OUTPUT_PREFIX = "debris_flow__"

NODE_FIELDS = (
    # fields that Landlab has, too, are described in its words
    NodeField("topographic__elevation", "inout", "m", "Land surface topographic elevation"),
    NodeField("soil__depth", "inout", "m", "Depth of soil or weathered bedrock", True),
    NodeField("debris_flow__release_depth", "inout", "m", "Thickness of ground that fails, 0 once taken", True),
    NodeField(
        "debris_flow__release_velocity_x", "inout", "m/s",
        "Velocity over the map along x at which ground fails, 0 once taken", True,
    ),
    NodeField(
        "debris_flow__release_velocity_y", "inout", "m/s",
        "Velocity over the map along y at which ground fails, 0 once taken", True,
    ),
    NodeField(
        "mass__wasting_id", "inout", "-",
        "integer or float id of each mass wasting area is assigned                 "  # spaces as in Landlab
        "to all nodes representing the mass wasting area.",
        True, int,
    ),
    NodeField(
        "bed__excess_pore_pressure_ratio", "in", "-",
        "Excess pore pressure of the bed over its liquefaction value", True,
    ),
    NodeField(
        "bed__degree_of_saturation", "in", "-", "Volume of water over volume of pores of the bed", True
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
    NodeField(
        "debris_flow__solid_fraction", "out", "-",
        "Volume of grains over that of the flow in columns with dilatancy; after settling, the last value",
        True,
    ),
    # peaks count from the depth of arrival on, since the component was built or new_event() was called
    NodeField("debris_flow__max_depth", "out", "m", "Largest depth so far"),
    NodeField("debris_flow__max_speed", "out", "m/s", "Largest speed so far"),
    NodeField(
        "debris_flow__max_impact_pressure", "out", "Pa",
        "Largest density times speed squared so far; on closed nodes with the speed towards their faces",
    ),
    NodeField(
        "debris_flow__max_run_up", "out", "m",
        "Largest height so far of the surface of moving mass above the lowest bed it came over; on closed nodes at "
        "their faces",
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


def output_fields(setup) -> list[NodeField]:
    """Return the declarations of the fields that a component with some `Setup` writes besides elevation and soil."""
    lacking = set() if setup.two_phases else {OUTPUT_PREFIX + name for name in PHASES}
    lacking |= set() if setup.has_dilatancy else {OUTPUT_PREFIX + SOLID_FRACTION}
    return [field for field in NODE_FIELDS if field.intent == "out" and field.name not in lacking]


def fields_in_use(grid, laws) -> dict:
    """Return the fields at nodes of a component and its laws, by name.

    `laws` are those that may read fields, by kind.
    """
    at, names = grid.at_node, {field.name for field in NODE_FIELDS}
    for law in laws.values():
        names.update(value for value in getattr(law, "__dict__", {}).values() if isinstance(value, str))
    return {name: at[name] for name in sorted(names & set(at))}


@contextmanager
def no_new_fields(grid):
    """Enter a block at whose failure all fields that were added to `grid` in it are taken away again."""
    before = set(grid.at_node)
    try:
        yield
    except BaseException:
        for name in set(grid.at_node) - before:
            grid.delete_field("node", name)
        raise
