"""What a call tells at its end: what left, what still moves and what was stopped; each once, with numbers that hold."""

import logging
import re

import numpy as np
import pytest
from landlab import RasterModelGrid

from landlab_debrisflow import DebrisFlow, SimulationError
from landlab_debrisflow.model.particles import Particles
from landlab_debrisflow.model.stopped import Stopped
from validation.grids import COARSE, dry_block, inclined, place, release_slab, throw

Z, SOIL, RELEASE = "topographic__elevation", "soil__depth", "debris_flow__release_depth"
FLUID = {"friction": {"law": "coulomb", "basal_friction_angle": 10.0}, "numerics": COARSE}
NUMBER = r"([\d.e+-]+)"


@pytest.fixture(autouse=True)
def logged(caplog):
    caplog.set_level(logging.INFO, "landlab_debrisflow")


def told(caplog, words, level=logging.WARNING):
    """Return the messages of a level with some words in them, so far; they are forgotten."""
    found = [r.getMessage() for r in caplog.records if words in r.getMessage() and r.levelno == level]
    caplog.clear()
    return found


# ---- outflow ----


def ending(foot, columns, soil=1.0):
    """A slope with its foot at a given place [m], on a DEM that ends at some column."""
    grid = inclined((20, columns), 5.0, 0.5, soil=soil, foot=foot)
    release_slab(grid, (30.0, 48.0), 8.0, 1.0)
    return grid


@pytest.mark.slow
def test_a_dem_that_ends_inside_the_deposit_is_told_with_side_and_volume(caplog):
    flow = DebrisFlow(ending(150.0, 58), numerics=COARSE)
    flow.run_until_rest()
    budget = flow.budget
    share = budget["outflow"] / (budget["released"] + budget["eroded"])
    assert 0.05 < share < 0.9  # of the case
    (message,) = told(caplog, "the DEM ends within the reach of the flow")
    volume, percent = re.match(rf"{NUMBER} m3 over the east edge left the grid, {NUMBER} %", message).groups()
    assert float(volume) == pytest.approx(budget["outflow"], rel=1e-3)  # four digits
    assert float(percent) == pytest.approx(100.0 * share, rel=1e-2)


@pytest.mark.slow
@pytest.mark.parametrize(("left", "tells"), [(0.009, 0), (0.011, 1)])
def test_one_per_cent_is_where_telling_begins(caplog, left, tells):
    flow = place(DebrisFlow(inclined_with_release(), numerics=COARSE | {"settle": False}))
    flow._simulation.particles.volume *= 1.0 - left
    flow._simulation.state.outflow.count(np.array([60]), np.array([left * 225.0]), np.array([left * 225.0]))
    flow.run_one_step(1e-9)
    assert len(told(caplog, "left the grid")) == tells


@pytest.mark.slow
def test_outflow_of_the_flow_before_is_not_told_again(caplog):
    first = DebrisFlow(ending(150.0, 58), numerics=COARSE)
    first.run_until_rest()
    assert len(told(caplog, "left the grid")) == 1
    second = DebrisFlow(first.grid, numerics=COARSE, continues=first)
    assert sum(second.outflow_by_edge.values()) == first.budget["outflow"] > 0.0
    second.run_until_rest()  # without a release
    assert told(caplog, "left the grid") == []
    release_slab(first.grid, (30.0, 48.0), 8.0, 0.5, on_top=True)
    second.run_until_rest()
    volumes = [float(re.match(NUMBER, message)[0]) for message in told(caplog, "left the grid")]
    left = second.budget["outflow"] - first.budget["outflow"]
    assert left > 1.0 and volumes == [pytest.approx(left, rel=1e-3)]  # its own, of four digits


def inclined_with_release():
    grid = inclined((20, 60), 5.0, 0.5)
    release_slab(grid, (30.0, 48.0), 8.0, 1.0)
    return grid


@pytest.mark.slow
def test_every_side_is_named(caplog):
    """A cone, from the top of which it flows down all round."""
    grid = RasterModelGrid((31, 31), xy_spacing=5.0)
    x, y = grid.x_of_node - 75.0, grid.y_of_node - 75.0
    grid.add_field(Z, 100.0 - 0.7 * np.hypot(x, y), at="node")
    release_slab(grid, (75.0, 75.0), 8.0, 2.0, on_top=True)
    flow = DebrisFlow(grid, **FLUID)
    flow.run_until_rest()
    (message,) = told(caplog, "left the grid")
    for side in ("west", "east", "south", "north"):
        volume = re.search(rf"{NUMBER} m3 over the {side} edge", message)[1]
        assert float(volume) == pytest.approx(flow.outflow_by_edge[side], rel=1e-3)


@pytest.mark.slow
def test_open_nodes_inside_are_an_edge_too(caplog, valley):
    sink = (valley.x_of_node == 175.0) & (abs(valley.y_of_node - 47.5) < 30.0)
    valley.status_at_node[sink] = valley.BC_NODE_IS_FIXED_VALUE
    DebrisFlow(valley, numerics=COARSE).run_until_rest()
    assert "over open nodes inside" in told(caplog, "left the grid")[0]


@pytest.mark.slow
def test_steps_tell_once_and_rest_tells_the_whole(caplog):
    flow = DebrisFlow(ending(150.0, 58), numerics=COARSE)
    for _ in range(60):
        flow.run_one_step(1.0)
    assert flow.at_rest
    whole = [r for r in caplog.records if "left the grid" in r.getMessage()]
    assert [r.levelno for r in whole] == [logging.WARNING, logging.INFO]
    assert float(whole[1].getMessage().split()[0]) == pytest.approx(flow.budget["outflow"], rel=1e-3)


@pytest.mark.slow
def test_every_event_is_told_by_itself(caplog):
    grid = ending(150.0, 58, soil=5.0)
    flow = DebrisFlow(grid, numerics=COARSE)
    flow.run_until_rest()
    first = flow.budget
    caplog.clear()
    flow.run_one_step(100.0)  # nothing happens
    assert told(caplog, "left the grid") == []
    release_slab(grid, (40.0, 48.0), 8.0, 1.0)
    flow.run_until_rest()
    left = flow.budget["outflow"] - first["outflow"]
    came = sum(flow.budget[name] - first[name] for name in ("released", "eroded"))
    (message,) = told(caplog, "left the grid")
    found = re.match(rf"{NUMBER} m3 over the east edge left the grid, {NUMBER} %", message).groups()
    assert [float(v) for v in found] == pytest.approx([left, 100.0 * left / came], rel=1e-2)


@pytest.mark.slow
def test_what_stays_inside_is_not_told(caplog, valley):
    DebrisFlow(valley, numerics=COARSE).run_until_rest()
    assert caplog.messages == []


# ---- not at rest ----


@pytest.mark.slow
def test_what_does_not_rest_is_told_with_volume_speed_and_place(caplog):
    grid = inclined((20, 80), 5.0, 0.5, foot=150.0, xy_of_lower_left=(5e5, 4e6))
    release_slab(grid, (5e5 + 30.0, 4e6 + 48.0), 8.0, 1.0)
    flow = DebrisFlow(grid, friction={"law": "bingham", "viscosity": 2000.0}, numerics=COARSE)
    assert flow.run_until_rest(max_duration=20.0) is False
    (message,) = told(caplog, "not at rest after 20 s")
    found = re.search(
        rf"{NUMBER} m3 in (\d+) of 100 particles still move, the fastest with {NUMBER} m/s near \({NUMBER}, {NUMBER}\)",
        message,
    ).groups()
    p = flow.particles
    speed = np.sqrt(p.velocity_x**2 + p.velocity_y**2 + p.velocity_z**2).values
    assert int(found[1]) == np.count_nonzero(speed)
    expected = [float(p.volume.values[speed > 0.0].sum()), speed.max()]
    expected += [float(p[k].values[speed.argmax()]) for k in "xy"]
    assert [float(found[k]) for k in (0, 2, 3, 4)] == pytest.approx(expected, rel=1e-2)
    for words in ("No mass was settled", "run_until_rest() again", "larger max_duration"):
        assert words in message
    flow.run_until_rest(max_duration=1.0)
    assert len(told(caplog, "not at rest after 21 s")) == 1


@pytest.mark.slow
def test_inflow_that_has_yet_to_come_is_told(caplog):
    surge = {
        "line_start": (20.0, 38.0), "line_end": (20.0, 58.0), "times": [50.0, 60.0], "discharge": 20.0, "velocity": 4.0,
    }  # fmt: skip
    flow = DebrisFlow(inclined((20, 60), 5.0, 0.5), inflow=surge, numerics=COARSE)
    assert flow.run_until_rest(10.0) is False
    (message,) = told(caplog, "not at rest after 10 s")
    assert "the inflow lasts until 60 s" in message and "still move" not in message


@pytest.mark.slow
def test_rest_and_plain_steps_are_not_told(caplog, valley):
    flow = DebrisFlow(valley, numerics=COARSE)
    flow.run_one_step(1.0)
    flow.run_until_rest()
    assert told(caplog, "not at rest") == []


# ---- walls ----


def thrown(wall, speed, slope=0.0, friction=0.2, volume_per_node=1.5):
    """A dry slab on a plane whose nodes are closed where `wall(x)`, thrown along x with a speed [m/s]."""
    grid = RasterModelGrid((32, 36), xy_spacing=5.0)
    grid.add_field(Z, 300.0 - slope * grid.x_of_node, at="node")
    grid.status_at_node[wall(grid.x_of_node)] = grid.BC_NODE_IS_CLOSED
    release_slab(grid, (75.0, 80.0), 13.0, volume_per_node, on_top=True)
    flow = place(DebrisFlow(grid, **dry_block(friction, particle_count=100)))
    throw(flow, speed * np.array([1.0, 0.0, -slope]))
    return flow


@pytest.mark.slow
def test_what_was_stopped_is_told_with_the_time_of_the_first(caplog):
    """Its front, 12.5 m from the middle, is 22.5 m from the face of the wall, and slows from 20 m/s by 2 m/s2."""
    flow = thrown(lambda x: x > 112.0, 20.0)
    flow.run_until_rest()
    (message,) = told(caplog, "ran against closed or NODATA nodes")
    volume, time = re.match(rf"{NUMBER} m3 ran against closed or NODATA nodes at {NUMBER} s", message).groups()
    # it spreads at 2 (g h)^(1/2) = 7.7 m/s at most, and counts from a spacing (2.6 m) of the wall on; a front that does
    # not spread is at the wall after 1.196 s
    assert (22.5 - 5.0) / 27.7 < float(time) < 10.0 - (10.0**2 - 22.5) ** 0.5
    assert 0.1 * flow.budget["released"] < float(volume) <= 1.001 * flow.budget["released"]
    assert "obstacles, or the DEM is too small" in message


@pytest.mark.slow
def test_what_bounced_off_and_left_is_counted(caplog):
    """It runs up against a wall, slides back down, and leaves on the other side."""
    flow = thrown(lambda x: x > 112.0, 25.0, slope=-0.5, friction=0.05)
    assert flow.run_until_rest(200.0) is True
    assert flow.budget["outflow"] == pytest.approx(flow.budget["released"], rel=1e-12)
    (message,) = told(caplog, "ran against closed or NODATA nodes")
    assert float(message.split()[0]) > 0.2 * flow.budget["released"]


@pytest.mark.slow
def test_a_particle_is_counted_once_however_the_time_is_cut(caplog):
    whole, steps = (thrown(lambda x: x > 112.0, 20.0) for _ in range(2))
    whole.run_one_step(6.0)
    (message,) = told(caplog, "ran against")
    for _ in range(12):
        steps.run_one_step(0.5)
    messages = told(caplog, "ran against")
    volumes = [float(m.split()[0]) for m in messages]
    assert 1 <= len(messages) < 12
    assert sum(volumes) == pytest.approx(float(message.split()[0]), rel=0.15)  # steps of other lengths
    assert sum(volumes) <= 1.001 * steps.budget["released"]


def test_the_volume_is_that_when_it_is_stopped():
    """What a particle takes up later does not count, and what has left the grid stays counted."""
    p, stopped = Particles(levels=11), Stopped()
    p.append(3, volume=[1.0, 2.0, 4.0], x=[10.0, 20.0, 30.0])
    p.touched_wall[1] = 1
    stopped.count(p, 5.0)
    p.volume *= 10.0
    stopped.count(p, 6.0)
    assert (stopped.volume, stopped.first, stopped.last, stopped.where) == (2.0, 5.0, 5.0, (20.0, 0.0))
    p.keep(np.array([True, False, True]))
    p.touched_wall[:] = 1
    stopped.count(p, 7.0)
    assert (stopped.volume, stopped.first, stopped.last, stopped.where) == (52.0, 5.0, 7.0, (20.0, 0.0))
    stopped.forget()
    stopped.count(p, 8.0)
    assert stopped.volume == 0.0


@pytest.mark.slow
def test_what_leaves_a_wall_did_not_run_against_it(caplog):
    """A slide that starts at a divide, beyond which there is no DEM."""
    grid = RasterModelGrid((31, 81), xy_spacing=5.0)
    x, y = grid.x_of_node, grid.y_of_node
    z = grid.add_field(Z, np.maximum(0.0, 0.5 * (250.0 - x)) + 0.1 * abs(y - 75.0), at="node")
    z[x < 40.0] = -9999.0
    grid.set_nodata_nodes_to_closed(z, -9999.0)
    release = grid.add_zeros(RELEASE, at="node")
    release[(x >= 40.0) & (x <= 80.0) & (abs(y - 75.0) <= 20.0)] = 1.5
    DebrisFlow(grid, friction="voellmy", numerics=COARSE).run_until_rest()
    assert told(caplog, "ran against") == []


class Poison:
    """No friction, and no number either from some time on."""

    def __init__(self):
        self.flow, self.after = None, np.inf

    def basal_resistance(self, state, yield_stress, drag):
        yield_stress[:] = drag[:] = np.nan if self.flow and self.flow._simulation.time > self.after else 0.0


@pytest.mark.slow
def test_a_call_that_fails_counts_nothing(caplog):
    """Half of the slab is stopped before numbers cease to be any; the same half is counted when it is run again."""
    poison, counted = Poison(), []
    for poisoned in (False, True):
        grid = RasterModelGrid((32, 36), xy_spacing=5.0)
        grid.add_full(Z, 300.0, at="node")
        grid.status_at_node[grid.x_of_node > 112.0] = grid.BC_NODE_IS_CLOSED
        release_slab(grid, (75.0, 80.0), 13.0, 1.5, on_top=True)
        flow = place(DebrisFlow(grid, **dry_block(0.0, particle_count=100) | {"friction": poison}))
        flow._simulation.particles.velocity[0] = 20.0
        poison.flow, poison.after = flow, 1.5 if poisoned else np.inf
        if poisoned:
            with pytest.raises(SimulationError):
                flow.run_one_step(2.0)
            assert told(caplog, "ran against") == []
        poison.after = np.inf
        flow.run_one_step(1.4)
        counted += told(caplog, "ran against")
    one, other = (float(message.split()[0]) for message in counted)
    assert one == pytest.approx(other, rel=0.05) and one > 50.0
