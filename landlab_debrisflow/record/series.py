"""Observer that measures the flow at given times, by interpolation between steps."""

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from ..core.errors import InputError
from ..model.schedule import EVERY_STEP


class Series:
    """Measures of the flow at given times, each interpolated linearly between the two steps around.

    Parameters
    ----------
    times : array_like, shape (n,)
        Times of the measures, increasing [s of `flow.elapsed_time`].
    measure : callable
        Called with the flow before the first step of a call and after every step. Returns a mapping of names to
        numbers or arrays, the same names and shapes every time.

    Raises
    ------
    InputError
        If the times do not increase or `measure` cannot be called.

    Examples
    --------
    >>> import numpy as np
    >>> series = Series(np.arange(0.0, 61.0), lambda flow: {"eroded": flow.budget["eroded"]})
    >>> series.dataset.sizes["time"]  # nothing was observed yet
    0
    """

    interval = EVERY_STEP

    def __init__(self, times: ArrayLike, measure: Callable[[Any], Mapping[str, ArrayLike]]) -> None:
        self._wanted = np.array(times, float, ndmin=1)
        if self._wanted.ndim != 1 or not np.all(np.isfinite(self._wanted)) or np.any(np.diff(self._wanted) <= 0.0):
            raise InputError(f"Series: times must be finite numbers of seconds that increase, got {times!r}")
        if not callable(measure):
            raise InputError(f"Series: measure must be callable with the flow, got {measure!r}")
        self._measure = measure
        self._before: tuple[float, dict[str, np.ndarray]] | None = None
        self._times: list[float] = []
        self._values: list[dict[str, np.ndarray]] = []

    def observe(self, flow: Any) -> None:
        """Measure, and interpolate to the wanted times between the last step and now.

        Parameters
        ----------
        flow : DebrisFlow
            The component after a step.
        """
        measured = self._measure(flow)
        if not isinstance(measured, Mapping):
            raise InputError(
                "Series: measure must return a mapping of names to numbers, such as {'eroded': flow.budget['eroded']}, "
                f"got {measured!r:.80}"
            )
        now, values = flow.elapsed_time, {k: np.asarray(v, float) for k, v in measured.items()}
        then, earlier = self._before or (now, values)
        if {k: v.shape for k, v in values.items()} != {k: v.shape for k, v in earlier.items()}:
            raise InputError(
                f"Series: measure must return the same names and shapes every time, got {_shapes(values)} "
                f"after {_shapes(earlier)}"
            )
        since = self._wanted >= then if self._before is None else self._wanted > then
        for time in self._wanted[since & (self._wanted <= now)]:
            part = (time - then) / (now - then) if now > then else 1.0
            self._times.append(float(time))
            self._values.append({k: (1.0 - part) * earlier[k] + part * v for k, v in values.items()})
        self._before = now, values

    def state(self) -> dict[str, Any]:
        """Return times [s] and measures so far and of the last step by name, for a checkpoint."""
        time, before = self._before or (np.nan, {})
        values = {name: np.stack([one[name] for one in self._values]) for name in before if self._values}
        memory = {"times": np.array(self._times), "time_before": time}
        memory |= {f"before {name}": value for name, value in before.items()}
        return memory | {f"values {name}": value for name, value in values.items()}

    def restore(self, state: Mapping[str, Any]) -> None:
        """Go on after the measures of a checkpoint.

        Parameters
        ----------
        state : mapping
            As `state` returned it.
        """
        before, values = ({
            key.removeprefix(word): np.asarray(value) for key, value in state.items() if key.startswith(word)
        } for word in ("before ", "values "))  # fmt: skip
        time = float(state["time_before"])
        self._before = None if np.isnan(time) else (time, before)
        self._times = np.ravel(state["times"]).tolist()
        self._values = [{name: value[k] for name, value in values.items()} for k in range(len(self._times))]

    @property
    def dataset(self) -> xr.Dataset:
        """The measures at the wanted times that have passed, over ``time`` [s]."""
        first = self._values[0] if self._values else {}
        data = {
            name: (("time", *(f"{name}_{k}" for k in range(value.ndim))), np.stack([v[name] for v in self._values]))
            for name, value in first.items()
        }
        time = ("time", self._times, {"units": "s", "long_name": "elapsed time"})
        return xr.Dataset(data, {"time": time}, {"interpolation": "linear in time between the two steps around"})


def _shapes(values) -> str:
    return ", ".join(f"{name} {value.shape}" for name, value in values.items()) or "nothing"
