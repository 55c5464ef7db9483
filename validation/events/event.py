"""Declaration of an event: set-up, measures, targets and figure of a measured flow."""

import math
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import xarray as xr

from .data import absence
from .sets import ParameterSet, read_set

FOLDER = Path(__file__).parent


class Measure(NamedTuple):
    """A number by which a run is compared with the observation: words with the unit, format, place in tables.

    Parameters
    ----------
    words : str
        Name and unit.
    form : str
        Format of its values.
    tabulated : bool
        Whether it stands in the table of the page; all are recorded.
    """

    words: str
    form: str = "{:.2f}"
    tabulated: bool = True

    def text(self, value: float) -> str:
        """Return a value as tables show it; NaN is empty, and a zero has no sign minus.

        Examples
        --------
        >>> Measure("volume", "{:.0f}").text(-0.2), Measure("correlation", "{:+.2f}").text(0.5)
        ('0', '+0.50')
        """
        return "" if math.isnan(value) else re.sub(r"^-(?=[0.]+%?$)", "", self.form.format(value))


class Target(NamedTuple):
    """Bounds within which a measure should lie.

    Parameters
    ----------
    measure : str
        Its name.
    words : str
        The target as the page says it.
    low, high : float
        Bounds, which belong to it.
    events : tuple of str
        Events over whose scores with the same set the mean is taken; by default the event alone.
    """

    measure: str
    words: str
    low: float = -math.inf
    high: float = math.inf
    events: tuple[str, ...] = ()

    def met(self, value: float) -> bool:
        """Return whether a value lies within the bounds."""
        return self.low <= value <= self.high


@dataclass(frozen=True)
class Event:
    """A measured event.

    Attributes
    ----------
    name : str
        Name of its folder here, and of its figure, ``event_NAME.png``.
    title : str
        Name in tables.
    default_set : str
        Name of the set whose result is shown.
    particle_count : int
        Number of particles of a scored run.
    measures : mapping of str to Measure
    targets : tuple of Target
    run : callable
        Given a `ParameterSet` and a number of particles, returns a Dataset: the maps and series that the figure and
        the scores need, observed and modelled.
    score : callable
        Given that Dataset, returns the measures by name.
    references : callable
        Given that Dataset, returns measures of other things than runs, by their words: the observation itself, a model
        without physics, a perfect model seen through the noise of the measurement. They are recorded with the scores.
    shown : callable
        Given that Dataset, returns the variables that the figure needs, to be committed as result.nc: small, and of
        measured data no more than its licence allows.
    draw : callable
        Given the variables that are stored, returns the figure.
    steps : mapping of str to float
        Steps to which variables are rounded when they are stored, as integers of 16 bits.
    shared_sets : str
        Name of the event in whose folder the sets are; by default the event's own.
    drawn_with : str
        File of the measured data that the figure needs beside result.nc, because its licence keeps it out of there.
    """

    name: str
    title: str
    default_set: str
    particle_count: int
    measures: Mapping[str, Measure]
    targets: tuple[Target, ...]
    run: Callable[[ParameterSet, int], xr.Dataset]
    score: Callable[[xr.Dataset], dict[str, float]]
    references: Callable[[xr.Dataset], dict[str, dict[str, float]]]
    shown: Callable[[xr.Dataset], xr.Dataset]
    draw: Callable[[xr.Dataset], Any]
    steps: Mapping[str, float]
    shared_sets: str = ""
    drawn_with: str = ""

    @property
    def folder(self) -> Path:
        """Return the folder of the event."""
        return FOLDER / self.name

    def absence(self) -> str:
        """Return why the figure cannot be drawn, or an empty text if it can."""
        return absence(self.name, self.drawn_with) if self.drawn_with else ""

    def read_set(self, name: str = "") -> ParameterSet:
        """Return a set of parameters, by default the one that is shown; InputError if there is none."""
        return read_set(FOLDER / (self.shared_sets or self.name) / "sets", name or self.default_set)
