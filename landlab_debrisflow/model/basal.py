"""The base of the flow: its state as laws read it, and the resistance there."""

from types import SimpleNamespace
from typing import Any, NamedTuple

import numpy as np

from ..core.constants import THINNEST
from ..core.jit import allocating_kernel
from ..core.structs import struct
from ..physics.bed_state import SATURATED_BED, BedState
from ..physics.contracts import NOT_ASKED, BasalState, BasalStress, Phases

NO_VARIABLES = SimpleNamespace()


@struct
class BedLoad(NamedTuple):
    """Flow whose weight the bed bears, at n particles.

    Attributes
    ----------
    thickness : ndarray, shape (n,)
        Slope-normal thickness [m].
    density : ndarray, shape (n,)
        Density of the mixture [kg m-3].
    pressure : ndarray, shape (n,)
        Basal excess pore pressure [Pa].
    """

    thickness: np.ndarray
    density: np.ndarray
    pressure: np.ndarray


@struct
class Weighing(NamedTuple):
    """Constants by which a flow weighs on the bed.

    Attributes
    ----------
    gravity : float
        Acceleration by gravity [m s-2].
    bearing_density : float
        Hydrostatic pressure at the base over normal gravity and thickness [kg m-3].
    least_radius : float
        Least radius of curvature of the bed [m].
    """

    gravity: float
    bearing_density: float
    least_radius: float


def weighing_on(material, spacing: float):
    """Return the `Weighing` of a material on a raster whose smaller node spacing is `spacing` [m]."""
    return Weighing(gravity=material.gravity, bearing_density=material.bearing_density, least_radius=spacing)


def shear_per_speed(thickness, material):
    """Return the shear rate over the mean speed, 2 (1 - v_b/v)/h_n, for `thickness` h_n, shape (n,) [m-1]."""
    return 2.0 * (1.0 - material.basal_slip_ratio) / np.maximum(thickness, THINNEST)


class BasalLaw(NamedTuple):
    """A law of friction or erosion on the bed of a call.

    Attributes
    ----------
    law : FrictionLaw or ErosionLaw
        The law.
    parameters : NamedTuple of ndarray, shape (nodes,) or (1,)
        Parameters in SI units (`core.parameters.on_nodes`).
    material : Material
        Densities, porosity and gravity.
    weighing : tuple
        Constants by which the flow weighs on the bed, a `Weighing`.
    variables : tuple of Variable
        Variables per particle that the law brought.
    varies : bool
        Whether a parameter varies in space.
    dilatant_column : ColumnLaw or None
        Law of the columns above, if it has dilatancy.
    """

    law: Any
    parameters: Any
    material: Any
    weighing: tuple
    variables: tuple
    varies: bool
    dilatant_column: Any


def basal_state(
    p, which: slice, basal: BasalLaw, pressure=None, asking: bool = False, eroded_depth=NOT_ASKED, resistance=None,
    bed: BedState = SATURATED_BED,
) -> BasalState:  # fmt: skip
    """Return the base under some particles, as a law reads it.

    Parameters
    ----------
    p : Particles
        All particles.
    which : slice
        Places of the n particles asked for.
    basal : BasalLaw
        The law that reads it, and the parameters it has.
    pressure : ndarray, shape (n,), optional
        Basal excess pore pressure to suppose instead of the one there is [Pa].
    asking : bool
        Whether the call is no part of a step: the law's variables are then copies.
    eroded_depth : ndarray, shape (n,) or (1,)
        Depth taken from the bed in this event [m].
    resistance : tuple of ndarray, shape (n,), optional
        Yield stress [Pa] and drag [Pa s m-1] of the friction law, which a law of erosion reads.
    bed : BedState
        Pore water of the bed, which a law of erosion reads.
    """
    material = basal.material
    thickness, density = p.thickness[which], p.density[which]
    pressure = p.basal_excess_pore_pressure[which] if pressure is None else pressure
    load = BedLoad(thickness=thickness, density=density, pressure=pressure)
    speed, normal_gravity, effective = press_on_bed(
        which.start or 0, p.velocity, p.curvature, p.cos_slope, load, basal.weighing
    )  # fmt: skip
    parameters, shear = basal.parameters, NOT_ASKED
    if resistance is not None:
        yield_stress, drag = resistance
        shear = yield_stress + drag * speed
    if basal.varies:
        here = (values if values.size == 1 else values[p.nearest_node[which]] for values in parameters)
        parameters = type(parameters)(*here)
    return BasalState(
        depth=p.depth[which],
        thickness=thickness,
        speed=speed,
        density=density,
        normal_gravity=normal_gravity,
        stress=BasalStress(effective, p.liquefaction_pressure[which], pressure, shear),
        eroded_depth=eroded_depth,
        material=material,
        parameters=parameters,
        variables=_variables(p, which, basal, asking) if basal.variables else NO_VARIABLES,
        dilatancy=None
        if (column := basal.dilatant_column) is None
        else column.at_base(p.column_memory[which]).dilatancy,
        bed=bed,
    )


def _variables(p, which: slice, basal: BasalLaw, asking: bool):
    """Return the variables of the law `basal` at `p[which]` as attributes: copies if `asking`, else views."""
    place = {False: which, True: (slice(None), which)}
    values = {v.name: getattr(p, v.name)[place[v.components > 0]] for v in basal.variables}
    return SimpleNamespace(**{name: value.copy() if asking else value for name, value in values.items()})


@allocating_kernel
def press_on_bed(first, velocity, curvature, cosine, load, weighing):
    """Return speed, normal gravity and effective normal stress at the base of particles.

    The centripetal part v.Hess(Z).v is capped at v^2 over the least radius: a raster resolves no smaller radius than
    its spacing, and noise of the elevation must not add to the load.

    Parameters
    ----------
    first : int
        Place of the first particle asked for.
    velocity : ndarray, shape (3, all)
        Velocity of all particles [m s-1].
    curvature : tuple of ndarray, shape (all,)
        Second derivatives of the bed below all particles, xx, xy and yy [m-1].
    cosine : ndarray, shape (all,)
        Cosine of the slope of the bed [-].
    load : BedLoad
        Load of the n particles asked for.
    weighing : Weighing
        Constants by which the flow weighs on the bed.

    Returns
    -------
    ndarray, shape (3, n)
        Rows: speed [m s-1]; slope-normal gravity with the centripetal part [m s-2]; effective normal stress [Pa].
    """
    curvature_xx, curvature_xy, curvature_yy = curvature
    thickness, density, pressure = load
    gravity, bearing_density, least_radius = weighing
    n = thickness.size
    found = np.empty((3, n))  # one array is handed to Python in a third of the time of three
    speed, normal_gravity, effective_normal_stress = found[0], found[1], found[2]
    for k in range(n):
        i = first + k
        u, v, w = velocity[0, i], velocity[1, i], velocity[2, i]
        bend = u * u * curvature_xx[i] + 2.0 * u * v * curvature_xy[i] + v * v * curvature_yy[i]
        most = (u * u + v * v) / least_radius
        bend = min(max(bend, -most), most)
        speed[k] = np.sqrt(u * u + v * v + w * w)
        normal_gravity[k] = max(0.0, (gravity + bend) * cosine[i])
        stress = (density[k] - bearing_density) * normal_gravity[k] * thickness[k] - pressure[k]
        effective_normal_stress[k] = max(0.0, stress)
    return found


def basal_resistance(p, which: slice, friction: BasalLaw, pressure=None, asking: bool = False, out=None):
    """Return yield stress [Pa] and drag [Pa s m-1] under the particles `p[which]`, each of shape (n,).

    `pressure`, shape (n,) [Pa], is supposed as basal excess pore pressure instead of the one there is (None). `asking`
    outside a step gives the law copies of its variables, so that nothing changes; see `basal_state`. `out` are the two
    arrays to write, by default new ones.
    """
    state = basal_state(p, which, friction, pressure, asking=asking)
    yield_stress, drag = np.empty((2, state.depth.size)) if out is None else out
    friction.law.basal_resistance(state, yield_stress, drag)
    if friction.dilatant_column is not None:  # sheared pore fluid resists beside the grains, whatever their friction
        viscosity = friction.dilatant_column.at_base(p.column_memory[which]).fluid_viscosity
        drag += shear_per_speed(state.thickness, friction.material) * viscosity
    return yield_stress, drag


def held_at_rest(p, which: slice, pressure, friction: BasalLaw, phases: Phases, exchange, walls):
    """Return whether friction would hold each of some particles at rest, shape (n,).

    Parameters
    ----------
    p : Particles
        All particles.
    which : slice
        Places of the n particles asked for.
    pressure : ndarray, shape (n,)
        Basal excess pore pressure to suppose [Pa].
    friction : BasalLaw
        Law of friction and its parameters.
    phases : Phases
        Stages of a step that depend on the number of phases.
    exchange : Exchange
        State of the exchange between grains and water.
    walls : Raster or None
        Raster with closed nodes; None where no node is closed.
    """
    yield_stress, drag = basal_resistance(p, which, friction, pressure, asking=True)
    return phases.held_at_rest(p, exchange, which, yield_stress, drag, walls)
