"""Laws and materials that do not go together."""

from ..core.errors import ParameterError
from .column.dilatancy import DENSEST, LOOSEST
from .contracts import is_jump_condition
from .registry import law_name

CONSOLIDATION = "coefficient_of_consolidation"
"""Parameter of the material that follows from dilatancy."""


def check_laws(setup, names_c_v: bool) -> None:
    """Refuse laws and material of a `setup` that do not go together.

    `names_c_v` tells whether a coefficient of consolidation was given, be it the default one.

    Raises
    ------
    ParameterError
        If columns with dilatancy have two phases, a material that is dry, not saturated, too loose or too dense, or a
        coefficient of consolidation; if the erosion law is a jump condition and the columns have the paper's scheme.
    """
    if setup.has_dilatancy:
        _check_dilatancy(setup.material, setup.two_phases, names_c_v)
    if is_jump_condition(setup.erosion) and getattr(setup.column, "scheme", "") == "lax_wendroff":
        raise ParameterError(
            f"erosion: {law_name('erosion', setup.erosion)} needs a column whose base keeps a pressure of its own, "
            "got the scheme 'lax_wendroff', whose base has the pressure of the bed while soil comes in; choose the "
            "scheme 'default' or 'upwind', or another law of erosion"
        )


def _check_dilatancy(material, two_phases: bool, names_c_v: bool) -> None:
    """Refuse phases and material with which columns cannot have dilatancy; arguments as in `check_laws`."""
    if two_phases:
        raise ParameterError(
            "column: dilatancy goes with one phase; in a flow of two phases the change of porosity makes the pore "
            "pressure already: remove dilatancy, or use flow='one_phase'"
        )
    given = material.coefficient_of_consolidation
    if names_c_v or given != type(material).coefficient_of_consolidation:
        raise ParameterError(
            f"material: coefficient_of_consolidation must be left out with dilatancy, got {given:g}: it follows from "
            "permeability, pore_fluid_viscosity and compressibility at every level; remove one of the two"
        )
    for name, allowed in (("water_density", "> 0 kg m-3"), ("water_table_ratio", "1")):
        value = getattr(material, name)
        if value == 0.0 or (name == "water_table_ratio" and value < 1.0):
            raise ParameterError(
                f"material: {name} must be {allowed} with dilatancy, got {value:g}: only saturated debris makes pore "
                "pressure as it contracts; remove dilatancy for other debris"
            )
    for name, porosity in (("porosity", material.porosity), ("bed_porosity", material.soil_porosity)):
        if not LOOSEST <= 1.0 - porosity <= DENSEST:
            allowed = f"[{1.0 - DENSEST:g}, {1.0 - LOOSEST:g}]"
            raise ParameterError(
                f"material: {name} must lie in {allowed} with dilatancy, got {porosity:g}: its law is for solid "
                f"fractions of {LOOSEST:g} to {DENSEST:g}"
            )
