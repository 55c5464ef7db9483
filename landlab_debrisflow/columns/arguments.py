"""Arguments of `solve_column`, checked: a refusal names the argument, the value given, the values allowed, a remedy."""

import dataclasses
from numbers import Real
from typing import Any, NamedTuple, NoReturn

import numpy as np

from ..core.checks import in_range
from ..core.errors import ParameterError
from ..core.hints import did_you_mean, give_number
from ..core.values import checked, derived
from ..physics.column import ALE, Classical, ConstantRatio
from ..physics.column.initial import initial_profile
from ..physics.column_contracts import BaseContact
from .declarations import CHOICES, NUMBERS, SINGLE_NUMBERS

ALLOWED = BaseContact.BY_EROSION, BaseContact.PRESCRIBED, BaseContact.IMPERMEABLE, BaseContact.DRAINED
BASE = {contact.name.lower(): contact for contact in ALLOWED}
STARTS = ("zero", "linear", "uniform", "basal_layer")


def refuse(message: str) -> NoReturn:
    """Raise ParameterError on behalf of `solve_column`."""
    raise ParameterError(f"solve_column: {message}")


class History:
    """An argument of `NUMBERS`, or "base": one per column, or a function of time [s], checked at every call."""

    def __init__(self, name: str, given: Any):
        self.name, self.given = name, given
        self.varies = callable(given) and (name == "base" or NUMBERS[name].metadata["timed"])
        self.value = self._read(given(0.0), " at t = 0 s") if self.varies else self._read(given)

    def spread(self, count: int) -> None:
        """Repeat a single value for every column, in place."""
        self.value = np.array(np.broadcast_to(self.value, (count,)))

    def at(self, time: float) -> np.ndarray:
        """Return the values at a time [s], shape (column,)."""
        if not self.varies:
            return self.value
        value, count = self._read(self.given(time), f" at t = {time:g} s"), self.value.size
        if value.size not in (1, count):
            shape = f"returned shape {value.shape} at t = {time:g} s"
            refuse(f"{self.name} {shape}; a function must return one number, or {count}, one per column, at every time")
        return np.array(np.broadcast_to(value, (count,)))

    def _read(self, value, when=""):
        if self.name == "base":
            return _contacts(value, when)
        return checked_numbers(self.name, NUMBERS[self.name], value, when)


def checked_numbers(
    name: str, argument: dataclasses.Field, value: Any, when: str = "", each: str = "column"
) -> np.ndarray:
    """Return `value`, one number or one for ``each``, as array (0 or 1 dimensions); else raise ParameterError.

    `argument` declares the argument `name`: unit, bounds, remedy. `when` is text on the time, for the message.
    """
    array = _float_array(derived(f"solve_column: {name}", value, meta := argument.metadata))
    if array is None or array.ndim > 1 or array.size == 0:
        got = f"{value!r}{give_number(value)}" if array is None else f"shape {array.shape}"
        refuse(f"{name} must be one number or one per {each}, got {got}{when}; {meta['remedy']}")
    low, high = meta["bounds"]
    in_range(
        f"solve_column: {name}", array, low, high, meta["unit"],
        lambda bad: f" for {each} {bad[0]}{when}" if array.ndim else when, meta["remedy"],
        open_ends=(meta["open_below"] or np.isinf(low), np.isinf(high)), form="g",
    )  # fmt: skip
    return array


def _float_array(value):
    """Return real numbers, one or a sequence, as an array of floats of that shape; None for anything else."""
    try:
        array = np.asarray(value)
    except ValueError:  # rows of different lengths
        return None
    return array.astype(float) if array.dtype.kind in "iuf" else None


def _contacts(value, when="") -> np.ndarray:
    words = np.asarray(value, dtype=object)
    bad = [word for word in words.flat if not isinstance(word, str) or word not in BASE]
    if bad or words.ndim > 1 or words.size == 0:
        got = f"{bad[0]!r}{did_you_mean(bad[0], BASE)}" if bad else f"shape {words.shape}"
        refuse(f"base must be one of {', '.join(BASE)}, or one of these per column; got {got}{when}")
    return np.array([BASE[word] for word in words.flat], np.int8).reshape(words.shape)


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
    for name in ("initial_layer_fraction", "step"):
        if given[name] is not None and checked_numbers(name, SINGLE_NUMBERS[name], given[name]).ndim:
            refuse(f"{name} must be one number, got {given[name]!r}")
    absent = [name for name in ("initial_pressure", "basal_pressure_ratio") if given[name] is None]
    histories = {name: History(name, given[name]) for name in NUMBERS if name not in absent}
    histories["base"] = History("base", given["base"])
    _refuse_contradictions(given, histories)
    law, profile = _checked_law(given, histories), _given_profile(given)
    shapes = {name: history.value.shape for name, history in histories.items()}
    if profile is not None:
        shapes["initial"] = profile.shape[:-1]
    count = _column_count({name: shape for name, shape in shapes.items() if shape})
    for history in histories.values():
        history.spread(count)
    value = {name: history.value for name, history in histories.items()}
    is_ratio = "basal_pressure_ratio" in histories
    inputs = Inputs(
        times, law, profile, value["thickness"], value["coefficient_of_consolidation"], value["loading"], np.empty(0),
        histories["entrainment_rate"], histories["divergence_rate"], histories["porosity_source"], histories["base"],
        histories["basal_pressure_ratio" if is_ratio else "basal_pressure"], is_ratio, given["bounded"], given["step"],
    )  # fmt: skip
    bed = inputs.bed_pressure(0.0, inputs.thickness)
    if profile is None:
        profile = _profile_of_word(given, inputs, value.get("initial_pressure", bed))
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
    if given["advance"] == "every_step" and given["tolerance"] is not None:
        refuse(f"tolerance is for advance='lazy' only, got {given['tolerance']!r} with 'every_step'; leave it None")


def _checked_law(given, histories):
    """Return the law, with its own checks of its parameters."""
    names = ("levels", "scheme", "bed_contact", "loading_source", "source_includes_erosion")
    parameters = {name: given[name] for name in names}
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


def _given_profile(given):
    """Return `initial` if it is an array, else None."""
    initial, levels = given["initial"], given["levels"]
    if isinstance(initial, str):
        if initial not in STARTS:
            hint = did_you_mean(initial, STARTS)
            refuse(f"initial must be one of {', '.join(STARTS)} or an array over levels [Pa]; got {initial!r}{hint}")
        if initial != "zero":
            return None
    if given["initial_pressure"] is not None:
        word = "'zero'" if isinstance(initial, str) else "an array"
        refuse(
            f"initial_pressure must be left None where initial is {word}, got {given['initial_pressure']!r}; "
            "it is for 'linear', 'uniform' and 'basal_layer'"
        )
    array = np.zeros(levels) if isinstance(initial, str) else _float_array(initial)
    if array is None or array.ndim not in (1, 2) or array.shape[-1] != levels or array.size == 0:
        got = repr(initial) if array is None else f"shape {array.shape}"
        refuse(
            f"initial must be one of {', '.join(STARTS)} or pressures [Pa] of shape ({levels},) or (column, {levels}) "
            f"as levels={levels}, index 0 at the base; got {got}"
        )
    if not np.isfinite(array).all():
        bad = tuple(int(index) for index in np.argwhere(~np.isfinite(array))[0])
        refuse(f"initial must be finite, got {array[bad]} at index {bad}")
    if (surface := array[..., -1][array[..., -1] != 0.0]).size:
        refuse(
            f"initial must be 0 Pa at the surface, the last level, got {surface[0]:g}; index 0 is the base: reverse it "
            "if it runs downward"
        )
    return array


def _profile_of_word(given, inputs, pressure) -> np.ndarray:
    """Return the profile [Pa] that `initial` names by a word, with `pressure` at the base [Pa]."""
    levels, shape = given["levels"], given["initial"]
    if inputs.loading[0] > 0.0:
        load = inputs.loading * inputs.thickness
    else:  # a load that no level exceeds; a power of two, so that the division loses no digit
        load = np.exp2(np.ceil(np.log2(np.maximum(np.abs(pressure), 1e-300))) + np.ceil(np.log2(levels)))
    profile = initial_profile(load, levels, pressure / load, shape, given["initial_layer_fraction"])
    profile[:, -1] = 0.0  # suction, too, is 0 at the surface
    return profile
