"""The Landlab component: fields of the grid on one side, the model on the other."""

import logging
from contextlib import contextmanager
from typing import ClassVar

import numpy as np
from landlab import Component, RasterModelGrid

from . import inputs
from .citation import PAPER
from .core.variables import NODE_FIELDS, OUTPUT_PREFIX
from .ground import Ground
from .inflow_inputs import check_lines, check_strips, read_hydrographs
from .model.footprint import NOW, PEAKS, Footprint
from .model.inflow import Inflow
from .model.journal import Journal
from .model.ledger import Ledger
from .model.numerics import Numerics
from .model.physics import build_declared, build_physics
from .model.simulation import Simulation
from .record.datasets import columns_dataset, maps_dataset, particles_dataset
from .spatial.transfer import REACH

log = logging.getLogger("landlab_debrisflow")


class DebrisFlow(Component):
    """Landslides and debris flows that pick up wet ground on their way.

    Depth-integrated SPH on the terrain with a column of pore pressure under every particle, which moves
    with the flow while new soil enters from below (Pastor et al., 2022).

    Parameters
    ----------
    grid : RasterModelGrid
        With ``topographic__elevation`` [m]; give ``soil__depth`` [m] to let the bed erode and
        ``debris_flow__release_depth`` [m] to say what fails.
    friction, erosion, column, flow : law, str or mapping, optional
        A law object, its name, or plain values: ``{"law": "voellmy", "turbulent_coefficient": 500.0}``.
    material : Material or mapping, optional
        Densities, porosity, consolidation, initial pore pressure.
    numerics : Numerics or mapping, optional
        Number of particles, threads, settling.
    inflow : Hydrograph, mapping or a sequence of them, optional
        What flows in across lines: discharge, velocity and pore pressure against `elapsed_time`.
    observers : sequence, optional
        Objects with an ``interval`` [s] and a method ``observe(flow)``, called every so many seconds of
        the event and when it comes to rest.

    Raises
    ------
    InputError (a ValueError), ParameterError (a ValueError), landlab.FieldError
        If the grid, a boundary, a law or a parameter is not usable.

    Examples
    --------
    >>> import numpy as np
    >>> from landlab import RasterModelGrid
    >>> from landlab_debrisflow import DebrisFlow
    >>> grid = RasterModelGrid((20, 60), xy_spacing=5.0)
    >>> z = grid.add_field("topographic__elevation", np.maximum(0.0, 75.0 - 0.5 * grid.x_of_node), at="node")
    >>> soil = grid.add_full("soil__depth", 1.0, at="node")
    >>> release = grid.add_zeros("debris_flow__release_depth", at="node")
    >>> release[(abs(grid.x_of_node - 30) < 8) & (abs(grid.y_of_node - 48) < 8)] = 1.0
    >>> flow = DebrisFlow(grid, numerics={"particle_count": 200})
    >>> flow.run_until_rest()
    True
    >>> flow.budget["released"]
    225.0
    >>> bool(abs(flow.budget["residual"]) < 1e-12 * 225.0)
    True
    """

    _name = "DebrisFlow"
    _unit_agnostic = False
    _cite_as = PAPER
    _info: ClassVar = {field.name: field.info for field in NODE_FIELDS}

    def __init__(self, grid, *, friction=None, erosion=None, column=None, flow=None, material=None,
                 numerics=None, inflow=None, observers=()):  # fmt: skip
        if not isinstance(grid, RasterModelGrid):
            raise inputs.InputError(f"DebrisFlow needs a RasterModelGrid, got {type(grid).__name__}")
        self._physics = build_physics(flow, friction, erosion, column, material)
        self._numerics = build_declared(Numerics, numerics, "numerics")
        self._observers = inputs.check_observers(observers)
        self._hydrographs = read_hydrographs(inflow)
        super().__init__(grid)
        inputs.check_boundaries(grid)
        inputs.add_fields(self)
        entering = Inflow(self._hydrographs, self._numerics, grid.xy_of_lower_left)
        self._simulation = Simulation(self._physics, self._numerics, entering)
        self._settled = np.zeros(grid.number_of_nodes)
        self._ledger = Ledger(grid.dx * grid.dy)
        self._ground = Ground(grid, self._physics)
        self._lying = np.zeros(0, int)  # nodes whose deposit is still that of particles
        self._said_nothing_to_do = False

    # ---- what a user calls ----

    def run_one_step(self, dt):
        """Advance exactly `dt` seconds.

        Values > 0 in ``debris_flow__release_depth`` are taken first; what has come to rest at the end is
        laid into the terrain, unless ``numerics={"settle": False}``.

        Parameters
        ----------
        dt : float
            Duration [s], whatever unit other components use; 0 does nothing.

        Raises
        ------
        InputError
            If `dt` or a field is not usable; nothing was changed.
        SimulationError
            If the state stopped being finite; the grid is as it was before the call.
        """
        if (dt := inputs.check_duration(dt)) > 0.0:
            self._run(dt, stop_at_rest=False)

    def run_until_rest(self, max_duration=3600.0):
        """Run the whole event.

        Parameters
        ----------
        max_duration : float
            Longest time to simulate [s].

        Returns
        -------
        bool
            True if all is at rest (and settled); False: it still moves, nothing settled, call again to go on.
        """
        if (duration := inputs.check_duration(max_duration, "max_duration")) > 0.0:
            self._run(duration, stop_at_rest=True)
        return self.at_rest

    def settle(self):
        """Lay the mass at rest into elevation and soil; the particles go.

        Raises
        ------
        InputError
            If something still moves.
        """
        if not self.at_rest:
            raise inputs.InputError("settle() lays down mass at rest, but the flow still moves; run_until_rest() first")
        with self._all_or_nothing():
            self._begin(take_release=False)
            self._settle()
            self._finish()

    @property
    def elapsed_time(self):
        """Time simulated so far [s]."""
        return self._simulation.time

    @property
    def at_rest(self):
        """Whether nothing moves."""
        return self._simulation.at_rest

    @property
    def budget(self):
        """Volumes so far [m3]: released + inflow + eroded = moving + deposited + outflow, up to the residual.

        Each is measured on its own: release field, hydrographs, soil field, particles, elevation field,
        particles that left. ``moving`` counts all particles, also those at rest but not settled.
        """
        return self._ledger.budget(self._simulation)

    @property
    def outflow_by_edge(self):
        """Volume that left over each side of the grid, or over open nodes inside it [m3]."""
        return self._simulation.outflow_by_edge(*self.grid.shape)

    @property
    def particles(self):
        """The particles now: a Dataset over ``particle`` with map coordinates of the grid."""
        return particles_dataset(self._simulation.particles, self.grid.xy_of_lower_left, self.elapsed_time)

    @property
    def columns(self):
        """Excess pore pressure over ``particle`` and ``level`` (0 at the base, 1 at the surface), what shapes it."""
        sim, c_v = self._simulation, self._physics.material.coefficient_of_consolidation
        return columns_dataset(sim.columns_now(), sim.particles, c_v, self.elapsed_time)

    @property
    def maps(self):
        """The fields of the grid as a Dataset over ``y`` and ``x``, with units and all parameters."""
        return maps_dataset(self.grid, self._physics, self._numerics, self.budget, self.elapsed_time, self._hydrographs)

    # ---- the life of a call ----

    def _run(self, duration, stop_at_rest):
        with self._all_or_nothing():
            self._begin()
            self._advance(duration, stop_at_rest)
            self._ledger.watch_soil(None, None)
            self._simulation.warn_of_walls()
            if self.at_rest and self._numerics.settle:
                self._settle()
            self._finish()

    @contextmanager
    def _all_or_nothing(self):
        """Leave grid and model as they were if anything goes wrong inside, an interrupt included."""
        names = [f for f in self._info if f in self.grid.at_node and "out" in self._info[f]["intent"]]
        fields = [self.grid.at_node[name] for name in names] + [self._settled]
        self._undo = Journal(fields, self.grid.number_of_node_columns)
        simulation, ledger, lying = self._simulation.snapshot(), self._ledger.snapshot(), self._lying
        try:
            yield
        except BaseException:
            self._undo.restore()
            self._simulation.restore(simulation)
            self._ledger.restore(ledger)
            self._lying = lying
            self._ground.forget()
            raise

    def _begin(self, take_release=True):
        """Read and check the grid, let fail what is to fail, and put the model on the bare bed."""
        grid, ground, sim = self.grid, self._ground, self._simulation
        changed = ground.read()
        check_lines(grid, sim.inflow)
        failing, depth = inputs.read_release(grid, ground.soil) if take_release else (np.zeros(0, int), np.zeros(0))
        if failing.size:
            rows = failing // grid.number_of_node_columns
            self._undo.cover(rows.min(), rows.max() + 1)
            ground.fail(failing, depth)
            self._ledger.released += float(depth.sum() * grid.dx * grid.dy)
        elif sim.particles.count == 0 and sim.inflow.over and not self._said_nothing_to_do:
            log.warning("nothing to do: no value > 0 in debris_flow__release_depth and nothing moving")
            self._said_nothing_to_do = True
        bed = ground.make_bed(sim.time, sim.particles.count == 0 and sim.inflow.over)
        sim.inflow.aim(bed.surface)
        check_strips(grid, sim.inflow)
        sim.on(bed, ground.status, ground.parameters, changed or failing.size > 0)
        shown = {name: grid.at_node[OUTPUT_PREFIX + name] for name in NOW + PEAKS}
        self._footprint = Footprint(bed.nodes, shown, self._numerics.arrival_depth, sim.time)
        soil = None if ground.soil is None else Journal([ground.soil], grid.number_of_node_columns)
        self._ledger.watch_soil(bed.nodes.core, soil)
        self._journals = [self._undo] if soil is None else [self._undo, soil]
        if failing.size:
            sim.release(failing, depth)
        self._cover()
        self._footprint.record(sim.particles, sim.time)

    def _cover(self):
        """Keep the rows of the grid that the next step may change."""
        south, north = self._simulation.extent()
        for journal in self._journals if south <= north else ():
            journal.cover(int(south / self.grid.dy) - REACH, int(north / self.grid.dy) + REACH + 2)

    def _advance(self, duration, stop_at_rest):
        """Run, stopping where an observer wants to look while there is an event."""
        sim, end = self._simulation, self._simulation.time + duration
        while sim.time < end and not (stop_at_rest and self.at_rest):
            sim.wait(end)
            watching = () if sim.idle else self._observers
            looks = [o.interval * (np.floor(sim.time / o.interval * (1 + 1e-12)) + 1) for o in watching]
            self._cover()
            sim.advance(min([end, *looks]) - sim.time, self._follow, stop_at_rest)
            self._footprint.record(sim.particles, sim.time)
            for observer, look in zip(watching, looks, strict=True):
                if sim.time >= look or sim.idle:
                    self._show()
                    observer.observe(self)

    def _follow(self):
        sim = self._simulation
        self._cover()
        self._footprint.follow(sim.particles, sim.time, sim.survey.fastest)

    def _settle(self):
        self._ledger.watch_soil(None, None)  # what settles becomes soil, too
        rise = Journal([self._ground.elevation], self.grid.number_of_node_columns)
        self._journals = [self._undo, rise]
        self._cover()
        nodes, depth = self._simulation.settle()
        self._ledger.count_deposit(self._simulation.bed.nodes.core, rise)
        self._settled[nodes] += depth
        self._lying = np.union1d(self._lying, nodes)
        self._footprint.clear()

    def _finish(self):
        """Show the deposit, and remember the terrain to notice what other components change."""
        self._show()
        self._ground.remember(self._undo.nodes, self.elapsed_time)

    def _show(self):
        """Write the deposit: what has settled and what lies still now."""
        self._ground.show(self._undo.nodes, self.elapsed_time)
        field = self.grid.at_node[OUTPUT_PREFIX + "deposit_depth"]
        nodes, depth = self._simulation.resting_depth()
        field[self._lying] = self._settled[self._lying]
        field[nodes] = self._settled[nodes] + depth
        self._lying = nodes
