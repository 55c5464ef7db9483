"""What every law must do, by kind: a new law in `model.physics.LAWS` is tested here without a line more."""

import dataclasses
import math
import re

import numpy as np
import pytest

from landlab_debrisflow import Material, Numerics, Setup
from landlab_debrisflow.cli import laws as laws_page
from landlab_debrisflow.core.errors import ParameterError
from landlab_debrisflow.core.parameters import on_nodes
from landlab_debrisflow.physics.bed_state import BedState
from landlab_debrisflow.physics.contracts import BasalState, BasalStress
from landlab_debrisflow.physics.erosion import Growth
from landlab_debrisflow.physics.friction import Bingham, Coulomb, HerschelBulkley, Voellmy
from landlab_debrisflow.physics.registry import LAWS, METHOD, build_law

ALL = [(kind, name) for kind, laws in LAWS.items() for name in laws]
DECLARED = [law for laws in LAWS.values() for law in laws.values()] + [Material, Numerics]
PARAMETERS = [(law, field) for law in DECLARED for field in dataclasses.fields(law)]


def of(kind):
    return pytest.mark.parametrize("law", [law() for law in LAWS[kind].values()], ids=list(LAWS[kind]))


def of_friction(test):
    """Every law by its defaults, and once more with all there is in it."""
    more = [
        Coulomb(cohesion=800.0, viscosity=50.0, velocity_profile="parabolic"), Voellmy(cohesion=800.0),
        Bingham(basal_friction_angle=20.0), HerschelBulkley(basal_friction_angle=20.0, flow_index=1.5),
        Bingham(yield_stress=0.0), HerschelBulkley(yield_stress=0.0),
    ]  # fmt: skip
    return pytest.mark.parametrize("law", [law() for law in LAWS["friction"].values()] + more, ids=str)(test)


def has_friction(law):
    """Whether an angle of the law says that normal stress holds a body."""
    angles = [field.name for field in dataclasses.fields(law) if field.metadata["unit"] == "deg"]
    return any(getattr(law, name) > 0.0 for name in angles)


def strength_without_normal_stress(law):
    """Return what holds a body that is liquefied or off the ground [Pa]."""
    return getattr(law, "cohesion", 0.0) + getattr(law, "yield_stress", 0.0)


def basal_state(count=50, seed=1, **given):
    """A plausible base; by default between dry and liquefied, on all slopes and at all speeds."""
    rng = np.random.default_rng(seed)
    slope = rng.uniform(0.0, 1.3, count)
    thickness = given.pop("thickness", 10.0 ** rng.uniform(-4.0, 1.3, count))
    liquefaction = 990.0 * 9.81 * thickness * np.cos(slope)
    pressure = given.pop("excess_pore_pressure", rng.uniform(0.0, 1.0, count) * liquefaction)
    normal_gravity = given.pop("normal_gravity", 9.81 * np.cos(slope))
    effective = np.maximum(0.0, 990.0 * normal_gravity * thickness - pressure)
    values = {
        "depth": thickness / np.cos(slope), "thickness": thickness, "speed": 10.0 ** rng.uniform(-6.0, 2.0, count),
        "normal_gravity": normal_gravity, "density": np.full(count, 1990.0), "eroded_depth": np.zeros(count),
        "stress": BasalStress(effective, liquefaction, pressure, rng.uniform(0.0, 1.5, count) * effective),
        "material": Material(basal_slip_ratio=given.pop("slip_ratio", 0.0)), "parameters": None, "variables": None,
        "bed": BedState(rng.uniform(0.0, 1.0, count), rng.uniform(0.0, 1.0, count), None, np.arange(count)),
    }  # fmt: skip
    return BasalState(**(values | given))


def resistance(law, state):
    out = np.full((2, state.depth.size), np.nan)  # everything must be written
    law.basal_resistance(state._replace(parameters=on_nodes(law, {})), *out)
    return out


def entrainment(law, state):
    out = np.full(state.depth.size, np.nan)
    law.entrainment_rate(state._replace(parameters=on_nodes(law, {})), out)
    return out


@of_friction
def test_friction_is_finite_and_never_negative(law):
    state = basal_state()
    yield_stress, drag = resistance(law, state)
    assert np.isfinite(yield_stress).all() and np.isfinite(drag).all()
    assert (yield_stress >= 0.0).all() and (drag >= 0.0).all()


@of_friction
def test_friction_leaves_its_inputs_alone(law):
    unchanged(resistance, law)


@of("erosion")
def test_erosion_leaves_its_inputs_alone(law):
    unchanged(entrainment, law)


def unchanged(ask, law):
    state = basal_state()
    before = [np.copy(values) for values in state[:-1]]
    first = ask(law, state)
    for values, copy in zip(state[:-1], before, strict=False):
        np.testing.assert_array_equal(values, copy)
    np.testing.assert_array_equal(first, ask(law, state))  # and keeps nothing to itself


@of_friction
def test_pore_pressure_lowers_what_holds_a_body(law):
    dry, wet = basal_state(excess_pore_pressure=np.zeros(50)), basal_state()
    if has_friction(law):
        assert np.all(resistance(law, wet)[0] < resistance(law, dry)[0])
    else:
        np.testing.assert_array_equal(resistance(law, wet), resistance(law, dry))


@of_friction
def test_pore_pressure_enters_through_the_effective_normal_stress_only(law):
    state, other = basal_state(), np.full(50, np.nan)
    stress = state.stress._replace(excess_pore_pressure=other, liquefaction=other)
    found = resistance(law, state._replace(stress=stress))
    np.testing.assert_array_equal(found, resistance(law, state))


@of_friction
@pytest.mark.parametrize("excess", [1.0, 1.5, 1e6])
def test_what_is_liquefied_keeps_its_cohesion_only(law, excess):
    load = basal_state().stress.liquefaction
    # the small excess over 1 keeps round-off of rho' g_n h_n - p out of it
    state = basal_state(excess_pore_pressure=load * excess * (1.0 + 1e-12))
    assert np.all(resistance(law, state)[0] == strength_without_normal_stress(law))


@of_friction
def test_a_bend_that_lifts_the_flow_off_leaves_no_friction_to_hold_it(law):
    found = resistance(law, basal_state(normal_gravity=np.zeros(50)))[0]
    assert np.all(found == strength_without_normal_stress(law))


@of_friction
def test_a_film_of_no_thickness_needs_no_special_case(law):
    state = basal_state(thickness=np.zeros(50))
    out = resistance(law, state)
    assert np.isfinite(out).all() and np.all(out[0] == strength_without_normal_stress(law))


@of_friction
@pytest.mark.parametrize("slip_ratio", [0.0, 0.4, 1.0])
def test_friction_at_rest_is_finite_whatever_slides(law, slip_ratio):
    for thickness in (np.zeros(50), np.full(50, 2.0)):
        out = resistance(law, basal_state(thickness=thickness, speed=np.zeros(50), slip_ratio=slip_ratio))
        assert np.isfinite(out).all() and (out >= 0.0).all()


@of_friction
def test_parameters_that_vary_are_taken_each_at_its_place(law):
    """Given as arrays over the particles, all alike, they change nothing; a changed one changes its own particle."""
    state, here = basal_state(), on_nodes(law, {})
    same, other = np.empty((2, 50)), np.empty((2, 50))
    spread = [np.full(50, values[0]) for values in here]
    law.basal_resistance(state._replace(parameters=type(here)(*spread)), *same)
    np.testing.assert_array_equal(same, resistance(law, state))
    for name, values in zip(here._fields, spread, strict=True):
        changed = values.copy()
        changed[7] = 0.9 * values[7] + 0.1
        law.basal_resistance(state._replace(parameters=type(here)(*spread)._replace(**{name: changed})), *other)
        assert np.flatnonzero((other != same).any(axis=0)).tolist() == [7], name


@of("erosion")
def test_erosion_is_finite_and_never_negative(law):
    rate = entrainment(law, basal_state())
    assert np.isfinite(rate).all() and (rate >= 0.0).all()


@of("erosion")
def test_nothing_erodes_at_rest(law):
    assert not entrainment(law, basal_state(speed=np.zeros(50))).any()


@of("column")
def test_columns_have_levels(law):
    assert law.levels >= 2


@pytest.mark.parametrize(("kind", "name"), ALL)
def test_a_law_is_built_by_name_mapping_or_given(kind, name):
    law = LAWS[kind][name]()
    assert build_law(kind, name) == law
    assert build_law(kind, law) is law
    values = {field.name: getattr(law, field.name) for field in dataclasses.fields(law)}
    assert build_law(kind, {"law": name, **values}) == law
    assert callable(getattr(law, METHOD[kind])) and type(law).__doc__ and hash(law) == hash(LAWS[kind][name]())


@pytest.mark.parametrize(
    "entry", [entry for kind in LAWS for entry in laws_page.law_entries(kind)], ids=lambda e: e.title
)
def test_the_docstring_of_a_law_has_its_formula_and_source(entry):
    name = entry.cls.__name__
    assert " = " in entry.formula, f"{name}: the first line must be the formula, with '=': {entry.formula!r}"
    assert re.search(r"[A-Z]\w+.*\b(1[6-9]|20)\d\d\b", entry.source), (
        f"{name}: a section References must name author and year, got {entry.source!r}; see CONTRIBUTING.md"
    )


def test_defaults_are_those_of_tsing_shan():
    physics = Setup()
    names = [type(getattr(physics, kind)).__name__ for kind in ("flow", "friction", "erosion", "column")]
    assert names == ["OnePhase", "Coulomb", "Growth", "ALE"]
    assert math.tan(on_nodes(physics.friction, {}).basal_friction_angle[0]) == pytest.approx(0.6, rel=1e-15)
    assert physics.erosion.growth_rate == 3e-3
    material = physics.material
    assert (material.density, material.buoyant_density) == (1990.0, 990.0)
    assert material.coefficient_of_consolidation == 4e-4
    assert material.bed_pressure_ratio == material.initial_pressure_ratio == 0.65


@pytest.mark.parametrize("kind", LAWS)
@pytest.mark.parametrize("value", ["plough", {"law": "plough"}, {}, {"rate": 1.0}])
def test_an_unknown_law_lists_the_legal_ones(kind, value):
    with pytest.raises(ParameterError) as refusal:
        build_law(kind, value)
    why = "a mapping needs the key 'law'" if isinstance(value, dict) and "law" not in value else "unknown law"
    assert str(refusal.value).startswith(f"{kind}: {why}")
    assert all(name in str(refusal.value) for name in LAWS[kind])


@pytest.mark.parametrize(("kind", "name"), ALL)
def test_an_unknown_key_lists_the_legal_ones_with_units(kind, name):
    with pytest.raises(ParameterError) as refusal:
        build_law(kind, {"law": name, "ploughing_depth": 1.0})
    law = LAWS[kind][name]
    expected = [f"{field.name} [{field.metadata['unit']}]" for field in dataclasses.fields(law)]
    for words in (law.__name__, "unknown key 'ploughing_depth'", *(expected or ["allowed: none"])):
        assert words in str(refusal.value)


@pytest.mark.parametrize("kind", LAWS)
@pytest.mark.parametrize("value", [3.0, object(), ["coulomb"]], ids=["number", "object", "list"])
def test_what_is_no_law_is_refused(kind, value):
    with pytest.raises(ParameterError, match=f"{kind}: .* is no {kind} law"):
        build_law(kind, value)


@pytest.mark.parametrize(("kind", "name"), ALL)
def test_a_class_is_not_taken_for_a_law(kind, name):
    with pytest.raises(ParameterError, match="is no"):
        build_law(kind, LAWS[kind][name])


def refused_values(meta):
    """Yield values a parameter must refuse."""
    yield from (math.nan, math.inf, -math.inf)
    if meta["varies"]:
        yield from ([], [[1.0]], {}, ["text"])
    else:
        yield from ("text", [1.0])
    if meta["kind"] is bool:
        return
    yield True
    if meta["kind"] in (int, float):
        low, high = meta["bounds"]
        yield from (bound + side for bound, side in ((low, -1), (high, 1)) if math.isfinite(bound))
    if meta["kind"] is int:
        yield 2.5


@pytest.mark.parametrize(("law", "field"), PARAMETERS, ids=lambda value: getattr(value, "name", None) or value.__name__)
def test_a_parameter_out_of_bounds_is_refused_by_name_unit_bounds_and_value(law, field):
    meta = field.metadata
    assert meta["meaning"] and meta["unit"]
    for value in refused_values(meta):
        with pytest.raises(ParameterError) as refusal:
            law(**{field.name: value})
        message = str(refusal.value)
        names = [f"{law.__name__}: {field.name}{place} must" for place in ("", "[0]")]  # or of an item
        assert message.startswith(tuple(names))
        assert repr(value) in message or (isinstance(value, list) and repr(value[0]) in message)
        if meta["kind"] is str:
            assert all(choice in message for choice in meta["choices"])
        elif meta["kind"] in (int, float) and meta["unit"] != "-":
            assert meta["unit"] in message
        if "lie in" in message:
            assert f"[{meta['bounds'][0]:g}, {meta['bounds'][1]:g}]" in message


def hand_state():
    """Two metres on a flat at 10 m/s, 9000 Pa of excess pore pressure."""
    one = np.ones(1)
    return BasalState(
        2.5 * one, 2.0 * one, 10.0 * one, 1990.0 * one, 9.81 * one,
        BasalStress(10423.8 * one, 19423.8 * one, 9000.0 * one), 0.0 * one, Material(), None, None,
    )  # fmt: skip


def test_coulomb_by_hand():
    yield_stress, drag = resistance(Coulomb(basal_friction_angle=45.0), hand_state())
    # 990 * 9.81 * 2 - 9000 = 10423.8 Pa, tan 45 = 1; round-off of the tangent
    assert yield_stress[0] == pytest.approx(10423.8, rel=1e-14)
    assert drag[0] == 0.0


def test_voellmy_by_hand():
    law = Voellmy(basal_friction_angle=45.0, turbulent_coefficient=500.0)
    yield_stress, drag = resistance(law, hand_state())
    assert yield_stress[0] == pytest.approx(10423.8, rel=1e-14)
    # rho g v^2/xi = 1990 * 9.81 * 100/500 = 3904.38 Pa, per speed of 10 m/s
    assert drag[0] == pytest.approx(390.438, rel=1e-14)


def test_growth_by_hand():
    # 3e-3 per metre * 2.5 m (vertical) * 10 m/s
    assert entrainment(Growth(growth_rate=3e-3), hand_state())[0] == pytest.approx(0.075, rel=1e-14)


def test_debris_that_floats_is_refused():
    with pytest.raises(ParameterError, match=r"solid_density must exceed water_density, 1000 kg m-3, got 1000"):
        Material(solid_density=1000.0)
