"""Laws and materials that do not go together are refused: which two, the value, and which one to leave out."""

import pytest

from landlab_debrisflow import Material, ParameterError, Setup

DILATANT = {"column": {"law": "ale", "dilatancy": {}}}
SAND = {"permeability": 1e-9, "pore_fluid_viscosity": 1e-3, "stiffness": 1e5}


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"flow": "two_phase"}, "dilatancy goes with one phase"),
        ({"material": {"coefficient_of_consolidation": 1e-3}}, "must be left out with dilatancy, got 0.001"),
        (
            {"material": {"coefficient_of_consolidation": 4e-4}},
            "must be left out with dilatancy, got 0.0004",
        ),  # default
        ({"material": {"coefficient_of_consolidation": SAND}}, "must be left out with dilatancy, got 0.1"),
        ({"material": Material(coefficient_of_consolidation=1e-3)}, "must be left out with dilatancy, got 0.001"),
        ({"material": {"water_density": 0.0}}, "water_density must be > 0 kg m-3 with dilatancy, got 0"),
        ({"material": {"water_table_ratio": 0.9}}, "water_table_ratio must be 1 with dilatancy, got 0.9"),
        ({"material": {"porosity": 0.71}}, r"porosity must lie in \[0.26, 0.7\] with dilatancy, got 0.71"),
        ({"material": {"porosity": 0.25}}, r"porosity must lie in \[0.26, 0.7\] with dilatancy, got 0.25"),
        ({"material": {"bed_porosity": 0.2}}, r"bed_porosity must lie in \[0.26, 0.7\] with dilatancy, got 0.2"),
    ],
)
def test_with_dilatancy(given, words):
    Setup(**given)
    with pytest.raises(ParameterError, match=words):
        Setup(**DILATANT | given)


@pytest.mark.parametrize("given", [{"scheme": "upwind"}, {"tolerance": 1e-3}, {"source_includes_erosion": True}])
def test_choices_of_columns_that_dilatancy_has_no_use_for(given):
    with pytest.raises(ParameterError, match=f"{next(iter(given))} must be left out with dilatancy"):
        Setup(column=DILATANT["column"] | given)


def test_columns_with_dilatancy_come_back_from_plain_values_without_a_coefficient():
    setup = Setup(**DILATANT)
    mapping = setup.to_mapping()
    assert "coefficient_of_consolidation" not in mapping["material"] and Setup.from_mapping(mapping) == setup


@pytest.mark.parametrize(
    ("value", "words"),
    [
        ("5e-9 m2", "give the number 5e-09 alone, without its unit"),
        (True, r"permeability must be a number \[m2\], got True"),
        (-1e-9, r"permeability must lie in \[0, 0.001\] m2, got -1e-09"),
        ([1e-9], "give one number, it is the same everywhere"),
        (float("nan"), "got nan"),
    ],
)
def test_values_of_dilatancy_that_are_no_numbers(value, words):
    with pytest.raises(ParameterError, match=words):
        Setup(column={"law": "ale", "dilatancy": {"permeability": value}})


@pytest.mark.parametrize("value", [True, False, "on", 0.64, [], [{}]])
def test_dilatancy_is_a_mapping(value):
    with pytest.raises(ParameterError, match="dilatancy must be a mapping with some of critical_solid_fraction"):
        Setup(column={"law": "ale", "dilatancy": value})


def test_a_paper_s_base_has_no_jump_of_stress():
    paper = {"column": {"law": "ale", "scheme": "lax_wendroff"}}
    Setup(**paper, erosion="growth")
    with pytest.raises(ParameterError, match="excess_traction needs a column whose base keeps a pressure of its own"):
        Setup(**paper, erosion="excess_traction")
