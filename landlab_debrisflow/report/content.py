"""Content of a report, gathered from the files in the directory of a run."""

import dataclasses
from collections.abc import Iterator
from datetime import UTC, datetime

import xarray as xr

from ..core.version import __version__
from ..run.record import RunRecord
from ..run.recorded import Recorded, read_recorded
from ..run.results import Results
from .blocks import Block, Section, Sentences, Table, Verbatim, line
from .cautions import DISTRUST, NOT_MODELLED
from .citation import SENTENCE, bibtex
from .errors import error_blocks
from .exposure import Exposed, exposed, exposure_table
from .inputs import input_blocks
from .ledger import ledger_blocks
from .moving import moving_pictures
from .outcome import outcome_of
from .parameters import law_blocks, scene_blocks
from .pictures import column_pictures, map_pictures, section_pictures, series_pictures, volume_pictures
from .summary import BEYOND, state_of, summary_of

NOT_KEPT = "The version that made the run did not keep these."


@dataclasses.dataclass(frozen=True, kw_only=True)
class Content:
    """Content of a report.

    Attributes
    ----------
    title : str
        Name of the scene.
    kind : str
        Kind of the page, day of the run and version.
    state : str
        At rest, still moving, not finished.
    alert : str
        Sentence on a run that has not come to its end; empty otherwise.
    summary : Sentences
    sections : list of Section
    made : str
        Command, version and time with which the page was made.
    """

    title: str
    kind: str
    state: str
    alert: str
    summary: Sentences
    sections: list[Section]
    made: str

    def __post_init__(self) -> None:
        for name in ("title", "kind", "state", "alert", "made"):
            object.__setattr__(self, name, line(getattr(self, name)))


def gather_content(results: Results) -> Content:
    """Gather the content of the report of a run.

    Parameters
    ----------
    results : Results

    Returns
    -------
    Content

    Raises
    ------
    InputError
        If a file of the run is damaged.
    """
    record = results.record
    state, alert = state_of(results)
    recorded = read_recorded(results.directory) if results.finished else Recorded(results.directory)
    exposure = exposed(results) if results.finished else None
    summary = [] if recorded.maps is None else summary_of(record, outcome_of(recorded.maps), exposure)
    kind = f"Report of a run of {record.started[:10]}, landlab_debrisflow {record.version}"
    return Content(
        title=scene_name(results), kind=kind, state=state, alert=alert, summary=Sentences(summary),
        sections=list(_sections(results, recorded, exposure)), made=_made(),
    )  # fmt: skip


def scene_name(results: Results) -> str:
    """Return the name of the scene of a run: the name of its file, or of the directory of the results."""
    file = results.record.scene_file
    name = (file or str(results.directory.resolve())).replace("\\", "/").rstrip("/").rpartition("/")[2]
    return name.removesuffix(".yaml").removesuffix(".yml").removesuffix("_out") or name


def _sections(results: Results, recorded: Recorded, exposure: Exposed | None) -> Iterator[Section]:
    record, maps = results.record, recorded.maps
    if maps is not None:
        yield Section("errors", "How sure this is", [*error_blocks(results), Sentences([BEYOND])])
    yield Section("cautions", "Processes left out, and numbers to distrust", [
        Sentences([NOT_MODELLED]), Sentences(DISTRUST, listed=True),
    ])  # fmt: skip
    yield Section("remarks", "Notes, doubts and warnings", list(_remarks(record)))
    if maps is not None:
        yield Section("maps", "Maps", [*map_pictures(recorded, maps), *moving_pictures(recorded)])
        if sections := list(section_pictures(recorded, maps)):
            yield Section("sections", "Along the flow", sections)
        if series := list(series_pictures(recorded)):
            yield Section("series", "At sections and gauges", series)
        if columns := list(column_pictures(recorded)):
            yield Section("columns", "Pore pressure in a column", columns)
        if exposure is not None:
            yield Section("exposure", "Exposed polygons", [exposure_table(exposure)])
        yield Section("volumes", "Volumes", [*ledger_blocks(record.budget), *volume_pictures(recorded)])
    yield Section("input", "Input", input_blocks(record, maps))
    yield Section("scene", "The scene as it was given", scene_blocks(record))
    yield Section("parameters", "Laws and parameters", law_blocks(record, maps))
    yield Section("provenance", "How this was made", list(_provenance(results, maps)))
    yield Section("citation", "Citation", [Sentences([SENTENCE]), Verbatim(bibtex(record.version, _year(record)))])


def _remarks(record: RunRecord) -> Iterator[Block]:
    kinds = (
        ("Notes on files and values", record.notes), ("Odd before the run, as check prints it", record.doubts),
        ("Warnings while it ran", record.warnings),
    )  # fmt: skip
    for heading, found in kinds:
        if found is None:
            yield Sentences([f"{heading}: {NOT_KEPT}"])
        elif found:
            yield Sentences([f"{heading}:"])
            yield Sentences([str(one) for one in found], listed=True)
        else:
            yield Sentences([f"{heading}: none."])


def _provenance(results: Results, maps: xr.Dataset | None) -> Iterator[Block]:
    record = results.record
    rows = [
        ("package", f"landlab_debrisflow {record.version}"), ("started", record.started),
        *([("digest of the scene", str(maps.attrs["scene_digest"]))] if maps and "scene_digest" in maps.attrs else []),
        ("digest of keys and files", record.digest), ("time steps", str(record.steps)),
    ]  # fmt: skip
    if record.environment is None:
        yield Table(caption="The run", rows=rows)
        yield Sentences([f"Python, libraries and machine: {NOT_KEPT}"])
        return
    found = record.environment
    libraries = found.get("libraries") or {}
    rows += [
        ("Python", str(found.get("python"))),
        ("machine", f"{found.get('machine')}, {found.get('system')}, {found.get('processors')} processors"),
        ("libraries", ", ".join(f"{name} {version}" for name, version in libraries.items())),
    ]
    yield Table(caption="The run", rows=rows)
    if record.statement is not None and results.report:
        yield Verbatim(results.report)


def _made() -> str:
    now = datetime.now(UTC).strftime("%Y-%m-%d %H:%M UTC")
    return f"Made by landlab-debrisflow report, version {__version__}, on {now}, from the files that the run wrote."


def _year(record: RunRecord) -> str:
    return record.started[:4] if record.started[:4].isdigit() else ""
