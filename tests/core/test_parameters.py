"""Parameters are declared once, checked when a law is built, and given to kernels in SI units."""

import dataclasses
import math

import numpy as np
import pytest

from landlab_debrisflow.core.errors import ParameterError
from landlab_debrisflow.core.parameters import declared, on_nodes, parameter
from landlab_debrisflow.core.values import from_mapping


@declared
class Sledge:
    angle: float = parameter("deg", "angle of the runners", 30.0, (0.0, 90.0))
    bells: int = parameter("-", "number of bells", 2, (0, 10), kind=int)
    load: float | None = parameter("kg", "load, if any", None, (0.0, None))
    painted: bool = parameter("-", "painted or not", False, kind=bool)
    wood: str = parameter("-", "kind of wood", "ash", choices=("ash", "beech"))

    def _agree(self):
        if self.load is not None and self.load > 100.0 * self.bells:
            raise ParameterError("Sledge: load needs one bell per 100 kg")


def test_values_are_kept_in_their_declared_type():
    sledge = Sledge(angle=np.int64(45), bells=np.int32(3), load=np.float32(2.5))
    assert (sledge.angle, sledge.bells, sledge.load) == (45.0, 3, 2.5)
    assert type(sledge.angle) is float and type(sledge.bells) is int and type(sledge.load) is float


def test_kernels_read_si_units():
    si = on_nodes(Sledge(angle=90.0, bells=3), {})
    assert si.angle == math.pi / 2  # degrees become radians
    assert si.bells == 3
    assert not hasattr(si, "load")  # "not set" and words are no numbers
    assert not hasattr(si, "wood")


def test_a_law_is_frozen_and_keyword_only():
    with pytest.raises(dataclasses.FrozenInstanceError):
        Sledge().angle = 1.0
    with pytest.raises(TypeError):
        Sledge(30.0)
    assert Sledge() == Sledge(angle=30) and hash(Sledge()) == hash(Sledge())


@pytest.mark.parametrize("bound", [0.0, 90.0])
def test_bounds_are_included(bound):
    assert Sledge(angle=bound).angle == bound


@pytest.mark.parametrize(
    ("key", "value", "words"),
    [
        ("angle", -1.0, ("[0, 90] deg", "-1.0")),
        ("angle", np.nextafter(90.0, 100.0), ("[0, 90] deg",)),
        ("angle", math.nan, ("[0, 90] deg", "nan")),
        ("angle", -math.inf, ("[0, 90] deg", "-inf")),
        ("load", math.inf, ("[0, inf] kg", "inf")),
        ("angle", "30", ("a number", "deg", "'30'")),
        ("angle", "30 deg", ("a number", "'30 deg'", "give the number 30 alone")),
        ("angle", True, ("a number", "True")),
        ("angle", None, ("a number", "None")),
        ("angle", [30.0], ("a number", "[30.0]")),
        ("angle", 1j, ("a number",)),
        ("bells", 2.0, ("an integer", "2.0")),
        ("bells", 11, ("[0, 10]", "11")),
        ("bells", 2**64, ("[0, 10]", "1.8446744073709552e+19")),
        ("bells", False, ("an integer", "False")),
        ("painted", 1, ("true or false", "1")),
        ("wood", "oak", ("ash, beech", "'oak'")),
        ("wood", None, ("ash, beech", "None")),
    ],
)
def test_what_is_refused_says_why(key, value, words):
    with pytest.raises(ParameterError) as refusal:
        Sledge(**{key: value})
    message = str(refusal.value)
    assert message.startswith(f"Sledge: {key} must")
    for word in words:
        assert word in message


def test_parameters_can_be_checked_together():
    with pytest.raises(ParameterError, match="one bell per 100 kg"):
        Sledge(load=201.0)
    assert Sledge(load=200.0).load == 200.0


def test_unknown_keys_list_the_legal_ones_with_units():
    with pytest.raises(ParameterError) as refusal:
        from_mapping(Sledge, {"angel": 30.0})
    for words in ("Sledge: unknown key 'angel'", "angle [deg]", "load [kg]", "bells [-]"):
        assert words in str(refusal.value)


def test_a_law_without_parameters_says_so():
    @declared
    class Nothing:
        pass

    with pytest.raises(ParameterError, match="allowed: none"):
        from_mapping(Nothing, {"angle": 1.0})
