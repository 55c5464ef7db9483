"""Calibration: values of a scene, found from observations of an event."""

from .calibrate import calibrate, calibrate_events
from .change_volume import ChangeVolume
from .event import Event
from .model_error import ModelError
from .observations import ArrivalTime, AtPoint, Measure, RunOut, Volume
from .observed_maps import DepositOutline, ElevationChange
from .posterior import Posterior

__all__ = [
    "ArrivalTime", "AtPoint", "ChangeVolume", "DepositOutline", "ElevationChange", "Event", "Measure", "ModelError",
    "Posterior", "RunOut", "Volume", "calibrate", "calibrate_events",
]  # fmt: skip
