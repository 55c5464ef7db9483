"""Times that a user waits: one scene, an ensemble of scenes, the start of the program."""

import multiprocessing
import os
import statistics
import tempfile
import time
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from typing import NamedTuple

from benchmarks.speed_engine import counting, valley
from benchmarks.start import PROGRAMS, cpu_seconds

MEMBERS, MEMBER = 8, 1500  # scenes of an ensemble, particles of each


class Scene(NamedTuple):
    """One row of the table of scenes."""

    particles: int
    cpu: float  # to rest, median [s]
    least: float  # [s]
    steps: int
    asleep: float  # part of all particle-steps that was left out
    volume: float  # deposited [m3]


def scene(particles, repeats) -> Scene:
    """Run the demo's valley to rest; the making of grid and component is not counted, placing and settling are."""
    times = []
    for _ in range(repeats):
        flow = valley(particles)
        with counting() as done:
            begin = time.process_time()
            flow.run_until_rest()
            times.append(time.process_time() - begin)
    asleep = 1.0 - done.awake / done.all
    return Scene(particles, statistics.median(times), min(times), done.steps, asleep, float(flow.budget["deposited"]))


def member(_) -> float:
    """Run one member of an ensemble, on a grid of its own; return its volume [m3]."""
    flow = valley(MEMBER)
    flow.run_until_rest()
    return float(flow.budget["deposited"])


def ensemble(repeats):
    """Return scenes a minute of wall time (best of some) one after the other, in two threads, in two processes."""
    member(0)
    context = multiprocessing.get_context("spawn")
    with ThreadPoolExecutor(2) as threads, ProcessPoolExecutor(2, mp_context=context) as processes:
        list(processes.map(member, range(4)))  # both have started and loaded their kernels
        ways = {"one after the other": map, "two threads": threads.map, "two processes": processes.map}
        least = dict.fromkeys(ways, float("inf"))
        for _ in range(repeats):
            for name, way in ways.items():
                begin, cpu = time.perf_counter(), time.process_time()
                volumes = set(way(member, range(MEMBERS)))
                least[name] = min(least[name], time.perf_counter() - begin)
                if name == "two threads":
                    threaded = time.process_time() - cpu
            assert len(volumes) == 1, "members differ"
    return {name: 60.0 * MEMBERS / taken for name, taken in least.items()}, threaded / MEMBERS


def start(warm=3):
    """Return CPU of the import of the package and a first step, beyond landlab's import, cold and warm (median) [s]."""
    programs = PROGRAMS["import of landlab"], PROGRAMS["import and first step"]
    with tempfile.TemporaryDirectory() as folder:
        times = [
            [cpu_seconds(p, os.path.join(folder, str(k))) for k, p in enumerate(programs)] for _ in range(warm + 1)
        ]
    return times[0][1] - times[0][0], statistics.median(full - bare for bare, full in times[1:])
