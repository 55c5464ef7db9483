"""Steady inflow on a slope that friction balances: uniform flow of thickness Q/(v L)."""

import math

import numpy as np
import pytest
from landlab import RasterModelGrid

from landlab_debrisflow import DebrisFlow
from landlab_debrisflow.model.inflow.source import Source

ANGLE, SPEED, THICKNESS, SPACING = math.radians(15.0), 5.0, 0.5, 2.0


def steady(width=44.0, duration=8.0, count=900):
    """Let a wide channel between closed walls fill for some seconds; friction holds every speed."""
    grid = RasterModelGrid((int(width / SPACING) + 2, 50), xy_spacing=SPACING)
    grid.add_field("topographic__elevation", math.tan(ANGLE) * (98.0 - grid.x_of_node), at="node")
    top = grid.y_of_node.max()
    grid.status_at_node[(grid.y_of_node == 0.0) | (grid.y_of_node == top)] = grid.BC_NODE_IS_CLOSED
    line = {"line_start": (4.0, 0.5 * SPACING + 1e-6), "line_end": (4.0, top - 0.5 * SPACING - 1e-6)}
    inflow = line | {"times": [0.0, 2.0 * duration], "discharge": SPEED * THICKNESS * width, "velocity": SPEED}
    flow = DebrisFlow(
        grid, friction={"law": "coulomb", "basal_friction_angle": math.degrees(ANGLE)}, erosion="none", column="none",
        material={"water_density": 0.0}, numerics={"particle_count": 2 * count}, inflow=inflow,
    )  # fmt: skip
    flow.run_one_step(duration)
    p = flow.particles
    # The front spreads: its rarefaction has come down to x = (v - c) t = 22 m; the walls, which do not push, are
    # felt from 17 m away
    inner = (p.x < 20.0) & (p.x > 4.5) & (abs(p.y - 0.5 * top) < 5.0)
    speed = np.sqrt(p.velocity_x**2 + p.velocity_y**2 + p.velocity_z**2)
    return flow, p.thickness.values[inner], speed.values[inner]


def test_steady_inflow_makes_uniform_flow():
    flow, thickness, speed = steady()
    assert thickness.size > 50
    # measured 8e-4 and 5e-4: on a lattice of rows shifted against each other the sum is not exactly the thickness
    np.testing.assert_allclose(thickness, THICKNESS, rtol=3e-3)
    np.testing.assert_allclose(speed, SPEED, rtol=2e-3)
    assert flow.budget["inflow"] == pytest.approx(SPEED * THICKNESS * 44.0 * 8.0, rel=0.01)  # whole rows
    assert flow.budget["moving"] == pytest.approx(flow.budget["inflow"], rel=1e-14)


@pytest.mark.slow
def test_without_the_strip_it_would_be_pushed_back(monkeypatch):
    """What the strip is for: with a free surface behind the line the flow is a tenth too slow and too thick."""
    build = Source.__init__

    def without(source, *arguments):
        build(source, *arguments)
        source.strip *= 1e-9

    monkeypatch.setattr(Source, "__init__", without)
    _, thickness, speed = steady()
    assert np.median(speed) < 0.95 * SPEED and np.median(thickness) > 1.05 * THICKNESS
