"""Hydrographs that cannot be, and lines across which nothing can flow in, are refused in clear words."""

import math

import numpy as np
import pytest
from landlab import RasterModelGrid

from landlab_debrisflow import DebrisFlow, Hydrograph, InputError, ParameterError
from validation.grids import COARSE, changed_fields, copy_fields, inclined

Z = "topographic__elevation"
GOOD = {
    "line_start": (20.0, 38.0), "line_end": (20.0, 58.0), "times": [0.0, 5.0, 10.0], "discharge": [0.0, 20.0, 0.0],
    "velocity": 4.0,
}  # fmt: skip


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"speed": 3.0}, ("unknown key 'speed'", "velocity [m s-1]", "line_start [m]", "times [s]")),
        ({"discharge": [0.0, -20.0, 0.0]}, ("discharge[1] must lie in [0, inf] m3 s-1", "-20.0")),
        ({"discharge": [0.0, math.nan, 0.0]}, ("discharge[1] must lie in [0, inf]", "nan")),
        ({"discharge": [0.0, math.inf, 0.0]}, ("discharge[1]", "inf")),
        ({"discharge": [0.0, "20", 0.0]}, ("discharge[1] must be a number [m3 s-1]", "'20'")),
        ({"discharge": [0.0, True, 0.0]}, ("discharge[1] must be a number", "True")),
        ({"discharge": [0.0, [20.0], 0.0]}, ("discharge[1] must be a number", "[20.0]")),
        ({"discharge": "much"}, ("discharge must be a number or a list of numbers [m3 s-1]", "'much'")),
        ({"discharge": {"a": 1.0}}, ("discharge must be a number or a list", "'a'")),
        ({"discharge": [0.0, 20.0]}, ("discharge has 2 values for 3 times", "one for each or for all")),
        ({"discharge": []}, ("discharge has 0 values for 3 times",)),
        ({"discharge": 0.0}, ("discharge is 0 m3 s-1 at all times", "leave the hydrograph out")),
        ({"velocity": [4.0, 0.0, 4.0]}, ("velocity is 0 m s-1 at 5 s (index 1)", "20 m3 s-1", "give a velocity > 0")),
        ({"velocity": -1.0}, ("velocity must lie in [0, inf] m s-1", "-1.0")),
        ({"velocity": [4.0, 4.0]}, ("velocity has 2 values for 3 times",)),
        ({"pressure_ratio": [0.5, 1.2, 0.5]}, ("pressure_ratio[1] must lie in [0, 1]", "1.2")),
        ({"pressure_ratio": [0.5, 0.5]}, ("pressure_ratio has 2 values",)),
        ({"times": [0.0, 5.0, 5.0]}, ("times must increase, got 5 s at index 2 after 5 s",)),
        ({"times": [0.0, 6.0, 5.0]}, ("times must increase, got 5 s at index 2 after 6 s",)),
        ({"times": [-1.0, 5.0, 6.0]}, ("times[0] must lie in [0, inf] s", "-1.0")),
        ({"times": [0.0, math.nan, 6.0]}, ("times[1]", "nan")),
        ({"times": [5.0], "discharge": 3.0}, ("times must be at least two",)),
        ({"times": 5.0, "discharge": 3.0}, ("times must be at least two",)),
        ({"times": None}, ("times missing", "line_start, line_end, times, discharge, velocity")),
        ({"line_start": None, "velocity": None}, ("line_start and velocity missing",)),
        ({"line_end": (20.0, 38.0)}, ("the same point",)),
        ({"line_end": (20.0,)}, ("line_end must be two numbers, x and y [m]",)),
        ({"line_end": (20.0, 30.0, 40.0)}, ("line_end must be two numbers",)),
        ({"line_end": (20.0, math.nan)}, ("line_end[1]", "nan")),
        ({"direction": 90.0}, ("direction 90 deg runs along the line", "180 deg or opposite")),
        ({"direction": 361.0}, ("direction must lie in [-360, 360] deg",)),
        ({"direction": "east"}, ("direction must be a number [deg]", "'east'")),
    ],
)
def test_hydrographs_that_cannot_be(change, words):
    grid = inclined((20, 60), 5.0, 0.5)
    before = copy_fields(grid)
    with pytest.raises(ParameterError) as refusal:
        DebrisFlow(grid, inflow=GOOD | change)
    message = str(refusal.value)
    assert message.startswith("Hydrograph: ") and [word for word in words if word not in message] == [], message
    assert not changed_fields(grid, before)


@pytest.mark.slow
@pytest.mark.parametrize("inflow", ["surge.csv", 3.0, [GOOD, 3.0], object()])
def test_what_is_no_hydrograph(inflow):
    with pytest.raises(ParameterError, match="inflow must be a Hydrograph"):
        DebrisFlow(inclined((20, 60), 5.0, 0.5), inflow=inflow)


def refused(grid, call):
    before = copy_fields(grid)
    with pytest.raises(InputError) as refusal:
        call()
    assert not changed_fields(grid, before)
    return str(refusal.value)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"line_start": (20.0, 158.0)}, ("the line must lie on core nodes", "is outside the grid")),
        ({"line_start": (-20.0, 38.0)}, ("is outside the grid",)),
        ({"line_start": (2.0, 38.0), "line_end": (2.0, 58.0)}, ("node 480 (row 8, column 0)", "open (fixed-value)")),
        ({"line_end": (20.0, 95.0)}, ("(row 19, column 4)", "open (fixed-value)", "half a node spacing inside")),
        ({"line_start": (100.0, 38.0), "line_end": (100.0, 58.0)}, ("the line must", "column 20), which is closed")),
        # core nodes, but it would flow against the wall at once
        ({"line_start": (96.0, 38.0), "line_end": (96.0, 58.0)}, ("the strip of", "closed", "more particles")),
        (
            {"line_start": (8.0, 38.0), "line_end": (8.0, 58.0), "direction": 180.0},
            ("the strip of", "column 0), which is open"),
        ),
    ],
)
def test_lines_that_are_not_on_core_nodes(change, words):
    grid = inclined((20, 60), 5.0, 0.5)
    grid.status_at_node[grid.x_of_node == 100.0] = grid.BC_NODE_IS_CLOSED
    flow = DebrisFlow(grid, inflow=GOOD | change, numerics=COARSE | {"particle_count": 40})
    message = refused(grid, lambda: flow.run_one_step(1.0))
    assert message.startswith("inflow from (") and [word for word in words if word not in message] == [], message
    assert flow.elapsed_time == 0.0 and flow.budget["inflow"] == 0.0


@pytest.mark.slow
def test_a_line_one_node_inside_the_edge_is_well():
    grid = inclined((20, 60), 5.0, 0.5)
    line = {"line_start": (5.0, 5.0), "line_end": (5.0, 90.0)}
    flow = DebrisFlow(grid, inflow=GOOD | line, numerics=COARSE)
    flow.run_one_step(10.0)
    assert flow.budget["inflow"] == pytest.approx(100.0, rel=1e-14) and flow.outflow_by_edge["west"] == 0.0


@pytest.mark.slow
def test_ground_that_falls_to_neither_side_needs_a_direction():
    grid = RasterModelGrid((20, 20), xy_spacing=5.0)
    grid.add_field(Z, 0.3 * grid.y_of_node, at="node")  # along the line
    flow = DebrisFlow(grid, inflow=GOOD, numerics=COARSE)
    message = refused(grid, lambda: flow.run_one_step(1.0))
    assert "falls to neither side of the line" in message and "180 or 0 deg from east" in message
    DebrisFlow(grid, inflow=GOOD | {"direction": 0.0}, numerics=COARSE).run_one_step(1.0)  # the remedy works
    grid.at_node[Z][:] -= 0.01 * grid.x_of_node
    flow.run_one_step(1.0)
    assert np.all(flow.particles.velocity_x > 0.0)


@pytest.mark.slow
def test_where_nothing_more_flows_in_the_nodes_may_close():
    grid = inclined((20, 60), 5.0, 0.5)
    flow = DebrisFlow(grid, inflow=GOOD, numerics=COARSE)
    flow.run_one_step(5.0)
    grid.status_at_node[grid.x_of_node < 22.0] = grid.BC_NODE_IS_CLOSED
    assert "closed" in refused(grid, lambda: flow.run_one_step(1.0))  # not yet
    grid.status_at_node[grid.x_of_node < 22.0] = grid.BC_NODE_IS_CORE
    flow.run_one_step(15.0)
    grid.status_at_node[grid.x_of_node < 22.0] = grid.BC_NODE_IS_CLOSED
    flow.run_one_step(1.0)


def test_a_hydrograph_takes_numbers_of_any_kind():
    other = {"times": np.array([0, 5, 10]), "discharge": np.array([0, 20, 0], np.float32), "velocity": np.float64(4.0)}
    assert Hydrograph(**GOOD) == Hydrograph(**(GOOD | other))


@pytest.mark.parametrize("change", [{"times": [0.0, 5.0, 1e19]}, {"line_end": (20.0, 1e17)}])
def test_lengths_beyond_any_memory_are_refused(change):
    """A strip or line is looked at as far as the terrain reaches: looked at whole, it would not fit into memory."""
    grid = inclined((20, 60), 5.0, 0.5)
    with pytest.raises(InputError, match="the line"):
        DebrisFlow(grid, inflow=GOOD | change, numerics={"particle_count": 60}).run_one_step(1.0)
