"""A refusal says what was probably meant, and what is clear is taken."""

import numpy as np
import pytest

from landlab_debrisflow import (  # fmt: skip
    DebrisFlow,
    Hydrograph,
    InputError,
    Material,
    Numerics,
    ParameterError,
    solve_column,
)
from landlab_debrisflow.core.values import NodeValues
from landlab_debrisflow.physics.column import ALE
from landlab_debrisflow.physics.friction import Coulomb, Voellmy
from landlab_debrisflow.physics.registry import LAWS, build_law
from landlab_debrisflow.record.observers import Snapshots
from validation.grids import COARSE, changed_fields, copy_fields, release_slab

Z, SOIL, RELEASE = "topographic__elevation", "soil__depth", "debris_flow__release_depth"


def refused(slope, **keywords):
    """Return the words in which a constructor is refused; the grid is as it was."""
    before = copy_fields(slope)
    with pytest.raises((ParameterError, InputError)) as refusal:
        DebrisFlow(slope, **keywords)
    assert not changed_fields(slope, before)
    return str(refusal.value)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("keywords", "words"),
    [
        ({"friction": "voelmy"}, "unknown law 'voelmy' (did you mean 'voellmy'?); allowed: coulomb, voellmy"),
        ({"friction": "Vollmy"}, "did you mean 'voellmy'?"),
        ({"friction": {"law": "Herschel-Bulkley"}}, "did you mean 'herschel_bulkley'?"),
        ({"friction": "mu(I)"}, "did you mean 'mu_i'?"),
        ({"erosion": "shear excess"}, "did you mean 'shear_excess'?"),
        ({"column": "clasical"}, "did you mean 'classical'?"),
        ({"flow": "twophase"}, "did you mean 'two_phase'?"),
        ({"friction": {"Law": "coulomb"}}, "did you mean 'law'?"),
        ({"friction": {"law": "coulomb", "basal_friction_angel": 30.0}}, "did you mean 'basal_friction_angle'?"),
        ({"friction": {"law": "coulomb", "Basal_Friction_Angle": 30.0}}, "did you mean 'basal_friction_angle'?"),
        ({"friction": {"law": "coulomb", "turbulent_coefficient": 500.0}}, "(it is one of voellmy)"),
        ({"erosion": {"law": "growth", "growthrate": 3e-3}}, "did you mean 'growth_rate'?"),
        ({"material": {"porositty": 0.4}}, "did you mean 'porosity'?"),
        ({"material": {"Solid Density": 2650.0}}, "did you mean 'solid_density'?"),
        ({"numerics": {"particles_count": 100}}, "did you mean 'particle_count'?"),
        ({"inflow": {"discharges": 1.0}}, "did you mean 'discharge'?"),
        ({"column": {"law": "ale", "loading_source": "overburdn"}}, "did you mean 'overburden'?"),
        ({"material": {"initial_pressure_profile": "basal layer"}}, "did you mean 'basal_layer'?"),
        ({"friction": {"law": "coulomb", "basal_friction_angle": "soil_depth"}}, "did you mean 'soil__depth'?"),
        ({"friction": Voellmy}, "Voellmy is no friction law but the class of one; give Voellmy()"),
        ({"material": Material}, "give Material(), not the class"),
    ],
)
def test_did_you_mean(slope, keywords, words):
    assert words in refused(slope, **keywords)


@pytest.mark.slow
@pytest.mark.parametrize("word", ["ice", "", "x" * 50, 3, None])
def test_nothing_near_is_not_suggested(slope, word):
    with pytest.raises(ParameterError) as refusal:
        build_law("friction", {"law": word})
    assert "did you mean" not in str(refusal.value) and "coulomb, voellmy" in str(refusal.value)


def test_a_list_is_no_name():
    with pytest.raises(ParameterError, match=r"unknown law \['voellmy'\]"):
        build_law("friction", {"law": ["voellmy"]})


@pytest.mark.parametrize("kind", LAWS)
def test_the_case_of_names_does_not_matter(kind):
    for name, law in LAWS[kind].items():
        for written in (name.upper(), name.capitalize(), np.str_(name.title())):
            assert build_law(kind, written) == build_law(kind, {"law": written}) == law()
    assert ALE(loading_source="Proportional") == ALE(loading_source="proportional")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("keywords", "words"),
    [
        ({"friction": {"law": "voellmy", "turbulent_coefficient": "500"}}, "give the number 500.0 without quotes"),
        ({"friction": {"law": "coulomb", "basal_friction_angle": "30.0"}}, "give the number 30.0 without quotes"),
        ({"friction": {"law": "coulomb", "basal_friction_angle": "30,5"}}, "give the number 30.5 without quotes"),
        ({"material": {"coefficient_of_consolidation": "4e-4"}}, "give the number 0.0004 without quotes"),
        ({"material": {"porosity": "0.4"}}, "porosity must be a number [-], got '0.4'; give the number 0.4 without"),
        ({"numerics": {"particle_count": "2000"}}, "give the number 2000 without quotes"),
        ({"numerics": {"particle_count": 2000.0}}, "must be an integer [-] or 'auto', got 2000.0; give 2000"),
        ({"numerics": {"particle_count": np.float64(2e3)}}, "must be an integer [-] or 'auto', got 2000.0; give 2000"),
        ({"numerics": {"particle_count": 2000.5}}, "round it"),
        ({"numerics": {"settle": "false"}}, "give True or False without quotes"),
        ({"numerics": {"settle": 0}}, "give True or False without quotes"),
        ({"material": {"porosity": [0.4, 0.3]}}, "give one number, it is the same everywhere"),
        ({"material": {"porosity": np.full(1200, 0.4)}}, "give one number, it is the same everywhere"),
    ],
)
def test_numbers_that_are_none(slope, keywords, words):
    assert words in refused(slope, **keywords)


def test_numbers_of_a_list_that_are_none():
    line = {"line_start": (20.0, 38.0), "line_end": (20.0, 58.0), "velocity": 4.0, "times": (0.0, 5.0)}
    with pytest.raises(ParameterError, match=r"discharge\[1\] must be a number .*; give the number 20\.0 without"):
        Hydrograph(discharge=[0.0, "20"], **line)
    with pytest.raises(ParameterError, match=r"discharge must be a number or .*; give the number 20\.0 without"):
        Hydrograph(discharge="20", **line)
    one = Hydrograph(discharge=np.array(20.0), **line)
    assert one == Hydrograph(discharge=20.0, **line) == Hydrograph(discharge=[np.float32(20.0)], **line)


@pytest.mark.parametrize("of", [np.float32, np.float64, np.int16, np.array, lambda v: np.array(v, "f4")])
def test_scalars_of_numpy_are_numbers(of):
    law = Voellmy(basal_friction_angle=of(30), turbulent_coefficient=of(500))
    assert law == Voellmy(basal_friction_angle=30.0, turbulent_coefficient=500.0)
    assert type(law.basal_friction_angle) is type(law.turbulent_coefficient) is float
    assert Numerics(settle=np.bool_(False), particle_count=np.int64(7)) == Numerics(settle=False, particle_count=7)


@pytest.mark.parametrize("shape", [(20, 60), (1, 1200), (1200, 1)])
def test_rasters_for_a_parameter_say_how_to_flatten_them(slope, shape):
    angle = np.full(shape, 30.0)
    message = refused(slope, friction={"law": "coulomb", "basal_friction_angle": angle})
    assert f"got an array of shape {shape}; give array.reshape(-1)" in message and "southern" in message
    DebrisFlow(slope, friction={"law": "coulomb", "basal_friction_angle": angle.reshape(-1)})


def test_an_array_of_words_is_no_array_of_numbers(slope):
    message = refused(slope, friction={"law": "coulomb", "basal_friction_angle": ["30.0", "31.0"]})
    assert "must be a number [deg], the name of a field at nodes, or an array over them" in message


def test_node_values_without_a_number_compare_and_print():
    one, other = (NodeValues(np.array([np.nan, 1.0, 3.0])) for _ in range(2))
    assert one == other and hash(one) == hash(other) and repr(one) == "<3 node values from 1 to 3>"
    assert "without a number" in repr(NodeValues(np.array([np.nan])))


@pytest.mark.parametrize("call", ["run_one_step", "run_until_rest"])
def test_durations_in_quotes(slope, call):
    flow = DebrisFlow(slope, numerics=COARSE)
    with pytest.raises(InputError, match=r"must be a number of seconds >= 0, got '10'; give the number 10\.0 without"):
        getattr(flow, call)("10")
    flow.run_one_step(np.array(0.5))
    assert flow.elapsed_time == 0.5


# ---- fields ----


@pytest.mark.slow
@pytest.mark.parametrize("dtype", ["float32", "int64", "int16", "uint16", ">f8"])
@pytest.mark.parametrize("name", [Z, SOIL, RELEASE])
def test_fields_of_other_numbers_say_how_to_convert_them(slope, name, dtype):
    slope.at_node[name] = slope.at_node[name].astype(dtype)
    message = refused(slope, numerics=COARSE)
    assert message.startswith(f"{name} must have the dtype float64, got {dtype}")
    exec(message[message.index("grid.at_node") :], {"grid": slope})
    DebrisFlow(slope, numerics=COARSE).run_one_step(0.1)


@pytest.mark.slow
@pytest.mark.parametrize("dtype", ["float64", "int32", "bool"])
def test_ids_of_other_numbers_say_how_to_convert_them(slope, dtype):
    slope.add_ones("mass__wasting_id", at="node", dtype=dtype)
    message = refused(slope, numerics=COARSE)
    exec(message[message.index("grid.at_node") :], {"grid": slope})
    DebrisFlow(slope, numerics=COARSE)


@pytest.mark.slow
def test_a_field_that_is_exchanged_later_is_looked_at_again(slope):
    flow = DebrisFlow(slope, numerics=COARSE)
    slope.at_node[Z] = slope.at_node[Z].astype(np.float32)
    before = copy_fields(slope)
    with pytest.raises(InputError, match="topographic__elevation must have the dtype float64, got float32"):
        flow.run_one_step(1.0)
    assert not changed_fields(slope, before)


# ---- observers ----


@pytest.mark.slow
def test_one_observer_needs_no_list(valley):
    one, other = (Snapshots(5.0, variables=["debris_flow__depth"]) for _ in range(2))
    DebrisFlow(valley, numerics=COARSE, observers=one).run_one_step(10.0)
    assert one.dataset.sizes["time"] == 2
    release_slab(valley, (60.0, 48.0), 8.0, 0.05)
    DebrisFlow(valley, numerics=COARSE, observers=(o for o in [other])).run_one_step(5.0)  # any sequence will do
    assert other.dataset.sizes["time"] == 1


@pytest.mark.slow
@pytest.mark.parametrize(
    ("observers", "words"),
    [
        (Snapshots, "give Snapshots(...), not the class"),
        ([Snapshots], "give Snapshots(...), not the class"),
        (5.0, "an observer needs interval > 0 [s] and observe(flow), got 5.0"),
        ("progress", "an observer needs interval > 0 [s] and observe(flow), got 'p"),
        (type("Slow", (), {"interval": "5", "observe": print})(), "an observer needs interval > 0 [s]"),
    ],
)
def test_what_cannot_observe(slope, observers, words):
    assert words in refused(slope, observers=observers)


def test_a_variable_of_snapshots_that_is_misspelled(valley):
    snapshots = Snapshots(5.0, variables=["debris_flow_depth"])
    with pytest.raises(InputError, match=r"no field 'debris_flow_depth' .*\(did you mean 'debris_flow__depth'\?\)"):
        snapshots.observe(DebrisFlow(valley, numerics=COARSE))


# ---- columns by themselves ----


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"law": "clasical"}, "did you mean 'classical'?"),
        ({"advance": "lasy"}, "did you mean 'lazy'?"),
        ({"base": "impermable"}, "did you mean 'impermeable'?"),
        ({"initial": "basal layer"}, "did you mean 'basal_layer'?"),
        ({"scheme": "upwnd"}, "did you mean 'upwind'?"),
        ({"thickness": "1.5"}, "give the number 1.5 without quotes"),
    ],
)
def test_arguments_of_a_column(given, words):
    with pytest.raises(ParameterError) as refusal:
        solve_column(times=[1.0], **given)
    assert words in str(refusal.value)


def test_the_case_of_words_for_a_column_does_not_matter():
    one, other = (solve_column(times=[1.0], law=law, advance=way) for law, way in (("ale", "lazy"), ("ALE", "Lazy")))
    np.testing.assert_array_equal(one.excess_pore_pressure, other.excess_pore_pressure)


def test_a_field_named_by_a_law_is_a_name():
    assert Coulomb(basal_friction_angle="friction__angle").basal_friction_angle == "friction__angle"
