"""Peaks at the nodes by hand: one particle, one node, four faces."""

import numpy as np
import pytest

from landlab_debrisflow.model.map_fields import CURRENT, PEAKS
from landlab_debrisflow.model.particles import Particles
from landlab_debrisflow.model.peak_maps import PeakMaps
from landlab_debrisflow.spatial.raster import CLOSED, Raster
from landlab_debrisflow.spatial.transfer import Cover

SHAPE, D, ARRIVAL_DEPTH = (5, 5), 10.0, 0.01
EAST, WEST, NORTH, SOUTH = (2, 3), (2, 1), (3, 2), (1, 2)
CORNERS = [(1, 1), (1, 3), (3, 1), (3, 3)]


def peak_maps(closed):
    status = np.zeros(SHAPE, int)
    for node in closed:
        status[node] = CLOSED
    fields = {name: np.zeros(status.size) for name in CURRENT + PEAKS}
    raster = Raster.from_status(status, (D, D))
    return PeakMaps(raster, fields, ARRIVAL_DEPTH, 0.0), {name: a.reshape(SHAPE) for name, a in fields.items()}


def record(seen, p, density, time):
    footprints = Cover(seen._raster).footprints(p.x, p.y, p.volume, p.depth, p.share)
    seen.record(p, footprints, density, time)


def over_the_middle(*velocities, **values):
    """Particles of 25 m3, 4 m deep: their hats are no wider than a node, so they are on none but the one below."""
    p, n = Particles(2), len(velocities)
    usual = {"x": 2 * D, "y": 2 * D, "volume": 25.0, "depth": 4.0, "z": 0.0, "lowest_z": 0.0}
    p.append(n, **(usual | values))
    p.velocity[:] = np.array(velocities).T
    return p


def test_a_closed_node_gets_what_is_towards_its_face():
    seen, field = peak_maps([EAST, WEST, NORTH, SOUTH])
    record(seen, over_the_middle((3.0, -4.0, 2.0)), 2000.0, 1.0)
    impact, run_up = field["max_impact_pressure"], field["max_run_up"]
    assert impact[2, 2] == pytest.approx(2000.0 * 29.0, rel=1e-14)
    assert [impact[face] for face in (EAST, WEST, NORTH, SOUTH)] == pytest.approx([18000.0, 0.0, 0.0, 32000.0])
    assert all(run_up[face] == run_up[2, 2] == 4.0 for face in (EAST, WEST, NORTH, SOUTH))
    assert not field["max_depth"][tuple(zip(EAST, WEST, NORTH, SOUTH, strict=True))].any()
    assert not any(impact[node] or run_up[node] for node in CORNERS)  # they have no face here


def test_peaks_stay_and_what_is_slower_or_lower_does_not_lower_them():
    seen, field = peak_maps([EAST])
    record(seen, over_the_middle((3.0, 0.0, 0.0), z=7.0, lowest_z=2.0), 2000.0, 1.0)
    before = {name: field[name].copy() for name in ("max_impact_pressure", "max_run_up")}
    assert before["max_run_up"][EAST] == 9.0 and before["max_impact_pressure"][EAST] == 18000.0
    record(seen, over_the_middle((-1.0, 0.0, 0.0)), 2000.0, 2.0)
    seen.clear()
    for name, values in before.items():
        np.testing.assert_array_equal(field[name], values)


def test_densities_may_be_those_of_each_particle():
    """The mean over the volume of density x speed^2, and of what is towards the wall: not of the speeds."""
    seen, field = peak_maps([EAST])
    record(seen, over_the_middle((3.0, 0.0, 0.0), (-1.0, 0.0, 0.0)), np.array([2000.0, 1000.0]), 1.0)
    assert field["max_impact_pressure"][2, 2] == pytest.approx(0.5 * (18000.0 + 1000.0), rel=1e-14)
    assert field["max_impact_pressure"][EAST] == pytest.approx(9000.0, rel=1e-14)


def test_a_node_on_the_rim_has_no_neighbour_beyond_it():
    """Not the node at the other end of the next row."""
    seen, field = peak_maps([(1, 0), (2, 0), (3, 0)])
    p = over_the_middle((5.0, 0.0, 0.0))
    p.x[:] = 4 * D
    record(seen, p, 1000.0, 1.0)
    assert field["max_impact_pressure"][2, 4] == 25000.0
    assert not field["max_impact_pressure"][:, 0].any()


@pytest.mark.parametrize(("share", "counts"), [(0.99, False), (1.01, True)])
def test_a_film_is_no_peak(share, counts):
    """What is less than counts as arrival, as the last per mille of a hat, shows where it is, and in no peak."""
    seen, field = peak_maps([EAST])
    field["arrival_time"][:] = -1.0
    p = over_the_middle(
        (3.0, 0.0, 0.0), volume=share * ARRIVAL_DEPTH * D * D, basal_excess_pore_pressure=600.0,
        liquefaction_pressure=1000.0, basal_peclet_number=7.0,
    )  # fmt: skip
    record(seen, p, 2000.0, 1.0)
    shown = {name: field[name][2, 2] for name in CURRENT}
    assert shown == pytest.approx(
        {"depth": share * 0.01, "speed": 3.0, "basal_excess_pore_pressure": 600.0, "basal_peclet_number": 7.0}
    )
    for name in PEAKS:
        assert (field[name][2, 2] != (-1.0 if name == "arrival_time" else 0.0)) == counts, name
    for name in ("max_impact_pressure", "max_run_up"):
        assert (field[name][EAST] > 0.0) == counts, name
