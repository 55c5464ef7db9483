"""Buildings as closed nodes and dams as raised terrain: impact and run-up against closed forms, nothing inside."""

import numpy as np
import pytest
from landlab import RasterModelGrid
from scipy.optimize import brentq

from landlab_debrisflow import DebrisFlow
from validation.grids import changed_fields, copy_fields, dry_block, place, release, release_cap, throw

from .twins import Failed, failing

Z, IMPACT, RUN_UP = "topographic__elevation", "debris_flow__max_impact_pressure", "debris_flow__max_run_up"
G, DENSITY = 9.81, 1590.0  # of dry debris


def field(grid, name):
    return grid.at_node[name].reshape(grid.shape)


def thrown(grid, velocity, **numerics):
    """Let what is to fail move without friction, all of it at one velocity; films count, too."""
    flow = place(DebrisFlow(grid, **dry_block(0.0, arrival_depth=1e-5, **numerics)))
    throw(flow, velocity)
    return flow


@pytest.mark.slow
@pytest.mark.parametrize("velocity", [(10.0, 0.0), (10.0, 5.0), (10.0, -20.0)])
def test_a_thin_sheet_strikes_a_wall_with_the_velocity_towards_it(velocity):
    grid = RasterModelGrid((41, 32), xy_spacing=5.0)
    grid.add_zeros(Z, at="node")
    grid.status_at_node[grid.x_of_node >= 150.0] = grid.BC_NODE_IS_CLOSED
    middle = 100.0 - 6.0 * velocity[1]  # it is there after 6 s
    release_cap(grid, (70.0, np.clip(middle, 40.0, 160.0)), (25.0, 25.0), 0.02, on_top=True)
    flow = thrown(grid, velocity, particle_count=300)
    flow.run_one_step(9.0)
    impact = field(grid, IMPACT)
    # the front is faster by its spreading: 2 g h/R for the 5.5 s on the way make 0.09 m/s of 10; measured 1.006
    assert DENSITY * 100.0 <= impact[:, 30].max() < DENSITY * 10.09**2
    assert not impact[:, 31].any()  # nothing is behind the face
    assert impact[:, :30].max() >= DENSITY * (100.0 + velocity[1] ** 2)


@pytest.mark.slow
@pytest.mark.parametrize(("speed", "depth", "duration"), [(3.0, 0.5, 5.0), (10.0, 1.0, 2.5)])
def test_at_a_wall_the_flow_stands_as_deep_as_behind_the_bore(speed, depth, duration):
    """The jump of mass and momentum that a wall across a channel sends back (e.g. Iverson, George & Logan, 2016).

    A body of uniform depth that fills the channel touches the wall when it starts.
    """
    grid = RasterModelGrid((13, 40), xy_spacing=2.0)
    grid.add_zeros(Z, at="node")
    grid.set_closed_boundaries_at_grid_edges(True, True, True, True)
    core = grid.status_at_node == grid.BC_NODE_IS_CORE
    release(grid, np.where(core & (grid.x_of_node > 38.0), depth, 0.0), on_top=True)
    flow = thrown(grid, (speed, 0.0), particle_count=600)
    flow.run_one_step(duration)  # the end of the body is felt after 38 m / (speed + celerity), 7.3 and 2.9 s
    end, sides = np.s_[1:-1, -1], np.s_[[0, -1], 15:-1]

    def jump(h):
        return speed**2 - 0.5 * G * (h - depth) ** 2 * (h + depth) / (h * depth)

    deep = brentq(jump, depth, 100.0)
    # measured .990 and 1.000 in the mean, and 1 % between the nodes: particles are in disorder behind a shock
    assert field(grid, RUN_UP)[end].mean() == pytest.approx(deep, rel=0.02)
    np.testing.assert_allclose(field(grid, RUN_UP)[end], deep, rtol=0.03)
    # all nodes of the wall are struck by the flow as it was; those along it only by the disorder
    np.testing.assert_allclose(field(grid, IMPACT)[end], DENSITY * speed**2, rtol=1e-12)
    assert field(grid, IMPACT)[sides].max() < 0.02 * DENSITY * speed**2


ANGLE, SPEED, DEPTH, SPACING = np.radians(15.0), 10.0, 0.2, 2.0


@pytest.mark.slow
def test_a_building_in_a_uniform_flow():
    """Steady inflow on a slope that friction balances meets a block of 6 by 5 closed nodes."""
    grid = RasterModelGrid((22, 50), xy_spacing=SPACING)
    z = grid.add_field(Z, np.tan(ANGLE) * (98.0 - grid.x_of_node), at="node")
    top = grid.y_of_node.max()
    building = (abs(grid.x_of_node - 50.0) < 5.0) & (abs(grid.y_of_node - 0.5 * top) < 6.0)
    grid.status_at_node[building | (grid.y_of_node == 0.0) | (grid.y_of_node == top)] = grid.BC_NODE_IS_CLOSED
    inflow = {
        "line_start": (4.0, 0.5 * SPACING + 1e-6), "line_end": (4.0, top - 0.5 * SPACING - 1e-6),
        "times": [0.0, 16.0], "discharge": SPEED * DEPTH * (top - SPACING), "velocity": SPEED,
    }  # fmt: skip
    flow = DebrisFlow(
        grid, friction={"law": "coulomb", "basal_friction_angle": 15.0}, erosion="none", column="none",
        material={"water_density": 0.0}, numerics={"particle_count": 2000}, inflow=inflow,
    )  # fmt: skip
    before = z.copy()
    flow.run_one_step(8.0)
    budget, inside = flow.budget, building.reshape(grid.shape)
    assert budget["inflow"] == pytest.approx(budget["moving"] + budget["outflow"], rel=1e-13)
    assert flow.particles.volume[flow.particles.x > 60.0].sum() > 0.1 * budget["inflow"]  # it flows round
    for name in ("depth", "max_depth", "max_speed", "deposit_depth", "max_basal_pressure_ratio"):
        assert not field(grid, f"debris_flow__{name}")[inside].any(), name
    np.testing.assert_array_equal(z, before)

    rows, columns = np.flatnonzero(inside.any(axis=1)), np.flatnonzero(inside.any(axis=0))
    impact, run_up = field(grid, IMPACT), field(grid, RUN_UP)
    # not less than the flow that enters brings, not more than the front of a dam break, v + 2 c, would; a wall is
    # struck by the part of the velocity on the map. Measured 1.22 of the one, 0.79 of the other.
    flowing, front = SPEED * np.cos(ANGLE), (SPEED + 2.0 * np.sqrt(G * DEPTH) * np.cos(ANGLE)) * np.cos(ANGLE)
    upstream = impact[rows, columns[0]]
    assert np.all((DENSITY * flowing**2 <= upstream) & (upstream <= DENSITY * front**2))
    along, lee = impact[rows[[0, -1]]][:, columns[1:]], impact[rows[1:-1], columns[-1]]
    assert along.max() < 0.01 * upstream.min() and not lee.any()
    assert not impact[rows[1:-1]][:, columns[1:-1]].any() and not run_up[rows[1:-1]][:, columns[1:-1]].any()
    # deeper than what comes, lower than its energy head, and deepest in the middle of the face
    standing = run_up[rows, columns[0]]
    assert np.all((standing > DEPTH) & (standing < DEPTH + front**2 / (2.0 * G)))
    assert standing[2:4].min() > 1.1 * standing[[0, -1]].max()
    assert run_up[rows[1:-1], columns[-1]].max() < 0.1 * standing.min()


@pytest.mark.slow
@pytest.mark.parametrize("slope", [0.6, 1.0])
def test_a_thin_body_runs_up_its_energy_head(slope):
    """From the flat over a rounded foot onto a dam, without friction: v^2/(2g)."""
    speed, foot = 15.0, 40.0
    grid = RasterModelGrid((21, 80), xy_spacing=5.0)
    on = np.maximum(0.0, grid.x_of_node - 200.0)
    grid.add_field(Z, slope * np.where(on < foot, on**2 / (2.0 * foot), on - 0.5 * foot), at="node")
    release_cap(grid, (140.0, 50.0), (15.0, 25.0), 0.002, on_top=True)
    flow = thrown(grid, (speed, 0.0), particle_count=400)
    flow.run_one_step(8.0)
    head = speed**2 / (2.0 * G)
    # measured .987 and 1.024: a node shows the mean over a tent, in which not all are at their highest; and those
    # first up are pushed by those that follow when they turn (1.030, 1.024, 1.011 with 100, 400, 1600 particles)
    assert grid.at_node[RUN_UP].max() == pytest.approx(head, rel=0.04)
    assert grid.at_node[RUN_UP][grid.x_of_node < 190.0].max() < 0.05 * head  # not yet: the dam shows where it was
    lowest = flow._simulation.particles.lowest_z
    assert lowest.min() > -0.03 and lowest.max() <= 0.0  # the surface through the nodes dips by 2 cm before the foot


@pytest.mark.slow
def test_downhill_run_up_is_the_depth_and_impact_that_of_the_speed(slope):
    flow = DebrisFlow(slope, erosion="none", numerics={"particle_count": 100, "arrival_depth": 0.0})
    flow.run_one_step(1e-3)
    deepest, at = float(flow.particles.depth.max()), slope.at_node
    flow.run_one_step(6.0)
    moved = at["debris_flow__max_speed"] > 1.0
    # the mean of squares is not less than the square of the mean
    assert np.all(at[IMPACT] >= 1990.0 * at["debris_flow__max_speed"] ** 2 * (1.0 - 1e-12))
    assert at[IMPACT].max() < 1.5 * 1990.0 * at["debris_flow__max_speed"].max() ** 2
    assert moved.sum() > 50 and at[RUN_UP][moved].min() > 0.0 and at[RUN_UP].max() < 1.3 * deepest


def test_peaks_of_obstacles_are_kept_shown_and_undone():
    grid = RasterModelGrid((15, 32), xy_spacing=5.0)
    grid.add_zeros(Z, at="node")
    grid.status_at_node[grid.x_of_node >= 100.0] = grid.BC_NODE_IS_CLOSED
    release_cap(grid, (50.0, 35.0), (25.0, 25.0), 0.02, on_top=True)
    flow = thrown(grid, (10.0, 0.0), particle_count=100)
    before = copy_fields(grid)
    with failing(20), pytest.raises(Failed):
        flow.run_one_step(9.0)
    assert not changed_fields(grid, before) and not grid.at_node[IMPACT][grid.x_of_node >= 100.0].any()
    flow.run_one_step(9.0)
    peak = {name: grid.at_node[name].copy() for name in (IMPACT, RUN_UP)}
    flow.run_one_step(30.0)
    for name, unit in ((IMPACT, "Pa"), (RUN_UP, "m")):
        assert peak[name][grid.x_of_node == 100.0].max() > 0.0 and np.all(grid.at_node[name] >= peak[name])
        shown = flow.maps[name]
        np.testing.assert_array_equal(shown.values.ravel(), grid.at_node[name])
        assert shown.attrs["units"] == unit == flow._info[name]["units"]
