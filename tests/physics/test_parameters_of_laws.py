"""All that a law of friction or erosion reads of its own parameters stands in `state.parameters`."""

import ast
import dataclasses
import inspect
import pickle
import textwrap
from copy import deepcopy

import numpy as np
import pytest

from landlab_debrisflow.core.parameters import on_nodes
from landlab_debrisflow.physics.friction import Coulomb
from landlab_debrisflow.physics.friction.coulomb import SHEAR_AT_BASE
from landlab_debrisflow.physics.registry import LAWS, METHOD

ALL = [(kind, law) for kind in ("friction", "erosion") for law in LAWS[kind].values()]
NODES = np.linspace(1.0, 2.0, 6)


@pytest.mark.parametrize(("kind", "law"), ALL)
def test_a_law_reads_nothing_of_itself(kind, law):
    source = textwrap.dedent(inspect.getsource(getattr(law, METHOD[kind])))
    names = [node.id for node in ast.walk(ast.parse(source)) if isinstance(node, ast.Name)]
    assert "self" not in names


@pytest.mark.parametrize(("kind", "law"), ALL)
def test_every_number_is_there_in_si_units(kind, law):
    fields = {field.name: field for field in dataclasses.fields(law)}
    numeric = [name for name, field in fields.items() if field.metadata["kind"] is float]
    here = on_nodes(law(), {})
    assert list(here._fields) == numeric
    for name, values in zip(numeric, here, strict=True):
        factor = np.pi / 180.0 if fields[name].metadata["unit"] == "deg" else 1.0
        assert values.shape == (1,) and values.dtype == float
        assert values[0] == pytest.approx(fields[name].default * factor, rel=1e-15)


@pytest.mark.parametrize("given", [NODES, "some__cohesion"])
def test_they_pickle_and_are_copied(given):
    here = on_nodes(Coulomb(cohesion=given, velocity_profile="parabolic"), {"some__cohesion": NODES})
    for again in (pickle.loads(pickle.dumps(here)), deepcopy(here)):
        assert type(again) is type(here) and again._fields == here._fields
        assert again.velocity_profile == SHEAR_AT_BASE["parabolic"]
        for one, other in zip(again, here, strict=True):
            np.testing.assert_array_equal(one, other)
    assert type(here) is not type(on_nodes(Coulomb(), {}))  # whose profile is another


def test_what_is_not_declared_has_none():
    assert on_nodes(object(), {}) == () and pickle.loads(pickle.dumps(on_nodes(object(), {}))) == ()
