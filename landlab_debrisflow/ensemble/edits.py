"""Keys of a scene with other values in their place."""

import dataclasses
from collections.abc import Mapping
from typing import Any

from ..core.values import keys_of
from ..physics.registry import LAWS
from ..scene.content import SceneContent
from .names import FACTOR, NOISE

AMOUNTS = ("depth", "largest_depth", "volume")
"""Keys of a release of which one counts: another one takes its place."""


def with_values(content: SceneContent, values: Mapping[tuple[str | int, ...], Any]) -> SceneContent:
    """Return the keys of a scene with new values in place of some, checked.

    Parameters
    ----------
    content : SceneContent
    values : mapping of tuple to object
        New values by the path of a `Name`; factors and noise are left out.

    Returns
    -------
    SceneContent

    Raises
    ------
    ParameterError
        If a value is not allowed, or values do not agree with each other.
    """
    tree: dict[Any, Any] = {}
    for path, value in values.items():
        if path[-1] in (FACTOR, NOISE):
            continue
        branch = tree
        for step in path[:-1]:
            branch = branch.setdefault(step, {})
        branch[path[-1]] = _Leaf(value)
    setup = {key: branch for key, branch in tree.items() if key in (*LAWS, "material", "numerics", "inflow")}
    return content._replace(
        terrain=_replaced(content.terrain, tree.get("terrain", {})),
        release=_replaced(content.release, tree.get("release", {})),
        setup=_replaced(content.setup, setup),
    )


class _Leaf:
    def __init__(self, value: Any):
        self.value = value


def _replaced(obj: Any, branch: Any) -> Any:
    """Return an object, tuple or mapping with the values of a branch in their place."""
    if isinstance(branch, _Leaf):
        return branch.value
    if not branch:
        return obj
    if isinstance(obj, tuple) and not dataclasses.is_dataclass(obj):
        return tuple(_replaced(one, branch.get(k, {})) for k, one in enumerate(obj))
    if isinstance(obj, Mapping):
        return {**obj, **{key: _replaced(obj.get(key), inner) for key, inner in branch.items()}}
    fields = keys_of(type(obj))
    changed = {fields[key].name: _replaced(getattr(obj, fields[key].name), inner) for key, inner in branch.items()}
    if changed.keys() & set(AMOUNTS) and set(AMOUNTS) <= fields.keys():
        changed = dict.fromkeys(AMOUNTS) | changed
    return dataclasses.replace(obj, **changed)
