"""Inflow across a line: discharge, velocity and pore pressure against time."""

import itertools

import numpy as np

from ...core.errors import ParameterError
from ...core.parameters import declared, parameter


@declared
class Hydrograph:
    """Inflow across a straight line: discharge, velocity and pressure ratio, linear between given times.

    The discharge is spread evenly over the line, so its thickness is discharge / (velocity x length). Debris that
    enters at one time moves with the velocity prescribed for that time until it has passed a strip of some particle
    spacings behind the line. Beyond the strip it moves by the equations of the flow. Ends of the line, times, discharge
    and velocity are needed.

    Examples
    --------
    >>> surge = Hydrograph(
    ...     line_start=(10.0, 20.0), line_end=(10.0, 40.0), times=[0.0, 60.0, 300.0], discharge=[0.0, 50.0, 0.0],
    ...     velocity=5.0,
    ... )
    >>> surge.volume, surge.largest_thickness
    (7500.0, 0.5)

    >>> from landlab import RasterModelGrid
    >>> from landlab_debrisflow import DebrisFlow
    >>> grid = RasterModelGrid((13, 60), xy_spacing=5.0)
    >>> z = grid.add_field("topographic__elevation", 100.0 - 0.3 * grid.x_of_node, at="node")
    >>> flow = DebrisFlow(grid, inflow=surge, numerics={"particle_count": 750})
    >>> flow.run_one_step(60.0)
    >>> bool(abs(flow.budget["inflow"] - 1500.0) < 50.0)
    True
    """

    line_start: tuple = parameter("m", "one end of the line, map coordinates x and y", None, kind=tuple)
    line_end: tuple = parameter("m", "its other end", None, kind=tuple)
    times: tuple = parameter("s", "elapsed times of the event, increasing", None, (0.0, None), kind=tuple)
    discharge: tuple = parameter("m3 s-1", "at these times, or one for all", None, (0.0, None), kind=tuple)
    velocity: tuple = parameter("m s-1", "along the bed, at these times or one for all", None, (0.0, None), kind=tuple)
    pressure_ratio: tuple = parameter(
        "-", "basal excess pore pressure over its liquefaction value, likewise; not set: that of a release",
        None, (0.0, 1.0), kind=tuple,
    )  # fmt: skip
    direction: float | None = parameter(
        "deg", "of the flow, counterclockwise from east; not set: across the line, downslope", None, (-360.0, 360.0)
    )

    def _agree(self):
        needed = ("line_start", "line_end", "times", "discharge", "velocity")
        if missing := [name for name in needed if getattr(self, name) is None]:
            raise ParameterError(f"Hydrograph: {' and '.join(missing)} missing; needed are {', '.join(needed)}")
        for name in ("line_start", "line_end"):
            if len(getattr(self, name)) != 2:
                raise ParameterError(f"Hydrograph: {name} must be two numbers, x and y [m], got {getattr(self, name)}")
        if self.length == 0.0:
            raise ParameterError(f"Hydrograph: line_start and line_end are the same point {self.line_end}; give a line")
        self._check_series()
        if self.volume == 0.0:
            raise ParameterError(
                "Hydrograph: discharge is 0 m3 s-1 at all times; leave the hydrograph out, or give a discharge > 0"
            )
        if self._obliquity < 0.1:
            raise ParameterError(
                f"Hydrograph: direction {self.direction:g} deg runs along the line, which nothing would cross; "
                f"across the line is {(np.degrees(np.arctan2(*self._along[::-1])) + 90.0) % 360.0:.4g} deg or opposite"
            )

    def _check_series(self):
        times = self.times
        if len(times) < 2:
            raise ParameterError(
                f"Hydrograph: times must be at least two [s], got {times}; give the first and the last"
            )
        for k, (one, other) in enumerate(itertools.pairwise(times), 1):
            if other <= one:
                raise ParameterError(
                    f"Hydrograph: times must increase, got {other:g} s at index {k} after {one:g} s; sort them"
                )
        for name in ("discharge", "velocity", "pressure_ratio"):
            values = getattr(self, name)
            if values is not None and len(values) not in (1, len(times)):
                raise ParameterError(
                    f"Hydrograph: {name} has {len(values)} values for {len(times)} times; give one for each or for all"
                )
        for k, (q, v) in enumerate(zip(*self.series("discharge", "velocity"), strict=True)):
            if q > 0.0 and v == 0.0:
                raise ParameterError(
                    f"Hydrograph: velocity is 0 m s-1 at {times[k]:g} s (index {k}), where the discharge is {q:g} "
                    "m3 s-1: the flow would be infinitely thick; give a velocity > 0"
                )

    def series(self, *names: str) -> list[np.ndarray]:
        """Return parameters that are given against time as arrays with one value for each of the `times`.

        Parameters
        ----------
        *names : {"discharge", "velocity", "pressure_ratio"}
            Parameters; "pressure_ratio" only if it is set.

        Returns
        -------
        list of ndarray, shape (times,)
            One array per name, in their order, in the units of the parameters; one value for all times is repeated.
        """
        return [np.broadcast_to(np.asarray(getattr(self, name)), len(self.times)) for name in names]

    @property
    def _along(self):
        return np.subtract(self.line_end, self.line_start)

    @property
    def _obliquity(self) -> float:
        """Sine of the angle between line and flow [-]."""
        if self.direction is None:
            return 1.0
        towards = np.radians(self.direction)
        return float(abs(self._along @ (np.sin(towards), -np.cos(towards)))) / self.length

    @property
    def length(self) -> float:
        """Length of the line on the map [m]."""
        return float(np.hypot(*self._along))

    @property
    def width(self) -> float:
        """Width of the flow: length of the line seen in the direction of the flow [m]."""
        return self.length * self._obliquity

    @property
    def volume(self) -> float:
        """Volume that flows in altogether [m3]."""
        return Integral(np.array(self.times), *self.series("discharge")).total

    @property
    def largest_thickness(self) -> float:
        """Largest slope-normal thickness of the entering flow, discharge / (velocity x width) [m].

        Between two times the thickness is the quotient of two linear functions, so that its largest value lies at one
        of the times.
        """
        discharge, velocity = self.series("discharge", "velocity")
        flowing = velocity > 0.0
        return float(np.max(discharge[flowing] / velocity[flowing])) / self.width


class Integral:
    """Integral over time of a quantity that is linear between given times and constant before and after.

    Parameters
    ----------
    times, values : ndarray, shape (n,)
        Times [s], increasing, and values then, in any unit.

    Examples
    --------
    >>> volume = Integral(np.array([0.0, 2.0, 4.0]), np.array([0.0, 3.0, 3.0]))
    >>> volume(np.array([1.0, 2.0, 3.0, 5.0])), volume.when(0.75)
    (array([ 0.75,  3.  ,  6.  , 12.  ]), 1.0)
    """

    def __init__(self, times: np.ndarray, values: np.ndarray) -> None:
        self._times, self._values = times, values
        self._slopes = np.append(np.diff(values) / np.diff(times), 0.0)
        steps = 0.5 * (values[1:] + values[:-1]) * np.diff(times)
        self._before = np.concatenate([[0.0], np.cumsum(steps)])

    @property
    def total(self) -> float:
        """The integral over all times given."""
        return float(self._before[-1])

    def __call__(self, time: np.ndarray | float) -> np.ndarray:
        """Return the integral from the first of the times to `time`."""
        k = np.maximum(np.searchsorted(self._times, time, side="right") - 1, 0)
        passed = time - self._times[k]
        return self._before[k] + passed * (self._values[k] + 0.5 * self._slopes[k] * np.maximum(passed, 0.0))

    def when(self, amount: float) -> float:
        """Return the first time at which the integral reaches an amount > 0, at most the total."""
        k = max(int(np.searchsorted(self._before, amount)) - 1, 0)
        rest, value = amount - self._before[k], self._values[k]
        root = np.sqrt(max(0.0, value * value + 2.0 * self._slopes[k] * rest))
        # at most the end of the segment, which rounding passes where the discharge ends small
        return float(min(self._times[k] + 2.0 * rest / (value + root), self._times[k + 1]))
