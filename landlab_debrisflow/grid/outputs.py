"""The output fields of a component: in its grid, or put aside while another component uses the fields.

Outputs start at 0 (arrival time at -1), whatever stood in the fields, unless the component continues an earlier one.
Outputs of several components on one grid never mix: the fields hold those of the component that was built or called
last, and the others are put aside, as nodes with values other than at the start.
"""

import logging
from contextlib import contextmanager
from weakref import WeakKeyDictionary, ref

import numpy as np

from ..model.map_fields import PEAKS
from .fields import NODE_FIELDS, OUTPUT_PREFIX, NodeField

log = logging.getLogger("landlab_debrisflow")

ERODED, DEPOSIT = (OUTPUT_PREFIX + name for name in ("eroded_depth", "deposit_depth"))

STARTS = {field.name: field.start for field in NODE_FIELDS if field.intent == "out"}
"""Value of every output field where no debris came."""

_holders = WeakKeyDictionary()
"""By grid, a weak reference to the `Outputs` that its fields hold."""


class Outputs:
    """The output fields of one component.

    Parameters
    ----------
    grid : RasterModelGrid
        Gets the fields that it does not have.
    fields : list of NodeField
        Declarations of the fields that the component writes.
    carried_volume : callable
        Returns the volume of debris that the component carries [m3].
    continues : Outputs, optional
        Outputs of an earlier component, from which these go on.
    """

    def __init__(self, grid, fields: list[NodeField], carried_volume, continues=None):
        self._grid, self._fields, self._carried_volume, self._warned = grid, fields, carried_volume, False
        self._aside = {} if continues is None else continues._written()  # None while the fields hold the outputs
        self.show()
        for field in self._fields:
            if field.name not in grid.at_node:
                # pages that are not written take no memory, unlike with grid.add_zeros
                values = np.zeros(grid.number_of_nodes)
                if field.start:
                    values[:] = field.start
                grid.add_field(field.name, values, at="node", units=field.unit)
        if "debris_flow__release_depth" not in grid.at_node:
            grid.add_zeros("debris_flow__release_depth", at="node", units="m")

    def __setstate__(self, state):
        vars(self).update(state)
        if self._aside is None:  # the component was copied with its grid: the fields of the new grid hold its outputs
            _holders[self._grid] = ref(self)

    def show(self) -> None:
        """Put the outputs of this component into the fields of the grid, where another one may have put its own."""
        if self._aside is None:
            return
        holder, at, standing = _holders.get(self._grid, lambda: None)(), self._grid.at_node, _not_at_start(self._grid)
        if holder is not None:
            holder._aside = standing
            self._warn_of(holder)
        for name, (nodes, _) in standing.items():
            at[name][nodes] = STARTS[name]
        for name, (nodes, values) in self._aside.items():
            at[name][nodes] = values
        self._aside = None
        _holders[self._grid] = ref(self)

    @contextmanager
    def shown(self):
        """Put the outputs into the fields of the grid; if the block raises, restore the fields."""
        before = _holders.get(self._grid, lambda: None)()
        self.show()
        try:
            yield
        except BaseException:
            if before is not None:
                before.show()
            raise

    @contextmanager
    def shown_meanwhile(self):
        """Put the outputs into the fields of the grid for the time of the block."""
        before = _holders.get(self._grid, lambda: None)()
        self.show()
        try:
            yield
        finally:
            if before is not None:
                before.show()

    def maps(self, accounts) -> dict:
        """Return the values of maps by name over nodes: elevation, soil and release of now, and the outputs.

        Depths eroded and deposited come from `accounts`, because other components may have changed the fields.
        """
        at, count = self._grid.at_node, self._grid.number_of_nodes
        shown = {name: at[name] for name in ("topographic__elevation", "soil__depth", "debris_flow__release_depth")
                 if name in self._grid.at_node}  # fmt: skip
        for field in self._fields:
            shown[field.name] = at[field.name] if self._aside is None else np.full(count, field.start)
        for name, (nodes, values) in (self._aside or {}).items():
            if name in shown:
                shown[name][nodes] = values
        return shown | accounts

    def restart_peaks(self) -> None:
        """Put the fields of peaks back to 0 and that of the arrival time to -1 [s], in place."""
        self.show()
        for field in self._fields:
            if field.name.removeprefix(OUTPUT_PREFIX) in PEAKS:
                self._grid.at_node[field.name][:] = field.start

    def _written(self):
        return _not_at_start(self._grid) if self._aside is None else self._aside

    def _warn_of(self, other) -> None:
        """Warn once of debris that another component carries: no field of elevation holds this debris."""
        if (volume := other._carried_volume()) and not self._warned:
            self._warned = True
            log.warning(
                "another DebrisFlow on this grid carries %.4g m3 that have not settled: the flow of this one runs "
                "through them, and elevation lacks them; settle() before, or put elevation and soil back",
                volume,
            )


def _not_at_start(grid) -> dict:
    """Return nodes and values, by name, where the output fields of a grid are not at their start."""
    written = {}
    for name, start in STARTS.items():
        if name in grid.at_node:
            nodes = np.flatnonzero(grid.at_node[name] != start)
            written[name] = nodes, grid.at_node[name][nodes]
    return written
