"""Memory of observers in a checkpoint, from ``state()`` for ``restore(mapping)``."""

import json
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr

from ..core.errors import InputError


def write_memories(dataset: xr.Dataset, observers: Sequence[Any]) -> xr.Dataset:
    """Return a Dataset with the memory of all observers added that have a method ``state()``.

    Parameters
    ----------
    dataset : xarray.Dataset
        Gets variables whose names begin with ``observer_``.
    observers : sequence
        Their ``state()`` returns a mapping of names to arrays, numbers or texts.

    Returns
    -------
    xarray.Dataset

    Raises
    ------
    InputError
        If a value is of another type.
    """
    added, kept = {}, []
    for k, observer in enumerate(observers):
        kept.append(callable(getattr(observer, "state", None)))
        for j, (key, value) in enumerate(observer.state().items() if kept[-1] else ()):
            name, text = f"observer_{k}_{j}", isinstance(value, str)
            values = np.frombuffer(value.encode(), np.uint8) if text else np.asarray(value)
            if values.dtype.kind not in "biuf":
                raise InputError(
                    f"{type(observer).__name__}.state(): {key!r} must be an array of numbers, a number or a text, got "
                    f"{value!r}"
                )
            dimensions = [f"{name}_{axis}" for axis in range(values.ndim)]
            added[name] = (dimensions, values, {"key": key, "text": int(text), "observer": k})
    words = {"observers": json.dumps([_class(one) for one in observers]), "observers_with_state": json.dumps(kept)}
    return dataset.assign(added).assign_attrs(words)


def read_memories(dataset: xr.Dataset, observers: Sequence[Any]) -> list[Mapping[str, Any] | None]:
    """Return the memory of observers in a Dataset, one mapping each, or None without memory.

    Parameters
    ----------
    dataset : xarray.Dataset
        As `write_memories` returned it.
    observers : sequence
        Observers that get the memory.

    Returns
    -------
    list of dict or None

    Raises
    ------
    InputError
        If the classes of the observers differ from the classes in the Dataset.
    """
    written, given = json.loads(dataset.attrs["observers"]), [_class(one) for one in observers]
    if written != given:
        raise InputError(
            f"load: the flow was saved with the observers [{', '.join(written)}], got [{', '.join(given)}]; give "
            "observers of the same classes in the same order"
        )
    memories: list[Any] = [{} if kept else None for kept in json.loads(dataset.attrs["observers_with_state"])]
    for name, data in dataset.variables.items():
        if str(name).startswith("observer_"):
            values = data.values
            text = values.tobytes().decode() if data.attrs["text"] else values
            memories[int(data.attrs["observer"])][data.attrs["key"]] = text if data.ndim else values.item()
    return memories


def pack_maps(maps: Sequence[xr.Dataset]) -> dict[str, Any]:
    """Return maps of one grid as arrays by name, and a text of all else in them; `unpack_maps` undoes it."""
    names = dict.fromkeys(name for one in maps for name in one.variables)
    words = {
        name: [data.dims, data.attrs, data.encoding]
        for name in names if (data := next(one.variables[name] for one in maps if name in one.variables)) is not None
    }  # fmt: skip
    each = [[list(one.variables), list(one.coords), one.attrs] for one in maps]
    packed: dict[str, Any] = {"words": json.dumps({"variables": words, "maps": each})}
    for name in names:
        values = [one.variables[name].values for one in maps if name in one.variables]
        # coordinates are the same for all maps
        packed[f"map {name}"] = np.stack(values[:1] if words[name][0] == (name,) else values)
    return packed


def unpack_maps(packed: Mapping[str, Any]) -> list[xr.Dataset]:
    """Return the maps of which `pack_maps` made a mapping."""
    words, maps, seen = json.loads(packed["words"]), [], dict.fromkeys(packed, 0)
    for names, coords, attributes in words["maps"]:
        data = {}
        for name in names:
            dims, attrs, encoding = words["variables"][name]
            stacked, key = packed[f"map {name}"], f"map {name}"
            data[name] = xr.Variable(dims, stacked[min(seen[key], len(stacked) - 1)], _as_given(attrs), encoding)
            seen[key] += 1
        maps.append(xr.Dataset(data, attrs=_as_given(attributes)).set_coords(coords))
    return maps


def _as_given(attributes):
    """Return attributes that came from JSON with tuples instead of lists."""
    return {name: tuple(value) if isinstance(value, list) else value for name, value in attributes.items()}


def _class(observer) -> str:
    return type(observer).__qualname__
