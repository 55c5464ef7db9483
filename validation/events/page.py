"""Tables of docs/events.md, written between markers from sets, scores.json and result.nc: they cannot drift.

In the page stands ``<!-- event KIND NAME -->``, then the table, then ``<!-- end -->``.
"""

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from . import EVENTS, find_event, record
from .event import Event, Target

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
    shown = record.latest(record.read_scores(event.folder), parameters.name, event.particle_count)
    commit = f"commit {shown['commit']} of {shown['committed']}" if shown else "not yet scored"
    lines = [f"Shown is the set `{parameters.name}`: {parameters.title} ({commit}). Known when it was chosen:", ""]
    while parameters is not None:
        known = re.sub(r"\s+", " ", parameters.known_when_chosen.strip())
        lines.append(f"* `{parameters.name}`: {known}")
        parameters = event.read_set(parameters.base) if parameters.base else None
    return "\n".join(lines) + "\n"


def targets(name: str) -> str:
    """Return the targets of an event, and whether the set that is shown meets them."""
    event = find_event(name)
    found = [(target, _mean(target, event, event.default_set)) for target in event.targets]
    rows = [(target.words, _number_of(target, event, value), _verdict(target, value)) for target, value in found]
    return _table(["target", "value", "met"], rows)


def scores(name: str) -> str:
    """Return the last scores of every set, with references, noise and twice the particles."""
    event = find_event(name)
    kept = record.read_scores(event.folder)
    columns = [key for key, measure in event.measures.items() if measure.tabulated]
    rows = [
        (words, "", *_cells(event, found, columns)) for words, found in record.read_references(event.folder).items()
    ]
    sets = list(dict.fromkeys(row["set"] for row in kept))
    for set_name in sets:
        if row := record.latest(kept, set_name, event.particle_count):
            rows.append((f"`{set_name}`", row["commit"], *_cells(event, row["scores"], columns)))
    for set_name in sets:
        if finer := record.latest(kept, set_name, 2 * event.particle_count):
            cells = _cells(event, finer["scores"], columns)
            rows.append((f"`{set_name}`, {2 * event.particle_count} particles", finer["commit"], *cells))
        if found := record.noise(kept, set_name, event.particle_count):
            cells = ["±" + cell.lstrip("+") if cell else "" for cell in _cells(event, found, columns)]
            rows.append((f"`{set_name}`, noise", "", *cells))
    return _table(["run", "set committed in", *(event.measures[key].words for key in columns)], rows)


def scan(name: str) -> str:
    """Return the scores with one value changed to an end of its published range."""
    event = find_event(name)
    kept = record.read_scores(event.folder)
    columns = [key for key, measure in event.measures.items() if measure.tabulated]
    last = {(row["set"], row["change"]): row for row in kept if row["change"]}
    rows = [(f"`{row['set']}`", row["change"], *_cells(event, row["scores"], columns)) for row in last.values()]
    return _table(["set", "changed", *(event.measures[key].words for key in columns)], rows)


def refinement(name: str) -> str:
    """Return the scores of the set that is shown, by the number of particles."""
    event = find_event(name)
    kept = [row for row in record.read_scores(event.folder) if row["set"] == event.default_set and not row["change"]]
    columns = [key for key, measure in event.measures.items() if measure.tabulated]
    last = {row["particles"]: row["scores"] for row in kept}
    rows = [(str(count), *_cells(event, last[count], columns)) for count in sorted(last)]
    return _table(["particles", *(event.measures[key].words for key in columns)], rows)


def effects(name: str) -> str:
    """Return how the measures of the targets move from each set to the one that changes it: before → after."""
    event = find_event(name)
    rows = []
    for after in map(event.read_set, dict.fromkeys(row["set"] for row in record.read_scores(event.folder))):
        if after.base:
            found = [[_mean(target, event, each) for each in (after.base, after.name)] for target in event.targets]
            cells = (
                " → ".join(_number_of(target, event, n) for n in pair)
                for target, pair in zip(event.targets, found, strict=True)
            )
            rows.append((f"`{after.base}`", f"`{after.name}`", *cells))
    return _table(["from", "to", *_target_words(event)], rows)


def best(name: str) -> str:
    """Return the best value of each target over all sets and scans ever scored, with the values of the others there."""
    event = find_event(name)
    runs = dict.fromkeys((row["set"], row["change"]) for row in record.read_scores(event.folder))
    found = {run: [_mean(target, event, *run) for target in event.targets] for run in runs}
    rows = []
    for place, target in enumerate(event.targets):
        known = [run for run, numbers in found.items() if not any(map(math.isnan, numbers))]
        if known and math.isinf(target.high):
            run = max(known, key=lambda run, place=place: found[run][place])
            cells = [
                event.measures[each.measure].form.format(n) for each, n in zip(event.targets, found[run], strict=True)
            ]
            rows.append((target.words, f"`{run[0]}`{', ' if run[1] else ''}{run[1]}", *cells))
    words = [f"{'mean ' if each.events else ''}{event.measures[each.measure].words}" for each in event.targets]
    return _table(["best in", "run", *words], rows)


def summary(name: str) -> str:
    """Return a table of events and sets: how many targets each set meets, and the values of the measures aimed at."""
    rows = []
    for event in map(find_event, EVENTS):
        if event.shared_sets:  # its scores are in the row of the other event
            continue
        others = [each.title for each in map(find_event, EVENTS) if each.shared_sets == event.name]
        for set_name in dict.fromkeys(row["set"] for row in record.read_scores(event.folder)):
            found = [(target, _mean(target, event, set_name)) for target in event.targets]
            if all(math.isnan(value) for _, value in found):
                continue
            met = sum(target.met(value) for target, value in found)
            words = zip(_target_words(event), found, strict=True)
            told = "; ".join(f"{each} {_number_of(target, event, value)}" for each, (target, value) in words)
            shown = " (shown)" if set_name == event.default_set else ""
            rows.append((" and ".join([event.title, *others]), f"`{set_name}`{shown}", f"{met} of {len(found)}", told))
    return _table(["event", "set", "targets met", "values"], rows, "---")


KINDS = {
    "values": values, "chosen": chosen, "targets": targets, "scores": scores, "scan": scan, "effects": effects,
    "refinement": refinement, "best": best, "summary": summary,
}  # fmt: skip
"""Functions by the kind of table."""


def _mean(target: Target, event: Event, set_name: str, change: str = "") -> float:
    """Return the measure of a target, the mean over its events; NaN if one was not scored with the set."""
    found = []
    for each in map(find_event, target.events or (event.name,)):
        row = record.latest(record.read_scores(each.folder), set_name, each.particle_count, change)
        found.append(row["scores"].get(target.measure, math.nan) if row else math.nan)
    return sum(found) / len(found)


def _target_words(event: Event) -> list[str]:
    """Return the words of the measures that are aimed at."""
    return [f"{'mean ' if target.events else ''}{event.measures[target.measure].words}" for target in event.targets]


def _number_of(target: Target, event: Event, value: float) -> str:
    return event.measures[target.measure].text(value) or "–"


def _verdict(target: Target, value: float) -> str:
    return "not scored" if math.isnan(value) else "yes" if target.met(value) else "**no**"


def _cells(event: Event, found: Mapping[str, float], columns: Sequence[str]) -> list[str]:
    return [event.measures[key].text(found.get(key, math.nan)) for key in columns]


def _number(value) -> str:
    return f"{value:g}" if isinstance(value, (int, float)) else str(value)


def _table(heads: Sequence[str], rows: Sequence[Sequence[str]], other: str = "---:") -> str:
    """Return a table of Markdown; `other` tells how columns but the first are aligned, by default as numbers."""
    if not rows:
        return "None yet.\n"
    lines = ["| " + " | ".join(heads) + " |", "|---|" + f"{other}|" * (len(heads) - 1)]
    cells = [[cell.replace("|", "\\|") for cell in row] for row in rows]
    return "\n".join([*lines, *("| " + " | ".join(row) + " |" for row in cells)]) + "\n"
