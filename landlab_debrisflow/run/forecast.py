"""Forecast of a run: particles, number of steps, wall time, memory, and doubts."""

import dataclasses
import math
from collections.abc import Sequence

import numpy as np

from ..core.words import duration_text, grouped
from .advance import check_mass
from .doubts import scene_doubts
from .memory import peak_memory
from .pilot import Pilot, Start, run_pilot, run_start
from .scene import Scene

FACTOR = 2.0
"""Factor within which the wall time is right in most cases. A flow whose tail creeps took five times as long, because
with few particles it came to rest sooner (`python -m benchmarks.forecast`, benchmarks/forecast.txt)."""

COMPILED = 2.0
"""CPU time before the first step from which on kernels may have been compiled in it and in later steps [s]: both pilot
runs are then made again, because their times are of no use."""


@dataclasses.dataclass(frozen=True, kw_only=True)
class Forecast:
    """Forecast of a run.

    Attributes
    ----------
    nodes : tuple of int
        Rows and columns of the grid.
    spacing : tuple of float
        dx, dy [m].
    released : float
        Volume of all releases [m3].
    inflow : float
        Volume of all inflow [m3].
    particles : int
        Number of particles at the start.
    consolidation_time : float
        T_c = h^2 / c_v, median over the particles at the start [s].
    erosion_time : float
        T_e = h / e, thickness over erosion rate, median over the particles that erode while the flow is fast [s].
    peclet_number, largest_peclet_number : float
        Pe_b = T_c / T_e at the base, median and largest of the peaks over the eroded area [-].
    duration : float
        Elapsed time at the end of the event [s].
    complete : bool
        Whether the pilot run came to the end of the event; False: the event lasts longer.
    at_rest : bool
        Whether the flow comes to rest before `max_duration`.
    eroded, peak_depth, peak_speed : float
        Volume eroded, peak depth and peak speed of the pilot run [m3, m, m s-1].
    steps : float
        Number of time steps.
    seconds : float
        Wall time of the steps on this machine if nothing else runs on it, without kernels to compile and files [s].
    memory : float
        Memory of this process at the start of the run [bytes].
    notes, doubts : tuple of str
        Remarks on files, and doubts.
    """

    nodes: tuple[int, int]
    spacing: tuple[float, float]
    released: float
    inflow: float
    particles: int
    consolidation_time: float
    erosion_time: float
    peclet_number: float
    largest_peclet_number: float
    duration: float
    complete: bool
    at_rest: bool
    eroded: float
    peak_depth: float
    peak_speed: float
    steps: float
    seconds: float
    memory: float
    notes: tuple[str, ...]
    doubts: tuple[str, ...]

    def __str__(self) -> str:
        rows = [*self._content(), *self._outcome()]
        width = max(len(name) for name, _ in rows)
        lines = [f"{name:{width}}  {words}" for name, words in rows]
        return "\n".join([*lines, *sentences(self.notes, self.doubts)])

    def _content(self) -> list[tuple[str, str]]:
        (rows, columns), (dx, dy) = self.nodes, self.spacing
        spacing = f"{dx:g} m" if dx == dy else f"{dx:g} m x {dy:g} m"
        mass = f"{grouped(self.released)} m3" + (f", inflow {grouped(self.inflow)} m3" if self.inflow else "")
        return [
            ("grid", f"{rows} x {columns} nodes of {spacing}"),
            ("released", mass),
            ("particles", f"{grouped(self.particles)} at the start"),
        ]

    def _outcome(self) -> list[tuple[str, str]]:
        at_least = "" if self.complete else "more than "
        end = "" if not self.complete else " until rest" if self.at_rest else " (max_duration), still moving"
        ratio = self.consolidation_time / self.duration if self.duration > 0.0 else math.nan
        times = f", {ratio:.2g} times the duration" if self.complete and math.isfinite(ratio) else ""
        rows = [("consolidation time T_c", _long(self.consolidation_time) + times)]
        if math.isfinite(self.erosion_time):
            rows += [
                ("erosion time T_e", _long(self.erosion_time)),
                ("basal Péclet number Pe_b", f"{self.peclet_number:.3g}, largest {self.largest_peclet_number:.3g}"),
                ("eroded", f"{at_least}{grouped(self.eroded)} m3 in the pilot run"),
            ]
        return [
            *rows,
            ("peaks", f"{self.peak_depth:.1f} m deep, {self.peak_speed:.1f} m/s in the pilot run"),
            ("duration", f"{at_least}{self.duration:.0f} s{end}"),
            ("steps", f"{at_least}{grouped(self.steps)}"),
            ("memory", f"{self.memory / 2**20:.0f} MB"),
            ("wall time", f"{at_least}{duration_text(self.seconds)} to a factor of {FACTOR:g}; longer if it creeps"),
        ]


def sentences(notes: Sequence[str], doubts: Sequence[str]) -> list[str]:
    """Return notes and doubts as lines under headings."""
    lines: list[str] = []
    for heading, found in (("notes", notes), ("odd", doubts)):
        lines += [f"{heading}:", *(f"  - {sentence}" for sentence in found)] if found else []
    return lines


def forecast(scene: Scene) -> Forecast:
    """Forecast a run, by a pilot run with few particles and the first steps with all; nothing is written.

    The pilot run goes to the end of the event, or for ten seconds. It gives the duration, T_e and Pe_b. The number of
    steps follows from the length of its steps: those that pressure waves limit are shorter by the square root of the
    ratio of the numbers of particles (`Pilot.steps_with`). The first steps with all particles give T_c and the CPU
    time of a step on this machine; the change of this time during a run is that of the pilot run.

    Parameters
    ----------
    scene : Scene

    Returns
    -------
    Forecast

    Raises
    ------
    InputError, ParameterError
        If something of the scene cannot be used.

    References
    ----------
    Pastor et al. (2022) for T_c, T_e and Pe_b; Monaghan (1992) for the Courant condition, see docs/theory.md.
    """
    check_mass(scene)
    releases, _ = scene.releases, scene.places
    grid = scene.grid()
    area = grid.dx * grid.dy
    start, pilot = timed_runs(scene)
    steps = pilot.steps_with(start.particles)
    return Forecast(
        nodes=grid.shape, spacing=(grid.dx, grid.dy),
        released=float(sum(np.sum(one.depth) for one in releases)) * area, inflow=_inflow_volume(scene),
        particles=start.particles, consolidation_time=start.consolidation_time, erosion_time=pilot.erosion_time,
        peclet_number=pilot.peclet_number, largest_peclet_number=pilot.largest_peclet_number,
        duration=pilot.duration, complete=pilot.complete, at_rest=pilot.at_rest, eroded=pilot.eroded,
        peak_depth=pilot.peak_depth, peak_speed=pilot.peak_speed, steps=steps,
        seconds=start.seconds + steps * start.seconds_per_step * pilot.cost_ratio, memory=peak_memory(),
        notes=tuple(scene.notes), doubts=(*scene_doubts(scene), *start.doubts),
    )  # fmt: skip


def timed_runs(scene: Scene, run_start=run_start, run_pilot=run_pilot) -> tuple[Start, Pilot]:
    """Return outcomes of the first steps and of the pilot run of a scene, neither timed while kernels compile."""
    start, pilot = run_start(scene), run_pilot(scene)
    return (run_start(scene), run_pilot(scene)) if start.seconds > COMPILED else (start, pilot)


def _inflow_volume(scene: Scene) -> float:
    return float(sum(np.trapezoid(one.series("discharge")[0], one.times) for one in scene.setup.inflow))


def _long(seconds: float) -> str:
    return f"{seconds:.3g} s" if seconds < 100.0 else f"{seconds:.3g} s ({duration_text(seconds)})"
