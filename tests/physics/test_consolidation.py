"""A coefficient of consolidation follows from permeability, viscosity and stiffness, wherever a number will do."""

import copy
import pickle

import pytest
from landlab.bmi import wrap_as_bmi

from landlab_debrisflow import DebrisFlow, Material, ParameterError, solve_column
from landlab_debrisflow.core.derived_number import DerivedNumber
from landlab_debrisflow.laws import Consolidation
from landlab_debrisflow.run.scene import Scene
from landlab_debrisflow.scene.schema import scene_schema
from validation.grids import COARSE, inclined, release_slab

SAND = {"permeability": 5e-9, "pore_fluid_viscosity": 0.005, "stiffness": 5e5}
C_V = 5e-9 / 0.005 * 5e5


def test_by_hand():
    """1e-12 m2 of water, 1e-3 Pa s, is a conductivity of 9.81e-6 m/s; with 4 kPa, c_v is 4e-6 m2/s."""
    found = Consolidation(permeability=1e-12, pore_fluid_viscosity=1e-3, stiffness=4e3).value
    assert found == pytest.approx(9.81e-6 * 4e3 / 9810.0, rel=1e-14) == pytest.approx(4e-6, rel=1e-14)


def test_a_material_keeps_number_and_source():
    for given in (SAND, Consolidation(**SAND)):
        number = Material(coefficient_of_consolidation=given).coefficient_of_consolidation
        for same in (number, copy.deepcopy(number), pickle.loads(pickle.dumps(number))):
            assert same == C_V and isinstance(same, DerivedNumber) and same.parameters == SAND
    assert Material(coefficient_of_consolidation=SAND) == Material(coefficient_of_consolidation=C_V)


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({}, ("not given: permeability, pore_fluid_viscosity, stiffness", "[m2 s-1]")),
        ({"permeability": 1e-12, "stiffness": 1e5}, ("not given: pore_fluid_viscosity", "stiffness [Pa]")),
        (SAND | {"compressibility": 2e-6}, ("unknown key 'compressibility'", "stiffness [Pa]")),
        ({"permeabilty": 1e-12}, ("did you mean 'permeability'",)),
        (SAND | {"stiffness": 0.0}, ("stiffness must lie in", "got 0.0")),
        (SAND | {"stiffness": "5e5"}, ("without quotes",)),
        (SAND | {"permeability": float("nan")}, ("permeability must lie in", "nan")),
        (SAND | {"permeability": [1e-9]}, ("permeability must be a number [m2]",)),
        ({"permeability": 1e-3, "pore_fluid_viscosity": 1e-5, "stiffness": 1e12}, ("[0, 1e+06] m2 s-1",)),
        ("soft", ("or a mapping of permeability, pore_fluid_viscosity, stiffness", "got 'soft'")),
    ],
)
def test_refusals(given, words):
    with pytest.raises(ParameterError) as refusal:
        Material(coefficient_of_consolidation=given)
    message = str(refusal.value)
    assert "Material: coefficient_of_consolidation" in message and all(word in message for word in words), message


def test_columns_take_it_too():
    column = solve_column(coefficient_of_consolidation=SAND, entrainment_rate=0.0, thickness=2.0, times=[1.0])
    assert column.consolidation_time.values == pytest.approx(8.0)  # 2^2/0.5
    with pytest.raises(ParameterError, match=r"solve_column: coefficient_of_consolidation: .*not given: stiffness"):
        solve_column(coefficient_of_consolidation={"permeability": 1e-9, "pore_fluid_viscosity": 1.0}, times=[1.0])


@pytest.mark.slow
def test_a_flow_is_that_of_the_number():
    ends = []
    for given in (SAND, C_V):
        grid = inclined((15, 40), 5.0, 0.4)
        release_slab(grid, (40.0, 35.0), 20.0, 1.0)
        flow = DebrisFlow(grid, material={"coefficient_of_consolidation": given}, numerics=COARSE)
        flow.run_one_step(2.0)
        ends.append(flow.particles)
        assert flow.maps.attrs["material_coefficient_of_consolidation"] == C_V
    assert ends[0].equals(ends[1])


YAML = """
grid:
  RasterModelGrid:
  - [15, 30]
  - xy_spacing: 5.0
  - fields:
      node:
        topographic__elevation:
          constant:
          - value: 0.0
clock: {start: 0.0, stop: 10.0, step: 1.0}
debris_flow:
  material:
    coefficient_of_consolidation: {permeability: 5.0e-9, pore_fluid_viscosity: 0.005, stiffness: 5.0e+5}
"""


@pytest.mark.slow
def test_bmi():
    model = wrap_as_bmi(DebrisFlow)()
    model.initialize(YAML)
    assert model._base.setup.material.coefficient_of_consolidation == C_V


def test_scenes_and_their_schema(tmp_path):
    path = tmp_path / "scene.yaml"
    path.write_text(
        "terrain: {example: gully}\nmaterial:\n  coefficient_of_consolidation:\n    permeability: 5e-9\n"
        "    pore_fluid_viscosity: 0.005\n    stiffness: 5e5\n", encoding="utf-8",
    )  # fmt: skip
    scene = Scene.from_file(path)
    assert scene.setup.material.coefficient_of_consolidation == C_V
    assert scene.to_mapping()["material"]["coefficient_of_consolidation"] == SAND
    forms = scene_schema()["$defs"]["material"]["properties"]["coefficient_of_consolidation"]["anyOf"]
    assert [form["type"] for form in forms] == ["number", "object"] and forms[1]["required"] == list(SAND)
