"""The base of the flow: its state as laws read it, and the forcing of the pore-pressure columns above."""

from types import SimpleNamespace
from typing import Any, NamedTuple

import numpy as np

from ..physics.contracts import (
    NOT_ASKED,
    BasalState,
    BasalStress,
    BaseContact,
    ColumnForcing,
    ColumnLaw,
    ColumnState,
    Phases,
)
from .normal_stress import BedLoad, Weighing, press_on_bed

BY_EROSION = np.array([BaseContact.BY_EROSION], np.int8)
"""Contact at the base of columns where nothing is drained."""

SOIL_ALONE = np.array([BaseContact.INFLOW], np.int8)
"""The same over a bed whose stress is not that of the flow: soil brings its own pressure, and nothing else comes in."""

NO_SOURCE = np.zeros(1)
"""Pressure by a change of porosity [Pa s-1]: one phase has none."""

NO_VARIABLES = SimpleNamespace()


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
    spacing : float
        Smaller node spacing of the raster [m].
    variables : tuple of Variable
        Variables per particle that the law brought.
    varies : bool
        Whether a parameter varies in space.
    """

    law: Any
    parameters: Any
    material: Any
    spacing: float
    variables: tuple
    varies: bool


class ColumnPhysics(NamedTuple):
    """Law, material and boundary by which the columns under particles are advanced in a call.

    Attributes
    ----------
    law : ColumnLaw
        Law of the columns.
    material : Material
        Densities, porosity and gravity.
    phases : Phases
        Gives the coefficient of consolidation.
    drained : ndarray of bool, shape (nodes,), or None
        Where a drain holds the excess pore pressure at 0; None: nowhere.
    water_to_buoyant : float
        Density of water over buoyant density [-].
    contact : ndarray of int8, shape (1,)
        Contact at the base of columns where nothing is drained, `BY_EROSION` or `SOIL_ALONE`.
    """

    law: ColumnLaw
    material: Any
    phases: Phases
    drained: Any
    water_to_buoyant: float
    contact: np.ndarray = BY_EROSION


def basal_state(
    p, which: slice, basal: BasalLaw, pressure=None, eroded_depth=NOT_ASKED, asking: bool = False
) -> BasalState:
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
    eroded_depth : ndarray, shape (n,) or (1,)
        Depth taken from the bed in this event [m].
    asking : bool
        Whether the call is no part of a step: the law's variables are then copies.
    """
    material = basal.material
    depth, thickness, density = p.depth[which], p.thickness[which], p.density[which]
    pressure = p.basal_excess_pore_pressure[which] if pressure is None else pressure
    load = BedLoad(thickness=thickness, density=density, pressure=pressure)
    weighing = Weighing(
        gravity=material.gravity, bearing_density=material.bearing_density, least_radius=basal.spacing
    )  # fmt: skip
    first = which.start or 0
    speed, normal_gravity, effective = press_on_bed(
        first, p.velocity, p.surface_sample, p.cos_slope, load, weighing
    )  # fmt: skip
    parameters = basal.parameters
    if basal.varies:
        here = (values if values.size == 1 else values[p.nearest_node[which]] for values in parameters)
        parameters = type(parameters)(*here)
    return BasalState(
        depth=depth,
        thickness=thickness,
        speed=speed,
        density=density,
        normal_gravity=normal_gravity,
        stress=BasalStress(effective, p.liquefaction_pressure[which], pressure),
        eroded_depth=eroded_depth,
        material=material,
        parameters=parameters,
        variables=_variables(p, which, basal, asking) if basal.variables else NO_VARIABLES,
    )


def _variables(p, which: slice, basal: BasalLaw, asking: bool):
    """Return the variables of the law `basal` at `p[which]` as attributes: copies if `asking`, else views."""
    place = {False: which, True: (slice(None), which)}
    values = {v.name: getattr(p, v.name)[place[v.components > 0]] for v in basal.variables}
    return SimpleNamespace(**{name: value.copy() if asking else value for name, value in values.items()})


def basal_resistance(p, which: slice, friction: BasalLaw, pressure=None, asking: bool = False):
    """Return yield stress [Pa] and drag [Pa s m-1] under the particles `p[which]`, each of shape (n,).

    `pressure`, shape (n,) [Pa], is supposed as basal excess pore pressure instead of the one there is (None). `asking`
    outside a step gives the law copies of its variables, so that nothing changes; see `basal_state`.
    """
    state = basal_state(p, which, friction, pressure, asking=asking)
    yield_stress, drag = np.empty(state.depth.size), np.empty(state.depth.size)
    friction.law.basal_resistance(state, yield_stress, drag)
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


# ---- columns ----


def column_state(p, which: slice) -> ColumnState:
    """Return the column arrays of the particles `p[which]` as a `ColumnState` of views: pressures in Pa."""
    return ColumnState(p.excess_pore_pressure[which], p.column_memory[which], p.column_clipped[which])


def column_forcing(p, which: slice, columns: ColumnPhysics, entrained, entrained_ratio) -> ColumnForcing:
    """Return the forcing of some columns by one step of the flow.

    Parameters
    ----------
    p : Particles
    which : slice
    columns : ColumnPhysics
    entrained, entrained_ratio : ndarray, shape (n,)
        Soil that came in [m3] and its excess pore pressure over the liquefaction value [-].
    """
    load = p.liquefaction_pressure[which]
    bed_pressure, bases = entrained_ratio * load, columns.contact
    if columns.drained is not None:
        drained = columns.drained[p.nearest_node[which]]
        bed_pressure[drained] = 0.0
        bases = np.where(drained, BaseContact.PRESCRIBED, columns.contact).astype(np.int8)
    return ColumnForcing(
        volume=p.volume[which],
        thickness=p.thickness[which],
        liquefaction_pressure=load,
        entrained=entrained,
        bed_pressure=bed_pressure,
        base=bases,
        porosity_source=NO_SOURCE,
        coefficient_of_consolidation=columns.phases.coefficient_of_consolidation(p, which),
        water_to_buoyant=columns.water_to_buoyant,
        bounded=True,
    )


def present_profiles(p, which: slice, columns: ColumnPhysics):
    """Return the excess pore pressure of the columns of `p[which]` at levels now, (n, levels) [Pa]; change nothing."""
    state = ColumnState(*(values.copy() for values in column_state(p, which)))
    none = np.zeros(state.clipped.size)
    columns.law.synchronise(state, column_forcing(p, which, columns, none, none))
    return state.profile
