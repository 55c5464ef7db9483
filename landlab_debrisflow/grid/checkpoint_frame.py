"""Refusals of checkpoints of which neither a grid nor a setup can be built; `checkpoint_checks` checks the rest."""

import json
from typing import Any

import numpy as np

from ..core.errors import InputError

TEXTS = {"setup": dict, "law_digests": dict, "warned": list, "observers": list, "observers_with_state": list}
"""Attributes that are JSON, and the type of their content."""


def check_frame(dataset: Any) -> None:
    """Refuse a Dataset without the attributes, the raster and the fields that every checkpoint has.

    Parameters
    ----------
    dataset : xarray.Dataset
        Contents of a file.

    Raises
    ------
    InputError
        The message names the attribute, variable or field that is missing or of another kind.
    """
    found = {name: _json(dataset.attrs, name, kind) for name, kind in TEXTS.items()}
    if not all(isinstance(word, str) for word in (*found["observers"], *found["law_digests"].values())):
        _refuse("observers and law_digests are no texts")
    if len(found["observers"]) != len(found["observers_with_state"]):
        _refuse("observers and observers_with_state differ in number")
    for name in ("spacing", "lower_left"):
        if name not in dataset.attrs:
            _refuse(f"it lacks the attribute {name!r}")
        values = np.ravel(dataset.attrs[name])
        if values.shape != (2,) or values.dtype.kind not in "iuf" or not np.isfinite(values).all():
            _refuse(f"the attribute {name!r} is not two numbers")
    if np.min(dataset.attrs["spacing"]) <= 0.0:
        _refuse("the spacing is not above 0")
    shape = tuple(dataset.sizes.get(axis, 0) for axis in "yx")
    if min(shape) < 3:
        _refuse(f"its raster has {shape[0]} x {shape[1]} nodes")
    fields = {name: data for name, data in dataset.variables.items() if "field" in data.attrs}
    for name, data in {"node_status": dataset.variables.get("node_status"), **fields}.items():
        kinds = "iu" if name == "node_status" else "iufb"
        if data is None or data.dims != ("y", "x") or data.dtype.kind not in kinds:
            _refuse(f"{name!r} is no variable of numbers over y and x")
    if np.any((dataset.variables["node_status"].values < 0) | (dataset.variables["node_status"].values > 4)):
        _refuse("node_status has numbers outside [0, 4]")
    for name, data in fields.items():
        if not all(isinstance(data.attrs.get(key), str) for key in ("field", "units")):
            _refuse(f"{name!r} has no name or no unit of a field")
    for name, data in dataset.variables.items():
        if str(name).startswith("observer_"):
            _check_memory(str(name), data, found["observers_with_state"])


def _json(attributes: Any, name: str, kind: type) -> Any:
    try:
        content = json.loads(attributes[name])
    except KeyError:
        _refuse(f"it lacks the attribute {name!r}")
    except (TypeError, ValueError, RecursionError):
        content = None
    if not isinstance(content, kind):
        _refuse(f"the attribute {name!r} is no {kind.__name__} in JSON")
    return content


def _check_memory(name: str, data: Any, with_state: list) -> None:
    """Refuse a variable that is no memory of one of the observers."""
    owner, text = data.attrs.get("observer"), data.attrs.get("text")
    owned = np.ndim(owner) == 0 and owner in range(len(with_state)) and with_state[int(owner)] is True
    readable = isinstance(data.attrs.get("key"), str) and text in (0, 1) and data.dtype.kind in "biuf"
    if not (owned and readable):
        _refuse(f"{name!r} is no memory of an observer")
    if text:
        try:
            data.values.astype(np.uint8).tobytes().decode()
        except UnicodeDecodeError:
            _refuse(f"{name!r} is no text")


def _refuse(reason: str) -> None:
    raise InputError(f"load: the contents of the checkpoint are not those of a flow: {reason}; nothing was loaded")
