"""Report of an ensemble: members, probabilities with their errors, exposed polygons."""

import os
from collections.abc import Iterator, Mapping
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr
import yaml

from ..core.errors import InputError
from ..core.version import __version__
from ..ensemble import EnsembleResults
from ..hazard import hazard_summary
from ..hazard.files import EXPOSURE, HAZARD
from ..hazard.of_scene import scene_hazard_maps
from ..hazard.summary import probabilities_of
from ..hazard.write import layers_of
from ..plots import draw_probability
from ..plots.style import unit_text
from ..record.files import check_writable, write_atomically
from ..run.files import PAGE, STORE
from ..run.scene import Scene
from .blocks import Block, Section, Sentences, Table, Verbatim
from .cautions import DISTRUST, NOT_MODELLED
from .citation import SENTENCE, bibtex
from .content import Content
from .danger import danger_blocks
from .exposure import read_exposed
from .numbers import duration, rounded
from .page import render_page
from .pictures import picture

GIVEN = (
    "These are the probabilities of the members that were drawn: they hold for the distributions that the scene "
    "states, and for the model. Errors of the model itself, and of guessed distributions, come on top. They are no "
    "probabilities of an event in a year."
)

MOST_FAILURES = 10
"""Failures that are listed at most."""


def write_ensemble_report(
    directory: str | os.PathLike[str], output: str | os.PathLike[str] | None = None
) -> Path:  # fmt: skip
    """Write the report of an ensemble as one HTML page: members, probabilities with their errors, exposed polygons.

    Parameters
    ----------
    directory : str or os.PathLike
        Directory of the results of the command ``ensemble``.
    output : str or os.PathLike, optional
        The file; by default ``report.html`` in the directory. It is replaced if it exists.

    Returns
    -------
    pathlib.Path
        Where the page is.

    Raises
    ------
    InputError
        If the directory holds no ensemble, no member has come to its end, or a file of it is damaged.
    OutputError, OSError
        If the page cannot be written.
    """
    folder = Path(directory)
    results = EnsembleResults.open(folder / STORE)
    path = check_writable(folder / PAGE if output is None else output)
    maps = _maps(folder, results)
    done, failures = int(results.done.sum()), len(results.failures)
    now = datetime.now(UTC).strftime("%Y-%m-%d %H:%M UTC")
    complete = done == results.done.size
    content = Content(
        title=folder.resolve().name.removesuffix("_ensemble"),
        kind=f"Report of an ensemble of {results.done.size} runs, landlab_debrisflow {__version__}",
        state="Complete" if complete else f"{done} of {results.done.size} members",
        alert="" if complete else "Members are missing: run the command ensemble again to complete it.",
        summary=Sentences([*hazard_summary(maps), *_hit(folder)]), sections=list(_sections(folder, results, maps)),
        made=f"Made by landlab-debrisflow report, version {__version__}, on {now}; {failures} members failed.",
    )  # fmt: skip
    page = render_page(content)
    return write_atomically(path, lambda temporary: temporary.write_text(page, encoding="utf-8"))


def _maps(folder: Path, results: EnsembleResults) -> xr.Dataset:
    """Return the hazard maps of a directory, from its file, or from its store if the file has other members."""
    path = folder / HAZARD
    if path.is_file():
        try:
            with xr.open_dataset(path, engine="netcdf4") as file:
                maps = file.load()
        except (OSError, ValueError, RuntimeError) as error:
            raise InputError(f"cannot read {path}: {error}; the file is damaged, run the command ensemble") from error
        counted = int(results.done.sum()) - len(results.failures)
        if maps.attrs.get("ensemble_digest") == results.digest and maps.attrs.get("members_completed") == counted:
            return maps
    return scene_hazard_maps(results, Scene.from_mapping(results.scene))


def _sections(folder: Path, results: EnsembleResults, maps: xr.Dataset) -> Iterator[Section]:
    yield Section("errors", "How sure this is", [Sentences([GIVEN, _error_words(maps)])])
    yield Section("cautions", "Processes left out, and numbers to distrust", [
        Sentences([NOT_MODELLED]), Sentences(DISTRUST, listed=True),
    ])  # fmt: skip
    yield Section("members", "Members", list(_members(results)))
    yield Section("probabilities", "Probabilities", list(_probabilities(maps, _shapes(folder))))
    if danger := danger_blocks(folder, results.digest, _shapes(folder)):
        yield Section("danger", "Danger levels", danger)
    if (table := exposure_blocks(folder)) is not None:
        yield Section("exposure", "Exposed polygons", [table])
    scene = yaml.safe_dump(_plain(results.scene), sort_keys=False, allow_unicode=True, default_flow_style=None)
    yield Section("scene", "The scene as it was given", [Verbatim(scene)])
    yield Section("citation", "Citation", [Sentences([SENTENCE]), Verbatim(bibtex())])


def _error_words(maps: xr.Dataset) -> str:
    """Return the sentence on how the sampling error is told."""
    told = maps.attrs["sampling_error"]
    if told == "none":
        return f"A sampling error is not told: {maps.attrs['no_sampling_error']}."
    interval = f"intervals hold the true value in {100.0 * float(maps.attrs['confidence']):.0f} % of samples"
    return f"The sampling error, because members are no more than they are, is told by {told}; {interval}."


def _members(results: EnsembleResults) -> Iterator[Block]:
    design = results.design
    rows = []
    for values in design.data_vars.values():
        if "key" not in values.attrs:
            continue
        numbers = values.values.astype(float)
        middle = [rounded(float(one)) for one in (numbers.min(), np.median(numbers), numbers.max())]
        choices = str(values.attrs.get("choices", ""))
        rows.append((str(values.attrs["key"]), unit_text(str(values.attrs.get("units", ""))), *middle, choices))
    head = ("value", "unit", "least", "median", "largest", "choices, by number")
    yield Table(caption="Values that vary between members", head=head, rows=rows, numbers=(2, 3, 4))
    seconds = results.seconds
    yield Table(caption="Members", rows=[
        ("sampling", results.sampling), ("members", str(results.done.size)), ("run", str(int(results.done.sum()))),
        ("failed", str(len(results.failures))), ("time of a member", duration(float(np.nanmean(seconds)))),
        ("digest", results.digest),
    ])  # fmt: skip
    for one in results.failures[:MOST_FAILURES]:
        told = ", ".join(f"{key} {value}" for key, value in one.values.items())
        yield Sentences([f"Member {one.member} failed ({told}): {one.error}"])


def _probabilities(maps: xr.Dataset, shapes: Any) -> Iterator[Block]:
    known = probabilities_of(maps)
    for layer in (one for one in layers_of(maps) if one.variable in known):
        figure = draw_probability(maps, layer.variable.removeprefix("probability_of_"), layer.threshold, shapes=shapes)
        title = figure.axes[0].get_title(loc="left")
        area = float((layer.values >= 0.5).sum()) * _cell_area(maps)
        words = f"{title}, in percent of the members, and its standard error."
        yield picture(figure, f"Map: {title}. On {rounded(area, 'm²')} it is a half or more.", words)


def _shapes(folder: Path) -> Any:
    """Return the exposed polygons of an ensemble, None if there are none."""
    path = folder / f"{EXPOSURE}.gpkg"
    if not path.is_file():
        return None
    import geopandas

    return geopandas.read_file(path)


def _cell_area(maps: xr.Dataset) -> float:
    return abs(float(maps.x[1] - maps.x[0]) * float(maps.y[1] - maps.y[0]))


def exposure_rows(folder: Path) -> list[dict[str, str]]:
    """Return the table of exposed polygons of an ensemble, a row for each; empty if there is none.

    Raises
    ------
    InputError
        If the file is damaged.
    """
    found = read_exposed(folder / f"{EXPOSURE}.csv", {"id", "p_reached"}, "run the command ensemble again")
    return [] if found is None else [dict(zip(found.head, row, strict=True)) for row in found.rows]


def exposure_blocks(folder: Path) -> Table | None:
    """Return the table of probabilities at exposed polygons, None if there are none."""
    rows = exposure_rows(folder)
    if not rows:
        return None
    names = [name for name in rows[0] if name.startswith("p_") and not name.endswith(("_low", "_high"))]
    head = ("polygon", *(name.removeprefix("p_").replace("_", " ") for name in names), "earliest [s]", "median [s]")
    cells = [
        (row["id"], *(_percent(row, name) for name in names), *(_seconds(row, kind) for kind in ("earliest", "median")))
        for row in rows
    ]
    return Table(
        caption="Probability that each polygon is hit [%], and arrival", head=head, rows=cells,
        numbers=range(1, len(head)), note="In brackets the ends of the 95 % interval.",
    )  # fmt: skip


def _hit(folder: Path) -> list[str]:
    rows = exposure_rows(folder)
    if not rows:
        return []
    worst = max(rows, key=lambda row: float(row["p_reached"]))
    hit = sum(float(row["p_reached"]) > 0.0 for row in rows)
    return [
        f"Some members reach {hit} of the {len(rows)} polygons given as exposed; the most probable one is "
        f"{worst['id']}, with {_percent(worst, 'p_reached')} %."
    ]


def _percent(row: Mapping[str, str], name: str) -> str:
    ends = [row.get(f"{name}{end}", "") for end in ("_low", "_high")]
    interval = f" ({100.0 * float(ends[0]):.0f}–{100.0 * float(ends[1]):.0f})" if all(ends) else ""
    return f"{100.0 * float(row[name]):.0f}{interval}"


def _seconds(row: Mapping[str, str], kind: str) -> str:
    text = row.get(f"{kind}_arrival_s", "")
    return rounded(float(text)) if text else ""


def _plain(value: Any) -> Any:
    """Return plain values without empty ones."""
    if isinstance(value, Mapping):
        return {str(key): _plain(one) for key, one in value.items() if one not in (None, [], {})}
    return [_plain(one) for one in value] if isinstance(value, list | tuple) else value
