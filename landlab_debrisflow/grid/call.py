"""The life of a call: read the grid, let fail what is to fail, run, settle, show; or leave everything as it was.

Whoever looks between two steps sees the grid as the end of a call would leave it, and what was done for that is taken
back. A call that is interrupted ends like that, too, but what belongs to the moment is kept: if nobody has changed the
grid, the next call takes all of it back and goes on, so that in the end nothing tells that there was an interruption.
"""

import logging
from contextlib import contextmanager
from copy import copy
from typing import NamedTuple

import numpy as np

from ..model.peak_maps import CURRENT, PEAKS, PHASES, PeakMaps
from ..spatial.transfer import REACH
from . import checks, doubts, looks
from .budget import Ledger
from .fields import OUTPUT_PREFIX
from .ground import Ground
from .inflow_lines import check_lines, check_strips
from .interruption import Interruption
from .moment import Moment
from .outputs import DEPOSIT, ERODED
from .reports import Reports
from .row_backup import Journal, Spot

log = logging.getLogger("landlab_debrisflow")


class Interrupted(NamedTuple):
    """A call that has not come to its end."""

    moment: Moment  # as it was before it was shown
    end: float  # until when it should have gone [s]
    fingerprint: tuple  # of the grid as it was left


class Calls:
    """What happens between the fields of a grid and a simulation in every call.

    Parameters
    ----------
    flow : DebrisFlow
        Its grid is read and written; its observers get it to look at.
    simulation : Simulation
    """

    def __init__(self, flow, simulation):
        self.flow, self._simulation, grid = flow, simulation, flow.grid
        self._settled = np.zeros(grid.number_of_nodes)
        self._reached = slice(0, 0)  # nodes that calls so far may have changed
        self.ledger = Ledger(grid.dx * grid.dy)
        self._ground = Ground(grid, simulation.physics)
        self._undo = self._footprint = None  # in a call: rows as it found them, and what shows the flow
        self.interruption = Interruption()  # entered by whatever may not be done while a call runs
        self._interrupted = None
        self._said_nothing_to_do = self._said_deep = False
        self._reports = Reports(flow, simulation)

    def run(self, duration: float, stop_at_rest: bool) -> None:
        """Run for `duration` seconds, or until rest."""
        sim = self._simulation
        with self.interruption as interruption, self.flow._outputs.shown(), self.all_or_nothing() as earlier:
            end = sim.time + duration
            if earlier is None:
                self.begin()
                self._start(end, stop_at_rest)
            elif np.isclose(end, earlier.end, rtol=1e-12, atol=0.0):
                end = earlier.end  # what is left of it was computed with rounding
            done = sim.advance(end, stop_at_rest, self._after_step, lambda: interruption.wanted)
            with interruption.held():
                if done:
                    self._close(settle=sim.at_rest and sim.numerics.settle)
                    self._reports.tell(stop_at_rest)
                else:
                    self._break_off(end)
        interruption.raise_cause(sim.time, done)

    def settle(self) -> None:
        """Lay down what is at rest."""
        with self.interruption as interruption, self.flow._outputs.shown(), self.all_or_nothing() as earlier:
            if earlier is None:
                self.begin(take_release=False)
            with interruption.held():
                self._close(settle=True)
        interruption.raise_cause(self._simulation.time, done=True)

    @contextmanager
    def all_or_nothing(self):
        """Leave grid and model as they were if anything goes wrong inside; give the call that goes on here, or None."""
        latest, columns = self._interrupted, self.flow.grid.number_of_node_columns
        goes_on = latest is not None and latest.fingerprint == self._ground.fingerprint(self.flow._info)
        # without it, the bed of the last call is of no use any more
        moment = latest.moment if goes_on else self._moment(Journal(self._rasters(), columns), [self._simulation.bed])
        try:
            with self.interruption.held():
                if goes_on:
                    moment.restore()
                self._undo = moment.rows
            yield latest if goes_on else None
        except BaseException as failure:
            with self.interruption.held():
                moment.restore()
                if goes_on:
                    self._undo = moment.rows
                    self._close()
                self._interrupted = latest
            if isinstance(failure, KeyboardInterrupt):
                failure.add_note("interrupted within a step: grid and model are as they were before the call")
            raise
        finally:
            self._undo = None

    def begin(self, take_release=True):
        """Read and check the grid, let fail what is to fail, and put the model on the bare bed."""
        grid, ground, sim = self.flow.grid, self._ground, self._simulation
        changed = ground.read()
        check_lines(grid, sim.inflow)
        failing, depth = checks.read_release(grid, ground.soil) if take_release else (np.zeros(0, int), np.zeros(0))
        for doubt in () if self._said_deep else doubts.about_release(grid, failing, depth):
            log.warning("%s", doubt)
            self._said_deep = True
        if failing.size:
            rows = failing // grid.number_of_node_columns
            self._undo.cover(rows.min(), rows.max() + 1)
            ground.fail(failing, depth)
            self.ledger.released += float(depth.sum() * grid.dx * grid.dy)
        elif sim.particles.count == 0 and sim.inflow.over and not self._said_nothing_to_do:
            found = doubts.about_nothing(grid, ground.soil)
            log.warning("nothing to do: no value > 0 in debris_flow__release_depth and nothing moving%s", found)
            self._said_nothing_to_do = True
        bed = ground.make_bed(sim.time, sim.particles.count == 0 and sim.inflow.over)
        sim.inflow.aim(bed.surface)
        check_strips(grid, sim.inflow)
        sim.set_bed(bed, ground.status, ground.parameters, changed)
        names = CURRENT + PEAKS + (PHASES if sim.physics.two_phases else ())
        shown = {name: grid.at_node[OUTPUT_PREFIX + name] for name in names}
        self._footprint = PeakMaps(bed.nodes, ground.status, shown, sim.numerics.arrival_depth, sim.time)
        soil = None if ground.soil is None else Journal([ground.soil], grid.number_of_node_columns)
        self.ledger.watch_soil(bed.nodes.core, soil)
        if failing.size:
            sim.release(failing, depth)
        self._cover()
        self._record()

    def _start(self, end, stop_at_rest):
        sim = self._simulation
        if stop_at_rest and sim.at_rest:
            return
        sim.start(end)
        self._cover()
        if not sim.idle:
            self._look(looks.at_start(self.flow._observers))

    def _cover(self, *others):
        """Keep the rows of the grid that the next step may change."""
        south, north = self._simulation.extent()
        for journal in (self._undo, self.ledger, *others) if south <= north else ():
            journal.cover(int(south / self.flow.grid.dy) - REACH, int(north / self.flow.grid.dy) + REACH + 2)

    def _after_step(self, began):
        sim, observers = self._simulation, self.flow._observers
        self._cover()
        if self._footprint.is_due(sim.time, sim.state.limits.fastest):
            self._record()
        self._look(observers if sim.idle else looks.after_step(observers, began, sim.time))

    def _record(self):
        sim = self._simulation
        self._footprint.record(sim.particles, sim.phases.density(sim.particles), sim.time)

    # ---- what others see ----

    def _look(self, observers):
        if observers:
            with self._showing():
                looks.look(self.flow, observers, self.interruption)

    @contextmanager
    def _showing(self):
        """Show the present, and take all of that back."""
        sim, footprint = self._simulation, self._footprint
        state, at = sim.state, self.flow.grid.at_node
        shown, accounts = {f for f in self.flow._info if f.startswith(OUTPUT_PREFIX) and f in at}, {ERODED, DEPOSIT}
        kept = (
            Spot([at[name] for name in shown - accounts], self._near()),
            Spot([at[name] for name in accounts], self._undo.nodes), Spot(self._ground.draining, slice(None)),
        )  # fmt: skip
        sim.state, self._footprint = state.copy(), copy(footprint)
        try:
            self._show(self._undo.nodes)
            yield
        finally:
            with self.interruption.held():
                sim.state, self._footprint = state, footprint
                for each in kept:
                    each.restore()

    def _near(self):
        """Return all nodes on which what is shown may change."""
        sim, columns = self._simulation, self.flow.grid.number_of_node_columns
        p = sim.particles
        under, _ = sim.bed.depth_of(p.x, p.y, p.spread, p.volume)
        nodes = np.concatenate([under, self._footprint.under])
        nodes = np.unique([nodes + k for k in (0, 1, -1, columns, -columns)])  # closed ones beside show what is there
        return nodes[(nodes >= 0) & (nodes < self.flow.grid.number_of_nodes)]

    def _show(self, nodes):
        """Bring columns to the present and fields, those of the accounts at some nodes; the flow was nowhere else."""
        sim, at = self._simulation, self.flow.grid.at_node
        sim.catch_up()
        self._record()
        self._ground.show(self._undo.nodes, sim.time)
        at[ERODED][nodes], at[DEPOSIT][nodes] = self._ground.eroded[nodes], self._settled[nodes]
        lying, depth = sim.resting_depth()
        at[DEPOSIT][lying] += depth

    # ---- the end ----

    def _break_off(self, end):
        """Leave the grid as the end of a call does, and keep what is needed to go on as if it had not ended."""
        moment = self._moment(self._undo.again(self._rasters()))
        self._close()
        self._interrupted = Interrupted(moment, end, self._ground.fingerprint(self.flow._info))

    def _close(self, settle: bool = False):
        """Show the present, and remember the terrain to notice what other components change."""
        if settle:
            self._settle()
        self.ledger.watch_soil(None, None)
        now, before = self._undo.nodes, self._reached
        if now.stop > 0:
            first = min(before.start, now.start) if before.stop > 0 else now.start
            self._reached = slice(first, max(before.stop, now.stop))
        self._show(self._reached)  # also where somebody else has written
        self._ground.remember(now)
        self._footprint = self._interrupted = None

    def _settle(self):
        sim, elevation = self._simulation, self._ground.elevation
        sim.catch_up()
        self._record()
        self.ledger.watch_soil(None, None)  # what settles becomes soil, too
        rise = Journal([elevation], self.flow.grid.number_of_node_columns)
        self._cover(rise)
        nodes, depth = sim.settle()
        self.ledger.count_deposit(sim.bed.nodes.core, rise)
        self._settled[nodes] += depth
        self._footprint.clear()

    # ---- accounts over all calls ----

    def accounts(self) -> dict:
        """Return the depths eroded and deposited so far [m] over nodes, by the names of their fields."""
        deposit, (nodes, depth) = self._settled.copy(), self._simulation.resting_depth()
        deposit[nodes] += depth
        return {ERODED: self._ground.eroded, DEPOSIT: deposit}

    def continue_from(self, earlier: "Calls") -> None:
        """Go on with clock and accounts of an earlier component that holds no particles any more."""
        simulation, before = self._simulation, earlier._simulation
        state = simulation.state
        state.time, state.settled_solid = before.time, before.state.settled_solid
        state.outflow = before.state.outflow.copy()
        self.ledger.continue_from(earlier.ledger, before)
        self._settled[:], self._ground.eroded[:] = earlier._settled, earlier._ground.eroded
        self._reached = earlier._reached

    # ---- to go back ----

    def _rasters(self):
        """Return the node arrays that a call changes."""
        at, info = self.flow.grid.at_node, self.flow._info
        return [at[f] for f in info if f in at and "out" in info[f]["intent"]] + [self._settled, *self._ground.rasters]

    def _moment(self, rows, shared=()):
        """Return what there is now; `rows` is a journal of the node arrays, and what is `shared` is not copied."""
        sim, ground, in_call = self._simulation, self._ground, [] if self._footprint is None else [self._footprint]
        # calls and ground replace what they have, if it is not in the rows
        values = [value for each in (self, ground) for value in vars(each).values() if value is not sim.bed]
        laws = [sim.physics, *vars(sim.physics).values(), sim.numerics, sim.particles.variables]
        if sim.bed is not None:
            laws += [sim.status, sim.bed.nodes, sim.bed.drained, sim.friction.parameters, sim.erosion.parameters]
        objects = [self, sim, ground, self.ledger, *in_call]
        return Moment(objects, ground, rows, ground.draining if in_call else (), [*values, *laws, *shared])
