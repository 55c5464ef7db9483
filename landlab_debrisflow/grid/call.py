"""A call of the component: read the grid, run the model, write the results; or leave everything as it was."""

from collections.abc import Callable
from functools import partial
from threading import get_ident
from time import process_time

import numpy as np

from . import checkpoint
from .checkpoint_checks import check_contents
from .fields import output_fields
from .interruption import Interruption
from .listener import CallListener
from .outputs import Outputs
from .owned import OwnedByFlow
from .read import GridReader
from .rollback import Rollback
from .write import FieldWriter


class GridCall(OwnedByFlow):
    """Calls between the fields of a grid and a simulation.

    A call leaves this file five times, for `Rollback.around_call`, `GridReader.read`, `GridBed.lay`, `Simulation.run`
    and `CallListener.ended`, which writes (tests/grid/test_call.py counts). Nothing of Landlab goes beyond `read`.

    Parameters
    ----------
    flow : DebrisFlow
        Component under construction: its grid gets fields that are missing, its observers are shown the component.
    continues : GridCall, optional
        Calls of the component before on the same grid.

    Attributes
    ----------
    before_settling : callable or None
        Called with the flow at the end of a call, as an observer is, before mass at rest settles.
    cpu : float
        CPU time of all calls, those of `continues` left out [s].
    """

    def __init__(self, flow, continues: "GridCall | None" = None):
        super().__init__(flow)
        grid, self._simulation = flow.grid, flow._simulation
        self.interruption = Interruption()
        self._reader = GridReader(grid, self._simulation.setup)
        self._writer = FieldWriter(grid, self._simulation, self.interruption)
        self._listener = CallListener(flow, self._writer, self.interruption)
        if continues is not None:
            self._writer.continue_from(continues._writer)
            self._listener.reports.continue_from(continues._listener.reports)
        # last, so that a component that is refused has changed nothing
        before = None if continues is None else continues._outputs
        self.before_settling: Callable[[], None] | None = None
        self.cpu = 0.0
        self._outputs = Outputs(grid, output_fields(self._simulation.setup), self._writer.carried_volume, before)
        self.rollback = Rollback(grid, self._reader.laws, self._writer, self.interruption, self._outputs)

    def run(self, duration: float, stop_at_rest: bool) -> None:
        """Run for `duration` seconds, or until rest if `stop_at_rest` is set and rest comes first.

        Raises
        ------
        As `DebrisFlow.run_one_step`.
        """
        sim, began = self._simulation, process_time()
        with self.rollback.around_call() as interrupted:
            end = self.interruption.end = sim.state.time + duration
            if interrupted is None:
                done = sim.run(*self._prepare(), end, stop_at_rest, self._listener)
            else:
                if np.isclose(end, interrupted.end, rtol=1e-12, atol=0.0):
                    # the end of an interrupted call, without the rounding in the duration that is left
                    end = self.interruption.end = interrupted.end
                done = sim.advance(end, stop_at_rest, self._listener)
            if done:
                self._listener.ended(stop_at_rest, self.before_settling)
            else:
                self._listener.broken_off()
                self.rollback.break_off(end)
            self.cpu += process_time() - began
        while self._listener.requests:  # requests of another thread that came after the last step
            self._listener.requests.pop(0)()

    def settle(self) -> None:
        """Lay down the mass at rest."""
        with self.rollback.around_call() as interrupted:
            if interrupted is None:
                self.begin(with_release=False)
            self._writer.close(settle=True)

    def begin(self, with_release: bool = True) -> None:
        """Read the grid and put the simulation on its bed.

        `with_release` tells whether values > 0 in the release field fail now.
        """
        self._simulation.begin(*self._prepare(with_release), self._listener)

    def _prepare(self, with_release: bool = True):
        """Return the bed of the call, and the input.

        `with_release` tells whether values > 0 in the release field fail now; their volume is then counted.
        """
        model, state = self._simulation.state, self._writer.state
        carried = model.particles.volume.size > 0
        given = self._reader.read(state.grid_bed, model.inflow, carried, state.warned, with_release)
        state.warned = given.warned
        bed = state.grid_bed.lay(given, self._writer.rows, model.inflow, model.time)
        state.budget.released += given.release.volume
        return bed, given

    # ---- checkpoints ----

    def save(self, write) -> None:
        """Hand the flow as a Dataset to a function, at once or as soon as the step that is being made is over.

        Parameters
        ----------
        write : callable
            Called with the Dataset of `checkpoint.capture`.

        Raises
        ------
        As the function
            If it is called at once; otherwise its exception ends the call, as that of an observer does.
        """
        if not self.interruption.running:
            with self.rollback.between_calls() as end:
                write(self._capture(end))
        elif self._listener.paused == get_ident():
            write(self._capture(self.interruption.end))
        else:
            self._listener.requests.append(partial(self.save, write))

    def load(self, dataset) -> None:
        """Put the flow into the state of a Dataset from `save`, whose fields the grid has already."""
        terrain = self.flow.grid.shape, (self.flow.grid.dx, self.flow.grid.dy)
        rows = self._simulation.inflow.rows
        check_contents(dataset, self._capture(None), checkpoint.PARTICLE, *terrain, rows)
        end = checkpoint.restore(self._writer, self._reader, self._listener.reports, dataset)
        if end is not None:
            self.rollback.break_off(end)
            self._writer.rows = None

    @property
    def unfinished_until(self) -> float | None:
        """Time until which a call that was interrupted should have gone [s], or None."""
        return None if self.rollback.interrupted is None else self.rollback.interrupted.end

    def _capture(self, end):
        grid, reports = self.flow.grid, self._listener.reports
        return checkpoint.capture(grid, self._writer, self._reader.laws, reports, end)

    # ---- results over all calls ----

    @property
    def budget(self) -> dict[str, float]:
        """Volumes so far [m3]."""
        return self._writer.state.budget.terms(self._writer.model_volumes())

    @property
    def budget_by_phase(self) -> dict[str, dict[str, float]]:
        """Volumes of grains and water so far [m3]."""
        material = self._simulation.setup.material
        return self._writer.state.budget.terms_by_phase(self._writer.model_volumes(), material)

    def maps(self) -> dict:
        """Return elevation, soil and outputs by name, each (nodes,)."""
        return self._outputs.maps(self._writer.accounts())

    def restart_peaks(self) -> None:
        """Start peaks and arrival time anew; run-up counts from where the mass lies now."""
        with self.interruption:
            particles = self._simulation.particles
            particles.lowest_z[:] = particles.z
            self._outputs.restart_peaks()
