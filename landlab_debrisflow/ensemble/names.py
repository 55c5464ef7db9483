"""Dotted names of the values of a scene that an ensemble may vary."""

import dataclasses
from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

from ..core.errors import ParameterError
from ..core.hints import did_you_mean
from ..core.values import keys_of
from ..physics.registry import LAWS
from ..scene.content import LISTS, SceneContent

INFINITY = float("inf")
FACTOR, NOISE = "factor", "elevation_noise"
"""Keys that only ensembles have: a factor on a mass, and noise on the elevation."""

REFUSED = {
    "particle_count": "one number of particles holds for all members, so that parameters alone make their "
    "differences; set it in the scene, or give fidelity: auto",
    "threads": "a member has one thread",
    "settle": "maps show settled deposits",
    "window": "all members have the nodes of the scene",
}
REFUSED |= dict.fromkeys(("particle_spacing", "tolerance", "hold"), REFUSED["particle_count"])
REFUSED |= dict.fromkeys(("spacing", "crs", "travel_angle", "example", "nodata"), REFUSED["window"])
"""Keys of numerics and terrain that no ensemble varies, and why."""


class Name(NamedTuple):
    """Value of a scene that may vary.

    Attributes
    ----------
    key : str
        Dotted name, such as ``friction.cohesion``.
    path : tuple of str and int
        Keys from the scene down to the value, with the index in lists.
    unit : str
        Unit of the value, "-" for none.
    meaning : str
        Meaning as declared.
    bounds : tuple of float
        Least and largest value of a number.
    open_below : bool
        Whether the least value itself is refused.
    number : type or None
        float or int if the value may be a number; None: a word, a file, coordinates or a law.
    """

    key: str
    path: tuple[str | int, ...]
    unit: str
    meaning: str
    bounds: tuple[float, float] = (-INFINITY, INFINITY)
    open_below: bool = False
    number: type | None = None


def find_name(key: str, content: SceneContent) -> Name:
    """Return the value of a scene that a dotted name means.

    Parameters
    ----------
    key : str
        Such as ``friction.basal_friction_angle``, ``release.volume`` or ``release 2.volume``.
    content : SceneContent

    Returns
    -------
    Name

    Raises
    ------
    ParameterError
        If the scene has no value of this name (the message asks for the one that was probably meant), if the name fits
        several releases, or if ensembles do not vary the value.
    """
    names = {name.key: name for name in scene_names(content)}
    if key in names:
        name = names[key]
        reason = REFUSED.get(str(name.path[-1])) if name.path[0] in ("numerics", "terrain") else None
        if reason is not None:
            raise ParameterError(f"ensemble: {key} cannot vary: {reason}")
        return name
    first, _, rest = str(key).partition(".")
    several = [f"{first} {k + 1}.{rest}" for k in range(len(names))]
    if found := [one for one in several if one in names]:
        raise ParameterError(f"ensemble: {key} fits {len(found)} of {first}; name one: {' or '.join(found)}")
    if first == "output":
        raise ParameterError(f"ensemble: {key} cannot vary: output does not change a run")
    near = did_you_mean(key, names)
    inside = [name for name in names if name.startswith(f"{first}.")]
    told = "" if near else f"; known below {first}: {', '.join(inside)}" if inside else "; give a name such as " + (
        "friction.basal_friction_angle or release.volume"
    )  # fmt: skip
    raise ParameterError(f"ensemble: unknown name {key!r}{near}{told}")


def scene_names(content: SceneContent) -> Iterator[Name]:
    """Yield all values of a scene by their dotted names, also values that ensembles do not vary.

    Parameters
    ----------
    content : SceneContent

    Yields
    ------
    Name
        A value in a list of one has two names, with the number and without it.
    """
    setup = content.setup
    yield Name(f"terrain.{NOISE}", ("terrain", NOISE), "m", "noise added to the elevation, new for every member")
    yield from _below(content.terrain, "terrain", ("terrain",), content)
    for kind in LAWS:
        yield Name(kind, (kind,), "-", f"law of {kind}, a name or a mapping")
        yield from _below(getattr(setup, kind), kind, (kind,), content)
    yield from _below(setup.material, "material", ("material",), content)
    yield from _below(setup.numerics, "numerics", ("numerics",), content)
    for kind, several in (("release", content.release), ("inflow", setup.inflow)):
        words = "factor on the mass that is released" if kind == "release" else "factor on the discharge"
        if several:
            yield Name(f"{kind}.{FACTOR}", (kind, FACTOR), "-", words, (0.0, INFINITY), True, float)
        for k in range(len(several)):
            yield Name(f"{kind} {k + 1}.{FACTOR}", (kind, k, FACTOR), "-", words, (0.0, INFINITY), True, float)
        yield from _items(several, kind, (kind,), content)


def _below(obj: Any, key: str, path: tuple[str | int, ...], content: SceneContent) -> Iterator[Name]:
    """Yield the values of an object of a declared class, and of objects of declared classes in it."""
    for name, field in keys_of(type(obj)).items() if dataclasses.is_dataclass(obj) else ():
        meta, value = field.metadata, getattr(obj, field.name)
        inner, below = f"{key}.{name}", (*path, name)
        if not meta:  # a law of a user whose values are not declared
            continue
        if meta["items"] is not None:
            yield from _items(value, inner, below, content)
        elif dataclasses.is_dataclass(meta["kind"]):
            yield from _below(value, inner, below, content)
        elif meta["kind"] is dict and name in LAWS:
            law = getattr(content.setup, name)
            yield from (
                one for one in _below(law, inner, below, content) if one.path[-1] in (value or {})
            )  # fmt: skip
        else:
            yield _name(inner, below, meta)


def _items(several: Any, key: str, path: tuple[str | int, ...], content: SceneContent) -> Iterator[Name]:
    for k, one in enumerate(several):
        yield from _below(one, f"{key} {k + 1}", (*path, k), content)
        if len(several) == 1 and key.rpartition(".")[2] in LISTS:
            yield from _below(one, key, (*path, k), content)


def _name(key: str, path: tuple[str | int, ...], meta: Mapping[str, Any]) -> Name:
    is_list = meta["kind"] is tuple and not meta["choices"] and meta["length"] is None  # one number does for all
    number = meta["kind"] if meta["kind"] in (float, int) else float if is_list else None
    return Name(key, path, meta["unit"], meta["meaning"], meta["bounds"], meta["open_below"], number)
