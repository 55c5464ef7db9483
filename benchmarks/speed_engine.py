"""Rates of the engine: sums over neighbours alone, whole steps, and where the time of a step goes.

This file and speed_grids.py reach inside the engine: they time and count its stages by name.
"""

import statistics
import time
from contextlib import contextmanager
from typing import NamedTuple
from unittest import mock

import numba
import numpy as np

from landlab_debrisflow import DebrisFlow
from landlab_debrisflow.cli.demo import MATERIAL
from landlab_debrisflow.core.lanes import LANES
from landlab_debrisflow.grid import grid_bed, read, write
from landlab_debrisflow.model import activity, peak_maps, simulation, step
from landlab_debrisflow.model.release import release
from landlab_debrisflow.physics.flow import one_phase
from landlab_debrisflow.scene import tsing_shan_valley
from landlab_debrisflow.spatial.cells import sort_into_cells
from landlab_debrisflow.spatial.groups import find_candidates, group
from landlab_debrisflow.spatial.packing import Position, empty_packed, quantum_of
from landlab_debrisflow.spatial.summation import SummationInput, Sums, _pack, sum_over_neighbours
from landlab_debrisflow.terrain import bed
from validation.cases.planes import similarity_body

FLOPS = 64
"""Floating-point operations for a pair in summation._sum, minima and maxima among them, a reciprocal root as two."""


class Steps:
    """Counts of steps and particle-steps inside `counting`."""

    def __init__(self):
        self.steps, self.awake, self.all, self.cpu, self.wall = 0, 0, 0, 0.0, 0.0  # numbers summed over the steps


@contextmanager
def counting():
    """Count steps and the particles they advanced, and time them; yields a `Steps`."""
    done, original = Steps(), step.advance

    def advance(sim, dt):
        cpu, wall = time.process_time(), time.perf_counter()
        original(sim, dt)
        p = sim.particles
        done.cpu, done.wall = done.cpu + time.process_time() - cpu, done.wall + time.perf_counter() - wall
        done.steps, done.awake, done.all = done.steps + 1, done.awake + p.awake, done.all + p.count

    with mock.patch.object(step, "advance", advance):
        yield done


def cap(count, threads=1):
    """Return the similarity solution at rest."""
    return similarity_body(count, threads)


class SumRate(NamedTuple):
    """One row of the table of sums."""

    particles: int
    cpu: float  # of one pass with one thread [s]
    sorting: float  # its part in `sort_into_cells` [s]
    walls: tuple[float, float]  # of one pass with one thread and with two [s]
    computed: float  # pairs per particle that are computed
    acting: float  # of these, in reach


def sums(flow, repeats) -> SumRate:
    """Time density and force of a flow as it is now: every particle, with the lengths it has."""
    sim = flow._simulation
    p, normal = sim.particles, 9.81 * sim.particles.cos_slope
    given = SummationInput(
        position=Position(p.x, p.y, p.z),
        velocity=p.velocity,
        volume=p.volume,
        smoothing_length=p.smoothing_length,
        longest=np.full(p.count, np.inf),
        pressure_coefficient=0.5 * normal / p.gradient_term,
        celerity=np.sqrt(normal * p.thickness),
        thickness=p.thickness,
        convergence=p.thickening,
        inertia=np.ones(p.count),
    )
    found = Sums(*(np.empty(s) for s in (p.count, p.count, p.count, (3, p.count), p.count)))
    cpus, sorting, walls = [], [], {1: [], 2: []}
    for _ in range(repeats):
        for threads, times in walls.items():
            wall, cpu = time.perf_counter(), time.process_time()
            cells = sort_into_cells(p.x, p.y, 2.0 * p.smoothing_length)
            between = time.process_time()
            sum_over_neighbours(cells, given, 1.0, found, threads)
            times.append(time.perf_counter() - wall)
            if threads == 1:
                cpus.append(time.process_time() - cpu)
                sorting.append(between - cpu)
    computed, acting = pairs(cells, given)
    return SumRate(p.count, min(cpus), min(sorting), (min(walls[1]), min(walls[2])), computed, acting)


def pairs(cells, given):
    """Return how many pairs per particle are computed, and how many of them are in reach of one another."""
    groups, packed = group(cells), empty_packed(given.volume.size, 10, quantum_of(cells))
    _pack((tuple(given.position), *given[1:]), 1.0, packed)
    found = _count(tuple(groups), tuple(cells), packed)
    return found[0] / given.volume.size, found[1] / given.volume.size


@numba.njit
def _count(groups, cells, packed):
    first, last, _, _ = groups
    order, sorted_places = cells[6], cells[9]
    places, values, _ = packed
    near, computed, acting = np.empty(order.size + LANES, np.uint32), 0, 0
    for g in range(first.size):
        m = find_candidates(g, groups, sorted_places, cells, near)
        computed += m * LANES
        for k in range(first[g], last[g]):
            i = order[k]
            for s in range(m):
                r2, j = 0.0, order[near[s]]
                for axis in range(3):
                    r2 += float(np.int32(places[axis, i] - places[axis, j])) ** 2
                inverse = min(values[3, i], values[3, j])
                acting += r2 * inverse * inverse < 1.0
    return computed, acting


class StepRate(NamedTuple):
    """One row of the table of whole steps."""

    particles: int
    steps: int
    cpu: float  # one thread, per step that advances all [s]
    walls: tuple[float, float]


def _timed(make, duration, threads):
    """Run a flow that is at rest; return particle-steps, steps, CPU and wall time."""
    flow = make(threads)
    with counting() as done:
        wall, cpu = time.perf_counter(), time.process_time()
        flow.run_one_step(duration)
        cpu, wall = time.process_time() - cpu, time.perf_counter() - wall
    return done.awake, done.steps, cpu, wall


def whole(count, make, duration, repeats) -> StepRate:
    """Time whole steps, the record on the nodes and all else of a call included; best of some repeats."""
    runs = {threads: [_timed(make, duration, threads) for _ in range(repeats)] for threads in (1, 2)}
    per = [min(wall / done for done, _, _, wall in runs[threads]) for threads in (1, 2)]
    cpu = min(cpu / done for done, _, cpu, _ in runs[1])
    return StepRate(count, runs[1][0][1], cpu * count, (per[0] * count, per[1] * count))


def valley(count, threads=1, column=None):
    """Return the demo's valley, its release not yet taken."""
    numerics = {"particle_count": count, "threads": threads}
    return DebrisFlow(tsing_shan_valley(), column=column, material=MATERIAL, numerics=numerics)


def placed_valley(count, threads=1):
    """Return the demo's valley at rest, particles placed."""
    flow = valley(count, threads)
    flow.run_one_step(1e-9)
    return flow


STAGES = {
    "placing of the release": (release, "place_particles"), "read": (read.GridReader, "read"),
    "lay the bed": (grid_bed.GridBed, "lay"),
    "friction and kick": (step, "friction_and_kick"), "entrain": (step, "entrain"),
    "  of it the bed": (bed.Bed, "erode"), "move": (step, "move"), "find ground": (step, "sample_bed"),
    "interact": (step, "interact"),
    "  of it sorting": (step, "sort_into_cells"), "  of it sums": (one_phase, "sum_over_neighbours"),
    "consolidate": (step, "consolidate"), "check": (step, "find_limits"),
    "wake those disturbed": (activity, "wake"), "fall asleep": (activity, "fall_asleep"),
    "look for rest": (simulation.Simulation, "_let_rest"), "peak maps": (peak_maps.PeakMaps, "record"),
    "keep rows": (write.FieldWriter, "keep_rows"), "settle and finish": (write.FieldWriter, "close"),
}  # fmt: skip
"""Stages of the profile; time in a stage that another stage calls counts for the inner stage alone, unless "of it"."""


def profile(make, repeats):
    """Return CPU time by stage [s] of a whole event (medians), and the last `Steps`."""
    runs = []
    for _ in range(repeats):
        flow, spent = make(), dict.fromkeys(STAGES, 0.0)
        begin_of_step = []  # time spent in stages inside the one that is running

        def timed(name, original, spent=spent, inside=begin_of_step):
            part = name.startswith("  ")

            def stage(*arguments, **keywords):
                if not part:
                    inside.append(0.0)
                begin = time.process_time()
                try:
                    return original(*arguments, **keywords)
                finally:
                    taken = time.process_time() - begin
                    spent[name] += taken if part else taken - inside.pop()
                    if not part and inside:
                        inside[-1] += taken

            return stage

        patches = [mock.patch.object(o, a, timed(n, getattr(o, a))) for n, (o, a) in STAGES.items()]
        with counting() as done:
            for one in patches:
                one.start()
            begin = time.process_time()
            flow.run_until_rest()
            spent["all"] = time.process_time() - begin
            for one in patches:
                one.stop()
        spent["the rest"] = spent["all"] - sum(spent[name] for name in STAGES if not name.startswith("  "))
        runs.append(spent)
    return {name: statistics.median(run[name] for run in runs) for name in runs[0]}, done
