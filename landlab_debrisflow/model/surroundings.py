"""Inputs of a call that the stages of a step read: the bed, its walls, and the laws at the base."""

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from ..physics.column_contracts import is_dilatant
from ..physics.contracts import is_jump_condition
from ..spatial.raster import CLOSED, Raster
from ..terrain.bed import Bed
from .basal import BasalLaw, weighing_on
from .column_forcing import BY_EROSION, SOIL_ALONE, ColumnPhysics
from .step_rule import StepRule, step_rule


class Surroundings(NamedTuple):
    """Bed of a call and laws on it; replaced as a whole by the next call.

    Attributes
    ----------
    bed : Bed
        Ground below the flow.
    walls : Raster or None
        Raster with closed nodes; None where no node is closed.
    friction : BasalLaw
        Law of friction.
    erosion : BasalLaw
        Law of erosion.
    columns : ColumnPhysics
        Law of the columns.
    step_rule : StepRule
        Bounds of the length of a step.
    """

    bed: Bed
    walls: Raster | None
    friction: BasalLaw
    erosion: BasalLaw
    columns: ColumnPhysics
    step_rule: StepRule


def surround(setup, phases, bed: Bed, parameters: Mapping[str, Any]) -> Surroundings:
    """Return the surroundings of a flow on a bed.

    Parameters
    ----------
    setup : Setup
        Laws, material and numerics.
    phases : Phases
        Stages of a step that depend on the number of phases.
    bed : Bed
        Ground below the flow.
    parameters : mapping of str to NamedTuple
        Parameters of the laws of friction and erosion (`core.parameters.on_nodes`).
    """
    material, numerics, raster = setup.material, setup.numerics, bed.raster
    friction, erosion = (
        BasalLaw(
            law=law,
            parameters=parameters[kind],
            material=material,
            weighing=weighing_on(material, raster.spacing),
            variables=getattr(law, "variables", ()),
            varies=any(values.size > 1 for values in parameters[kind]),
            dilatant_column=setup.column if is_dilatant(setup.column) else None,
        )
        for kind, law in (("friction", setup.friction), ("erosion", setup.erosion))
    )
    contact = SOIL_ALONE if is_jump_condition(erosion.law) else BY_EROSION
    water_to_buoyant = material.bearing_density / material.buoyant_density
    # pore pressure of a bed with air in its pores is the part S of hydrostatic pressure, where a drain takes the excess
    drain_ratio = np.zeros(1) if bed.saturation is None else (bed.saturation - 1.0) * water_to_buoyant
    return Surroundings(
        bed=bed,
        walls=raster if np.any(raster.status == CLOSED) else None,
        friction=friction,
        erosion=erosion,
        columns=ColumnPhysics(
            setup.column, material, phases, bed.drained, water_to_buoyant, raster.spacing, contact, drain_ratio
        ),
        step_rule=step_rule(numerics, raster.spacing),
    )
