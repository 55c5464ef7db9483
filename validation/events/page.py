"""Tables of docs/events.md, written between markers from sets, scores.json and result.nc: they cannot drift.

In the page stands ``<!-- event KIND NAME -->``, then the table, then ``<!-- end -->``.
"""

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from . import EVENTS, find_event, record
from .event import Event, Target
from .sets import set_names

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "docs" / "events.md"
MARKED = re.compile(r"(<!-- event (\w+) (\w+) -->\n).*?(<!-- end -->)", re.DOTALL)


def fill() -> Iterator[Path]:
    """Write the tables of the page; yield the page if it changed."""
    before = PAGE.read_text(encoding="utf-8")
    if (after := filled(before)) != before:
        PAGE.write_text(after, encoding="utf-8")
        yield PAGE


def filled(text: str) -> str:
    """Return the text of a page with its tables written anew."""
    return MARKED.sub(lambda found: f"{found[1]}{KINDS[found[2]](found[3])}{found[4]}", text)


def values(name: str) -> str:
    """Return the values of the set that is shown, each with range, choice and source."""
    event = find_event(name)
    rows = [
        (f"`{section}: {key}`", _number(value.value), value.unit,
         f"{_number(value.span[0])} to {_number(value.span[1])}" if value.span else "", value.choice, value.source)
        for section, key, value in event.read_set().sourced()
    ]  # fmt: skip
    return _table(["parameter", "value", "unit", "range", "choice", "source"], rows, "---")


def chosen(name: str) -> str:
    """Return the commit of the set that is shown, and what was known of the event when it was chosen."""
    event = find_event(name)
    parameters = event.read_set()
    rows = record.read_scores(event.folder)
    shown = record.latest(rows, parameters.name, event.particle_count)
    known = re.sub(r"\s+", " ", parameters.known_when_chosen.strip())
    commit = f"commit {shown['commit']} of {shown['committed']}" if shown else "not yet scored"
    return f"Set `{parameters.name}` ({parameters.title}), {commit}. Known when it was chosen: {known}\n"


def targets(name: str) -> str:
    """Return the targets of an event, and whether the set that is shown meets them."""
    event = find_event(name)
    rows = [(target.words, _value_of(target, event), _verdict(target, event)) for target in event.targets]
    return _table(["target", "value", "met"], rows)


def scores(name: str) -> str:
    """Return the scores of every set ever scored, with references, noise and twice the particles."""
    event = find_event(name)
    kept = record.read_scores(event.folder)
    columns = [key for key, measure in event.measures.items() if measure.tabulated]
    references = record.read_references(event.folder)
    rows = [(words, "", *_cells(event, found, columns)) for words, found in references.items()]
    for row in kept:
        if not row["change"] and row["particles"] == event.particle_count:
            version = f"{row['commit']}, {row['code']}"
            rows.append((f"`{row['set']}`", version, *_cells(event, row["scores"], columns)))
    for set_name in dict.fromkeys(row["set"] for row in kept):
        if finer := record.latest(kept, set_name, 2 * event.particle_count):
            cells = _cells(event, finer["scores"], columns)
            rows.append((f"`{set_name}`, {2 * event.particle_count} particles", finer["commit"], *cells))
        if found := record.noise(kept, set_name, event.particle_count):
            cells = ["±" + cell.lstrip("+") if cell else "" for cell in _cells(event, found, columns)]
            rows.append((f"`{set_name}`, noise", "", *cells))
    return _table(["run", "commits: set, code", *(event.measures[key].words for key in columns)], rows)


def scan(name: str) -> str:
    """Return the scores with one value changed to an end of its published range."""
    event = find_event(name)
    kept = record.read_scores(event.folder)
    columns = [key for key, measure in event.measures.items() if measure.tabulated]
    last = {(row["set"], row["change"]): row for row in kept if row["change"]}
    rows = [(f"`{row['set']}`", row["change"], *_cells(event, row["scores"], columns)) for row in last.values()]
    return _table(["set", "changed", *(event.measures[key].words for key in columns)], rows)


def effects(name: str) -> str:
    """Return how the scores move from each set to the one that changes one law of it: before → after."""
    event = find_event(name)
    kept = record.read_scores(event.folder)
    columns = [key for key, measure in event.measures.items() if measure.tabulated]
    rows = []
    for after in map(event.read_set, set_names(event.read_set().paths[0].parent)):
        found = [record.latest(kept, set_name, event.particle_count) for set_name in (after.base, after.name)]
        if after.base and all(found):
            cells = zip(*(_cells(event, row["scores"], columns) for row in found), strict=True)
            rows.append((f"`{after.base}` to `{after.name}`", *(" → ".join(pair) for pair in cells)))
    return _table(["sets", *(event.measures[key].words for key in columns)], rows)


def summary(name: str) -> str:
    """Return a table of events and sets: how many targets each set meets, and the values of the measures aimed at."""
    rows = []
    for event in map(find_event, EVENTS):
        folder = event.read_set().paths[0].parent
        for set_name in set_names(folder):
            found = [(target, _mean(target, event, set_name)) for target in event.targets]
            if not found or all(math.isnan(value) for _, value in found):
                continue
            met = sum(target.met(value) for target, value in found)
            told = "; ".join(_told(target, event, value) for target, value in found)
            shown = " (shown)" if set_name == event.default_set else ""
            rows.append((event.title, f"`{set_name}`{shown}", f"{met} of {len(found)}", told))
    return _table(["event", "set", "targets met", "values"], rows, "---")


KINDS = {
    "values": values, "chosen": chosen, "targets": targets, "scores": scores, "scan": scan, "effects": effects,
    "summary": summary,
}  # fmt: skip
"""Functions by the kind of table."""


def _mean(target: Target, event: Event, set_name: str) -> float:
    """Return the measure of a target, the mean over its events; NaN if one was not scored with the set."""
    found = []
    for each in map(find_event, target.events or (event.name,)):
        row = record.latest(record.read_scores(each.folder), set_name, each.particle_count)
        found.append(row["scores"].get(target.measure, math.nan) if row else math.nan)
    return sum(found) / len(found)


def _value_of(target: Target, event: Event) -> str:
    value = _mean(target, event, event.default_set)
    return "" if math.isnan(value) else event.measures[target.measure].form.format(value)


def _verdict(target: Target, event: Event) -> str:
    value = _mean(target, event, event.default_set)
    return "not scored" if math.isnan(value) else "yes" if target.met(value) else "**no**"


def _told(target: Target, event: Event, value: float) -> str:
    measure = event.measures[target.measure]
    words = f"mean of {measure.words}" if len(target.events) > 1 else measure.words
    return f"{words} {'–' if math.isnan(value) else measure.form.format(value)}"


def _cells(event: Event, found: Mapping[str, float], columns: Sequence[str]) -> list[str]:
    numbers = [found.get(key, math.nan) for key in columns]
    return [
        "" if math.isnan(n) else event.measures[key].form.format(n) for key, n in zip(columns, numbers, strict=True)
    ]


def _number(value) -> str:
    return f"{value:g}" if isinstance(value, (int, float)) else str(value)


def _table(heads: Sequence[str], rows: Sequence[Sequence[str]], other: str = "---:") -> str:
    """Return a table of Markdown; `other` tells how columns but the first are aligned, by default as numbers."""
    if not rows:
        return "None yet.\n"
    lines = ["| " + " | ".join(heads) + " |", "|---|" + f"{other}|" * (len(heads) - 1)]
    cells = [[cell.replace("|", "\\|") for cell in row] for row in rows]
    return "\n".join([*lines, *("| " + " | ".join(row) + " |" for row in cells)]) + "\n"
