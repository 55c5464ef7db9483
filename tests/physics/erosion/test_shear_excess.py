"""The RAMMS type of erosion: by hand, and in a flow (Frank et al. 2015, 2017)."""

import math

import numpy as np
import pytest

from landlab_debrisflow import DebrisFlow
from landlab_debrisflow.core.parameters import on_nodes
from landlab_debrisflow.physics.erosion import ShearExcess
from validation.grids import dry_block, inclined, release_slab

from ..test_contracts import basal_state


def rate_of(law, **given):
    """On a slope of 30 degrees under 2 m (slope-normal) of 2000 kg/m3: tau = 2000 * 9.81 * 2 * 0.5 = 19 620 Pa."""
    n = len(next(iter(given.values()))) if given else 1
    one = np.ones(n)
    state = {
        "thickness": 2.0 * one, "depth": 2.0 / math.cos(math.radians(30.0)) * one, "density": 2000.0 * one,
        "speed": 5.0 * one, "excess_pore_pressure": 0.0 * one, "normal_gravity": 8.5 * one,
    }  # fmt: skip
    out = np.full(n, np.nan)
    given = {name: np.array(values, float) for name, values in given.items()}
    law.entrainment_rate(
        basal_state(n, **(state | {"eroded_depth": 0.0 * one} | given))._replace(parameters=on_nodes(law, {})), out
    )
    return out


def test_defaults_are_those_of_ramms():
    law = ShearExcess()
    # 0.025 m/s; 1 kPa; 0.1 m per kPa
    assert (law.erosion_rate, law.critical_shear_stress, law.erosion_depth_per_stress) == (0.025, 1000.0, 0.1 / 1000.0)


def test_it_erodes_at_its_rate_down_to_the_depth_of_its_stress():
    # e_m = 1e-4 * (19 620 - 1000) = 1.862 m
    rates = rate_of(ShearExcess(), eroded_depth=[0.0, 1.0, 1.8619, 1.8621, 5.0])
    np.testing.assert_array_equal(rates, [0.025, 0.025, 0.025, 0.0, 0.0])


def test_the_stress_is_that_of_depth_and_slope():
    assert rate_of(ShearExcess(critical_shear_stress=19619.9))[0] == 0.025
    assert rate_of(ShearExcess(critical_shear_stress=19620.1))[0] == 0.0
    assert rate_of(ShearExcess(critical_shear_stress=0.0), depth=[2.0])[0] == 0.0  # on a flat nothing drives


def test_at_rest_and_under_nothing_it_is_zero():
    np.testing.assert_array_equal(rate_of(ShearExcess(), speed=[0.0, 1e-9]), [0.0, 0.025])
    assert rate_of(ShearExcess(critical_shear_stress=0.0), thickness=[0.0], depth=[0.0])[0] == 0.0


def slab(erosion, depth=2.0):
    """Sliding down a plane of 30 degrees until it has left."""
    grid = inclined((15, 30), 10.0, math.tan(math.radians(30.0)), soil=5.0)
    release_slab(grid, (60.0, 70.0), 26.0, depth, on_top=True)
    return grid, DebrisFlow(grid, **dry_block(0.2, erosion, particle_count=120))


@pytest.mark.slow
def test_below_the_threshold_a_flow_erodes_nothing():
    # tau = 1590 * 9.81 * 0.05 m * cos * sin = 338 Pa
    grid, flow = slab("shear_excess", depth=0.05)
    flow.run_one_step(3.0)
    assert float(flow.particles.velocity_x.mean()) > 5.0 and not grid.at_node["debris_flow__eroded_depth"].any()
    assert flow.budget["eroded"] == 0.0


SHALLOW = {"law": "shear_excess", "erosion_rate": 0.1, "erosion_depth_per_stress": 1e-5}
"""Under 2 m as above e_m = 1e-5 (13 510 - 1000) = 0.125 m, which takes 1.25 s: less than the flow takes to pass."""


def event(grid, flow, calls):
    """Run until all has left; return what was eroded [m]."""
    before = grid.at_node["debris_flow__eroded_depth"].copy()
    for _ in range(calls):
        flow.run_one_step(30.0 / calls)
    assert flow.particles.sizes["particle"] == 0
    assert abs(flow.budget["residual"]) < 1e-12 * flow.budget["released"]
    return grid.at_node["debris_flow__eroded_depth"] - before


@pytest.mark.slow
@pytest.mark.parametrize("calls", [1, 24])
def test_the_depth_holds_for_an_event_in_one_call_or_many(calls):
    grid, flow = slab(SHALLOW)
    eroded = event(grid, flow, calls)
    angle = math.radians(30.0)
    stress = 1590.0 * 9.81 * grid.at_node["debris_flow__max_depth"] * math.cos(angle) * math.sin(angle)
    limit = 1e-5 * np.maximum(0.0, stress - 1000.0)
    under = limit > 0.06
    # measured 1.02, .75 to 1.12 for half of the nodes, 1.8 at the sides: a particle erodes under all of its tent until
    # the depth is reached at the node nearest to it. Without the limit it is 3 times as much
    assert np.count_nonzero(under) > 150 and np.median(eroded[under] / limit[under]) == pytest.approx(1.0, abs=0.1)
    assert np.all(eroded[under] < 2.0 * limit[under])


@pytest.mark.slow
def test_the_next_event_erodes_again():
    grid, flow = slab(SHALLOW)
    first = event(grid, flow, 1)
    release_slab(grid, (60.0, 70.0), 26.0, 2.0, on_top=True)
    second = event(grid, flow, 3)
    # through the furrow of the first, and so not quite the same: measured .3 % more
    assert second.sum() == pytest.approx(first.sum(), rel=0.05)
