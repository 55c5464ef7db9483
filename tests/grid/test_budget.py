"""The accounts of volume, each term measured here anew from fields and particles."""

import numpy as np
import pytest

from landlab_debrisflow import DebrisFlow
from validation.grids import COARSE, inclined, release_cap, release_slab

Z, SOIL, RELEASE = "topographic__elevation", "soil__depth", "debris_flow__release_depth"


class Auditor:
    """Measures every term on its own, from what any user can see."""

    def __init__(self, grid, **keywords):
        self.grid, self.area = grid, grid.dx * grid.dy
        self.start = grid.at_node[Z].copy()
        self.soil = grid.at_node[SOIL].copy()
        self.released = self.inflow = 0.0
        self.flow = DebrisFlow(grid, **({"numerics": COARSE} | keywords))

    def expect_release(self):
        self.released += float(self.grid.at_node[RELEASE].sum()) * self.area
        return self.flow

    def check(self):
        """Assert both balances and return the terms."""
        at, flow, budget = self.grid.at_node, self.flow, self.flow.budget
        deposit = float(at["debris_flow__deposit_depth"].sum()) * self.area
        particles = float(flow.particles.volume.sum())
        terms = {
            "released": self.released,
            "inflow": self.inflow,
            "eroded": float(at["debris_flow__eroded_depth"].sum()) * self.area,
            "moving": particles,
            "outflow": sum(flow.outflow_by_edge.values()),
        }
        size = terms["released"] + terms["inflow"] + terms["eroded"]
        # rounding of sums over some thousand nodes and of elevations of some 100 m: 1e-12 of the volume
        tolerance = 1e-12 * size
        for name, volume in terms.items():
            assert budget[name] == pytest.approx(volume, abs=tolerance), name
        if particles == 0.0:
            assert budget["deposited"] == pytest.approx(deposit, abs=tolerance)
        rest = size - terms["moving"] - budget["deposited"] - terms["outflow"]
        assert abs(rest) <= tolerance and abs(budget["residual"]) <= tolerance
        for name, before in ((Z, self.start), (SOIL, self.soil)):
            gain = float((at[name] - before).sum()) * self.area
            assert gain == pytest.approx(budget["deposited"] - self.released - terms["eroded"], abs=tolerance), name
        assert np.all(at[SOIL] >= 0.0)
        return budget


@pytest.mark.slow
def test_at_every_moment_of_an_event(valley):
    audit = Auditor(valley)
    flow = audit.expect_release()
    eroded = []
    for _ in range(8):
        flow.run_one_step(2.0)
        eroded.append(audit.check()["eroded"])
    assert eroded == sorted(eroded) and eroded[-1] > 100.0
    assert flow.run_until_rest() is True
    budget = audit.check()
    assert budget["deposited"] > 300.0 and budget["moving"] == budget["outflow"] == 0.0


@pytest.mark.slow
def test_until_the_soil_is_used_up():
    grid = inclined((20, 80), 5.0, 0.5, soil=0.05, foot=200.0)
    release_slab(grid, (30.0, 48.0), 8.0, 0.05)
    grid.at_node[SOIL][grid.at_node[RELEASE] > 0.0] = 3.0
    grid.at_node[RELEASE][grid.at_node[RELEASE] > 0.0] = 3.0
    audit = Auditor(grid, erosion={"law": "growth", "growth_rate": 0.1})
    assert audit.expect_release().run_until_rest() is True
    budget = audit.check()
    assert budget["eroded"] > 50.0
    bare = (grid.at_node[SOIL] < 1e-12) & (grid.at_node["debris_flow__eroded_depth"] > 0.0)
    assert bare.sum() > 10  # exhausted somewhere, to the last grain


@pytest.mark.slow
def test_with_inflow_and_outflow(slope):
    line = {"line_start": (20.0, 30.0), "line_end": (20.0, 60.0)}
    hydrograph = {"times": [0.0, 5.0, 20.0], "discharge": [0.0, 60.0, 0.0], "velocity": 5.0}
    audit = Auditor(slope, inflow=line | hydrograph)
    flow = audit.expect_release()
    for _ in range(8):
        flow.run_one_step(2.5)
        audit.inflow = float(flow.budget["inflow"])
        audit.check()
    audit.inflow = 0.5 * 60.0 * 20.0
    assert audit.check()["outflow"] > 500.0
    flow.run_until_rest()
    assert audit.check()["eroded"] > 100.0


@pytest.mark.parametrize("closed", [False, True])
def test_with_outflow_and_with_walls(slope, closed):
    if closed:
        slope.set_closed_boundaries_at_grid_edges(True, True, True, True)
    audit = Auditor(slope)
    audit.expect_release().run_until_rest()
    budget = audit.check()
    assert (budget["outflow"] == 0.0) == closed and (budget["outflow"] > 200.0) != closed


def test_with_two_releases_and_settling_by_hand(valley):
    audit = Auditor(valley, numerics=COARSE | {"settle": False})
    audit.expect_release().run_one_step(3.0)
    release_slab(valley, (60.0, 30.0), 8.0, 0.3)
    audit.expect_release().run_one_step(1.0)
    audit.check()
    assert audit.flow.run_until_rest() is True
    resting = audit.check()
    assert resting["deposited"] == 0.0
    audit.flow.settle()
    assert audit.check()["deposited"] == pytest.approx(resting["moving"], rel=1e-12)


@pytest.mark.slow
def test_over_many_events(valley):
    release = valley.at_node[RELEASE].copy()
    audit = Auditor(valley, column="none")
    deposited = []
    for _ in range(4):
        valley.at_node[RELEASE][:] = np.minimum(0.3 * release, valley.at_node[SOIL])
        audit.expect_release().run_until_rest()
        deposited.append(audit.check()["deposited"])
    assert deposited == sorted(set(deposited))


@pytest.mark.slow
def test_with_unequal_spacing_and_a_bed_of_its_own_ratio():
    grid = inclined((24, 60), (6.0, 4.0), 0.6, soil=1.0, foot=200.0)
    grid.at_node[SOIL][:] = np.random.default_rng(1).uniform(0.0, 1.0, grid.number_of_nodes)
    grid.add_field("bed__excess_pore_pressure_ratio", np.linspace(0.0, 1.0, grid.number_of_nodes), at="node")
    release_cap(grid, (40.0, 48.0), (15.0, 12.0), 1.0)
    grid.at_node[RELEASE][:] = np.minimum(grid.at_node[RELEASE], grid.at_node[SOIL])
    audit = Auditor(grid, friction={"law": "voellmy", "turbulent_coefficient": 300.0})
    audit.expect_release().run_until_rest()
    assert audit.check()["eroded"] > 1.0
