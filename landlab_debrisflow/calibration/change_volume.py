"""Observed volumes of a difference of surveys."""

import dataclasses
from typing import ClassVar

import numpy as np

from ..core.errors import InputError
from ..core.hints import did_you_mean
from .bound import Bound, check_error, plain_error, stated_error
from .model_error import ModelError
from .observed_maps import ElevationChange, change_of
from .place import Place

PARTS = {"lowered": -1.0, "raised": 1.0}
"""Sign of the change by the part of the ground that is summed."""


@dataclasses.dataclass(frozen=True, eq=False)
class ChangeVolume:
    """Volume by which a difference of surveys was lowered, or raised, beyond its threshold [m3].

    Where maps are compared cell by cell, a flow that lies one cell beside its place is punished twice: where it is and
    where it should be. Such a comparison prefers a flow that erodes and deposits too little (the double penalty of
    weather forecasts, Mass et al. 2002, Ebert 2008). A volume does not depend on the place.

    Parameters
    ----------
    change : ElevationChange
        The survey; its mask, threshold and treatment of the source count here, too.
    part : {"lowered", "raised"}
    sd : float, optional
        Standard deviation of the error of the volume [m3]: that of the survey's systematic and correlated part; None:
        not stated.
    model_error : float or ModelError, optional
        Scale of the error of the model [m3].
    """

    change: ElevationChange
    part: str
    sd: float | None = None
    model_error: ModelError | float | None = None
    maps: ClassVar[tuple[str, ...]] = ElevationChange.maps

    def __post_init__(self):
        if not isinstance(self.change, ElevationChange):
            raise InputError(f"calibration: volume of a change: give an ElevationChange, got {self.change!r:.60}")
        if self.part not in PARTS:
            raise InputError(
                f"calibration: volume of a change: part must be lowered or raised, got {self.part!r}"
                f"{did_you_mean(str(self.part), PARTS)}"
            )
        check_error(f"volume {self.part}", self.sd, self.model_error, "m3")

    def at(self, place: Place) -> Bound:
        """Return the observation at the nodes of an event."""
        known, compared = self.change.compared(place)
        observed = self._volume(known, compared, place)

        def misfit(one):
            return self._volume(change_of(one, place, self.change.source), compared, place) - observed

        stated = stated_error(self.sd, 1.0, observed, self.model_error)
        label = f"volume {self.part}" if self.change.source else f"volume {self.part} outside of the release"
        content = (self.part, self.change.threshold, known, compared, *plain_error(stated))
        return Bound(label, "m3", misfit, stated, content)

    def _volume(self, change: np.ndarray, compared: np.ndarray, place: Place) -> float:
        part = PARTS[self.part] * change
        return float(np.sum(part[compared & (part > self.change.threshold)])) * place.lattice.area
