"""Two phases through the component: what is refused, shown, accounted for, let in and undone."""

import numpy as np
import pytest

from landlab_debrisflow import DebrisFlow, InputError

from .twins import Failed, failing

FEW = {"particle_count": 150}
PERMEABLE = {"law": "two_phase", "drag": "anderson_jackson", "terminal_velocity": 2.0, "drag_exponent": 1.0}


@pytest.mark.slow
@pytest.mark.parametrize(
    ("keywords", "words"),
    [
        ({"material": {"water_density": 0.0}}, "water_density is > 0, got 0"),
        ({"material": {"porosity": 0.0}}, "porosity is > 0, got 0"),
        ({"material": {"water_table_ratio": 0.5}}, "water_table_ratio is 1, got 0.5"),
        ({"material": {"coefficient_of_consolidation": 0.0}}, "give hydraulic_conductivity"),
        ({"flow": {"law": "two_phase", "stiffness": 0.0}}, "give hydraulic_conductivity"),
    ],
)
def test_materials_that_have_no_two_phases_are_refused(slope, keywords, words):
    with pytest.raises(InputError, match=words):
        DebrisFlow(slope, **({"flow": "two_phase"} | keywords))


@pytest.mark.slow
def test_a_drag_that_needs_no_stiffness_takes_a_material_that_does_not_consolidate(slope):
    material = {"coefficient_of_consolidation": 0.0}
    flow = DebrisFlow(slope, flow=PERMEABLE, material=material, numerics=FEW)
    flow.run_one_step(0.5)
    assert np.isfinite(flow.particles.velocity_x).all()


@pytest.mark.slow
def test_phases_have_fields_of_their_own(slope):
    flow = DebrisFlow(slope, flow=PERMEABLE, numerics=FEW)
    flow.run_one_step(4.0)
    at, p = slope.at_node, flow.particles
    under = at["debris_flow__depth"] > 0.0
    solid, depth = at["debris_flow__solid_depth"], at["debris_flow__depth"]
    assert (solid >= 0.0).all() and (solid[under] < depth[under]).any() and (solid <= depth).all()
    area = slope.dx * slope.dy
    # the same volume by particles and by nodes, to the rounding of some hundred additions
    assert solid.sum() * area == pytest.approx(float(p.volume[p.phase == 0].sum()), rel=1e-12)
    grains, water = (np.average(p.velocity_x[p.phase == k], weights=p.volume[p.phase == k]) for k in (0, 1))
    assert grains < water  # friction is theirs
    ways = [
        float((at[f"debris_flow__{name}_speed"] * d).sum()) for name, d in (("solid", solid), ("water", depth - solid))
    ]
    speed = np.sqrt(p.velocity_x**2 + p.velocity_y**2 + p.velocity_z**2)
    for k, way in enumerate(ways):
        assert way * area == pytest.approx(float((p.volume * speed)[p.phase == k].sum()), rel=1e-12)
    assert "debris_flow__solid_depth" in flow.maps and flow.maps["debris_flow__water_speed"].attrs["units"] == "m/s"
    assert p.porosity.min() > 0.0 and p.porosity.max() < 1.0
    assert not p.liquefaction_pressure[p.phase == 1].any() and not p.basal_excess_pore_pressure[p.phase == 1].any()
    assert p.basal_excess_pore_pressure[p.phase == 0].all()  # it is grains that have columns


@pytest.mark.slow
def test_one_phase_does_not_have_them(slope):
    DebrisFlow(slope)
    assert not [name for name in slope.at_node if "solid" in name or "water_speed" in name]


@pytest.mark.slow
def test_each_phase_is_in_balance_when_it_has_settled(valley):
    flow = DebrisFlow(valley, flow="two_phase", material={"bed_porosity": 0.5}, numerics=FEW)
    assert flow.run_until_rest()
    phases, whole = flow.budget_by_phase, flow.budget
    assert phases["solid"]["released"] == pytest.approx(0.6 * whole["released"], rel=1e-14)
    assert phases["solid"]["eroded"] == pytest.approx(0.5 * whole["eroded"], rel=1e-14)
    for terms in phases.values():
        assert abs(terms["residual"]) < 1e-12 * whole["deposited"]  # some thousand roundings of 1e-16
        assert terms["deposited"] > terms["released"] and terms["moving"] == 0.0


@pytest.mark.slow
def test_columns_consolidate_as_the_drag_says(slope):
    """K k_w = 2.5e5 Pa * 1e-3 m/s / (1000 kg/m3 * 9.81 m/s2) = 0.0255 m2/s, whatever the material says."""
    conductivity, c_v = 1e-3, 2.5e5 * 1e-3 / 9810.0
    flow = DebrisFlow(slope, flow={"law": "two_phase", "hydraulic_conductivity": conductivity}, numerics=FEW)
    flow.run_one_step(4.0)
    p, columns = flow.particles, flow.columns
    grains = (p.phase == 0).values
    # n^2 over n^2: rounding
    np.testing.assert_allclose(columns.consolidation_time[grains], p.thickness[grains] ** 2 / c_v, rtol=1e-13)
    eroding = grains & (p.entrainment_rate > 0.0).values
    # the thickness has changed by up to a sixth since; with the material's coefficient it would be 64 times as much
    expected = (p.entrainment_rate * p.thickness**2 / p.depth / c_v)[eroding]
    np.testing.assert_allclose(p.basal_peclet_number[eroding], expected, rtol=0.5)
    assert eroding.sum() > 50


def test_one_phase_has_a_budget_by_phase_too(valley):
    flow = DebrisFlow(valley, material={"bed_porosity": 0.5}, numerics=FEW)
    flow.run_one_step(4.0)
    phases, whole = flow.budget_by_phase, flow.budget
    assert whole["eroded"] > 0.0
    for name in ("released", "eroded", "moving"):
        assert phases["solid"][name] + phases["water"][name] == pytest.approx(whole[name], rel=1e-14)
    assert abs(phases["solid"]["residual"]) < 1e-12 * whole["moving"]


@pytest.mark.slow
def test_a_hydrograph_brings_both(slope):
    inflow = {
        "line_start": (20.0, 35.0),
        "line_end": (20.0, 60.0),
        "times": [0.0, 8.0],
        "discharge": 40.0,
        "velocity": 4.0,
    }
    slope.at_node["debris_flow__release_depth"][:] = 0.0
    flow = DebrisFlow(slope, flow="two_phase", inflow=inflow, numerics=FEW)
    flow.run_one_step(6.0)
    phases = flow.budget_by_phase
    assert phases["water"]["inflow"] == pytest.approx(0.4 * flow.budget["inflow"], rel=1e-14)
    assert max(abs(terms["residual"]) for terms in phases.values()) < 1e-12 * flow.budget["inflow"]
    assert flow.budget["inflow"] > 200.0


@pytest.mark.slow
def test_when_all_has_left_all_is_over(slope):
    flow = DebrisFlow(slope, flow="two_phase", erosion="none", numerics={"particle_count": 1})
    flow.run_one_step(60.0)  # a grain and its water, which leave in the same step
    assert flow.at_rest and flow.budget["outflow"] == pytest.approx(flow.budget["released"], rel=1e-15)


@pytest.mark.slow
def test_a_call_that_fails_leaves_grid_and_budget_as_they_were(slope):
    flow = DebrisFlow(slope, flow="two_phase", numerics=FEW)
    flow.run_one_step(2.5)
    fields = {name: slope.at_node[name].copy() for name in slope.at_node}
    budget, particles = flow.budget_by_phase, flow.particles
    with failing(9), pytest.raises(Failed):
        flow.run_one_step(3.0)
    assert all(np.array_equal(slope.at_node[name], values) for name, values in fields.items())
    assert flow.budget_by_phase == budget and flow.particles.identical(particles)
    assert flow.run_until_rest()
