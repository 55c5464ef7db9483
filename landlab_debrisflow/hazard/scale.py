"""Scales of hazard classes, declared as tables with their source."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ..core.errors import ParameterError
from .counting import Event, Values
from .questions import DEPTH


class HazardClass(NamedTuple):
    """Class of intensity.

    Attributes
    ----------
    name : str
    exceeded : tuple of dict of str to float
        Alternatives: a node has the class if all thresholds of one of these are exceeded, by map in its unit.
    """

    name: str
    exceeded: tuple[dict[str, float], ...]


class HazardScale(NamedTuple):
    """Scale of hazard classes.

    Depth and speed are the peaks of a member at a node, which need not come at the same time: the class is never below
    that of the moment.

    Attributes
    ----------
    name : str
    classes : tuple of HazardClass
        From the least to the most severe one; a node has the most severe class that holds.
    source : str
        Document that declares the classes.

    Examples
    --------
    >>> scale = HazardScale("depth alone", (HazardClass("deep", ({"max_depth": 1.0},)),), "an example")
    >>> scale.class_of({"max_depth": np.array([0.0, 0.5, 2.0])}).tolist()
    [0, 0, 1]
    """

    name: str
    classes: tuple[HazardClass, ...]
    source: str

    @property
    def maps(self) -> tuple[str, ...]:
        """Names of the maps that the classes look at, in the order in which they occur."""
        return tuple(dict.fromkeys(name for one in self.classes for rule in one.exceeded for name in rule))

    def class_of(self, values: Values) -> np.ndarray:
        """Return the class of every node: 0 for none, 1 for the least severe one and so on.

        Parameters
        ----------
        values : mapping of str to ndarray
            Maps by name, of one shape.

        Returns
        -------
        ndarray of int
        """
        found = np.zeros(next(iter(values.values())).shape, np.uint8)
        for k, one in enumerate(self.classes, 1):
            found[_holds(one, values)] = k
        return found


def check_scale(scale: HazardScale, kept: Sequence[str]) -> None:
    """Refuse a scale without classes, or one that needs a map that is not kept.

    Parameters
    ----------
    scale : HazardScale
    kept : sequence of str
        Names of the maps that the members have kept.

    Raises
    ------
    ParameterError
    """
    if not isinstance(scale, HazardScale) or not scale.classes:
        raise ParameterError(f"hazard: scale must be a HazardScale with a class or more, got {scale!r:.60}")
    if missing := [name for name in scale.maps if name not in kept]:
        raise ParameterError(
            f"hazard: {scale.name} needs the map {missing[0]!r}, which the members have not kept; run the ensemble "
            f"with it; kept are {', '.join(kept)}"
        )


def class_events(scale: HazardScale) -> list[Event]:
    """Return the events that a node has a class or a more severe one, for each class.

    Parameters
    ----------
    scale : HazardScale

    Returns
    -------
    list of Event
    """

    def event(k: int) -> Event:
        return Event(scale.classes[k].name, lambda values: scale.class_of(values) > k)

    return [event(k) for k in range(len(scale.classes))]


def _holds(one: HazardClass, values: Values) -> np.ndarray:
    return np.any(
        [np.all([values[name] > bound for name, bound in rule.items()], axis=0) for rule in one.exceeded], axis=0
    )


SWISS = HazardScale(
    "Swiss intensities of debris flows",
    (HazardClass("medium", ({DEPTH: 0.0},)), HazardClass("strong", ({DEPTH: 1.0, "max_speed": 1.0},))),
    "PLANAT (2005). Vademecum: hazard maps and related instruments, quoted in the manual of FLO-2D MapCrafter: high "
    "above 1 m and 1 m/s, moderate below 1 m or 1 m/s; Canton Valais, Hydrologische Gefahrenkarten "
    "(https://vs.ch/de/web/sdana/hydrologie): intensities of debris flows begin at medium",
)
"""Intensities of debris flows in Switzerland: strong above 1 m and 1 m/s; any other debris flow is medium, a weak one
does not exist. Both sources quote the federal recommendations of BWW, BRP and BUWAL (1997), which were not seen."""

SCALES = {"swiss": SWISS}
"""Scales by their names in scene files."""
