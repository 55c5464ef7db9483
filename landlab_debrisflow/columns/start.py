"""The profile from which `solve_column` starts: pressures, or a word."""

from typing import Any

import numpy as np

from ..core.hints import did_you_mean
from ..physics.column.initial import initial_profile
from .history import float_array, refuse

STARTS = ("zero", "linear", "uniform", "basal_layer")


def given_profile(given: dict[str, Any]) -> np.ndarray | None:
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
    array = np.zeros(levels) if isinstance(initial, str) else float_array(initial)
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


def profile_of_word(given: dict[str, Any], inputs: Any, pressure: np.ndarray) -> np.ndarray:
    """Return the profile [Pa] that `initial` names by a word, with `pressure` at the base [Pa]."""
    levels, shape = given["levels"], given["initial"]
    if inputs.loading[0] > 0.0:
        load = inputs.loading * inputs.thickness
    else:  # a load that no level exceeds; a power of two, so that the division loses no digit
        load = np.exp2(np.ceil(np.log2(np.maximum(np.abs(pressure), 1e-300))) + np.ceil(np.log2(levels)))
    profile = initial_profile(load, levels, pressure / load, shape, given["initial_layer_fraction"])
    profile[:, -1] = 0.0  # suction, too, is 0 at the surface
    return profile
