"""Observations of an event that are one number: measures, volumes, run-out, values at points."""

import dataclasses
from collections.abc import Callable, Mapping
from typing import Any, ClassVar

import numpy as np

from ..core.checks import in_range
from ..core.errors import InputError
from ..core.hints import did_you_mean
from ..ensemble.result import ARRIVAL, MemberResult
from ..geo.cover import covered_fraction
from .bound import Bound, check_error, plain_error, stated_error
from .model_error import ModelError
from .place import Place, check_map, unit_of
from .shapes import polygon_of


@dataclasses.dataclass(frozen=True)
class Measure:
    """Observed measure of the whole event, any of `landlab_debrisflow.measures`.

    Parameters
    ----------
    name : str
        Such as ``run_out``, ``eroded_volume``, ``deposit_volume``, ``budget_outflow``, ``travel_angle``.
    value : float
        Observed value, in the unit of the measure.
    sd : float, optional
        Standard deviation of its error, in its unit; None: not stated, and all observations are then compared by a
        distance.
    model_error : float or ModelError, optional
        Scale of the error of the model, in the unit; by default the model is taken to be right.
    """

    name: str
    value: float
    sd: float | None = None
    model_error: ModelError | float | None = None
    maps: ClassVar[tuple[str, ...]] = ()

    def __post_init__(self):
        in_range(f"calibration: {self.name}: value", self.value, error=InputError)
        check_error(self.name, self.sd, self.model_error)

    def at(self, place: Place) -> Bound:
        """Return the observation at the nodes of an event."""
        return _scalar(self, self.name, "-", lambda one: measure_of(one.measures, self.name), (self.name,))


@dataclasses.dataclass(frozen=True)
class RunOut:
    """Observed farthest point, as distance in plan from the centre of the release [m].

    The simulated distance is the measure ``run_out``, behind which 99 % of the volume lies.

    Parameters
    ----------
    x, y : float
        Point on the map [m].
    sd : float, optional
        Standard deviation of the distance [m]; None: not stated.
    model_error : float or ModelError, optional
        As of `Measure` [m].
    """

    x: float
    y: float
    sd: float | None = None
    model_error: ModelError | float | None = None
    maps: ClassVar[tuple[str, ...]] = ()

    def __post_init__(self):
        check_error("run-out", self.sd, self.model_error, "m")

    def at(self, place: Place) -> Bound:
        """Return the observation at the nodes of an event."""
        label = f"run-out to ({self.x:.10g}, {self.y:.10g})"
        place.node_at(label, self.x, self.y)
        distance = float(np.hypot(self.x - place.centre[0], self.y - place.centre[1]))
        if not np.isfinite(distance):
            raise InputError(
                "calibration: run-out is counted from a release at time 0; the scene has none, use Measure"
            )
        named = Measure("run_out", distance, self.sd, self.model_error)
        return _scalar(named, label, "m", lambda one: measure_of(one.measures, "run_out"), ("run_out",))


@dataclasses.dataclass(frozen=True)
class Volume:
    """Observed volume of a map, over all nodes or inside a polygon [m3].

    Parameters
    ----------
    map_name : str
        Map of a depth, such as ``eroded_depth`` or ``deposit_depth``.
    value : float
        Observed volume [m3].
    sd : float, optional
        Standard deviation of its error [m3]; None: not stated.
    inside : polygon, file or coordinates, optional
        Polygon to which the volume is limited.
    model_error : float or ModelError, optional
        As of `Measure` [m3].
    """

    map_name: str
    value: float
    sd: float | None = None
    inside: Any = None
    model_error: ModelError | float | None = None

    def __post_init__(self):
        check_map("volume", self.map_name)
        in_range(f"calibration: volume of {self.map_name}", self.value, unit="m3", error=InputError)
        check_error(f"volume of {self.map_name}", self.sd, self.model_error, "m3")

    @property
    def maps(self) -> tuple[str, ...]:
        """Names of the maps that are needed."""
        return (self.map_name,)

    def at(self, place: Place) -> Bound:
        """Return the observation at the nodes of an event."""
        area, label = np.full(place.lattice.shape, place.lattice.area), f"volume of {self.map_name}"
        if self.inside is not None:
            label += " inside a polygon"
            area *= covered_fraction(polygon_of(self.inside, label, place), place.lattice)

        def simulated(one):
            return float(np.sum(one.maps[self.map_name] * area[one.rows, one.columns]))

        return _scalar(self, label, "m3", simulated, (self.map_name, area))


@dataclasses.dataclass(frozen=True)
class AtPoint:
    """Observed value of a map in the cell at a point, such as the peak depth or pressure at a gauge.

    Parameters
    ----------
    map_name : str
        Such as ``max_depth``, ``max_speed``, ``max_impact_pressure``, ``max_basal_pressure_ratio``, ``deposit_depth``.
    x, y : float
        Point on the map [m].
    value : float
        Observed value, in the unit of the map.
    sd : float, optional
        Standard deviation of its error, in the unit of the map; None: not stated.
    model_error : float or ModelError, optional
        As of `Measure`.
    """

    map_name: str
    x: float
    y: float
    value: float
    sd: float | None = None
    model_error: ModelError | float | None = None

    def __post_init__(self):
        check_map("point", self.map_name)
        in_range(f"calibration: {self.map_name} at a point", self.value, error=InputError)
        check_error(f"{self.map_name} at a point", self.sd, self.model_error)

    @property
    def maps(self) -> tuple[str, ...]:
        """Names of the maps that are needed."""
        return (self.map_name,)

    def at(self, place: Place) -> Bound:
        """Return the observation at the nodes of an event."""
        label = f"{self.map_name} at ({self.x:.10g}, {self.y:.10g})"
        row, column = place.node_at(label, self.x, self.y)
        nothing = np.inf if self.map_name == ARRIVAL else 0.0  # a time that no run has is infinitely far

        def simulated(one):
            if not (one.rows.start <= row < one.rows.stop and one.columns.start <= column < one.columns.stop):
                return nothing
            value = float(one.maps[self.map_name][row - one.rows.start, column - one.columns.start])
            return nothing if np.isnan(value) else value

        return _scalar(self, label, unit_of(self.map_name), simulated, (self.map_name, row, column))


@dataclasses.dataclass(frozen=True)
class ArrivalTime:
    """Observed time at which the flow came to a point; a run that never came there has the likelihood 0.

    Parameters
    ----------
    x, y : float
        Point on the map [m].
    value : float
        Time since the start of the event [s].
    sd : float, optional
        Standard deviation of its error [s]; None: not stated.
    model_error : float or ModelError, optional
        As of `Measure` [s].
    """

    x: float
    y: float
    value: float
    sd: float | None = None
    model_error: ModelError | float | None = None
    maps: ClassVar[tuple[str, ...]] = (ARRIVAL,)

    def __post_init__(self):
        self._point()

    def at(self, place: Place) -> Bound:
        """Return the observation at the nodes of an event."""
        return self._point().at(place)

    def _point(self) -> AtPoint:
        return AtPoint(ARRIVAL, self.x, self.y, self.value, self.sd, self.model_error)


def measure_of(measures: Mapping[str, float], name: str) -> float:
    """Return a measure of a run by its name.

    Parameters
    ----------
    measures : mapping of str to float
    name : str

    Raises
    ------
    InputError
        If runs have no measure of this name.
    """
    if name not in measures:
        raise InputError(
            f"calibration: no measure {name!r}{did_you_mean(name, measures)}; there are {', '.join(measures)}"
        )
    return float(measures[name])


def _scalar(given: Any, label: str, unit: str, simulated: Callable[[MemberResult], float], content: tuple) -> Bound:
    stated = stated_error(given.sd, 1.0, abs(given.value), given.model_error)
    return Bound(
        label, unit, lambda one: simulated(one) - given.value, stated, (*content, given.value, *plain_error(stated))
    )
