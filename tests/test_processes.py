"""Pickles, and what other processes do: forked and spawned workers, and what comes back from them."""

import multiprocessing
import os
import pickle
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from landlab_debrisflow import DebrisFlow, Hydrograph, Material, Numerics, Setup, SimulationError
from landlab_debrisflow.core.parameters import on_nodes
from landlab_debrisflow.core.threads import in_ranges
from landlab_debrisflow.core.values import NodeValues
from landlab_debrisflow.physics.registry import LAWS
from tests.twins import SCENES, build, state
from validation.grids import COARSE, copy_fields

SURGE = {
    "line_start": (20.0, 30.0), "line_end": (20.0, 60.0), "times": [0.0, 9.0], "discharge": 5.0, "velocity": 2.0,
}  # fmt: skip
DECLARED = [law() for laws in LAWS.values() for law in laws.values()] + [Material(), Numerics(), Hydrograph(**SURGE)]


def sent(value):
    return pickle.loads(pickle.dumps(value))


@pytest.mark.parametrize("law", DECLARED, ids=lambda law: type(law).__name__)
def test_a_law_pickles_also_when_it_was_used(law):
    assert sent(law) == law
    numbers = on_nodes(law, {})
    assert sent(law) == law and on_nodes(sent(law), {}) == numbers and sent(numbers) == numbers


def test_what_varies_in_space_pickles_and_stays_as_it_was_checked():
    angles = NodeValues(np.array([20.0, 30.0]))
    law = LAWS["friction"]["voellmy"](basal_friction_angle=angles)
    on_nodes(law, {})
    again = sent(law)
    assert again == law and hash(again) == hash(law)
    assert not again.basal_friction_angle.values.flags.writeable


def test_the_laws_of_a_flow_that_ran_pickle(valley):
    laws = {"flow": "two_phase", "friction": "herschel_bulkley", "column": "classical"}
    flow = DebrisFlow(valley, **laws, numerics=COARSE, inflow=SURGE)
    flow.run_one_step(0.5)
    assert flow.setup == Setup(**laws, numerics=COARSE, inflow=SURGE)
    for kept in (flow.setup, flow.setup.numerics, flow.setup.inflow):
        assert sent(kept) == kept


def test_an_error_of_the_simulation_comes_back_whole():
    # a pool that cannot read what a worker sent waits for it for ever
    error = SimulationError("thickness", 7, 12.5, float("nan"))
    error.add_note("of member 3")
    again = sent(error)
    assert str(again) == str(error) and (again.variable, again.particle, again.time) == ("thickness", 7, 12.5)
    assert again.__notes__ == ["of member 3"]


@pytest.mark.slow
@pytest.mark.parametrize("seconds", [0.0, 3.0, 1e4], ids=["before it runs", "while it moves", "at rest"])
def test_a_flow_goes_on_from_a_pickle(valley, seconds):
    flow = DebrisFlow(valley, numerics=COARSE)
    flow.run_one_step(seconds)
    other = sent(flow)
    for each in (flow, other):
        each.run_until_rest()
        each.grid.at_node["debris_flow__release_depth"][8 * 80 + 6] = 0.2
        each.run_one_step(5.0)
    fields, others = copy_fields(flow.grid), copy_fields(other.grid)
    assert {name: values.tobytes() for name, values in fields.items()} == {n: v.tobytes() for n, v in others.items()}
    assert flow.budget == other.budget and flow.elapsed_time == other.elapsed_time


@pytest.mark.parametrize("scene", list(SCENES))
def test_whatever_flows_goes_on_from_a_pickle(scene):
    flow = build(scene)
    flow.run_one_step(2.0)
    other = sent(flow)
    assert other.setup == flow.setup
    assert state(other) == state(flow)
    for each in (flow, other):
        each.run_one_step(2.0)
    assert state(other) == state(flow) and other.budget == flow.budget


def summed(threads):
    """Return by how much the doubles of some numbers, made in threads, are wrong, and how many these are."""
    x = np.random.default_rng(1).uniform(0.0, 100.0, 500)
    found = np.zeros(500)

    def double(first, last, out):
        out[first:last] = 2.0 * x[first:last]

    in_ranges(double, x.size, threads, found)
    return float((found - 2.0 * x).sum()), found.size


def in_a_fork(threads, generations):
    """Return whether a forked process, or one forked from that, ends well with so many threads."""

    def work():
        good = summed(threads) == (0.0, 500)
        good &= generations == 1 or in_a_fork(threads, generations - 1)
        os._exit(0 if good else 1)

    process = multiprocessing.get_context("fork").Process(target=work)
    process.start()
    process.join(20.0)
    if process.is_alive():
        process.kill()
        process.join()
    return process.exitcode == 0


METHODS = [way for way in ("fork", "spawn") if way in multiprocessing.get_all_start_methods()]


@pytest.mark.parametrize("generations", [1, 2] if "fork" in METHODS else [])
def test_threads_of_a_forked_process_are_its_own(generations):
    for _ in range(10):  # until all threads of the pool have started, and wait
        assert summed(3) == (0.0, 500)
    assert in_a_fork(3, generations)
    assert summed(3) == (0.0, 500)


def test_several_threads_may_compute_at_once():
    with ThreadPoolExecutor(8) as callers:  # more numbers of threads than pools are kept
        assert set(callers.map(summed, [1, 2, 3, 4, 5, 6, 7, 8] * 5)) == {(0.0, 500)}


WORKERS = """
import sys
from multiprocessing import get_context
import numpy as np
from landlab import RasterModelGrid
from landlab_debrisflow import DebrisFlow, SimulationError

def event(threads, speed=0.0):
    grid = RasterModelGrid((20, 40), xy_spacing=5.0)
    grid.add_field("topographic__elevation", 0.5 * (200.0 - grid.x_of_node), at="node")
    release = grid.add_zeros("debris_flow__release_depth", at="node")
    release[(abs(grid.x_of_node - 30) < 8) & (abs(grid.y_of_node - 48) < 8)] = 1.0
    flow = DebrisFlow(grid, numerics={"particle_count": 60, "threads": threads})
    flow.run_one_step(1e-9)
    flow._simulation.particles.velocity[0, 0] += speed
    flow.run_one_step(1.0)
    return grid.at_node["debris_flow__depth"].tobytes()

if __name__ == "__main__":
    expected = event(2)
    with get_context(sys.argv[1]).Pool(1) as pool:
        for threads in (1, 2):
            assert pool.apply_async(event, (threads,)).get(60) == expected
        try:
            pool.apply_async(event, (2, np.nan)).get(60)
        except SimulationError as error:
            assert error.variable == "velocity"
"""


@pytest.mark.slow
@pytest.mark.parametrize("method", METHODS)
def test_workers_get_the_same_result(tmp_path, method):
    # a process of its own: after a fork landlab's own OpenMP hangs if it had threads before (README)
    script = tmp_path / "workers.py"
    script.write_text(WORKERS)
    path = os.pathsep.join([os.getcwd(), os.environ.get("PYTHONPATH", "")])
    alone = os.environ | {"OMP_NUM_THREADS": "1", "PYTHONPATH": path}
    subprocess.run([sys.executable, str(script), method], check=True, env=alone, timeout=240)
