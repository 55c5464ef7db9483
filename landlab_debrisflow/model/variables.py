"""Variables of a particle: the variables of every flow, and the contributions of laws and phases."""

from ..core.errors import ParameterError
from ..core.variables import Variable

PARTICLE_VARIABLES = (
    Variable("identity", "-", "number of the particle, in order of release", "i8", 0, written=False),
    Variable("x", "m", "map coordinate, from the lower left node of the grid"),
    Variable("y", "m", "map coordinate, from the lower left node of the grid"),
    Variable("z", "m", "elevation of the bed below"),
    Variable("lowest_z", "m", "lowest bed it has come over", initial=float("inf"), written=False),
    Variable("velocity", "m s-1", "depth-averaged velocity, tangent to the bed", components=3),
    Variable("thrust", "m s-2", "acceleration by the pressure of the flow", components=3, written=False),
    Variable("volume", "m3", "volume of debris carried"),
    Variable("phase", "-", "0: grains, in a flow of one phase with their pore water; 1: water", "i1", 0),
    Variable("share", "-", "part of the thickness that is of its own phase", initial=1.0, written=False),
    Variable("own_thickness", "m", "slope-normal thickness of its own phase", written=False),
    Variable("porosity", "-", "volume fraction of the pores"),
    Variable("density", "kg m-3", "density of the mixture"),
    Variable("released_volume", "m3", "volume it was released with", written=False),
    Variable("first_erosion_time", "s", "time when it first eroded", initial=float("nan"), written=False),
    Variable("depth", "m", "vertical flow depth"),
    Variable("thickness", "m", "slope-normal flow thickness"),
    Variable("least_thickness", "m", "thickness below which the smoothing length stays", written=False),
    Variable("smoothing_length", "m", "SPH smoothing length"),
    Variable("next_smoothing_length", "m", "SPH smoothing length of the next step", written=False),
    Variable("light", "-", "whether it is much smaller than most of its release", bool, False, written=False),
    Variable("usual_length", "m", "usual smoothing length in the thickest part of the release", written=False),
    Variable("gradient_term", "-", "grad-h term Omega of the SPH sums", initial=1.0, written=False),
    Variable("thickening", "m s-1", "-h div v of the flow", written=False),
    Variable("reference_position", "m", "position when it last counted as changed", components=3, written=False),
    Variable("reference_volume", "m3", "volume when it last counted as changed", written=False),
    Variable("still_steps", "-", "steps since it counted as changed", "i8", 0, written=False),
    Variable("asleep_since", "s", "time to which its column was advanced, if it sleeps", written=False),
    Variable("liquefaction_pressure", "Pa", "effective normal stress without excess pore pressure"),
    Variable("basal_excess_pore_pressure", "Pa", "excess pore pressure at the base"),
    Variable("entrainment_rate", "m s-1", "erosion rate granted by the bed, per map area"),
    Variable("basal_peclet_number", "-", "erosion rate times thickness over c_v, of the last erosion"),
    Variable("column_clipped", "Pa m", "pressure above liquefaction taken off, times thickness"),
    Variable("inflow_row", "-", "row of the inflow it still moves with, -1: flows by itself", "i8", -1, written=False),
    Variable("origin", "-", "number among the released (release/origins.py), -1: flowed in", "i8", -1, written=False),
    Variable("body", "-", "number of the body it is of (model/rest.py), -1: not known yet", "i8", -1, written=False),
    Variable("arrested", "-", "1 if its body has come to rest", "i1", 0, written=False),
    Variable("rest_speed", "m s-1", "speed below which it comes to rest if friction holds it", written=False),
    Variable("touched_wall", "-", "1 if it ran against a closed node", "i1", 0, written=False),
    Variable("counted_at_wall", "-", "1 once that was counted", "i1", 0, written=False),
    Variable("excess_pore_pressure", "Pa", "excess pore pressure in the column", per_level=True),
    # values that the stages of a step pass on to each other
    Variable("nearest_node", "-", "node nearest to it", "i8", 0, written=False, scratch=True),
    Variable("slope_x", "-", "slope dz/dx of the bed below", written=False, scratch=True),
    Variable("slope_y", "-", "slope dz/dy of the bed below", written=False, scratch=True),
    Variable("curvature_xx", "m-1", "second derivative d2z/dx2 of the bed below", written=False, scratch=True),
    Variable("curvature_xy", "m-1", "second derivative d2z/dxdy of the bed below", written=False, scratch=True),
    Variable("curvature_yy", "m-1", "second derivative d2z/dy2 of the bed below", written=False, scratch=True),
    Variable("cos_slope", "-", "cosine of the slope of the bed below", initial=1.0, written=False, scratch=True),
    Variable("expected_elevation", "m", "elevation at which the kicks leave it", written=False, scratch=True),
    Variable("summed", "-", "whether its sums over neighbours were done in this step", bool, False, written=False,
             scratch=True),
    Variable("entrained_volume", "m3", "soil taken in this step", written=False, scratch=True),
    Variable("entrained_ratio", "-", "pore pressure ratio of that soil", written=False, scratch=True),
)  # fmt: skip


def particle_variables(column, laws=()) -> tuple[Variable, ...]:
    """Return the variables of the particles of a flow.

    Parameters
    ----------
    column : ColumnLaw
        Its ``memory_size``, if it has one, is the number of floats that it keeps per column.
    laws : sequence
        Laws and phases; those with an attribute ``variables``, a tuple of `Variable`, bring variables of their own.

    Returns
    -------
    tuple of Variable

    Raises
    ------
    ParameterError
        If two of the variables have one name.
    """
    memory = Variable(
        "column_memory", "-", "memory of the column law", written=False,
        width=getattr(column, "memory_size", 0),
    )  # fmt: skip
    variables = [*PARTICLE_VARIABLES, memory]
    known = {variable.name for variable in variables}
    for law in laws:
        for variable in getattr(law, "variables", ()):
            if variable.name in known:
                raise ParameterError(
                    f"{type(law).__name__}: particles already have a variable {variable.name!r}; give it another name"
                )
            known.add(variable.name)
            variables.append(variable)
    return tuple(variables)
