"""Plans of a flow: made by pilot runs, adopted before an event, and reported after it.

The modules that make plans are imported at the first plan: most flows have none.
"""

import dataclasses
import json
from collections.abc import Collection, Mapping
from functools import partial
from typing import TYPE_CHECKING, Any

from .core.errors import InputError
from .grid.call import GridCall
from .grid.checks import check_duration
from .model.inflow.inflow import Inflow
from .model.simulation import Simulation

if TYPE_CHECKING:
    from .fidelity.event import Event
    from .fidelity.plan import Plan
    from .fidelity.statement import Statement


class Planning:
    """Plans of a component."""

    _call: Any
    _simulation: Simulation
    _setup: Any
    _plan: "Plan | None" = None
    _measured: dict[str, float] | None = None
    grid: Any

    def plan(
        self, tolerance: float | None = None, hold: Collection[str] | None = None, *, max_particles: int = 8000,
        max_cost: float | None = None, max_duration: float = 3600.0, raster: bool | None = None,
    ) -> "Plan":  # fmt: skip
        """Find the number of particles, column and steps that an error asks for, by pilot runs on copies of the grid.

        Pilot runs have 250, 500 and 1000 particles. Grid and flow stay as they are, and observers are not called;
        progress goes to the logger "landlab_debrisflow.progress". Quantities that cannot be held are named in the plan.

        Parameters
        ----------
        tolerance : float, optional
            Error that the quantities to be held may have, of particles [-]; by default that of numerics, or 0.05.
        hold : collection of str, optional
            Quantities to be held, out of ``run_out``, ``speed``, ``depth``, ``area``, ``eroded``, ``pressure`` and
            ``deposit``; by default those of numerics, or run_out and speed. Pressure and deposit cannot be promised;
            asking for them raises particles and levels all the same.
        max_particles : int
            Most particles, at least 1000.
        max_cost : float, optional
            Longest CPU time of the run to come [s].
        max_duration : float
            As in `run_until_rest` [s].
        raster : bool, optional
            Whether to run a pilot with every second node, too; by default if that costs little.

        Returns
        -------
        Plan
            It prints itself; `adopt` uses it.

        Raises
        ------
        InputError, ParameterError
            If an argument is not usable, if the flow moves already, or if nothing is released and nothing flows in.
        SimulationError, KeyboardInterrupt
            In a pilot run; grid and flow are as they were.

        Notes
        -----
        The rules are those of docs/choosing.md, with the constants of `fidelity/constants.py`.
        """
        from .fidelity.planner import make_plan
        from .fidelity.wishes import wishes_of

        wishes = wishes_of(
            self._setup, tolerance=tolerance, hold=hold, max_particles=max_particles, max_cost=max_cost, raster=raster
        )
        if (duration := check_duration(max_duration, "max_duration")) == 0.0:
            raise InputError("plan: max_duration must be more than 0 s, got 0; give the longest time of the event")
        return make_plan(self._event(duration), wishes)

    def adopt(self, plan: "Plan") -> None:
        """Put numerics and column of a plan into the flow, before the event begins.

        Observers are prepared anew.

        Parameters
        ----------
        plan : Plan
            Plan of the same scene.

        Raises
        ------
        InputError
            If the flow moves already, or the plan is for another setup, terrain or release.
        """
        from .fidelity.plan import Plan
        from .fidelity.planner import setup_digest

        if not isinstance(plan, Plan):
            raise InputError(f"adopt: a Plan is needed, as plan() returns it, got {plan!r:.60}")
        event = self._event(plan.max_duration)
        if event.setup != plan.setup and setup_digest(event.setup) != plan.digests["setup"]:
            raise InputError(
                "adopt: the plan is for another setup: laws, material, inflow or numerics differ; make a plan of this "
                "flow with plan()"
            )
        if event.ground_digest() != plan.digests["ground"]:
            raise InputError(
                "adopt: the plan is for another terrain, soil or release than the grid has now; make a plan with plan()"
            )
        self._take(plan)

    def report(self) -> "Statement":
        """Return a statement on the run: particles, column and steps, cost, and stated errors.

        Returns
        -------
        Statement
            It prints itself. Without a plan the error is not known.
        """
        from .fidelity.statement import make_statement

        used = int(self._simulation.particles.ever), self._call.cpu
        return make_statement(self, *used, self._plan, self._measured)

    def _event(self: Any, max_duration: float) -> "Event":
        """Return the event that is about to begin; refuse one that has begun."""
        from .fidelity.event import event_of_grid

        simulation = self._simulation
        if self._call.interruption.running or self.unfinished_until is not None:
            raise InputError("plan: a call runs, or was interrupted; finish it, and plan before the event begins")
        if simulation.particles.count:
            state = "rests, but has not settled" if self.at_rest else "moves already"
            raise InputError(
                f"plan: the flow {state}, with {simulation.particles.count} particles; a plan is made before the event "
                "begins: settle() first, or build a new DebrisFlow on the grid"
            )
        if simulation.inflow.rows_entered and not simulation.inflow.over:
            raise InputError("plan: the inflow has begun; a plan is made before the event begins")
        setup, shift = self._setup, 0.0
        if simulation.inflow.over:
            setup = dataclasses.replace(setup, inflow=())
        elif self.elapsed_time > 0.0:  # the event of the pilot runs begins at time 0
            shift = min(self.elapsed_time, *(line.times[0] for line in setup.inflow))
            lines = [dataclasses.replace(one, times=tuple(t - shift for t in one.times)) for one in setup.inflow]
            setup = dataclasses.replace(setup, inflow=tuple(lines))
        duration = max_duration + self.elapsed_time - shift if setup.inflow else max_duration
        return event_of_grid(self.grid, setup, duration, type(self))

    def _find_count(self, max_duration: float) -> None:
        """Plan and adopt if numerics leave the number of particles open and something is about to move."""
        if not self._setup.numerics.automatic:
            return
        from .fidelity.planner import make_plan
        from .fidelity.wishes import wishes_of

        wishes, event = wishes_of(self._setup), self._event(max_duration)
        if event.volume > 0.0:  # otherwise the call warns that there is nothing to do
            self._take(make_plan(event, wishes))

    def _refuse_open_count(self) -> None:
        """Refuse a call of a duration while the number of particles is still to be found."""
        if self._setup.numerics.automatic:
            raise InputError(
                "run_one_step: particle_count is 'auto', which pilot runs to the end of the event have to find; call "
                "run_until_rest(), or flow.adopt(flow.plan()) before, or give a number"
            )

    def _take(self, plan: "Plan") -> None:
        """Make simulation and border anew with numerics and column of a plan; clock and accounts go on."""
        simulation, call, setup = self._simulation, self._call, self._setup
        planned = dataclasses.replace(setup, numerics=plan.numerics, column=plan.column)
        entering = Inflow(planned.inflow, planned.numerics, self.grid.xy_of_lower_left)
        entering.rows_entered = entering.rows if simulation.inflow.over else 0
        try:
            self._setup, self._simulation = planned, Simulation(planned, entering)
            self._call = GridCall(self, call)
        except BaseException:
            self._simulation, self._call, self._setup = simulation, call, setup
            raise
        self._simulation.state.counters, self._call.cpu = simulation.state.counters.copy(), call.cpu
        self._keep_plan(plan)

    def _keep_plan(self, plan: "Plan") -> None:
        """Keep the plan of the flow for its report."""
        self._plan, self._measured = plan, None
        self._call.before_settling = partial(self._measure, plan)

    def _measure(self: Any, plan: "Plan") -> None:
        """Measure the event of a plan at its end, unless other mass was released or flowed in."""
        from .fidelity.quantities import quantities

        budget = self.budget
        alone = abs(budget["released"] + budget["inflow"] - plan.volume) <= 1e-6 * plan.volume
        ended = self.at_rest or (plan.still_moving and self.elapsed_time >= plan.max_duration * (1.0 - 1e-9))
        if alone and ended and self._measured is None:
            self._measured = quantities(self, plan.origin)

    def _plan_attributes(self) -> dict[str, str]:
        """Return the plan as attributes of a checkpoint."""
        return {} if self._plan is None else {"plan": json.dumps(self._plan.to_mapping())}

    def _restore_plan(self, attributes: Mapping[str, Any]) -> None:
        """Take up the plan of a checkpoint."""
        if "plan" not in attributes:
            return
        from .fidelity.plan import Plan

        try:
            mapping = json.loads(attributes["plan"])
        except (TypeError, ValueError, RecursionError) as error:
            raise InputError(f"load: the plan in the checkpoint cannot be read: {error}") from error
        self._keep_plan(Plan.from_mapping(mapping, self._setup))
