"""Make a plan: pilot runs, then particles, column and steps by the rules of `constants`."""

import dataclasses
import logging
import math
from collections.abc import Callable, Collection

import numpy as np

from ..core.errors import InputError
from ..core.words import grouped
from ..grid.release import RELEASE_DEPTH
from ..scene.setup import Setup
from .choices import Choice, choose_column, choose_steps, consolidation_ratio, phase_warning, start_coefficient
from .constants import NOTABLE_OUTFLOW, PILOTS
from .cost import Cost, forecast_cost
from .errors import count_asked, errors_with, next_count, stated_errors
from .event import Event, origin, with_count
from .pilots import MeasuredPilot, measure_pilot
from .plan import Plan
from .raster import examine_raster
from .table import WORDS, percent
from .wishes import Wishes

log = logging.getLogger("landlab_debrisflow.progress")


def make_plan(event: Event, wishes: Wishes, notify: Callable[[str], None] = log.info) -> Plan:
    """Run pilots of an event on copies of its grid, and return a plan.

    Parameters
    ----------
    event : Event
    wishes : Wishes
    notify : callable
        Called with a text when a pilot run begins.

    Returns
    -------
    Plan

    Raises
    ------
    InputError, ParameterError, SimulationError
        If a pilot run cannot be made.
    KeyboardInterrupt
        After the step.
    """
    if event.volume == 0.0:
        raise InputError(
            "plan: nothing is released and nothing flows in, so there is nothing to plan; set "
            f"{RELEASE_DEPTH} > 0 where ground fails, or give inflow, before plan()"
        )
    steps = choose_steps(event.setup.numerics, wishes.tolerance)
    column, pilots = _measure_pilots(event, wishes, steps, notify)
    setup = dataclasses.replace(event.setup, numerics=steps.value, column=column.value)
    runs = {count: pilot.quantities for count, pilot in pilots.items()}
    costs = {count: pilot.cost for count, pilot in pilots.items()}
    errors, finest = stated_errors(runs), PILOTS[-1]
    count, rule = _choose_count(errors, costs, wishes)
    cost, last = forecast_cost(costs, count), pilots[finest]
    known = [one.seconds for one in costs.values() if math.isfinite(one.seconds)]
    raster = examine_raster(event, setup, pilots, sum(known) + cost.seconds, wishes.raster, notify)
    phases, warnings = _phases(event, last)
    if last.outflow > NOTABLE_OUTFLOW:
        warnings += (f"{percent(last.outflow)} of the volume leaves the grid: errors are those of the rest",)
    errors = errors_with(errors, count, finest) if count > finest else errors
    coarse = [WORDS[name] for name in wishes.hold if raster.errors.get(name, 0.0) > wishes.tolerance]
    if coarse:
        warnings += (
            f"the error of the raster exceeds the tolerance for {', '.join(coarse)}: particles do not help, a finer "
            "DEM does",
        )
    return Plan(
        particles=count, setup=with_count(setup, count), tolerance=wishes.tolerance, hold=wishes.hold,
        rules={
            "particles": (grouped(count), rule), "column": column[1:], "steps": steps[1:], "phases": phases,
            "raster": ("", raster.words),
        },
        errors=errors, raster_errors=raster.errors, creep=last.creep.get("run_out", 0.0), creep_level=last.creep_level,
        still_moving=not last.at_rest, cost=cost,
        pilot_seconds=sum(known) + (raster.seconds if math.isfinite(raster.seconds) else 0.0),
        max_particles=wishes.max_particles, max_cost=wishes.max_cost, max_duration=event.max_duration, runs=runs,
        origin=origin(event), volume=event.volume, warnings=warnings,
        digests={"setup": setup_digest(event.setup), "ground": event.ground_digest()},
    )  # fmt: skip


def setup_digest(setup: Setup) -> str:
    """Return a digest of the setup without the values that a plan chooses, such as the number of particles."""
    steps = choose_steps(setup.numerics, tolerance=1.0).value
    return with_count(dataclasses.replace(setup, numerics=steps), count=1).digest()


def _measure_pilots(event, wishes, steps, notify) -> tuple[Choice, dict[int, MeasuredPilot]]:
    """Return the choice of the column, and pilot runs by number of particles."""
    first, *others = PILOTS

    def run(count, setup):
        notify(f"plan: pilot run with {count} particles")
        return measure_pilot(event, setup, count)

    setup = dataclasses.replace(event.setup, numerics=steps.value)
    column, pilot = pilot_column(event, setup, wishes.hold, lambda setup: run(first, setup))
    setup = dataclasses.replace(setup, column=column.value)
    if pilot is None or math.isnan(pilot.cost.seconds):  # its time would include the compilation of kernels
        pilot = run(first, setup)
    return column, {first: pilot} | {count: run(count, setup) for count in others}


def pilot_column(
    event: Event, setup: Setup, hold: Collection[str], run: Callable[[Setup], MeasuredPilot]
) -> tuple[Choice, MeasuredPilot | None]:
    """Choose the column of an event by a pilot run.

    Parameters
    ----------
    event : Event
    setup : Setup
        Setup of the pilot run, without its column.
    hold : collection of str
        Quantities to be held.
    run : callable
        Makes the pilot run with a setup.

    Returns
    -------
    column : Choice
        Of a column law.
    pilot : MeasuredPilot or None
        The pilot run; None if it had another column.
    """
    guess = choose_column(event, _guessed_ratio(event), hold)
    pilot = run(dataclasses.replace(setup, column=guess.value))
    column = choose_column(event, _measured_ratio(pilot), hold)
    return column, pilot if column.value == guess.value else None


def _guessed_ratio(event: Event) -> float:
    """Return T_c/T from the release, as if it fell freely over the whole relief [-]."""
    depth = event.release_depth
    elevation = event.grid.at_node["topographic__elevation"][event.grid.status_at_node == 0]
    thickness = float(depth[depth > 0.0].mean()) if depth.any() else max(
        line.largest_thickness for line in event.setup.inflow
    )  # fmt: skip
    duration = math.sqrt(2.0 * max(np.ptp(elevation), thickness) / event.setup.material.gravity)
    return consolidation_ratio(thickness, start_coefficient(event.setup, thickness), duration)


def _measured_ratio(pilot: MeasuredPilot) -> float:
    found = pilot.quantities
    return consolidation_ratio(found["mean_depth"], pilot.coefficient_of_consolidation, found["duration"])


def _choose_count(errors, costs: dict[int, Cost], wishes: Wishes) -> tuple[int, str]:
    """Return the number of particles, and its rule in words."""
    finest = PILOTS[-1]
    asked = count_asked(errors, finest, wishes.tolerance, wishes.hold)
    count = next_count(asked, finest, wishes.max_particles)
    worst = max(wishes.hold, key=lambda name: errors[name] if errors[name] == errors[name] else -1.0)
    largest = f"{percent(errors[worst])}, of {WORDS[worst]}"
    rule = f"with {finest} the largest error of the quantities to be held is {largest}"
    rule += f", tolerance {100.0 * wishes.tolerance:g} %"
    if asked > finest:
        wanted = grouped(float(f"{asked:.3g}")) if math.isfinite(asked) else "more than any number"
        rule += f": {wanted} asked for" + (", no more than max_particles allowed" if asked > count else "")
    if wishes.max_cost is not None:
        dearest = count
        while count > finest and forecast_cost(costs, count).seconds > wishes.max_cost:
            count = max(finest, count // 2)
        if count < dearest:
            rule += f"; more would take longer than max_cost, {wishes.max_cost:g} s"
    return count, rule


def _phases(event: Event, pilot: MeasuredPilot) -> tuple[tuple[str, str], tuple[str, ...]]:
    """Return the phases with the number that tells whether they matter, in words, and a warning if they do."""
    thickness = pilot.quantities["mean_depth"]
    ratio, warning = phase_warning(event, thickness, pilot.coefficient_of_consolidation)
    chosen = "two" if event.setup.two_phases else "one"
    return (chosen, f"your choice; tau (g/h)^(1/2) = {ratio:.2g}"), (warning,) if warning else ()
