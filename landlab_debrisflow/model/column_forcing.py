"""The pore-pressure columns above the base of the flow: their arrays, and their forcing by a step."""

from typing import Any, NamedTuple

import numpy as np

from ..physics.column_contracts import BaseContact, ColumnForcing, ColumnLaw, ColumnState, Shearing, is_dilatant
from ..physics.contracts import Phases
from .basal import BedLoad, press_on_bed, shear_per_speed, weighing_on

BY_EROSION = np.array([BaseContact.BY_EROSION], np.int8)
"""Contact at the base of columns where nothing is drained."""

SOIL_ALONE = np.array([BaseContact.INFLOW], np.int8)
"""The same over a bed whose stress is not that of the flow: soil brings its own pressure, and nothing else comes in."""

NO_SOURCE = np.zeros(1)
"""Pressure by a change of porosity [Pa s-1]: one phase has none."""


PER_COLUMN = ColumnForcing._fields[: ColumnForcing._fields.index("water_to_buoyant")]
"""Members of a `ColumnForcing` that may have a number for each column."""


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
        Where a drain holds the excess pore pressure at `drain_ratio`; None: nowhere.
    water_to_buoyant : float
        Density of water over buoyant density [-].
    spacing : float
        Smaller node spacing of the raster [m].
    contact : ndarray of int8, shape (1,)
        Contact at the base of columns where nothing is drained, `BY_EROSION` or `SOIL_ALONE`.
    drain_ratio : ndarray, shape (nodes,) or (1,)
        Excess pore pressure over its liquefaction value that drains hold: 0, or less where pores of the bed hold air
        [-].
    """

    law: ColumnLaw
    material: Any
    phases: Phases
    drained: Any
    water_to_buoyant: float
    spacing: float
    contact: np.ndarray
    drain_ratio: np.ndarray


def column_state(p, which: slice) -> ColumnState:
    """Return the column arrays of the particles `p[which]` as a `ColumnState` of views: pressures in Pa."""
    fractions = getattr(p, "solid_fraction", None)
    fractions = None if fractions is None else fractions[which]
    return ColumnState(p.excess_pore_pressure[which], p.column_memory[which], p.column_clipped[which], fractions)


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
        nodes, ratio = p.nearest_node[which], columns.drain_ratio
        drained = columns.drained[nodes]
        bed_pressure[drained] = (ratio if ratio.size == 1 else ratio[nodes[drained]]) * load[drained]
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
        shearing=_shearing(p, which, columns) if is_dilatant(columns.law) else None,
    )


def forcing_of(forcing: ColumnForcing, which: slice) -> ColumnForcing:
    """Return the part of a forcing that belongs to the columns at `which`; numbers of all columns stay as they are."""
    if which.stop - which.start == forcing.volume.size:
        return forcing

    def part(value):
        return value[which] if isinstance(value, np.ndarray) and value.size > 1 else value

    shearing = None if forcing.shearing is None else Shearing(*map(part, forcing.shearing))
    return forcing._replace(shearing=shearing, **{name: part(getattr(forcing, name)) for name in PER_COLUMN})


def _shearing(p, which: slice, columns: ColumnPhysics) -> Shearing:
    """Return the shear of the columns of `p[which]` by the flow as it moves now."""
    material = columns.material
    thickness, density = p.thickness[which], p.density[which]
    weight = BedLoad(thickness=thickness, density=density, pressure=np.zeros(thickness.size))
    speed, _, load = press_on_bed(
        which.start or 0, p.velocity, p.curvature, p.cos_slope, weight, weighing_on(material, columns.spacing)
    )  # fmt: skip
    return shearing_of(material, speed * shear_per_speed(thickness, material), load)


def shearing_of(material, rate, load) -> Shearing:
    """Return the `Shearing` of debris of a material, of `rate` [s-1] under `load` [Pa], each (n,)."""
    return Shearing(
        rate=rate, load=load, start_solid_fraction=1.0 - material.porosity,
        soil_solid_fraction=1.0 - material.soil_porosity, solid_density=material.solid_density,
    )  # fmt: skip


def present_profiles(p, which: slice, columns: ColumnPhysics):
    """Return the excess pore pressure of the columns of `p[which]` at levels now, (n, levels) [Pa]; change nothing."""
    state = column_state(p, which).copy()
    none = np.zeros(state.clipped.size)
    columns.law.synchronise(state, column_forcing(p, which, columns, none, none))
    return state.profile
