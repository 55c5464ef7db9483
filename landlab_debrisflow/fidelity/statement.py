"""Statement on a run: particles, column and steps, cost, and stated errors."""

import dataclasses
import math
from collections.abc import Mapping
from typing import Any

from ..core.words import duration_text, grouped
from ..scene.setup import Setup
from .choices import column_words, steps_words
from .constants import PILOTS
from .errors import errors_after
from .plan import Plan, error_rows
from .table import Printed, Table

NO_PLAN = "no plan: the error is not known; flow.plan(), before a run, tells it"


@dataclasses.dataclass(frozen=True, kw_only=True, repr=False)
class Statement(Printed):
    """Particles, column and steps of a run, its cost, and its errors; printed as a table.

    Attributes
    ----------
    setup : Setup
        Laws, material, numerics and inflow.
    state : str
        How far the run came, in words.
    particles : int
        Number of all particles of the run.
    steps : int
        Steps.
    seconds : float
        CPU time of the calls, since the flow was built or loaded [s]; NaN: not told.
    plan : Plan or None
        Plan that the run followed.
    errors : dict of str to float
        Stated error by quantity, of particles [-]; empty without a plan.
    source : str
        Origin of the errors, in words.
    """

    setup: Setup
    state: str
    particles: int
    steps: int
    seconds: float
    plan: Plan | None = None
    errors: Mapping[str, float] = dataclasses.field(default_factory=dict)
    source: str = NO_PLAN

    def to_mapping(self) -> dict[str, Any]:
        """Return the statement as plain values: numbers, words and mappings; an error that is not known is None.

        Returns
        -------
        dict
        """
        errors = {name: error if math.isfinite(error) else None for name, error in self.errors.items()}
        return {
            "state": self.state, "particles": self.particles, "steps": self.steps, "seconds": self.seconds,
            "column": column_words(self.setup.column), "numerics": self.setup.to_mapping()["numerics"],
            "errors": errors, "raster_errors": dict(self.plan.raster_errors) if self.plan else {},
            "source": self.source,
        }  # fmt: skip

    def _table(self) -> Table:
        numerics, plan = self.setup.numerics, self.plan
        asked = numerics.particle_count or numerics.DEFAULT_COUNT
        words = f"{asked} asked for" if numerics.particle_spacing is None else f"{numerics.particle_spacing:g} m apart"
        rows = [
            ("state", self.state),
            ("particles", f"{grouped(self.particles)} ({words})"),
            ("column", column_words(self.setup.column)),
            ("steps", steps_words(numerics)),
            ("cost", self._cost_words()),
        ]
        if plan is None:
            return Table(title="Statement on a run", rows=[*rows, ("errors", self.source)])
        rows.append(("errors by", self.source))
        return Table(
            title="Statement on a run by a plan", rows=rows, errors=error_rows(plan, self.errors),
            raster=plan.rules["raster"][1], creep=plan.creep_words, notes=plan.warnings,
            not_held=plan.not_held_with(self.errors),
        )  # fmt: skip

    def _cost_words(self) -> str:
        steps = f"{grouped(self.steps)} steps"
        return f"{duration_text(self.seconds)} of CPU time in {steps}" if math.isfinite(self.seconds) else steps


def make_statement(
    flow: Any, particles: int, seconds: float, plan: Plan | None, measured: Mapping[str, float] | None
) -> Statement:
    """Return the statement on a flow.

    Parameters
    ----------
    flow : DebrisFlow
    particles : int
        Number of all particles of the run.
    seconds : float
        CPU time of its calls [s].
    plan : Plan or None
        Plan that was adopted.
    measured : mapping of str to float, or None
        Quantities at the end of the planned event, before the mass settled; None: the event has not ended.

    Returns
    -------
    Statement
    """
    diagnostics = flow.diagnostics
    values = {
        "setup": flow.setup, "particles": particles, "steps": diagnostics.steps,
        "seconds": seconds,
        "state": "not run yet" if not diagnostics.steps
        else f"{'at rest' if flow.at_rest else 'still moving'} at {flow.elapsed_time:.6g} s",
    }  # fmt: skip
    if plan is None:
        return Statement(**values)
    if measured is None:
        source = "the plan, before the run"
        if diagnostics.steps:
            source += ": the event has not come to its end, or was not the only one"
        return Statement(**values, plan=plan, errors=plan.errors, source=source)
    errors = errors_after({**plan.runs, plan.particles: measured}, plan.particles, PILOTS[-1])
    source = "the pilot runs" + ("" if plan.particles == PILOTS[-1] else " and the change since the last of them")
    return Statement(**values, plan=plan, errors=errors, source=source)
