"""A plan: particles, column and steps of a run, its cost, and its errors."""

import dataclasses
import math
from collections.abc import Mapping
from typing import Any

from ..core.errors import InputError, ParameterError
from ..core.words import duration_text, grouped
from ..model.numerics import Numerics
from ..physics.registry import build_declared, build_law
from ..scene.setup import Setup
from .constants import ERROR_LAWS
from .cost import Cost
from .errors import stated_errors
from .table import LEAST_CREEP, Printed, Table, percent

FORMAT = 1
"""Version of the mapping of a plan."""


@dataclasses.dataclass(frozen=True, kw_only=True, repr=False)
class Plan(Printed):
    """Particles, column and steps of a run, found by pilot runs; `DebrisFlow.plan` makes it, and it prints itself.

    Attributes
    ----------
    particles : int
        Number of particles.
    setup : Setup
        Setup of the run.
    tolerance : float
        Largest error of the quantities to be held [-].
    hold : tuple of str
        Quantities to be held.
    rules : dict of str to tuple of str
        Choice and rule, in words: ``particles``, ``column``, ``steps``, ``phases``, ``raster``.
    errors : dict of str to float
        Stated error by quantity, of particles, meant for 95 % of scenes [-]; NaN where nothing can be measured.
    raster_errors : dict of str to float
        Stated error by quantity, of the raster [-]; empty if the raster was not examined.
    creep, creep_level : float
        Relative change of run-out after the kinetic energy fell below a part of its peak, and that part [-].
    still_moving : bool
        Whether the event lasts longer than `max_duration`.
    cost : Cost
        Forecast of the run.
    pilot_seconds : float
        CPU time of the pilot runs [s].
    max_particles, max_cost, max_duration : float
        Limits: number of particles, CPU time (None: no limit) [s], elapsed time [s].
    runs : dict of int to dict of str to float
        Quantities of the pilot runs by number of particles.
    origin : tuple of float
        Point from which run-out is counted, x and y on the map [m].
    volume : float
        Volume that is released and flows in [m3].
    digests : dict of str to str
        Digests of the setup and the ground that the plan is for.
    warnings : tuple of str
        Doubts about the event that no choice of a plan removes.
    """

    particles: int
    setup: Setup
    tolerance: float
    hold: tuple[str, ...]
    rules: dict[str, tuple[str, str]]
    errors: dict[str, float]
    raster_errors: dict[str, float]
    creep: float
    creep_level: float
    still_moving: bool
    cost: Cost
    pilot_seconds: float
    max_particles: int
    max_cost: float | None
    max_duration: float
    runs: dict[int, dict[str, float]]
    origin: tuple[float, float]
    volume: float
    digests: dict[str, str]
    warnings: tuple[str, ...] = ()

    @property
    def numerics(self) -> Any:
        """Numerics of the run, for `DebrisFlow(grid, numerics=plan.numerics, column=plan.column)`: a `Numerics`."""
        return self.setup.numerics

    @property
    def column(self) -> Any:
        """Law of the column of the run."""
        return self.setup.column

    @property
    def not_held(self) -> dict[str, str]:
        """Quantities whose error may exceed the tolerance, and why, by name."""
        return self.not_held_with(self.errors)

    def not_held_with(self, errors: Mapping[str, float]) -> dict[str, str]:
        """Return quantities that are not held by name, with the reasons.

        Parameters
        ----------
        errors : mapping of str to float
            Errors of particles, by quantity [-].

        Returns
        -------
        dict of str to str
        """
        found = {name: law.reason for name, law in ERROR_LAWS.items() if law.reason}
        for name in self.hold:
            if name not in found and not errors[name] <= self.tolerance:
                found[name] = f"its stated error, {percent(errors[name])}, is more than {percent(self.tolerance)}"
        return found

    @property
    def creep_words(self) -> str:
        """Change of run-out in the last creep, in words; empty if it is small."""
        if not self.creep >= LEAST_CREEP:
            return ""
        return (
            f"run-out changed by {percent(self.creep)} after the kinetic energy had fallen below "
            f"{100.0 * self.creep_level:g} % of its peak; particles do not help"
        )

    # ---- as plain values ----

    def to_mapping(self) -> dict[str, Any]:
        """Return the plan as numbers, words, lists and mappings, with numerics and column for the setup.

        Returns
        -------
        dict
            `from_mapping` builds an equal plan from it, also by way of YAML or JSON; numbers that are not known are
            None.
        """
        setup = self.setup.to_mapping()
        values = {field.name: getattr(self, field.name) for field in dataclasses.fields(self) if field.name != "setup"}
        values |= {"cost": self.cost._asdict(), "numerics": setup["numerics"], "column": setup["column"]}
        return {"format": FORMAT} | {name: _plain(value) for name, value in values.items()}

    @classmethod
    def from_mapping(cls, mapping: Mapping[str, Any], setup: Setup) -> "Plan":
        """Build a plan from the plain values of `to_mapping`.

        Parameters
        ----------
        mapping : mapping
        setup : Setup
            Laws, material and inflow of the event; numerics and column are those of the mapping.

        Returns
        -------
        Plan

        Raises
        ------
        InputError
            If the mapping is not that of a plan.
        """
        try:
            if mapping["format"] != FORMAT:
                raise InputError(f"plan: format {mapping['format']!r} is not {FORMAT}, that of this version; plan anew")
            plan = cls(**_values(mapping, setup))
            stated_errors(plan.runs)
            str(plan)  # no key is missing
        except InputError:
            raise
        except (ParameterError, LookupError, TypeError, ValueError, AttributeError, ArithmeticError) as error:
            raise InputError(f"plan: the mapping is not that of a plan ({error}); plan anew") from error
        return plan

    # ---- as text ----

    def _table(self) -> Table:
        names = ("particles", "column", "steps", "phases")
        rows = [(name, _with_rule(*self.rules[name])) for name in names if name in self.rules]
        rows.append(("cost", self._cost_words()))
        notes = [*self.warnings]
        if self.still_moving:
            notes.append(
                f"the event lasts longer than max_duration, {self.max_duration:g} s: errors are stated for this time"
            )
        return Table(
            title=f"Plan: {grouped(self.particles)} particles, {self.rules['column'][0]}, {self.numerics.preset} steps",
            rows=rows, errors=error_rows(self, self.errors), raster=self.rules["raster"][1], notes=notes,
            creep=self.creep_words, not_held=self.not_held,
        )  # fmt: skip

    def _cost_words(self) -> str:
        limit = f"limit {grouped(self.max_particles)} particles"
        limit += "" if self.max_cost is None else f" and {duration_text(self.max_cost)}"
        if not math.isfinite(self.cost.seconds):
            return f"about {grouped(self.cost.steps)} steps; CPU time not known, kernels were compiled; {limit}"
        low, high = self.cost.between(self.particles)
        return (
            f"about {duration_text(self.cost.seconds)} of CPU time ({duration_text(low)} to {duration_text(high)}) and "
            f"{grouped(self.cost.steps)} steps; {limit}; pilot runs took {duration_text(self.pilot_seconds)}"
        )


def error_rows(plan: Plan, errors: Mapping[str, float]) -> list[tuple[str, float, float | None, str]]:
    """Return quantity, errors of particles and of the raster [-] (None: not examined), and whether it is held.

    Parameters
    ----------
    plan : Plan
    errors : mapping of str to float
        Errors of particles, by quantity [-].

    Returns
    -------
    list of tuple
    """
    rows, not_held = [], plan.not_held_with(errors)
    for name in ERROR_LAWS:
        verdict = "stated" if name not in plan.hold else "not held" if name in not_held else "held"
        rows.append((name, errors[name], plan.raster_errors.get(name), verdict))
    return rows


def _with_rule(choice: str, rule: str) -> str:
    return f"{choice} ({rule})" if rule else choice


def _values(mapping: Mapping[str, Any], setup: Setup) -> dict[str, Any]:
    """Return the attributes of a plan from its plain values."""
    numerics = build_declared(Numerics, dict(mapping["numerics"]), "numerics")
    column = dict(mapping["column"])
    law = setup.column if "repr" in column else build_law("column", column)  # plain values do not build every law
    values = {name: mapping[name] for name in ("max_cost", "still_moving")}
    values |= {name: float(mapping[name]) for name in ("tolerance", "creep", "creep_level", "max_duration", "volume")}
    values |= {name: int(mapping[name]) for name in ("particles", "max_particles")}
    values |= {name: tuple(map(str, mapping[name])) for name in ("hold", "warnings")}
    values |= {name: _numbers(mapping[name]) for name in ("errors", "raster_errors")}
    x, y = map(float, mapping["origin"])
    return values | {
        "setup": dataclasses.replace(setup, numerics=numerics, column=law), "origin": (x, y),
        "rules": {name: (str(choice), str(rule)) for name, (choice, rule) in mapping["rules"].items()},
        "runs": {int(count): _numbers(run) for count, run in mapping["runs"].items()},
        "cost": Cost(**_numbers(mapping["cost"])), "pilot_seconds": _number(mapping["pilot_seconds"]),
        "digests": {name: str(mapping["digests"][name]) for name in ("setup", "ground")},
    }  # fmt: skip


def _plain(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {str(key): _plain(one) for key, one in value.items()}
    if isinstance(value, tuple | list):
        return [_plain(one) for one in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def _number(value: Any) -> float:
    return math.nan if value is None else float(value)


def _numbers(values: Mapping[str, Any]) -> dict[str, float]:
    return {name: _number(value) for name, value in values.items()}
