"""The setup of a checkpoint, with the laws that a file cannot hold given again, and checked."""

import dataclasses
import json
from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr

from ..core.errors import ParameterError
from ..core.hints import did_you_mean
from ..physics.registry import LAWS, law_name
from .digest import digest, state_of
from .setup import Setup, written_mapping


def law_digests(setup: Setup) -> dict[str, str]:
    """Return digests, by kind, of laws that cannot be built from plain values."""
    laws = {kind: getattr(setup, kind) for kind in LAWS}
    return {kind: _digest(kind, law) for kind, law in laws.items() if law_name(kind, law) not in LAWS[kind]}


def agreed_setup(dataset: xr.Dataset, given: Mapping[str, Any]) -> Setup:
    """Return the setup of a Dataset; laws that no file can hold are given again.

    Parameters
    ----------
    dataset : xarray.Dataset
        With the attributes of `Setup.to_attributes`, and `law_digests` as JSON.
    given : mapping
        Keywords of `DebrisFlow`: laws, material, numerics, inflow. They must be those of the Dataset.

    Returns
    -------
    Setup

    Raises
    ------
    ParameterError
        If a given value differs, or a law is missing that cannot be built from plain values.
    """
    legal = [field.name for field in dataclasses.fields(Setup)]
    for name in given:
        if name not in legal:
            hint = did_you_mean(name, legal)
            raise ParameterError(f"load: unknown keyword {name!r}{hint}; allowed: grid, observers, {', '.join(legal)}")
    written, digests = written_mapping(dataset), json.loads(dataset.attrs["law_digests"])
    if foreign := digests.keys() - LAWS.keys():
        raise ParameterError(f"load: the checkpoint has a law of the kind {min(foreign)!r}, of which there is none")
    for kind in digests:
        if kind not in given:
            raise ParameterError(
                f"load: the {kind} law of the checkpoint is a {written[kind].get('law')}, which no file can hold; give "
                f"the same law again: {kind}=..."
            )
    setup = Setup.from_mapping(written | dict(given))
    now = setup.to_mapping()
    for name in given:
        law = getattr(setup, name)
        if (different := _difference(written.get(name), now[name])) or (
            name in digests and _digest(name, law) != digests[name]
        ):
            words = different or "it prints as the same text, but has other contents"
            raise ParameterError(
                f"load: {name} is not that of the checkpoint: {words}; give the value of the checkpoint, or leave "
                "out laws that a file can hold"
            )
    return setup


def _digest(kind, law) -> str:
    return digest([law_name(kind, law), state_of(law)])


def _difference(written, now) -> str:
    """Return the difference of a value of a setup in a file and a given one as text; "" if there is none."""
    if isinstance(written, Mapping) and isinstance(now, Mapping):
        found = (f"{key}: {words}" for key in written if (words := _difference(written[key], now.get(key))))
        return next(found, "")
    if isinstance(written, list) and isinstance(now, list) and len(written) == len(now) and _has_mappings(written):
        return next(filter(None, map(_difference, written, now)), "")
    return "" if np.array_equal(written, now) else f"{_short(written)} there, {_short(now)} given"


def _has_mappings(values) -> bool:
    return any(isinstance(value, Mapping) for value in values)


def _short(value) -> str:
    text = repr(value)
    return text if len(text) <= 60 else f"{text[:57]}..."
