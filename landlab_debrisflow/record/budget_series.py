"""Volume budget of a flow against time."""

from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr

from .attributes import date_created, file_attributes, variable_attributes
from .observers import check_interval


class BudgetSeries:
    """Observer that keeps the terms of `DebrisFlow.budget` at intervals and at rest.

    Parameters
    ----------
    interval : float
        Event time between two rows of terms [s].

    Raises
    ------
    InputError
        If the interval is not > 0.
    """

    def __init__(self, interval: float) -> None:
        self.interval = check_interval(interval, type(self).__name__)
        self._times: list[float] = []
        self._terms: dict[str, list[float]] = {}

    def observe(self, flow: Any) -> None:
        """Keep the terms of now.

        Parameters
        ----------
        flow : DebrisFlow
            The component after a step.
        """
        while self._times and self._times[-1] >= flow.elapsed_time:  # rows of a call that was undone
            for values in (self._times, *self._terms.values()):
                values.pop()
        self._times.append(flow.elapsed_time)
        for name, volume in flow.budget.items():
            self._terms.setdefault(name, []).append(volume)

    def state(self) -> dict[str, np.ndarray]:
        """Return times [s] and terms [m3] by name, each of shape (times,), for a checkpoint."""
        return {"times": np.array(self._times)} | {name: np.array(values) for name, values in self._terms.items()}

    def restore(self, state: Mapping[str, Any]) -> None:
        """Go on after the times of a checkpoint, as `state` returned them."""
        values = {name: [float(value) for value in np.ravel(one)] for name, one in state.items()}
        self._times, self._terms = values.pop("times"), values

    @property
    def dataset(self) -> xr.Dataset:
        """Terms so far over ``time`` [s]."""
        data = {
            name: ("time", np.array(values), variable_attributes("m3", name.replace("_", " ")))
            for name, values in self._terms.items()
        }
        time = ("time", np.array(self._times, float), variable_attributes("s", "elapsed time"))
        return xr.Dataset(data, {"time": time}, file_attributes() | date_created())
