"""Undo of a call, and the way back into one that was interrupted.

A call that fails leaves grid and model as they were. A call that is interrupted ends like any other: fields and model
show the present. But the state between its last two steps is kept. If the grid has not changed since, the next call
goes on from that state, and the results are those of a run without interruption, to the bit.
"""

from contextlib import contextmanager
from hashlib import blake2b
from typing import NamedTuple

import numpy as np

from .fields import fields_in_use
from .interruption import Interruption
from .outputs import Outputs
from .row_backup import NodeBackup, RowBackup
from .write import FieldWriter


class Moment:
    """Copy of fields, model and border between two steps, to go back to.

    Parameters
    ----------
    writer : FieldWriter
        Writes the fields of the component; its simulation and grid state are copied.
    rows : RowBackup
        Node arrays that a call changes; goes on keeping rows.
    """

    def __init__(self, writer: FieldWriter, rows: RowBackup):
        simulation = writer.simulation
        self.rows, self._writer = rows, writer
        self._draining = NodeBackup(writer.draining, slice(None))
        self._border, self._model = writer.state.copy(), simulation.state.copy()
        self._surroundings = simulation.surroundings  # each call replaces it as a whole

    def restore(self) -> None:
        """Go back, as often as wanted."""
        writer, simulation = self._writer, self._writer.simulation
        surface = writer.state.grid_bed.surface
        self._draining.restore()
        self.rows.restore()
        writer.state, simulation.state = self._border.copy(), self._model.copy()
        simulation.surroundings = self._surroundings
        if writer.state.bed is not None:  # the bed, with its accounts as they were between two steps
            simulation.surroundings = self._surroundings._replace(bed=writer.state.bed)
        if writer.state.grid_bed.surface is surface:  # otherwise the bed was made in the call that is undone
            writer.state.grid_bed.restore_surface(writer.elevation, self.rows.nodes)


class InterruptedCall(NamedTuple):
    """A call that has not come to its end.

    Attributes
    ----------
    moment : Moment
        State between its last two steps.
    end : float
        Time until which it should have gone [s].
    fingerprint : tuple
        Digests of the fields and statuses as they were left.
    """

    moment: Moment
    end: float
    fingerprint: tuple


class Rollback:
    """Guards every call of a component: undo, interruptions, and outputs of several components on one grid.

    Parameters
    ----------
    grid : RasterModelGrid
        Grid of the component.
    laws : mapping of str to object
        Laws that may read fields.
    writer : FieldWriter
        Writes the fields of the component.
    interruption : Interruption
    outputs : Outputs

    Attributes
    ----------
    interrupted : InterruptedCall or None
    """

    def __init__(self, grid, laws, writer: FieldWriter, interruption: Interruption, outputs: Outputs):
        self._grid, self._laws, self._writer = grid, laws, writer
        self._interruption, self._outputs = interruption, outputs
        self.interrupted = None

    @contextmanager
    def around_call(self):
        """Run a call as a block with undo; yield the interrupted call that this one continues, or None.

        Raises
        ------
        InputError
            If another call runs.
        KeyboardInterrupt, or the exception of an observer
            After the block.
        """
        with self._interruption, self._outputs.shown(), self.undo_on_failure() as earlier:
            yield earlier
        self._interruption.raise_cause(self._writer.simulation.time, done=self.interrupted is None)

    @contextmanager
    def undo_on_failure(self):
        """Undo the block if it raises; yield the interrupted call that this one continues, or None."""
        writer, earlier = self._writer, self.interrupted
        if earlier is not None and earlier.fingerprint != self._fingerprint():
            earlier = None
        columns = self._grid.number_of_node_columns
        moment = Moment(writer, RowBackup(writer.changed_arrays, columns)) if earlier is None else earlier.moment
        latest, self.interrupted = self.interrupted, None
        try:
            with self._interruption.deferred():
                if earlier is not None:
                    moment.restore()
                writer.rows = moment.rows
            yield earlier
        except BaseException as failure:
            with self._interruption.deferred():
                moment.restore()
                if earlier is not None:
                    writer.rows = moment.rows
                    writer.close()
                self.interrupted = latest
            if isinstance(failure, KeyboardInterrupt):
                failure.add_note("interrupted within a step: grid and model are as they were before the call")
            raise
        finally:
            writer.rows = None

    @contextmanager
    def between_calls(self):
        """Run a block between two calls that changes nothing; yield the end [s] of an interrupted call, or None.

        In an interrupted call grid, model and border are as they were between its last two steps, for the time of the
        block; the outputs are in the fields in any case.

        Raises
        ------
        InputError
            If a call runs.
        KeyboardInterrupt
            After the block.
        """
        writer = self._writer
        with self._interruption, self._interruption.deferred(), self._outputs.shown_meanwhile():
            earlier = self.interrupted
            if earlier is None or earlier.fingerprint != self._fingerprint():
                yield None
            else:
                earlier.moment.restore()
                writer.rows = earlier.moment.rows
                try:
                    yield earlier.end
                finally:
                    earlier.moment.restore()
                    writer.close()
                    writer.rows = None
        self._interruption.raise_cause(writer.simulation.time, done=self.interrupted is None)

    def break_off(self, end: float) -> None:
        """Close a call that should run until `end` [s], and keep the moment from which a later call can continue it."""
        writer = self._writer
        with self._interruption.deferred():
            moment = Moment(writer, writer.rows.renewed(writer.changed_arrays))
            writer.close()
            self.interrupted = InterruptedCall(moment, end, self._fingerprint())

    def _fingerprint(self) -> tuple:
        """Return a value that differs once statuses, fields of the component or fields that its laws read differ."""
        arrays = fields_in_use(self._grid, self._laws)
        places = {name: array.ctypes.data for name, array in arrays.items()}
        arrays["status"] = self._grid.status_at_node
        return places, {name: blake2b(np.ascontiguousarray(array)).digest() for name, array in arrays.items()}
