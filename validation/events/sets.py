"""Sets of parameters: one YAML file each, every value with its range and source, committed before its first score."""

import math
import re
import subprocess
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, NamedTuple

from landlab_debrisflow.core.errors import InputError
from landlab_debrisflow.core.hints import did_you_mean
from landlab_debrisflow.scene.read_yaml import read_yaml

SECTIONS = ("flow", "friction", "erosion", "column", "material", "numerics", "site")
"""Sections of a set: the keywords of `DebrisFlow`, and ``site`` for what the set-up of the event reads itself."""
KEYS = ("title", "known_when_chosen", "based_on", *SECTIONS)
PARTS = ("value", "unit", "range", "choice", "source")
CHOICES = (
    "centre",
    "geometric centre",
    "published simulation",
    "measured",
    "published value",
    "derived",
    "earlier set",
    "fitted",
    "numerics",
)
"""Ways to choose a value. Centres are recomputed from the range; a ``derived`` value follows from others of the set;
``fitted`` is to this event, and no forecast; ``numerics`` is no physics."""
ROUNDING = 0.06
"""Relative distance from the centre of a range that rounding of a value may cause, such as .39 to .4."""


class Value(NamedTuple):
    """A value of a set with its unit, published range, way of choice and source.

    ``span`` is None where no range was published.
    """

    value: Any
    unit: str
    span: tuple[float, float] | None
    choice: str
    source: str


class Commit(NamedTuple):
    """Short name and date of a commit."""

    name: str
    date: str


@dataclass(frozen=True)
class ParameterSet:
    """A set of parameters.

    Attributes
    ----------
    name, title : str
    known_when_chosen : str
        What was known of the event when the set was chosen.
    values : mapping
        Values by section and key; a value of several keys has them joined by dots, ``dilatancy.permeability``.
        Names of laws are words without a source.
    paths : tuple of Path
        Its file, and those of the sets that it is based on.
    base : str
        Name of the set that it is based on, or an empty text.
    change : str
        What differs from the file, in a scan; empty otherwise.
    """

    name: str
    title: str
    known_when_chosen: str
    values: Mapping[str, Mapping[str, Any]]
    paths: tuple[Path, ...]
    base: str = ""
    change: str = ""

    def plain(self, section: str) -> dict[str, Any]:
        """Return the values of a section without units and sources, nested where keys have dots."""
        found: dict[str, Any] = {}
        for key, value in self.values.get(section, {}).items():
            *above, last = key.split(".")
            place = found
            for part in above:
                place = place.setdefault(part, {})
            place[last] = value.value if isinstance(value, Value) else value
        return found

    def keywords(self) -> dict[str, Any]:
        """Return the keywords of `DebrisFlow` for the sections that are given."""
        return {section: self.plain(section) for section in SECTIONS if section in self.values and section != "site"}

    def sourced(self) -> Iterator[tuple[str, str, Value]]:
        """Yield section, key and value of all values with a source."""
        for section, values in self.values.items():
            for key, value in values.items():
                if isinstance(value, Value):
                    yield section, key, value

    def changed(self, section: str, key: str, value: Any) -> "ParameterSet":
        """Return the set with one value changed, which `change` tells."""
        before = self.values[section][key]
        values = {**self.values, section: {**self.values[section], key: before._replace(value=value)}}
        return replace(self, values=values, change=f"{key} = {value:g} {before.unit}".removesuffix(" -"))

    def scan(self, word: str = "") -> Iterator["ParameterSet"]:
        """Yield the sets with one value at either end of its published range, of wide ranges also between the ends.

        `word` limits the scan to the keys that hold it. A range of a factor of ten or more has two values per decade.
        """
        for section, key, value in self.sourced():
            if value.span is None or word not in key:
                continue
            low, high = value.span
            decades = math.log10(high / low) if low > 0.0 else 0.0
            steps = round(2.0 * decades) if decades >= 1.0 else 1
            for step in range(steps + 1):
                between = low * 10.0 ** (decades * step / steps)
                end = high if step == steps else between if step else low
                if not math.isclose(end, value.value, rel_tol=1e-6):
                    yield self.changed(section, key, float(f"{end:.3g}"))

    def commit(self) -> Commit:
        """Return the commit that last changed the files of the set.

        Raises
        ------
        InputError
            If a file has changes that are not committed, or there is no Git.
        """
        folder, names = self.paths[0].parent, [str(path) for path in self.paths]
        changes = _git(folder, "status", "--porcelain", "--", *names)
        if changes:
            raise InputError(
                f"the set {self.name} has changes that are not committed: {changes.split()[-1]}; commit it before it "
                "is scored, so that nobody can choose values by their scores"
            )
        found = _git(folder, "log", "-1", "--format=%h %cs", "--", *names)
        if not found:
            raise InputError(f"the set {self.name} has no commit; commit {names[0]} before it is scored")
        return Commit(*found.split())


def read_set(folder: Path, name: str) -> ParameterSet:
    """Read a set of parameters.

    Parameters
    ----------
    folder : Path
        Folder of the sets of an event.
    name : str
        Name of the file without ``.yaml``.

    Raises
    ------
    InputError
        If there is none of this name, or a value has no unit, no source, or is not chosen as it says.
    """
    known = set_names(folder)
    if name not in known:
        raise InputError(
            f"there is no set {name!r}{did_you_mean(name, known)} in {folder}; there are {', '.join(known)}"
        )
    path = folder / f"{name}.yaml"
    content = read_yaml(path).mapping
    _refuse_unknown(path, "", content, KEYS)
    values = {section: dict(_flat(path, section, content[section] or {})) for section in SECTIONS if section in content}
    for key in ("title", "known_when_chosen"):
        if not isinstance(content.get(key), str):
            raise InputError(f"{path}: {key} must be a text, got {content.get(key)!r}")
    paths, base_name = (path,), content.get("based_on", "")
    if base_name:
        base = read_set(folder, base_name)
        values, paths = _merged(base.values, values), (path, *base.paths)
    return ParameterSet(name, content["title"], content["known_when_chosen"], values, paths, base_name)


def set_names(folder: Path) -> list[str]:
    """Return the names of the sets in a folder."""
    return sorted(path.stem for path in folder.glob("*.yaml"))


def _merged(base: Mapping, own: Mapping) -> dict[str, dict]:
    """Return sections key by key, where another law replaces the whole section."""
    merged = {section: dict(values) for section, values in base.items()}
    for section, values in own.items():
        other_law = values.get("law", merged.get(section, {}).get("law")) != merged.get(section, {}).get("law")
        merged[section] = values if other_law else merged.get(section, {}) | values
    return merged


def _flat(path: Path, section: str, content: Any, above: str = "") -> Iterator[tuple[str, Any]]:
    """Yield keys, joined by dots, and their values."""
    if not isinstance(content, dict):
        raise InputError(f"{path}: {section} must be a mapping of keys to values, got {content!r}")
    for key, entry in content.items():
        place = f"{above}{key}"
        if isinstance(entry, dict) and "value" in entry:
            yield place, _value(path, f"{section}.{place}", entry)
        elif isinstance(entry, dict):
            yield from _flat(path, section, entry, f"{place}.")
        elif isinstance(entry, (str, bool)):
            yield place, entry
        else:
            raise InputError(f"{path}: {section}.{place} must have value, unit, choice and source, got {entry!r}")


def _value(path: Path, place: str, entry: Mapping[str, Any]) -> Value:
    _refuse_unknown(path, place, entry, PARTS)
    choice, source, span = entry.get("choice"), entry.get("source"), entry.get("range")
    if choice not in CHOICES:
        raise InputError(f"{path}: choice of {place} must be one of {', '.join(CHOICES)}, got {choice!r}")
    for part in ("unit", "source"):
        if not isinstance(entry.get(part), str) or not entry[part].strip():
            raise InputError(f"{path}: {place} needs a {part}, a text; got {entry.get(part)!r}")
    if span is not None and not (isinstance(span, list) and len(span) == 2 and span[0] < span[1]):
        raise InputError(f"{path}: range of {place} must be two increasing numbers, got {span!r}")
    if choice in ("centre", "geometric centre"):
        if span is None:
            raise InputError(f"{path}: {place} is the {choice} of a range; give range: [low, high]")
        centre = math.sqrt(span[0] * span[1]) if choice == "geometric centre" else 0.5 * (span[0] + span[1])
        if not math.isclose(entry["value"], centre, rel_tol=ROUNDING):
            raise InputError(
                f"{path}: {place} is {entry['value']:g}, but the {choice} of {span} is {centre:.3g}; correct the value "
                "or say how it was chosen"
            )
    source = re.sub(r"\s+", " ", source.strip())
    return Value(entry["value"], entry["unit"], tuple(span) if span else None, choice, source)


def _refuse_unknown(path: Path, place: str, entry: Mapping[str, Any], known: tuple[str, ...]) -> None:
    for key in entry:
        if key not in known:
            words = f" of {place}" if place else ""
            raise InputError(f"{path}: unknown key {key!r}{words}{did_you_mean(key, known)}; known: {', '.join(known)}")


def _git(folder: Path, *arguments: str) -> str:
    try:
        done = subprocess.run(["git", "-C", str(folder), *arguments], check=True, capture_output=True, text=True)
    except (OSError, subprocess.CalledProcessError) as error:
        raise InputError(f"the commit of a set is found by Git, which failed in {folder}; use a checkout") from error
    return done.stdout.strip()
