"""The arguments of `solve_column`, declared as the parameters of laws are."""

from ..core.parameters import parameter
from ..physics.column.dilatancy import DENSEST, LOOSEST, Dilatancy
from ..physics.column.driver import PACKED, SOLID_DENSITY
from ..physics.consolidation import Consolidation

HYDROSTATIC = "give a finite pressure over the hydrostatic one, negative for suction"
NUMBERS = {
    "thickness": parameter(
        "m", "slope-normal thickness at time 0", 1.0, (0.0, None), open_below=True,
        remedy="give the slope-normal thickness at time 0",
    ),
    "entrainment_rate": parameter(
        "m s-1", "erosion rate", 0.01, (0.0, None), timed=True,
        remedy="a column that gets thinner without losing soil has a divergence_rate > 0",
    ),
    "coefficient_of_consolidation": parameter(
        "m2 s-1", "diffusivity of excess pore pressure", 1e-3, (0.0, None), remedy="give 0 for no diffusion",
        derivation=Consolidation,
    ),
    "basal_pressure": parameter("Pa", "excess pore pressure of the bed", 1.0, timed=True, remedy=HYDROSTATIC),
    "initial_pressure": parameter("Pa", "at the base at time 0", None, remedy=HYDROSTATIC),
    "divergence_rate": parameter(
        "s-1", "strain rate at which a column spreads", 0.0, timed=True,
        remedy="give a finite rate, negative where flow converges",
    ),
    "loading": parameter(
        "Pa m-1", "liquefaction pressure over thickness", 0.0, (0.0, None),
        remedy="give rho' g cos(theta), or 0 to leave loading out",
    ),
    "porosity_source": parameter(
        "Pa s-1", "pressure made by a change of porosity", 0.0, timed=True, remedy="give a finite rate of pressure"
    ),
    "basal_pressure_ratio": parameter(
        "-", "excess pore pressure of the bed over its liquefaction value", None, (0.0, 1.0), timed=True,
        remedy="0 is a dry bed, 1 a liquefied one",
    ),
    "shear_rate": parameter(
        "s-1", "shear rate of a column with dilatancy", 0.0, (0.0, None), timed=True,
        remedy="give twice the mean velocity over the thickness",
    ),
    "solid_fraction": parameter(
        "-", "of a column with dilatancy at time 0", PACKED, (LOOSEST, DENSEST),
        remedy="give 1 less the porosity, or leave it out",
    ),
}  # fmt: skip
"""Arguments that are one number or one per column, declared as parameters are."""

SINGLE_NUMBERS = {
    "times": parameter(
        "s", "times of output", None, (0.0, None),
        remedy="the columns start at time 0; for example times=[10.0, 100.0]",
    ),
    "initial_layer_fraction": parameter(
        "-", "thickness of the basal layer over that of the column", 0.1, (0.0, 1.0),
        remedy="it is a part of the thickness",
    ),
    "soil_solid_fraction": parameter(
        "-", "of the soil that comes in, with dilatancy", None, (LOOSEST, DENSEST),
        remedy="leave it None for that of the columns",
    ),
    "solid_density": parameter(
        "kg m-3", "density of the grains, with dilatancy", SOLID_DENSITY, (1.0, 1e5), remedy="quartz has 2650",
    ),
    "step": parameter(
        "s", "longest time step", None, (0.0, None), open_below=True, remedy="leave it None to have it chosen"
    ),
}  # fmt: skip

CHOICES = {
    "law": parameter("-", "law of the column", "ale", choices=("ale", "classical", "constant_ratio")),
    "advance": parameter("-", "whether a column may be left alone", "lazy", choices=("lazy", "every_step")),
    "dilatancy": parameter("-", "debris contracts or dilates as it is sheared", None, kind=Dilatancy),
    "bounded": parameter("-", "show the pressure between suction and liquefaction", False, kind=bool),
}
