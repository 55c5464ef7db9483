"""Pilot runs: a scene with few particles to its end, and its first steps with all of them."""

import math
from collections.abc import Callable
from time import perf_counter, process_time
from typing import Any, NamedTuple

import numpy as np

from ..fidelity.event import with_count
from ..fidelity.pilots import PilotOverError, run_event
from ..model.step_rule import step_rule
from ..record.measures import measures
from .planning import event_of_scene
from .scene import Scene

PARTICLES = 150
"""Particles of a pilot run."""

LONGEST = 10.0
"""Longest wall time of a pilot run [s]."""

FIRST, TIMED = 4, 24
"""Steps before the timed ones of a start, and steps until its end."""

NEAR_LIMIT = 0.8
"""Length of a step over the limit by the terrain, from which on this limit counts as the cause [-]."""


FAST = 0.5
"""Speed over peak speed from which on a flow counts as fast [-]."""


class Pilot(NamedTuple):
    """Outcome of a pilot run.

    Attributes
    ----------
    duration : float
        Elapsed time at the end of the run [s].
    complete : bool
        Whether the scene came to its end, at rest or at its longest time.
    at_rest : bool
        Whether the flow came to rest.
    particles : int
        Number of particles that it had.
    steps : list of tuple of float
        For every step its length, and the longest that the speed allows on the terrain [s].
    erosion_time : float
        Median over the particles that erode and over the steps in which the flow is fast; infinite without erosion [s].
    peclet_number, largest_peclet_number : float
        Median and largest of the basal Péclet numbers over the eroded area; NaN without erosion [-].
    cost_ratio : float
        CPU time of a step in the mean over the run, over that of a start [-].
    eroded, peak_depth, peak_speed : float
        Volume [m3]; largest depth [m] and speed [m s-1].
    """

    duration: float
    complete: bool
    at_rest: bool
    particles: int
    steps: list
    erosion_time: float
    peclet_number: float
    largest_peclet_number: float
    cost_ratio: float
    eroded: float
    peak_depth: float
    peak_speed: float

    def steps_with(self, particles: int) -> float:
        """Return the number of steps that another number of particles would take.

        Steps that pressure waves limit are as long as the spacing of the particles, n^(-1/2), allows; those that the
        speed over the terrain limits do not depend on it (model/time_step.py).
        """
        finer = math.sqrt(particles / self.particles)
        lengths, across = np.array(self.steps).reshape(-1, 2).T
        return float(
            np.sum(lengths / np.minimum(np.where(lengths < NEAR_LIMIT * across, lengths / finer, across), across))
        )


class Start(NamedTuple):
    """Outcome of the first steps with all particles.

    Attributes
    ----------
    particles : int
        Number of particles.
    consolidation_time : float
        Median of thickness squared over coefficient of consolidation [s].
    seconds : float
        CPU time before the first step [s].
    seconds_per_step : float
        CPU time of a step [s].
    doubts : list of str
        Warnings of the component.
    """

    particles: int
    consolidation_time: float
    seconds: float
    seconds_per_step: float
    doubts: list


class _Steps:
    """Observer that notes the limits of every step and ends a run after a wall time."""

    interval = math.inf

    def __init__(self, way: float, longest: float, clock: Callable[[], float] = process_time):
        self._cpu = clock
        self._way, self._longest, self._began = way, longest, perf_counter()
        self.steps: list[tuple[float, float]] = []
        self._clock: list[float] = []
        self._erosion_times: list[tuple[float, float]] = []
        self.particles = 0

    def observe(self, flow: Any) -> None:
        """Let the flow be."""

    def follow(self, particles: Any, began: float, time: float) -> None:
        """Note a step from `began` to `time` [s] of `particles`."""
        self._clock.append(self._cpu())
        self.particles = max(self.particles, particles.volume.size)
        if time > began:
            awake = slice(particles.awake)
            speed2 = float((particles.velocity[:, awake] ** 2).sum(axis=0).max(initial=0.0))
            self.steps.append((time - began, self._way / math.sqrt(speed2) if speed2 else math.inf))
            eroding = particles.entrainment_rate[awake] > 0.0
            if eroding.any():
                times = particles.depth[awake][eroding] / particles.entrainment_rate[awake][eroding]
                self._erosion_times.append((math.sqrt(speed2), float(np.median(times))))
        if perf_counter() - self._began > self._longest:
            raise PilotOverError

    @property
    def cost_ratio(self) -> float:
        """CPU time of a step in the mean over the run, over that of a start [-]."""
        first = self._clock[: TIMED + 1]
        if len(self._clock) < 2 * TIMED or first[-1] == first[FIRST]:
            return 1.0
        whole = (self._clock[-1] - self._clock[FIRST]) / (len(self._clock) - 1 - FIRST)
        return whole / ((first[-1] - first[FIRST]) / (len(first) - 1 - FIRST))

    @property
    def erosion_time(self) -> float:
        """Median over particles and over the steps in which the flow is fast; infinite without erosion [s]."""
        fastest = max((speed for speed, _ in self._erosion_times), default=0.0)
        fast = [time for speed, time in self._erosion_times if speed >= FAST * fastest]
        return float(np.median(fast)) if fast else math.inf


class _Clock:
    """Observer that measures the time of steps and ends a run after some steps."""

    interval = math.inf

    def __init__(self) -> None:
        self.began, self.clock = process_time(), []

    def observe(self, flow: Any) -> None:
        """Let the flow be."""

    def follow(self, particles: Any, began: float, time: float) -> None:
        """Note the CPU time after a step from `began` to `time` [s]."""
        self.clock.append(process_time())
        if len(self.clock) > TIMED:
            raise PilotOverError


def run_pilot(scene: Scene, particles: int = PARTICLES, longest: float = LONGEST) -> Pilot:
    """Run a scene with few particles, in memory.

    Parameters
    ----------
    scene : Scene
    particles : int
        Number of particles of each release.
    longest : float
        Longest wall time [s]; a longer run ends there, and is not complete.

    Returns
    -------
    Pilot
    """
    event, setup = event_of_scene(scene), with_count(scene.setup, particles)
    rule = step_rule(setup.numerics, min(event.grid.dx, event.grid.dy))
    steps = _Steps(rule.longest_way, longest)
    run = run_event(event, setup, [steps])
    flow, found = run.flow, measures(run.flow)
    return Pilot(
        duration=flow.elapsed_time, complete=run.complete, at_rest=flow.at_rest, particles=max(1, steps.particles),
        steps=steps.steps, erosion_time=steps.erosion_time,
        peclet_number=float(found.median_basal_peclet_number),
        largest_peclet_number=float(found.max_basal_peclet_number), cost_ratio=steps.cost_ratio,
        eroded=flow.budget["eroded"],
        peak_depth=float(found.max_depth), peak_speed=float(found.max_speed),
    )  # fmt: skip


def run_start(scene: Scene) -> Start:
    """Run the first steps of a scene with all its particles, in memory.

    Parameters
    ----------
    scene : Scene

    Returns
    -------
    Start
    """
    event, clock = event_of_scene(scene), _Clock()
    run = run_event(event, scene.setup, [clock])
    flow, columns = run.flow, run.flow.columns
    read = clock.clock or [process_time()]
    timed = np.diff(read[min(FIRST, len(read) - 1) :])
    times = columns.consolidation_time.values
    return Start(
        particles=int(flow.particles.sizes["particle"]),
        consolidation_time=float(np.median(times)) if times.size else 0.0, seconds=read[0] - clock.began,
        seconds_per_step=float(np.mean(timed)) if timed.size else 0.0, doubts=run.doubts,
    )  # fmt: skip
