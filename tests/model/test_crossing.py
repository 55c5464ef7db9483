"""How much terrain a particle crosses in a step: half a node, or nearly a whole one over even ground."""

from types import SimpleNamespace

import numpy as np
import pytest

from landlab_debrisflow.model.crossing import find_time_across, time_over
from landlab_debrisflow.model.numerics import Numerics
from landlab_debrisflow.model.step_rule import step_rule
from landlab_debrisflow.spatial.raster import CLOSED, Raster
from landlab_debrisflow.terrain.surface import Surface

G, SPACING, SPEED = 9.81, 10.0, 60.0
ROWS, COLUMNS = 15, 40


def way(elevation, x=105.0, speed=SPEED, raster=None, direction=(1.0, 0.0), **numerics):
    """Return the way that a particle in the middle of the rows may go over terrain z(x, y) in a step, in nodes."""
    surface = Surface(elevation(*np.meshgrid(SPACING * np.arange(COLUMNS), SPACING * np.arange(ROWS))), (SPACING,) * 2)
    place = np.array([x]), np.array([70.0])
    sample = surface.sample(*place)
    p = SimpleNamespace(
        awake=1, x=place[0], y=place[1], thrust=np.zeros((3, 1)),
        velocity=np.array([[speed * direction[0]], [speed * direction[1]], [0.0]]),
        slope_x=sample.slope_x, slope_y=sample.slope_y, curvature_xx=sample.curvature_xx,
        curvature_xy=sample.curvature_xy, curvature_yy=sample.curvature_yy,
    )  # fmt: skip
    rule = step_rule(Numerics(**numerics), SPACING)
    short = np.array([time_over(rule.way, speed**2, G)])
    time = find_time_across(p, surface, raster, rule, G, short, 1e9)
    assert find_time_across(p, surface, raster, rule, G, short, 0.5 * time) == 0.5 * time  # other limits are shorter
    found = (speed * time + 0.5 * G * time**2) / SPACING
    assert time == pytest.approx(time_over(found * SPACING, speed**2, G), rel=1e-12)
    return found


def plane(x, y):
    return -0.3 * x + 0.1 * y


@pytest.mark.parametrize(
    ("number", "nodes"), [(0.5, 0.95), (0.25, 0.475), (0.1, 0.19), (0.8, 0.95), (1.0, 1.0), (2.0, 2.0)]
)
def test_over_a_plane_it_is_nearly_a_node_or_what_the_user_asks_for(number, nodes):
    assert way(plane, advective_courant_number=number) == pytest.approx(nodes)


@pytest.mark.parametrize("radius", [1000.0, 475.0, 350.0, 10.0])
def test_where_the_ground_bends_it_is_as_far_as_the_surface_turns_by_its_most(radius):
    """In a trough .95 nodes turn the surface by 9.5 m over the radius; 0.02 rad are allowed."""
    expected = max(0.5, min(0.95, 0.95 * 0.02 / (9.5 / radius)))
    assert way(lambda x, y: 0.5 * (x - 105.0) ** 2 / radius + 0.0 * y) == pytest.approx(expected, rel=1e-6)


def test_only_bends_along_the_way_count():
    """A gully, straight along x: the flow that follows it sees no bend."""

    def gully(x, y):
        return -0.3 * x + 0.01 * (y - 70.0) ** 2

    assert way(gully) == pytest.approx(0.95)
    assert way(gully, direction=(0.0, 1.0)) == pytest.approx(0.5)
    saddle = way(lambda x, y: 0.005 * (x - 105.0) * (y - 70.0))  # turns aside
    assert saddle == pytest.approx(0.5)


def test_a_kink_is_seen_before_it_is_entered():
    """It bends the surface from 190 m on; from 182 m a step of .95 nodes would end 1.5 m behind this."""

    def kink(x, y):
        return np.where(x < 200.0, -0.5 * (x - 200.0), 0.0) + 0.0 * y

    assert way(kink, x=170.0) == pytest.approx(0.95)
    assert way(kink, x=182.0) == pytest.approx(0.5, abs=0.2)
    assert way(kink, x=186.0) == pytest.approx(0.5)


def test_near_a_wall_and_from_a_stand_it_is_half_a_node():
    status = np.zeros((ROWS, COLUMNS))
    status[7, 13] = CLOSED
    raster = Raster.from_status(status, (SPACING, SPACING))
    assert way(plane, x=114.0, raster=raster) == pytest.approx(0.5)  # nearest is node 11
    assert way(plane, x=104.0, raster=raster) == pytest.approx(0.95)
    assert way(plane, speed=3.0) == pytest.approx(0.5)  # gravity may turn it on the way
