"""The bed's own pore pressure: closed forms on one node."""

import math

import numpy as np
import pytest

from landlab_debrisflow.spatial.raster import CLOSED, CORE, Raster
from landlab_debrisflow.spatial.transfer import Cover
from landlab_debrisflow.terrain.bed_pressure import BedPressure

SHAPE, SPACING = (5, 6), 2.0
HERE, THERE = 2 * SHAPE[1] + 2, 2 * SHAPE[1] + 3
B, T = 0.4, 30.0
LOAD, LIQUEFACTION = 39e3, 19e3  # rho g h and rho' g h of two metres [Pa]


class OnOneNode:
    """A column of debris as large as a cell, on a node or away."""

    def __init__(self, loading=B, drainage_time=T, start=100.0, pressure=0.0):
        status = np.full(SHAPE, CLOSED)
        status[1:-1, 1:-1] = CORE
        raster = Raster.from_status(status, (SPACING, SPACING))
        self.cover = Cover(raster)
        self.pressure = np.full(status.size, pressure)
        self.bed = BedPressure(raster, self.pressure, loading, drainage_time, start)
        self.start = self.time = start

    def after(self, dt, load, node=HERE, stand=False):
        """Let `dt` seconds pass in which the load on a node becomes `load` times the one above; return its pressure."""
        row, column = divmod(node, SHAPE[1])
        x, y, one = np.array([column * SPACING]), np.array([row * SPACING]), np.ones(1)
        footprints = self.cover.footprints(x, y, one, one, one)  # as wide as a node
        force = load * SPACING**2 * np.array([[LOAD, LIQUEFACTION]])
        self.time += dt
        if stand:
            self.bed.stand(footprints, force, self.time)
        else:
            self.bed.carry(footprints, force, self.time, dt)
        return self.pressure[node]


def test_a_load_laid_on_at_once_decays():
    """dp = B rho g_n h exp(-t/T)."""
    one = OnOneNode()
    assert one.after(0.0, 1.0) == pytest.approx(B * LOAD, rel=1e-15)
    for _ in range(7):
        found = one.after(9.0, 1.0)
        exact = B * LOAD * math.exp(-(one.time - one.start) / T)
        assert found == pytest.approx(exact, rel=1e-14)
        assert one.bed.ratio[HERE] == pytest.approx(exact / LIQUEFACTION, rel=1e-14)
    assert np.count_nonzero(one.pressure) == 1


@pytest.mark.parametrize("steps", [1, 3, 100])
def test_under_a_load_that_grows_evenly_it_is_exact_for_any_step(steps):
    """dp = B L' T (1 - exp(-t/T))."""
    one = OnOneNode()
    for k in range(steps):
        found = one.after(60.0 / steps, (k + 1) / steps)
    assert found == pytest.approx(B * LOAD / 60.0 * T * (1.0 - math.exp(-60.0 / T)), rel=1e-13)


def test_without_drainage_it_follows_the_load():
    one = OnOneNode(drainage_time=math.inf)
    for load in (0.2, 1.0, 0.7, 3.0):
        assert one.after(5.0, load) == pytest.approx(B * load * LOAD, rel=1e-14)
    one.after(5.0, 1.0, THERE)
    assert one.pressure[HERE] == pytest.approx(0.0, abs=1e-11)  # round-off of 47 kPa
    assert one.pressure[THERE] == pytest.approx(B * LOAD, rel=1e-15)


def test_it_never_falls_below_zero_and_the_ratio_never_rises_above_one():
    one = OnOneNode(loading=1.0)
    one.after(0.0, 1.0)
    assert one.bed.ratio[HERE] == 1.0 and one.pressure[HERE] == LOAD
    one.after(T, 1.0)  # 39/e = 14.3 kPa are left
    assert one.bed.ratio[HERE] == pytest.approx(LOAD / LIQUEFACTION / math.e, rel=1e-14)
    one.after(1.0, 1.0, THERE)
    assert one.pressure[HERE] == 0.0 and one.bed.ratio[HERE] == 0.0


def test_what_lies_there_at_the_start_is_no_new_load():
    one = OnOneNode(pressure=5e3)
    assert one.after(0.0, 1.0, stand=True) == 5e3
    assert one.bed.ratio[HERE] == pytest.approx(5.0 / 19.0, rel=1e-15)
    assert one.after(6.0, 1.0) == pytest.approx(5e3 * math.exp(-6.0 / T), rel=1e-14)
    assert one.after(0.0, 1.5) == pytest.approx(5e3 * math.exp(-6.0 / T) + 0.5 * B * LOAD, rel=1e-14)


def test_a_node_nobody_looks_at_drains_all_the_same():
    one = OnOneNode(pressure=5e3)
    one.after(4.0, 1.0, THERE)
    one.after(40.0, 1.0, THERE)
    assert one.pressure[HERE] == 5e3  # not yet
    # drained for 44 s, then loaded in 2 s
    late = B * LOAD * T / 2.0 * (1.0 - math.exp(-2.0 / T))
    assert one.after(2.0, 1.0) == pytest.approx(5e3 * math.exp(-46.0 / T) + late, rel=1e-14)


def test_when_all_are_asked_all_are_brought_to_the_present():
    one = OnOneNode(pressure=5e3)
    one.after(0.0, 1.0)
    one.after(7.0, 1.0)
    one.bed.drain(one.time, slice(SHAPE[1], 2 * SHAPE[1]))  # some
    one.bed.finish(one.time + 3.0, slice(SHAPE[1], 3 * SHAPE[1]))
    expected = np.full(one.pressure.size, 5e3 * math.exp(-10.0 / T))
    expected[HERE] += B * LOAD * math.exp(-10.0 / T)
    np.testing.assert_allclose(one.pressure, expected, rtol=1e-14)
