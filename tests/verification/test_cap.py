"""Parabolic caps that spread on a plane of 30 degrees (docs/theory.md#flow-solutions), by their second moments."""

import math

import numpy as np
import pytest

from landlab_debrisflow import DebrisFlow
from validation.cases import planes
from validation.grids import dry_block, inclined, place, release, release_cap

ANGLE = math.radians(30.0)
COS = math.cos(ANGLE)
SIZE, DEPTH = 10.0, 1.0  # radius or half width along the slope, slope-normal thickness in the middle [m]


@pytest.mark.slow
def test_a_circular_cap_spreads_at_the_exact_rate():
    """Without friction R^2 = R0^2 + 2 g' h0 t^2; on the map the cap is an ellipse."""
    grid = inclined((113, 221), 0.5, math.tan(ANGLE))
    release_cap(grid, (24.0, 28.0), (SIZE * COS, SIZE), DEPTH / COS, on_top=True)
    flow = place(DebrisFlow(grid, **dry_block(0.0, particle_count=500)))
    flow.run_one_step(5.0 - flow.elapsed_time)
    p = flow.particles
    x, y = float(p.x.std()) / COS, float(p.y.std())
    # in a parabolic cap <x^2> = <y^2> = R^2/6
    # measured 2.7e-3 and 2.2e-3 at 500 particles, 2.4e-3 and 1.9e-3 at 2000: the width of the smoothing kernel
    assert math.sqrt(6.0) * x == pytest.approx(22.908196, rel=4e-3)
    assert math.sqrt(6.0) * y == pytest.approx(22.908196, rel=4e-3)
    # h = h0 (R0/R)^2 in the middle; measured 1 %: noise of the thickness of one particle
    assert float(p.thickness.max()) == pytest.approx(DEPTH * (SIZE / 22.908196) ** 2, rel=0.03)
    assert np.median(abs(p.thickness / (DEPTH * (SIZE / 22.908196) ** 2) - parabola(p, x, y))) < 0.02


def parabola(p, x, y):
    """Return 1 - r^2/R^2 at the particles, R^2 = 6 <x^2>; measured median error .012, at 2000 .005."""
    return 1.0 - ((p.x - p.x.mean()) / (x * COS)) ** 2 / 6.0 - ((p.y - p.y.mean()) / y) ** 2 / 6.0


@pytest.mark.slow
@pytest.mark.parametrize("friction_angle", [0.0, 20.0])
def test_a_ridge_spreads_at_the_exact_rate_whatever_its_friction(friction_angle):
    """1-D: while all of it moves downslope, friction is the same for all and the half width obeys
    l'' = 3/2 g' V/l^2: 24.586978 m after 5 s. The ridge has free ends, which do not influence the middle:
    they unload it at 2 (g' h0)^(1/2) = 6 m/s from 40 m away."""
    grid = inclined((161, 151), 1.0, math.tan(ANGLE))
    x, y = grid.x_of_node - 30.0, grid.y_of_node - 80.0
    release(grid, (abs(y) < 50.5) * np.maximum(0.0, 1.0 - (x / SIZE / COS) ** 2) * DEPTH / COS, on_top=True)
    keywords = dry_block(math.tan(math.radians(friction_angle)), particle_count=4000)
    flow = place(DebrisFlow(grid, **keywords))
    middle = (abs(flow.particles.y - 80.0) < 10.0).values  # 28 particles across the ridge, some 800 in all
    flow.run_one_step(5.0 - flow.elapsed_time)
    half_width = math.sqrt(5.0) * float(flow.particles.x[middle].std()) / COS
    # measured +3.2e-3 and +3.1e-3; the raster ridge starts 6.6e-3 too narrow
    assert half_width == pytest.approx(24.586978, rel=6e-3)


@pytest.mark.slow
@pytest.mark.parametrize("degrees", [0.0, 45.0])
def test_a_circular_cap_keeps_its_shape_whatever_the_slope(degrees):
    found = planes.cap(500, degrees)
    # measured 3.0e-3 and 2.6e-3 at most, and .018, .017 of h, .025, .024 of hu in the frame of the centre; with 2000
    # particles .009 and .019: the width of the kernel
    assert abs(found.scalars["radius along, error"]) < 5e-3 and abs(found.scalars["radius across, error"]) < 5e-3
    assert found.h.l1 < 0.025 and found.hu.l1 < 0.035
    assert abs(found.scalars["energy drift"]) < 5.5e-4  # measured -3.6e-4, -4e-5


def test_a_cap_with_friction_follows_the_similarity_solution():
    found = planes.similarity(500)
    # 35 degrees, friction 25; measured .010 and .013, of which .006 and .008 are the solution's own: it linearises
    # friction
    assert found.h.l1 < 0.015 and found.hu.l1 < 0.02
