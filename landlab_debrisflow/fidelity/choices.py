"""Choices that need no pilot run of their own: column, steps, and a warning about phases; each with its rule."""

import dataclasses
import math
from collections.abc import Collection
from typing import Any, NamedTuple

import numpy as np

from ..model.numerics import PRESETS, Numerics
from ..physics.column.ale import ALE
from ..physics.column.none import NoExcessPressure
from ..physics.column_contracts import is_dilatant
from ..physics.erosion import NoErosion
from ..physics.registry import law_name
from ..scene.setup import Setup
from .constants import (
    FAST_TOLERANCE,
    FINE_COLUMN_RATIO,
    FINE_LEVELS,
    LEVELS,
    NO_PRESSURE_RATIO,
    PHASE_RATIO,
    STIFFNESS,
)
from .event import Event

BED_RATIO, SATURATION = "bed__excess_pore_pressure_ratio", "bed__degree_of_saturation"


class Choice(NamedTuple):
    """A choice and its reason.

    Attributes
    ----------
    value : object
        The chosen value.
    words : str
        The choice in words.
    rule : str
        Number and rule that it follows.
    """

    value: Any
    words: str
    rule: str


def choose_steps(numerics: Numerics, tolerance: float) -> Choice:
    """Choose the length of steps and the energy of rest.

    Parameters
    ----------
    numerics : Numerics
        Values that are not those of the standard preset are the user's, and stay.
    tolerance : float
        Tolerance of the plan [-].

    Returns
    -------
    Choice
        Of a `Numerics`.
    """
    own = {name for name, value in PRESETS["standard"].items() if getattr(numerics, name) != value}
    if own:
        rule = f"your own {', '.join(name for name in PRESETS['standard'] if name in own)} in numerics"
        return Choice(numerics, steps_words(numerics), rule)
    preset = "fast" if tolerance >= FAST_TOLERANCE else "standard"
    sign = ">=" if preset == "fast" else "<"
    values: dict[str, Any] = {"preset": preset} | PRESETS[preset]
    chosen = dataclasses.replace(numerics, **values)
    rule = f"tolerance {100.0 * tolerance:g} % {sign} {100.0 * FAST_TOLERANCE:g} %"
    return Choice(chosen, steps_words(chosen), rule)


def steps_words(numerics: Numerics) -> str:
    """Return preset, Courant numbers and rest energy of some numerics in words."""
    return (
        f"{numerics.preset}: Courant numbers {numerics.courant_number:g} and {numerics.advective_courant_number:g}, "
        f"rest energy {numerics.rest_energy:g}"
    )


def has_pressure(event: Event) -> bool:
    """Return whether body, inflow or a bed that may erode bring excess pore pressure, or suction."""
    setup, at = event.setup, event.grid.at_node
    material = setup.material
    if material.bearing_density == 0.0:
        return False
    released = event.release_depth.any() or any(line.pressure_ratio is None for line in setup.inflow)
    body = material.initial_pressure_ratio > 0.0 and released
    inflow = any(line.pressure_ratio is not None and any(line.pressure_ratio) for line in setup.inflow)
    ratio = at[BED_RATIO] if BED_RATIO in at else None  # noqa: SIM401  (Landlab's get finds nothing)
    wet = material.bed_pressure_ratio > 0.0 if ratio is None else bool(np.any(np.asarray(ratio) > 0.0))
    saturation = at[SATURATION] if SATURATION in at else material.bed_degree_of_saturation  # noqa: SIM401
    bed = wet or material.bed_loading_coefficient > 0.0 or bool(np.any(np.asarray(saturation) < 1.0))
    return bool(body or inflow or (erodes(event) and bed))


def erodes(event: Event) -> bool:
    """Return whether a flow may take up soil."""
    at = event.grid.at_node
    has_soil = "soil__depth" in at and bool(np.any(np.asarray(at["soil__depth"]) > 0.0))
    return has_soil and not isinstance(event.setup.erosion, NoErosion)


def choose_column(event: Event, time_ratio: float, hold: Collection[str]) -> Choice:
    """Choose the law of the column and its levels.

    Parameters
    ----------
    event : Event
        A column of its setup that is not the default is the user's, and stays.
    time_ratio : float
        T_c/T: consolidation time of the flow over its duration [-].
    hold : collection of str
        Quantities to be held.

    Returns
    -------
    Choice
        Of a column law.
    """
    setup = event.setup
    if setup.column != ALE():
        return Choice(setup.column, column_words(setup.column), "your own choice")
    number = f"T_c/T = {time_ratio:.3g}"
    none = NoExcessPressure()
    if setup.material.bearing_density == 0.0:
        return Choice(none, column_words(none), "there is no pore water")
    if not setup.two_phases and time_ratio <= NO_PRESSURE_RATIO and not has_pressure(event):
        return Choice(none, column_words(none), f"no pore pressure in body or bed, {number} <= {NO_PRESSURE_RATIO:g}")
    asked = [name for name in ("pressure", "deposit") if name in hold]
    if asked and time_ratio > FINE_COLUMN_RATIO:
        fine = ALE(levels=FINE_LEVELS)
        rule = f"{number} > {FINE_COLUMN_RATIO:g} and {' and '.join(asked)} asked for"
        return Choice(fine, column_words(fine), rule)
    usual = ALE(levels=LEVELS)
    return Choice(usual, column_words(usual), f"pore pressure moves with the grains; {number}")


def column_words(law: Any) -> str:
    """Return the name of a column law with its levels, and whether it has dilatancy."""
    name = law_name("column", law).split(".")[-1]
    details = ["dilatancy"] if is_dilatant(law) else []
    if "levels" in getattr(law, "__dataclass_fields__", {}):
        details.append(f"{law.levels} levels")
    return f"{name} with {' and '.join(details)}" if details else name


def consolidation_ratio(thickness: float, coefficient: float, duration: float) -> float:
    """Return T_c/T: thickness squared [m2] over coefficient of consolidation [m2 s-1] and duration [s], no unit."""
    return thickness**2 / (coefficient * duration) if coefficient * duration > 0.0 else math.inf


def start_coefficient(setup: Setup, thickness: float) -> float:
    """Return the coefficient of consolidation of the material, with dilatancy that of the start [m2 s-1].

    Parameters
    ----------
    setup : Setup
    thickness : float
        Thickness of the flow [m]; with dilatancy the coefficient is that under half its load.

    Returns
    -------
    float
    """
    material, dilatancy = setup.material, getattr(setup.column, "dilatancy", None)
    if dilatancy is None:
        return float(material.coefficient_of_consolidation)
    stress = 0.5 * material.buoyant_density * material.gravity * thickness
    return float(dilatancy.coefficient_of_consolidation(1.0 - material.porosity, stress))


def relaxation_time(setup: Setup, coefficient: float) -> float:
    """Return the relaxation time of the velocity between grains and water [s].

    Parameters
    ----------
    setup : Setup
    coefficient : float
        Coefficient of consolidation [m2 s-1]; not read with dilatancy, which has a permeability.

    Returns
    -------
    float
    """
    material, dilatancy = setup.material, getattr(setup.column, "dilatancy", None)
    if dilatancy is None:
        return coefficient / STIFFNESS
    grains, water = (1.0 - material.porosity) * material.solid_density, material.porosity * material.water_density
    conductivity = dilatancy.conductivity(1.0 - material.porosity)
    return float(grains * water / (grains + water) * conductivity / material.porosity**2)


def phase_warning(event: Event, thickness: float, coefficient: float) -> tuple[float, str]:
    """Return how far grains and water move apart, and a warning if one phase and two differ for it.

    Parameters
    ----------
    event : Event
    thickness : float
        Thickness of the flow [m].
    coefficient : float
        Coefficient of consolidation [m2 s-1].

    Returns
    -------
    ratio : float
        tau (g/h)^(1/2), relaxation time of the velocity between grains and water over the time of the flow [-].
    warning : str
        Empty if there is none.
    """
    setup = event.setup
    if not thickness > 0.0 or setup.material.bearing_density == 0.0:
        return 0.0, ""
    ratio = relaxation_time(setup, coefficient) * math.sqrt(setup.material.gravity / thickness)
    if ratio <= PHASE_RATIO:
        return ratio, ""
    bed = "; with an eroding bed they differ in any case" if erodes(event) else ""
    now, other = ("two phases", "one") if setup.two_phases else ("one phase", "two")
    return ratio, (
        f"the flow has {now}, as you chose: tau (g/h)^(1/2) = {ratio:.2g} > {PHASE_RATIO:g}, so {other} would give "
        f"another run-out (4 % at 0.11, 39 % at 1.1){bed}; which of them is right is physics, no particle helps"
    )
