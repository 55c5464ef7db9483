"""Pilot runs: an event with few particles, on copies of its grid, and what is measured in them."""

import logging
import math
from collections.abc import Iterator
from contextlib import contextmanager
from time import process_time
from typing import Any, NamedTuple

import numpy as np

from ..core.compilations import compilations
from ..scene.setup import Setup
from .cost import Cost
from .event import Event, origin, with_count
from .quantities import CREEP_LEVELS, Decay, quantities


class PilotOverError(Exception):
    """End of a pilot run before its time."""


class Pilot(NamedTuple):
    """Outcome of a pilot run.

    Attributes
    ----------
    quantities : dict of str to float
        As `fidelity.quantities.quantities` returns them.
    creep : dict of str to float
        Their changes since the kinetic energy was last above a small part of its peak, over their value at the end [-];
        empty if it came to rest from above.
    cost : Cost
        Steps and CPU time [s]; NaN for the time if kernels were compiled.
    at_rest : bool
        Whether it came to rest.
    coefficient_of_consolidation : float
        Median over the particles at the start [m2 s-1]; 0 if nothing drains.
    """

    quantities: dict[str, float]
    creep: dict[str, float]
    cost: Cost
    at_rest: bool
    coefficient_of_consolidation: float


class Drainage:
    """Observer that notes the coefficient of consolidation when particles are seen first.

    Attributes
    ----------
    coefficient : float
        Median over the particles [m2 s-1].
    """

    interval = math.inf

    def __init__(self) -> None:
        self.coefficient = math.nan
        self.flow: Any = None

    def follow(self, particles: Any, began: float, time: float) -> None:
        """Note the coefficient of `particles` after a step from `began` to `time` [s], once."""
        if math.isnan(self.coefficient) and particles.volume.size and self.flow is not None:
            columns, thickness = self.flow.columns, particles.thickness
            times = columns.consolidation_time.values
            known = np.isfinite(times) & (times > 0.0)
            self.coefficient = float(np.median(thickness[known] ** 2 / times[known])) if known.any() else 0.0

    def observe(self, flow: Any) -> None:
        """Let the flow be."""


def run_pilot(event: Event, setup: Setup, count: int) -> Pilot:
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
    Pilot

    Raises
    ------
    SimulationError
        If the state stopped being finite.
    KeyboardInterrupt
        After the step.
    """
    start = origin(event)
    decay, drainage, compiled = Decay(start), Drainage(), []
    with collected_warnings(), compilations(lambda: compiled.append(True)):
        flow = drainage.flow = event.flow(with_count(setup, count, settle=False), [decay, drainage])
        began = process_time()
        try:
            event.run(flow)
        except BaseException as failure:
            failure.__notes__ = [f"in a pilot run with {count} particles; grid and flow are as they were"]
            raise
        seconds = process_time() - began
    found = quantities(flow, start)
    return Pilot(
        quantities=found, creep=_creep(decay, found, setup.numerics.rest_energy),
        cost=Cost(flow.diagnostics.steps, math.nan if compiled else seconds), at_rest=flow.at_rest,
        coefficient_of_consolidation=0.0 if math.isnan(drainage.coefficient) else drainage.coefficient,
    )  # fmt: skip


def _creep(decay: Decay, end: dict[str, float], rest_energy: float) -> dict[str, float]:
    """Return relative changes of quantities since the last measured level above that of rest [-]."""
    levels = [level for level in CREEP_LEVELS if level > rest_energy and level in decay.found]
    if not levels:
        return {}
    before = decay.found[min(levels)]
    return {
        name: abs(value - before[name]) / abs(value)
        for name, value in end.items() if value and math.isfinite(value) and math.isfinite(before[name])
    }  # fmt: skip


@contextmanager
def collected_warnings() -> Iterator[list[str]]:
    """Collect the warnings of the package in a block, instead of logging them; yield their list."""
    collected: list[str] = []

    def collect(record: logging.LogRecord) -> bool:
        if record.levelno >= logging.WARNING and not record.getMessage().startswith(PilotOverError.__name__):
            collected.append(record.getMessage())
        return False

    log = logging.getLogger("landlab_debrisflow")
    log.addFilter(collect)
    try:
        yield collected
    finally:
        log.removeFilter(collect)
