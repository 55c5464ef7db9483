"""Coordinates as nested lists become tuples of floats, or are refused with the place in them."""

import numpy as np
import pytest

from landlab_debrisflow.core.coordinates import checked_coordinates
from landlab_debrisflow.core.errors import ParameterError

LINE = ((0.0, 1.0), (2.0, 3.0))


@pytest.mark.parametrize(
    ("form", "named", "value", "found"),
    [
        ("points", False, [0, 1], ((0.0, 1.0),)), ("points", False, [[0, 1], [2, 3]], LINE),
        ("points", False, np.array([[0, 1], [2, 3]]), LINE), ("points", False, np.array([0.0, 1.0]), ((0.0, 1.0),)),
        ("points", True, {"a": [0, 1]}, (("a", (0.0, 1.0)),)), ("points", True, [[0, 1]], (("1", (0.0, 1.0)),)),
        ("lines", False, [[0, 1], [2, 3]], (LINE,)), ("lines", False, [[[0, 1], [2, 3]]] * 2, (LINE, LINE)),
        ("lines", True, {"a": [[0, 1], [2, 3]]}, (("a", LINE),)), ("lines", True, (("a", LINE),), (("a", LINE),)),
        ("table", False, [[0, 1], [2, 3]], LINE),
        ("polygons", False, [[0, 1], [2, 3], [4, 5]], ((*LINE, (4.0, 5.0)),)),
    ],
)  # fmt: skip
def test_forms(form, named, value, found):
    assert checked_coordinates("key", value, form, named) == found


@pytest.mark.parametrize(
    ("form", "value", "words"),
    [
        ("points", 3, "key must be the name of a file or a point"), ("points", [], "key must be two numbers|empty"),
        ("points", [1], "two numbers in brackets"), ("points", [1, 2, 3], "two numbers in brackets"),
        ("points", [[1, 2], [3]], r"key\[1\] must be two numbers"),
        ("points", [[1, 2], 3], r"key\[1\] must be a point"),
        ("points", [1, "2"], "two finite numbers, got '2'; give the number"), ("points", [1, True], "got True"),
        ("points", [1, np.nan], "got nan"), ("points", [1, 10**400], "two finite numbers"),
        ("points", [1, None], "None"),
        ("points", [1, [2]], r"got \[2\]"), ("points", {"a": [1, 2]}, "must be the name of a file"),
        ("lines", [[0, 1]], "at least 2 pairs, got 1"), ("lines", [], "at least 2 pairs|two numbers|empty"),
        ("lines", [[[0, 1], [2, 3]], [[0, 1]]], r"key\[1\] must have at least 2 pairs"),
        ("lines", [[[0, 1], [2, 3]], 7], r"key\[1\] must be a line"),
        ("polygons", [[0, 1], [2, 3]], "at least 3 pairs"),
        ("table", [[0, 1], [2]], r"key\[1\] must be two numbers"), ("lines", [[[[0]]]], "two numbers in brackets"),
        ("points", "", "must be the name of a file"), ("points", np.array(3.0), "must be the name of a file"),
    ],
)  # fmt: skip
def test_refusals(form, value, words):
    with pytest.raises(ParameterError, match=words):
        checked_coordinates("key", value, form)


def test_names():
    for value, words in (({}, "has no entry"), ({3: [1, 2]}, "names must be words"), ({" ": [1, 2]}, "must be words")):
        with pytest.raises(ParameterError, match=words):
            checked_coordinates("key", value, "points", named=True)
