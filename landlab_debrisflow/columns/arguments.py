"""Arguments of `solve_column`, checked: a refusal names the argument, the value given, the values allowed, a remedy."""

import dataclasses
from numbers import Real
from typing import Any, NamedTuple, cast

import numpy as np

from ..core.values import checked
from ..physics.column import ALE, Classical, ConstantRatio
from .declarations import CHOICES, NUMBERS, SINGLE_NUMBERS
from .dilatancy import refuse_contradictions
from .history import History, checked_numbers, refuse
from .start import given_profile, profile_of_word


class Inputs(NamedTuple):
    """Arguments of `solve_column`, checked and spread over n columns.

    Attributes
    ----------
    times : ndarray, shape (times,)
        Times of output [s].
    law : ColumnLaw
        Law of the columns.
    profile : ndarray, shape (n, levels)
        Excess pore pressure at time 0 [Pa].
    thickness : ndarray, shape (n,)
        Slope-normal thickness at time 0 [m].
    coefficient_of_consolidation : ndarray, shape (n,)
        c_v [m2 s-1].
    loading : ndarray, shape (n,)
        Liquefaction pressure over thickness [Pa m-1]; all 0 or all > 0.
    pressure_scale : ndarray, shape (n,)
        Stands for the liquefaction pressure where there is no loading [Pa].
    entrainment_rate : History
        Slope-normal [m s-1].
    divergence_rate : History
        Rate at which divergence thins the column, over its thickness [s-1].
    porosity_source : History
        Pressure made by a change of porosity [Pa s-1].
    base : History
        Values of `BASE`.
    bed : History
        Pressure [Pa], or ratio [-], of the bed.
    bed_is_ratio : bool
        Whether `bed` is a ratio.
    shear_rate : History
        Read by a law with dilatancy [s-1].
    solid_fraction : ndarray, shape (n,), or None
        At time 0, of a law with dilatancy [-].
    soil_solid_fraction : float or None
        Of the soil that comes in [-]; None: that of the columns at time 0.
    solid_density : float
        Of the grains [kg m-3].
    bounded : bool
        Whether pressure is kept between suction and liquefaction.
    step : float or None
        Longest step asked for [s]; None: the choice of the solver.
    """

    times: np.ndarray
    law: Any
    profile: np.ndarray
    thickness: np.ndarray
    coefficient_of_consolidation: np.ndarray
    loading: np.ndarray
    pressure_scale: np.ndarray
    entrainment_rate: History
    divergence_rate: History
    porosity_source: History
    base: History
    bed: History
    bed_is_ratio: bool
    shear_rate: History
    solid_fraction: np.ndarray | None
    soil_solid_fraction: float | None
    solid_density: float
    bounded: bool
    step: float | None

    def liquefaction_pressure(self, thickness: np.ndarray) -> np.ndarray:
        """Return the load at the base [Pa]."""
        return self.loading * thickness if self.loading[0] > 0.0 else self.pressure_scale

    def bed_pressure(self, time: float, thickness: np.ndarray) -> np.ndarray:
        """Return the pressure of the bed [Pa]."""
        return self.bed.at(time) * (self.loading * thickness if self.bed_is_ratio else 1.0)


def read_inputs(given: dict[str, Any]) -> Inputs:
    """Check the arguments of `solve_column`, by name.

    Raises
    ------
    ParameterError
        If one is not usable, or two do not go together.
    """
    times = _times(given["times"])
    for name, argument in CHOICES.items():
        given[name] = checked("solve_column", name, argument, given[name])
    for name in ("initial_layer_fraction", "step", "soil_solid_fraction", "solid_density"):
        declared = SINGLE_NUMBERS[name]
        left_out = given[name] is None and declared.default is None
        if not left_out and checked_numbers(name, declared, given[name]).ndim:
            refuse(f"{name} must be one number, got {given[name]!r}")
    usual, unused = "coefficient_of_consolidation", "solid_fraction"
    if given["dilatancy"] is not None:
        usual, unused = unused, usual
    if given[usual] is None:
        given[usual] = NUMBERS[usual].default
    absent = [name for name in ("initial_pressure", "basal_pressure_ratio", unused) if given[name] is None]
    histories = {name: History(name, given[name]) for name in NUMBERS if name not in absent}
    histories["base"] = History("base", given["base"])
    _refuse_contradictions(given, histories)
    law, profile = _checked_law(given, histories), cast(Any, given_profile(given))
    shapes = {name: history.value.shape for name, history in histories.items()}
    if profile is not None:
        shapes["initial"] = profile.shape[:-1]
    count = _column_count({name: shape for name, shape in shapes.items() if shape})
    for history in histories.values():
        history.spread(count)
    value = {name: history.value for name, history in histories.items()}
    is_ratio = "basal_pressure_ratio" in histories
    inputs = Inputs(
        times, law, profile, value["thickness"], value.get("coefficient_of_consolidation", np.zeros(count)),
        value["loading"], np.empty(0),
        histories["entrainment_rate"], histories["divergence_rate"], histories["porosity_source"], histories["base"],
        histories["basal_pressure_ratio" if is_ratio else "basal_pressure"], is_ratio,
        histories["shear_rate"], value.get("solid_fraction"), given["soil_solid_fraction"], given["solid_density"],
        given["bounded"], given["step"],
    )  # fmt: skip
    bed = inputs.bed_pressure(0.0, inputs.thickness)
    if profile is None:
        profile = profile_of_word(given, inputs, value.get("initial_pressure", bed))
    profile = np.array(np.broadcast_to(profile, (count, given["levels"])))
    scale = np.maximum(np.abs(bed), np.abs(profile).max(axis=1))
    return inputs._replace(profile=profile, pressure_scale=np.where(scale > 0.0, scale, 1.0))


def _times(times) -> np.ndarray:
    if times is None:
        remedy = SINGLE_NUMBERS["times"].metadata["remedy"]
        refuse(f"times is missing: give the times of output [s], increasing and >= 0; {remedy}")
    times = np.atleast_1d(checked_numbers("times", SINGLE_NUMBERS["times"], times, each="output"))
    bad = np.flatnonzero(np.diff(times) <= 0.0)
    if bad.size:
        one, other = times[bad[0] : bad[0] + 2]
        refuse(f"times must increase, got {one:g} s and then {other:g} s for output {bad[0] + 1}; use np.unique(times)")
    return times


def _refuse_contradictions(given, histories) -> None:
    """Refuse arguments that contradict each other."""
    loading, ratio = histories["loading"].value, given["basal_pressure_ratio"]
    if loading.any() != loading.all():
        refuse(f"loading must be 0 in all columns or > 0 in all, got {loading}; solve the two kinds one by one")
    needs = {
        "bounded=True": given["bounded"],
        "basal_pressure_ratio": ratio is not None,
        "loading_source='proportional'": given["loading_source"] == "proportional",
        "source_includes_erosion=True": given["source_includes_erosion"] is True,
        "law='constant_ratio'": given["law"] == "constant_ratio",
    }
    for argument, asked in needs.items():
        if asked and not loading.any():
            refuse(f"{argument} needs loading > 0 Pa m-1, got loading=0; give loading=rho' g cos(theta)")
    if ratio is not None and not (isinstance(given["basal_pressure"], Real) and given["basal_pressure"] == 1.0):
        refuse(
            f"basal_pressure must be left out where basal_pressure_ratio is given, got {given['basal_pressure']!r}; "
            "the bed pressure is then ratio times loading times thickness"
        )
    if given["law"] == "constant_ratio" and (callable(ratio) or np.size(ratio) != 1 or ratio is None):
        refuse(f"law='constant_ratio' needs basal_pressure_ratio as one number in [0, 1], got {ratio!r}")
    if given["source_includes_erosion"] is True and given["loading_source"] != "overburden":
        refuse(f"source_includes_erosion needs loading_source='overburden', got {given['loading_source']!r}")
    refuse_contradictions(given, histories)
    if given["advance"] == "every_step" and given["tolerance"] is not None:
        refuse(f"tolerance is for advance='lazy' only, got {given['tolerance']!r} with 'every_step'; leave it None")


def _checked_law(given, histories):
    """Return the law, with its own checks of its parameters."""
    names = ("levels", "scheme", "bed_contact", "loading_source", "source_includes_erosion")
    parameters = {name: given[name] for name in names}
    if given["dilatancy"] is not None:  # whose columns are advanced in every step
        return ALE(**parameters, tolerance=given["tolerance"], dilatancy=given["dilatancy"])
    if given["advance"] == "every_step" or given["tolerance"] is not None:
        parameters["tolerance"] = 0.0 if given["advance"] == "every_step" else given["tolerance"]
    # a constant ratio has no such parameters: ALE checks them
    law = (Classical if given["law"] == "classical" else ALE)(**parameters)
    if given["law"] == "constant_ratio":
        return ConstantRatio(ratio=float(histories["basal_pressure_ratio"].value.item()))
    return law if histories["loading"].value.any() else dataclasses.replace(law, loading_source="none")


def _column_count(shapes) -> int:
    """Return the number of columns."""
    counts = {shape[0] for shape in shapes.values()} - {1}
    if len(counts) > 1:
        each = ", ".join(f"{name} {shape}" for name, shape in shapes.items())
        refuse(f"arguments of different numbers of columns: {each}; give each one number, or one per column")
    return counts.pop() if counts else 1
