"""The life of a call: read the grid, let fail what is to fail, run, settle, show; or leave everything as it was."""

import logging
from contextlib import contextmanager

import numpy as np

from . import inputs
from .core.variables import OUTPUT_PREFIX
from .ground import Ground
from .inflow_inputs import check_lines, check_strips
from .model.footprint import NOW, PEAKS, PHASES, Footprint
from .model.journal import Journal
from .model.ledger import Ledger
from .outputs import DEPOSIT, ERODED
from .spatial.transfer import REACH

log = logging.getLogger("landlab_debrisflow")


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
        self._said_nothing_to_do = False

    def run(self, duration: float, stop_at_rest: bool) -> None:
        """Run for `duration` seconds, or until rest."""
        with self.all_or_nothing():
            self.begin()
            self._advance(duration, stop_at_rest)
            self.ledger.watch_soil(None, None)
            self._simulation.warn_of_walls()
            if self._simulation.at_rest and self._simulation.numerics.settle:
                self._settle()
            self._finish()

    def settle(self) -> None:
        """Lay down what is at rest."""
        with self.all_or_nothing():
            self.begin(take_release=False)
            self._settle()
            self._finish()

    @contextmanager
    def all_or_nothing(self):
        """Leave grid and model as they were if anything goes wrong inside, an interrupt included."""
        names = [f for f in self.flow._info if f in self.flow.grid.at_node and "out" in self.flow._info[f]["intent"]]
        fields = [self.flow.grid.at_node[name] for name in names] + [self._settled, self._ground.eroded]
        self._undo = Journal(fields, self.flow.grid.number_of_node_columns)
        simulation, ledger = self._simulation.snapshot(), self.ledger.snapshot()
        try:
            yield
        except BaseException:
            self._undo.restore()
            self._simulation.restore(simulation)
            self.ledger.restore(ledger)
            self._ground.forget()
            raise

    def begin(self, take_release=True):
        """Read and check the grid, let fail what is to fail, and put the model on the bare bed."""
        grid, ground, sim = self.flow.grid, self._ground, self._simulation
        changed = ground.read()
        check_lines(grid, sim.inflow)
        failing, depth = inputs.read_release(grid, ground.soil) if take_release else (np.zeros(0, int), np.zeros(0))
        if failing.size:
            rows = failing // grid.number_of_node_columns
            self._undo.cover(rows.min(), rows.max() + 1)
            ground.fail(failing, depth)
            self.ledger.released += float(depth.sum() * grid.dx * grid.dy)
        elif sim.particles.count == 0 and sim.inflow.over and not self._said_nothing_to_do:
            log.warning("nothing to do: no value > 0 in debris_flow__release_depth and nothing moving")
            self._said_nothing_to_do = True
        bed = ground.make_bed(sim.time, sim.particles.count == 0 and sim.inflow.over)
        sim.inflow.aim(bed.surface)
        check_strips(grid, sim.inflow)
        sim.on(bed, ground.status, ground.parameters, changed or failing.size > 0)
        names = NOW + PEAKS + (PHASES if sim.physics.two_phases else ())
        shown = {name: grid.at_node[OUTPUT_PREFIX + name] for name in names}
        self._footprint = Footprint(bed.nodes, ground.status, shown, sim.numerics.arrival_depth, sim.time)
        soil = None if ground.soil is None else Journal([ground.soil], grid.number_of_node_columns)
        self.ledger.watch_soil(bed.nodes.core, soil)
        self._journals = [self._undo] if soil is None else [self._undo, soil]
        if failing.size:
            sim.release(failing, depth)
        self._cover()
        self._record()

    def _cover(self):
        """Keep the rows of the grid that the next step may change."""
        south, north = self._simulation.extent()
        for journal in self._journals if south <= north else ():
            journal.cover(int(south / self.flow.grid.dy) - REACH, int(north / self.flow.grid.dy) + REACH + 2)

    def _advance(self, duration, stop_at_rest):
        """Run, stopping where an observer wants to look while there is an event."""
        sim, end = self._simulation, self._simulation.time + duration
        while sim.time < end and not (stop_at_rest and sim.at_rest):
            sim.wait(end)
            watching = () if sim.idle else self.flow._observers
            looks = [o.interval * (np.floor(sim.time / o.interval * (1 + 1e-12)) + 1) for o in watching]
            self._cover()
            sim.advance(min([end, *looks]) - sim.time, self._follow, stop_at_rest)
            self._record()
            for observer, look in zip(watching, looks, strict=True):
                if sim.time >= look or sim.idle:
                    self._show(self._undo.nodes)
                    observer.observe(self.flow)

    def _follow(self):
        sim = self._simulation
        self._cover()
        if self._footprint.is_due(sim.time, sim.survey.fastest):
            self._record()

    def _record(self):
        sim = self._simulation
        self._footprint.record(sim.particles, sim.matter.density(sim.particles), sim.time)

    def _settle(self):
        elevation, bed = self._ground.elevation, self._simulation.bed
        self.ledger.watch_soil(None, None)  # what settles becomes soil, too
        rise = Journal([elevation], self.flow.grid.number_of_node_columns)
        self._journals = [self._undo, rise]
        self._cover()
        nodes, depth = self._simulation.settle()
        self.ledger.count_deposit(bed.nodes.core, rise)
        self._settled[nodes] += depth
        self._footprint.clear()

    def _finish(self):
        """Show the accounts of all calls so far, and remember the terrain to notice what others change."""
        now, before = self._undo.nodes, self._reached
        if now.stop > 0:
            first = min(before.start, now.start) if before.stop > 0 else now.start
            self._reached = slice(first, max(before.stop, now.stop))
        self._show(self._reached)
        self._ground.remember(now, self._simulation.time)

    def _show(self, nodes):
        """Write what was eroded, what has settled and lies still, at some nodes, and bed pressure where it changed."""
        self._ground.show(self._undo.nodes, self._simulation.time)
        at = self.flow.grid.at_node
        at[ERODED][nodes], at[DEPOSIT][nodes] = self._ground.eroded[nodes], self._settled[nodes]
        lying, depth = self._simulation.resting_depth()
        at[DEPOSIT][lying] += depth

    def accounts(self) -> dict:
        """Return the depths eroded and deposited so far [m] over nodes, by the names of their fields."""
        deposit, (nodes, depth) = self._settled.copy(), self._simulation.resting_depth()
        deposit[nodes] += depth
        return {ERODED: self._ground.eroded, DEPOSIT: deposit}

    def continue_from(self, earlier: "Calls") -> None:
        """Go on with clock and accounts of an earlier component that holds no particles any more."""
        simulation, before = self._simulation, earlier._simulation
        simulation.time, simulation.settled_solid = before.time, before.settled_solid
        simulation.outflow = before.outflow.copy()
        self.ledger.continue_from(earlier.ledger, before)
        self._settled[:], self._ground.eroded[:] = earlier._settled, earlier._ground.eroded
        self._reached = earlier._reached
