"""Observation at the nodes of an event: its misfit with a member, and its stated error."""

from collections.abc import Callable
from typing import Any, NamedTuple, Protocol

from ..core.checks import in_range
from ..core.errors import InputError
from ..ensemble.result import MemberResult
from .model_error import ModelError, Stated
from .place import Place


class Bound(NamedTuple):
    """Observation at the nodes of an event.

    Attributes
    ----------
    label : str
        Name for tables and messages.
    unit : str
    misfit : callable
        Simulated less observed of a `MemberResult`, in the unit; of a map the root mean square.
    stated : Stated or None
        Error; None: no error is stated.
    content : tuple
        All that the observation is made of, for a digest.
    """

    label: str
    unit: str
    misfit: Callable[[MemberResult], float]
    stated: Stated | None
    content: tuple[Any, ...]


class Observation(Protocol):
    """Observation of an event, of which every member has a misfit."""

    sd: float | None
    maps: tuple[str, ...]

    def at(self, place: Place) -> Bound:
        """Return the observation at the nodes of an event."""
        ...


def stated_error(sd: float | None, count: float, size: float, model_error: ModelError | float | None) -> Stated | None:
    """Return the error of an observation; a number as model error is the scale of an error of its own."""
    if sd is None:
        return None
    known = model_error if model_error is None or isinstance(model_error, ModelError) else ModelError(model_error)
    return Stated(sd, count, size, known)


def check_error(label: str, sd: float | None, model_error: ModelError | float | None, unit: str = "-") -> None:
    """Refuse an error of an observation that is not > 0, or a model error without error of the observation."""
    if sd is not None:
        in_range(f"calibration: {label}: sd", sd, 0.0, unit=unit, open_ends=(True, False), error=InputError)
    elif model_error is not None:
        raise InputError(f"calibration: {label}: a model error needs the error sd of the observation, too; state it")


def plain_error(stated: Stated | None) -> tuple[Any, ...]:
    """Return an error as plain values, for a digest."""
    if stated is None:
        return (None,)
    error = stated.model_error
    return (*stated[:3], None if error is None else (error.scale, error.relative))
