"""A run from plain arrays, and its state: copied, written, read and continued."""

import numpy as np
import pytest
import xarray as xr

from landlab_debrisflow import InputError
from landlab_debrisflow.core.parameters import on_nodes
from landlab_debrisflow.model.inflow.hydrograph import Hydrograph
from landlab_debrisflow.model.inflow.inflow import Inflow
from landlab_debrisflow.model.numerics import Numerics
from landlab_debrisflow.model.simulation import Simulation
from landlab_debrisflow.record.files import write_dataset
from landlab_debrisflow.scene.setup import Setup
from landlab_debrisflow.terrain.bed import Bed

SHAPE, SPACING = (20, 60), (5.0, 5.0)
SURGE = {
    "line_start": (20.0, 38.0), "line_end": (20.0, 58.0), "times": [1.0, 3.0, 12.0], "discharge": [0.0, 20.0, 0.0],
    "velocity": 4.0,
}  # fmt: skip
WET = {"coefficient_of_consolidation": 2e-3, "initial_pressure_ratio": 0.3}
SCENES = {
    "moves": ({"erosion": "none"}, ()),
    "erodes": ({}, ()),
    "sleeps": ({"erosion": "none", "material": WET}, ()),
    "flows in": ({}, (SURGE,)),
    "two phases": ({"flow": "two_phase"}, ()),
    "two phases flow in": ({"flow": "two_phase"}, (SURGE,)),
}


class Terrain:
    """A valley with a foot, as arrays."""

    def __init__(self, soil=1.0):
        self.y, self.x = np.mgrid[: SHAPE[0], : SHAPE[1]] * 5.0
        self.elevation = 0.5 * np.maximum(0.0, 120.0 - self.x)
        self.soil, self.eroded, self.earlier = np.full(SHAPE, soil), np.zeros(self.x.size), np.zeros(self.x.size)

    def copy(self):
        other = Terrain()
        vars(other).update({name: values.copy() for name, values in vars(self).items()})
        return other

    def bed(self):
        return Bed.from_arrays(
            self.elevation, SPACING, self.soil, 0.65, eroded_depth=self.eroded, earlier=self.earlier.copy()
        )


def build(scene, particles=60):
    """Return a simulation that nothing was released in yet."""
    laws, hydrographs = SCENES[scene]
    numerics = Numerics(particle_count=particles)
    inflow = Inflow([Hydrograph(**each) for each in hydrographs], numerics)
    return Simulation(Setup(**laws, numerics=numerics), inflow)


def call(simulation, terrain, seconds, failing=None, changed=False):
    """Do what a call does, on arrays: a bed, perhaps a release, and a run."""
    if failing is not None:
        terrain.elevation[failing] -= 1.0
    bed = terrain.bed()
    simulation.inflow.aim(bed.surface)
    laws = {"friction": simulation.setup.friction, "erosion": simulation.setup.erosion}
    simulation.set_bed(bed, {kind: on_nodes(law, {}) for kind, law in laws.items()}, changed)
    if failing is not None:
        nodes = np.flatnonzero(failing)
        simulation.release(nodes, np.ones(nodes.size))
    end = simulation.time + seconds
    simulation.start(end)
    simulation.advance(end)
    nodes, depth, _ = bed.lowered
    terrain.earlier[nodes] += depth


def begun(scene, seconds=4.0, particles=60):
    simulation, terrain = build(scene, particles), Terrain()
    failing = (abs(terrain.x - 30.0) < 9.0) & (abs(terrain.y - 48.0) < 9.0)
    if scene == "sleeps":
        failing |= (abs(terrain.x - 150.0) < 13.0) & (abs(terrain.y - 48.0) < 11.0)
    call(simulation, terrain, seconds, failing, changed=True)
    return simulation, terrain


def assert_same(one, other):
    one, other = one.to_dataset(), other.to_dataset()
    assert set(one.variables) == set(other.variables)
    for name in one.variables:
        np.testing.assert_array_equal(one[name].values, other[name].values, err_msg=name)


def test_it_runs_to_rest_on_arrays_alone():
    simulation, terrain = begun("erodes")
    volume = simulation.particles.volume.sum()
    call(simulation, terrain, 200.0)
    assert simulation.at_rest and not simulation.particles.velocity.any()
    assert terrain.eroded.sum() * 25.0 == pytest.approx(simulation.particles.volume.sum() - 300.0, rel=1e-12)
    assert simulation.particles.volume.sum() > volume
    before = terrain.elevation.sum()
    nodes, depth = simulation.settle()
    assert (terrain.elevation.sum() - before) == pytest.approx(depth.sum(), rel=1e-9) and nodes.size


@pytest.mark.parametrize("scene", SCENES)
def test_written_read_and_continued_it_is_the_run_without_interruption(scene, tmp_path):
    simulation, terrain = begun(scene)
    p = simulation.particles
    assert simulation.setup.two_phases or scene != "sleeps" or 0 < p.awake < p.count
    assert scene != "erodes" or p.entrained_volume.any()
    assert "flow" not in scene or "in" not in scene or simulation.inflow.prescribed(p).size
    path = write_dataset(tmp_path / "state.nc", simulation.state.to_dataset())
    other, other_terrain = build(scene), terrain.copy()
    with xr.open_dataset(path) as dataset:
        other.state = other.state.from_dataset(dataset)
    assert_same(other.state, simulation.state)
    for each, on in ((simulation, terrain), (other, other_terrain)):
        call(each, on, 5.0)
    assert_same(other.state, simulation.state)
    np.testing.assert_array_equal(other_terrain.elevation, terrain.elevation)
    assert simulation.state.counters.steps > 20


@pytest.mark.parametrize("scene", SCENES)
def test_to_go_back_is_one_assignment(scene):
    simulation, terrain = begun(scene)
    before, ground = simulation.state.copy(), terrain.copy()
    call(simulation, terrain, 3.0)
    first = simulation.state
    simulation.state = before
    call(simulation, ground, 3.0)
    assert_same(simulation.state, first)


def test_every_array_has_dimensions_and_every_variable_its_unit():
    simulation, _ = begun("two phases")
    dataset, p = simulation.state.to_dataset(), simulation.particles
    for variable in p.variables:
        assert dataset[variable.name].units == variable.unit and "particle" in dataset[variable.name].dims


def test_diagnostics_tell_what_a_run_took():
    simulation, _ = begun("sleeps")
    found = simulation.diagnostics
    assert found.steps == simulation.state.counters.steps > 10
    assert 0.0 < found.smallest_step < 4.0 / 10 and 0.0 < found.share_asleep < 1.0
    assert min(found.cpu.values()) >= 0.0 and sum(found.cpu.values()) > 0.0
    with pytest.raises(TypeError):
        found.cpu["summation"] = 0.0


def test_a_dataset_that_is_no_state_is_refused():
    with pytest.raises(InputError, match=r"state: the Dataset lacks identity, .* and more; give a Dataset that"):
        build("moves").state.from_dataset(xr.Dataset())


def test_accounts_are_written_and_read():
    state = build("moves").state
    state.settled_solid, state.stopped.volume = 2.5, 1.5
    state.outflow.count(np.array([3, 7]), np.array([2.0, 1.0]), np.array([1.0, 0.5]))
    again = build("moves").state.from_dataset(state.to_dataset())
    assert again.settled_solid == 2.5 and again.stopped.volume == 1.5
    assert again.outflow.total == 3.0 and again.outflow.solid == 1.5
