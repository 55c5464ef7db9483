"""Checkpoints of a flow: saved to a file, and loaded to go on to the bit."""

import json
import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any, Self

import numpy as np
import xarray as xr
from landlab import RasterModelGrid

from .core.errors import InputError, ParameterError
from .grid import checkpoint_grid, checks
from .grid.checkpoint_frame import check_frame
from .record.attributes import date_created, file_attributes
from .record.checkpoint_file import read_checkpoint, write_checkpoint
from .record.files import check_writable
from .record.memories import read_memories, write_memories
from .scene.agreement import agreed_setup, law_digests
from .scene.setup import Setup


class Restart:
    """Saving and loading of a component."""

    _call: Any
    _setup: Setup
    _observers: tuple[Any, ...]
    _plan_attributes: Any
    grid: RasterModelGrid

    @property
    def unfinished_until(self) -> float | None:
        """Elapsed time at which an unfinished call, interrupted or loaded, was to end [s]; None without one.

        ``flow.run_one_step(flow.unfinished_until - flow.elapsed_time)`` finishes it.
        """
        return self._call.unfinished_until

    def save(self, path: str | os.PathLike[str]) -> Path:
        """Save the whole state of the flow, so that `load` continues it to the bit.

        Between calls, and after a call that was interrupted, the file is there on return. If an observer calls, or
        another thread during a call, it is written as soon as the step is made and all observers have seen it; if it
        cannot be written then, the call ends after that step, as if an observer had failed.

        Parameters
        ----------
        path : str or os.PathLike
            NetCDF file. A checkpoint of that name is kept, ``event.nc`` as ``event.previous.nc``; at no moment is there
            half a file.

        Returns
        -------
        pathlib.Path
            Where it is, or will be.

        Raises
        ------
        InputError
            If it cannot be written (an `OutputError`); the checkpoint before stays.

        Notes
        -----
        The file holds arrays of numbers and no code: fields, statuses and place of the grid, particles, columns,
        accounts, the setup, and the memory of observers that have methods ``state()`` and ``restore(mapping)``.
        """
        path = check_writable(path)
        self._call.save(lambda dataset: write_checkpoint(path, self._completed(dataset)))
        return path

    @classmethod
    def load(
        cls, path: str | os.PathLike[str], grid: RasterModelGrid | None = None, *, observers: Any = (), **setup: Any
    ) -> Self:
        """Return the flow that `save` wrote.

        Parameters
        ----------
        path : str or os.PathLike
            The file.
        grid : RasterModelGrid, optional
            Grid of the same shape, place and statuses: its fields get the values of the file. By default a new grid.
        observers : observer or sequence of them, optional
            Observers of the same classes, in the same order, as the flow had when it was saved; the observers go on,
            too.
        **setup
            Keywords of `DebrisFlow`. Needed only for laws that are not declared or have no name in `LAWS`, because no
            file can hold these. Any other keyword must have the value that the flow was saved with.

        Returns
        -------
        DebrisFlow

        Raises
        ------
        InputError, ParameterError
            If the file is missing, damaged or something else, or if grid, observers or laws are not those of the flow;
            the grid is as it was then.
        """
        dataset = read_checkpoint(path)
        return cls._from_dataset(dataset, grid, checks.check_observers(observers), setup)

    @classmethod
    def _from_dataset(cls, dataset: xr.Dataset, grid: Any, observers: Sequence[Any], given: dict[str, Any]) -> Self:
        check_frame(dataset)
        setup = agreed_setup(dataset, given)
        if grid is None:
            shape = dataset.sizes["y"], dataset.sizes["x"]
            spacing, corner = dataset.attrs["spacing"], dataset.attrs["lower_left"]
            grid = RasterModelGrid(shape, xy_spacing=tuple(spacing), xy_of_lower_left=tuple(corner))
            grid.status_at_node = dataset["node_status"].values.reshape(-1)
        elif not isinstance(grid, RasterModelGrid):
            raise InputError(f"load: a RasterModelGrid is needed, got {type(grid).__name__}")
        checkpoint_grid.check_same(grid, dataset)
        memories = read_memories(dataset, observers)
        make: Any = cls
        with checkpoint_grid.fields_of(grid, dataset) as put_fields:
            flow = make(grid, **vars(setup), observers=observers)
            put_fields()
            _load(flow, dataset)
            flow._restore_plan(dataset.attrs)
            for observer, memory in zip(observers, memories, strict=True):
                if memory is not None:
                    _restore(observer, memory)
        return flow

    def _completed(self, dataset: xr.Dataset) -> xr.Dataset:
        """Return the Dataset of a flow with the setup and the memory of the observers."""
        shape = self.grid.shape
        for name, array in self._setup.node_arrays().items():
            dataset[name] = ("y", "x"), np.reshape(array.values, shape), {"units": array.unit}
        attributes = {"law_digests": json.dumps(law_digests(self._setup))} | self._setup.to_attributes()
        attributes |= self._plan_attributes()
        dataset.attrs |= file_attributes() | date_created() | attributes
        return write_memories(dataset, self._observers)


def _load(flow: Any, dataset: xr.Dataset) -> None:
    """Put a flow into the state of a checkpoint; refuse contents that do not fit each other."""
    try:
        flow._call.load(dataset)
    except (InputError, ParameterError):
        raise
    except (LookupError, TypeError, ValueError, OverflowError) as error:
        raise InputError(f"load: the contents of the checkpoint are not those of a flow: {error}") from error


def _restore(observer: Any, memory: Any) -> None:
    """Give an observer its memory; refuse a memory that the observer cannot restore."""
    try:
        observer.restore(memory)
    except (LookupError, TypeError, ValueError) as error:
        name = type(observer).__name__
        raise InputError(f"load: the memory of {name} in the checkpoint is not one of its own: {error}") from error
