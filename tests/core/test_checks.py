"""Values out of an allowed interval are refused in one place, with the words that belong to each."""

import numpy as np
import pytest

from landlab_debrisflow import Material, Numerics
from landlab_debrisflow.core.checks import in_range, require
from landlab_debrisflow.core.errors import InputError, ParameterError

AT = {"where": lambda bad: f" at place {bad[0]}, the first of {bad.size}"}


@pytest.mark.parametrize("value", [0.0, 1, np.float64(0.5), np.array([0.0, 1.0]), np.array([]), [0.5, 0.5]])
def test_what_lies_inside_passes(value):
    in_range("ratio", value, 0.0, 1.0)
    in_range("ratio", value)


@pytest.mark.parametrize(
    ("values", "keywords", "words"),
    [
        (2, {}, "ratio must lie in [0, 1], got 2"),
        (np.nan, {"unit": "m"}, "ratio must lie in [0, 1] m, got nan"),
        (0.0, {"open_ends": (True, False)}, "ratio must lie in (0, 1], got 0.0"),
        (1.0, {"open_ends": (True, True), "remedy": "give less"}, "ratio must lie in (0, 1), got 1.0; give less"),
        (np.array([0.5, 2.0, -3.0]), AT, "ratio must lie in [0, 1], got 2.0 at place 1, the first of 2"),
        (np.array([0.5, 2.0, -3.0]), AT | {"form": "g"}, "ratio must lie in [0, 1], got 2 at place 1, the first of 2"),
        (np.array([9.0, np.nan]), AT | {"ignored": np.array([True, False])},
         "ratio must lie in [0, 1], got nan at place 1, the first of 1"),
        (np.array([0.5, 0.6]), {"refused": np.array([False, True])}, "ratio must lie in [0, 1], got 0.6"),
        (np.array(2.0), {"form": "g", "where": " now"}, "ratio must lie in [0, 1], got 2 now"),
    ],
)  # fmt: skip
def test_what_does_not_is_told(values, keywords, words):
    with pytest.raises(ParameterError) as refusal:
        in_range("ratio", values, 0.0, 1.0, **keywords)
    assert str(refusal.value) == words


@pytest.mark.parametrize("value", [np.inf, -np.inf, np.nan])
def test_what_is_not_finite_lies_nowhere(value):
    with pytest.raises(InputError, match=r"ratio must lie in \[-inf, inf\], got"):
        in_range("ratio", value, error=InputError)


def test_a_condition_for_all_tells_what_was_given():
    require(True, "slopes", "be three angles", (1.0, 2.0))
    with pytest.raises(ParameterError, match=r"^slopes must be three angles, got \(1.0, 2.0\)$"):
        require(False, "slopes", "be three angles", (1.0, 2.0))


def test_an_enormous_integer_is_refused_like_any_number():
    for cls, name in ((Numerics, "particle_count"), (Numerics, "threads"), (Material, "gravity")):
        with pytest.raises(ParameterError, match=f"{name} must lie in"):
            cls(**{name: 10**400})
