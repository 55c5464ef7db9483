"""Pilot runs: an event with few particles, on copies of its grid, and its quantities and cost."""

import logging
import math
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from threading import get_ident
from time import process_time
from typing import Any, NamedTuple

import numpy as np

from ..core.compilations import compilations
from ..scene.setup import Setup
from .choices import start_coefficient
from .cost import Cost
from .event import Event, origin, with_count
from .quantities import CREEP_LEVELS, Decay, quantities


class PilotOverError(Exception):
    """End of a pilot run before its time."""


class MeasuredPilot(NamedTuple):
    """Quantities and cost of a pilot run.

    Attributes
    ----------
    quantities : dict of str to float
        As `fidelity.quantities.quantities` returns them.
    creep : dict of str to float
        Changes of the quantities since the kinetic energy fell below a small part of its peak, over their values at the
        end [-]; empty if the flow came to rest from above that level.
    creep_level : float
        The small part of the peak [-].
    cost : Cost
        Steps and CPU time [s]; NaN for the time if kernels were compiled.
    at_rest : bool
        Whether the flow came to rest.
    coefficient_of_consolidation : float
        Median over the particles [m2 s-1].
    outflow : float
        Volume that left the grid over the volume that was released, flowed in and eroded [-].
    """

    quantities: dict[str, float]
    creep: dict[str, float]
    creep_level: float
    cost: Cost
    at_rest: bool
    coefficient_of_consolidation: float
    outflow: float


class EventRun(NamedTuple):
    """Run of an event on a copy of its grid.

    Attributes
    ----------
    flow : DebrisFlow
        The component at the end of the run.
    complete : bool
        Whether the event has come to its end.
    seconds : float
        CPU time [s].
    doubts : list of str
        Warnings of the component, which were not logged.
    """

    flow: Any
    complete: bool
    seconds: float
    doubts: list[str]


def measure_pilot(event: Event, setup: Setup, count: int) -> MeasuredPilot:
    """Run an event with few particles on a copy of its grid, and measure it.

    Parameters
    ----------
    event : Event
    setup : Setup
        Laws, material, numerics and inflow; its number of particles does not count.
    count : int
        Number of particles.

    Returns
    -------
    MeasuredPilot

    Raises
    ------
    SimulationError
        If the state stopped being finite.
    KeyboardInterrupt
        After the step.
    """
    start, compiled = origin(event), []
    decay = Decay()
    with compilations(lambda: compiled.append(True)):
        try:
            run = run_event(event, with_count(setup, count, settle=False), [decay])
        except BaseException as failure:
            failure.__notes__ = [f"in a pilot run with {count} particles; grid and flow are as they were"]
            raise
    found, steps = quantities(run.flow, start), run.flow.diagnostics.steps
    creep, level = _creep(decay, found, setup.numerics.rest_energy)
    return MeasuredPilot(
        quantities=found, creep=creep, creep_level=level,
        cost=Cost(steps, math.nan if compiled else run.seconds), at_rest=run.flow.at_rest,
        coefficient_of_consolidation=_coefficient(run.flow, found["mean_depth"]), outflow=_outflow(run.flow.budget),
    )  # fmt: skip


def _coefficient(flow: Any, depth: float) -> float:
    """Return the median coefficient of consolidation of the particles, or that of the start if all left [m2 s-1].

    `depth` is the mean peak depth of the flow [m].
    """
    times, thickness = flow.columns.consolidation_time.values, flow.particles.thickness.values
    known = np.isfinite(times) & (times > 0.0)
    if not known.any():
        return start_coefficient(flow.setup, depth)
    return float(np.median(thickness[known] ** 2 / times[known]))


def _outflow(budget: Mapping[str, float]) -> float:
    supply = budget["released"] + budget["inflow"] + budget["eroded"]
    return budget["outflow"] / supply if supply else 0.0


def run_event(event: Event, setup: Setup, observers: Sequence[Any]) -> EventRun:
    """Run an event on a copy of its grid to its end, or until an observer ends it.

    Parameters
    ----------
    event : Event
    setup : Setup
        Laws, material, numerics and inflow in place of those of the event.
    observers : sequence of observers
        One that raises `PilotOverError` ends the run.

    Returns
    -------
    EventRun
    """
    complete = True
    with collected_warnings() as doubts:
        flow, began = event.flow(setup, observers), process_time()
        try:
            event.run(flow)
        except PilotOverError:
            complete = False
    return EventRun(flow, complete, process_time() - began, doubts)


def _creep(decay: Decay, end: dict[str, float], rest_energy: float) -> tuple[dict[str, float], float]:
    """Return relative changes of quantities [-] since the lowest level of energy above that of rest, and the level."""
    level = min((level for level in CREEP_LEVELS if level > rest_energy), default=rest_energy)
    before, changes = decay.found.get(level, {}), {}
    for name, value in before.items():
        if end[name] and math.isfinite(value) and math.isfinite(end[name]):
            changes[name] = abs(end[name] - value) / abs(end[name])
    return changes, level


@contextmanager
def collected_warnings() -> Iterator[list[str]]:
    """Collect the warnings of the package in a block, instead of logging them; yield their list.

    Messages of other threads are logged as ever.
    """
    collected: list[str] = []
    thread = get_ident()

    def collect(record: logging.LogRecord) -> bool:
        if record.thread != thread:
            return True
        if record.levelno >= logging.WARNING and not record.getMessage().startswith(PilotOverError.__name__):
            collected.append(record.getMessage())
        return False

    log = logging.getLogger("landlab_debrisflow")
    log.addFilter(collect)
    try:
        yield collected
    finally:
        log.removeFilter(collect)
