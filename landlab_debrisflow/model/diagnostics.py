"""Cost of a run: steps, CPU time by stage of a step, particles left asleep."""

import time
from collections.abc import Mapping
from types import MappingProxyType
from typing import NamedTuple

STAGES = ("friction and kick", "entrainment", "drift", "summation", "columns", "step limits")
"""Stages of a step that are timed, in their order."""


TIMED = 8
"""Number of steps for which one timed step stands: reading the clock takes a hundredth of a small step."""


class Diagnostics(NamedTuple):
    """Cost of a run so far, without the work between steps.

    Attributes
    ----------
    steps : int
        Number of steps.
    smallest_step : float
        Duration of the shortest step [s]; infinite before the first.
    share_asleep : float
        Particle-steps of particles asleep over all [-]; 0 before the first.
    cpu : Mapping of str to float
        CPU seconds in each stage of a step, of `STAGES`: measured in the first steps and in every `TIMED`-th after,
        each of which stands for `TIMED`. The first run of a version on a machine also compiles the kernels.
    """

    steps: int
    smallest_step: float
    share_asleep: float
    cpu: Mapping[str, float]


class Counters:
    """Counts of a run, from which `Diagnostics` are made.

    Attributes
    ----------
    steps : int
        Steps so far.
    smallest_step : float
        Duration of the shortest step so far [s]; infinite before the first.
    particle_steps, sleeping_steps : int
        Particles summed over the steps: all, and those asleep.
    cpu : list of float
        CPU time of each of `STAGES`, in their order [s]. It depends on the machine; no result of a run depends
        on it.
    """

    def __init__(self):
        self.steps, self.smallest_step = 0, float("inf")
        self.particle_steps = self.sleeping_steps = 0
        self.cpu = [0.0] * len(STAGES)

    def count(self, p, dt: float) -> None:
        """Count a step of `dt` seconds of the particles `p`, of which some are asleep."""
        self.steps += 1
        self.smallest_step = min(self.smallest_step, dt)
        self.particle_steps += p.count
        self.sleeping_steps += p.count - p.awake

    def copy(self) -> "Counters":
        """Return an independent copy of the counts."""
        other = Counters()
        vars(other).update(vars(self) | {"cpu": self.cpu.copy()})
        return other

    def clock(self):
        """Return the clock of the next step: a `StageClock` for the first steps, then for every `TIMED`-th only."""
        if self.steps < TIMED:
            return StageClock(self.cpu, 1)
        return NO_CLOCK if self.steps % TIMED else StageClock(self.cpu, TIMED)

    @property
    def diagnostics(self) -> Diagnostics:
        """Cost so far, as a value that later steps leave as it is."""
        cpu = MappingProxyType(dict(zip(STAGES, self.cpu, strict=True)))
        return Diagnostics(self.steps, self.smallest_step, self.sleeping_steps / max(self.particle_steps, 1), cpu)


class StageClock:
    """Measures CPU time from stage to stage of one step.

    Parameters
    ----------
    spent : list of float
        CPU time in each of `STAGES` so far, to which that of the step is added [s].
    steps : int
        Steps for which the measured one stands.
    """

    def __init__(self, spent, steps: int):
        self._spent, self._steps, self._began = spent, steps, time.process_time()

    def lap(self, stage: int) -> None:
        """Count the time since the last lap for a stage, by its place in `STAGES`."""
        now = time.process_time()
        self._spent[stage] += self._steps * (now - self._began)
        self._began = now


class NoClock:
    """Measures nothing."""

    def lap(self, stage: int) -> None:
        """Let a stage pass."""


NO_CLOCK = NoClock()
