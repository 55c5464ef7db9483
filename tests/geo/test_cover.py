"""Cells in a polygon and nodes along a line: areas to rounding, and the same nodes as one by one."""

import numpy as np
import pytest
import shapely
from numpy.testing import assert_array_equal
from shapely import LineString, MultiPolygon, Point, Polygon, box

from landlab_debrisflow.geo.cover import cover_cells, covered_fraction, nodes_inside, nodes_near
from landlab_debrisflow.geo.lattice import Lattice

LATTICE = Lattice((60, 90), (5.0, 4.0), (412_345.678, 5_123_456.789))
X, Y = (grid.reshape(-1) for grid in np.meshgrid(LATTICE.x, LATTICE.y))
WEST, SOUTH, EAST, NORTH = LATTICE.bounds


def star(generator, x, y, radius, corners=40):
    angles = np.sort(generator.uniform(0.0, 2.0 * np.pi, corners))
    radii = radius * generator.uniform(0.4, 1.0, corners)
    return Polygon(np.column_stack([x + radii * np.cos(angles), y + radii * np.sin(angles)]))


def shapes():
    generator = np.random.default_rng(5)
    for k in range(12):
        x, y = generator.uniform(WEST, EAST), generator.uniform(SOUTH, NORTH)
        yield pytest.param(star(generator, x, y, 10.0 ** generator.uniform(0.0, 2.3)), id=f"star{k}")
    ring = Point(WEST + 200.0, SOUTH + 120.0).buffer(90.0).difference(Point(WEST + 210.0, SOUTH + 110.0).buffer(40.0))
    yield pytest.param(ring, id="ring")
    yield pytest.param(star(generator, WEST + 200.0, SOUTH + 100.0, 60.0, corners=600), id="many_corners")
    yield pytest.param(MultiPolygon([ring, box(WEST - 50.0, SOUTH - 50.0, WEST + 33.0, SOUTH + 7.0)]), id="pieces")
    yield pytest.param(box(*LATTICE.bounds), id="all")
    yield pytest.param(box(WEST - 1e4, SOUTH - 1e4, EAST + 1e4, NORTH + 1e4), id="more")
    yield pytest.param(box(WEST - 20.0, SOUTH - 20.0, WEST - 10.0, NORTH), id="outside")
    yield pytest.param(box(WEST + 10.0, SOUTH + 8.0, WEST + 30.0, SOUTH + 16.0), id="whole_cells")


@pytest.mark.parametrize("polygon", list(shapes()))
def test_areas_are_exact_and_nodes_those_inside(polygon):
    cover = cover_cells(polygon, LATTICE)
    x0, y0 = LATTICE.lower_left
    moved = shapely.transform(polygon, lambda points: points - (x0, y0))  # rounding of large coordinates out of the way
    inside = moved.intersection(box(-2.5, -2.0, EAST - x0, NORTH - y0)).area
    # areas of single cells, rounded to 1e-16 each, are summed
    assert cover.fraction.sum() * LATTICE.area == pytest.approx(inside, rel=1e-12, abs=1e-9)
    assert np.all(np.diff(cover.nodes) > 0) and np.all((cover.fraction > 0.0) & (cover.fraction <= 1.0))
    cells = shapely.box(X - x0 - 2.5, Y - y0 - 2.0, X - x0 + 2.5, Y - y0 + 2.0)
    expected = shapely.area(shapely.intersection(cells, moved)) / LATTICE.area
    np.testing.assert_allclose(covered_fraction(polygon, LATTICE).reshape(-1), expected, atol=1e-9)
    assert_array_equal(nodes_inside(polygon, LATTICE), np.flatnonzero(shapely.contains_xy(moved, X - x0, Y - y0)))


@pytest.mark.parametrize("reach", [0.0, 3.0, 40.0])
def test_nodes_near_a_line(reach):
    line = LineString([(WEST - 30.0, SOUTH + 50.0), (WEST + 100.0, SOUTH + 120.0), (WEST + 300.0, SOUTH + 90.0)])
    near = nodes_near(line, LATTICE, reach)
    points = shapely.points(X, Y)
    distance = shapely.distance(line, points)
    assert_array_equal(near.nodes, np.flatnonzero(distance <= reach))
    # coordinates of 5e6 m hold nanometres
    np.testing.assert_allclose(near.distance, distance[near.nodes], atol=1e-8)
    np.testing.assert_allclose(near.station, shapely.line_locate_point(line, points)[near.nodes], atol=1e-8)
