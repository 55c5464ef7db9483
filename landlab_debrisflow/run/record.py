"""Record of a run in its directory: scene, digests of its files, versions, and progress."""

import dataclasses
import json
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from ..core.errors import InputError
from ..core.version import __version__
from ..geo.rasters import checksum_of
from ..record.files import write_atomically
from ..scene.content import leaves, named_files
from ..scene.digest import digest
from .files import is_result
from .record_checks import check_record

FORMAT = 2
"""Version of the record: 2 has the keys given, remarks, environment and statement; 1 has none of these."""

READABLE = (1, FORMAT)
"""Versions that are read."""

RUNNING, INTERRUPTED, FAILED, FINISHED = "running", "interrupted", "failed", "finished"

FREE = ("output.directory", "output.max_duration", "output.checkpoint_interval")
"""Keys that may differ when a run goes on: its numbers until then are the same."""


@dataclasses.dataclass(frozen=True, kw_only=True)
class RunRecord:
    """Record of a run.

    Attributes
    ----------
    scene : dict
        Scene as plain values.
    inputs : dict of str to str
        SHA-256 of the files that it names.
    digest : str
        Digest of both.
    scene_file : str or None
        The scene file, relative to the directory of the results; None for a scene without a file.
    state : str
        ``running`` (or killed), ``interrupted``, ``failed`` or ``finished``.
    elapsed_time : float
        Elapsed time at the end, or at the interruption [s].
    at_rest : bool
        Whether the whole flow came to rest.
    steps : int
        Number of time steps.
    budget : dict of str to float
        Volumes at the end [m3].
    files : list of str
        Files that were written, from the directory; with ``*`` for any name.
    reason : str
        Reason of a failure.
    plan : dict or None
        Plan as plain values, if the number of particles was left to one.
    given : list of str or None
        Keys of the scene that were given, with the keys above them in front, such as ``friction.cohesion``; others
        have their defaults. None in this and the following: a version that did not keep it wrote the record.
    notes, doubts, warnings : list of str or None
        Remarks on files, what is odd in the scene (both as `check` prints them), and warnings while it ran.
    environment : dict or None
        Kind of machine and versions of libraries, of the process that ran last.
    statement : dict or None
        Particles, column, steps and stated errors as plain values, of a run by a plan that came to its end.
    """

    scene: dict[str, Any]
    inputs: dict[str, str]
    digest: str
    scene_file: str | None = None
    state: str = RUNNING
    elapsed_time: float = 0.0
    at_rest: bool = False
    steps: int = 0
    budget: dict[str, float] = dataclasses.field(default_factory=dict)
    files: list[str] = dataclasses.field(default_factory=list)
    reason: str = ""
    plan: dict[str, Any] | None = None
    given: list[str] | None = None
    notes: list[str] | None = None
    doubts: list[str] | None = None
    warnings: list[str] | None = None
    environment: dict[str, Any] | None = None
    statement: dict[str, Any] | None = None
    started: str = dataclasses.field(default_factory=lambda: _now())
    version: str = __version__
    format: int = FORMAT

    @classmethod
    def of(cls, scene: Any, scene_file: str | None = None) -> "RunRecord":
        """Return the record of a `Scene` that is about to run."""
        mapping = json.loads(json.dumps(scene.to_mapping()))
        inputs = {name: checksum_of(path) for name, path in named_files(mapping, scene.folder).items()}
        return cls(
            scene=mapping,
            inputs=inputs,
            digest=digest([mapping, inputs]),
            scene_file=scene_file,
            given=list(scene.given_keys),
        )

    @classmethod
    def read(cls, path: Path) -> "RunRecord":
        """Read a record.

        Raises
        ------
        InputError
            If the file cannot be read or is no record.
        """
        try:
            values = json.loads(path.read_text(encoding="utf-8"))
        except (OSError, ValueError, RecursionError) as error:
            raise InputError(
                f"cannot read {path}: {error}; it is the record of a run, give another directory"
            ) from error
        names = {field.name: field for field in dataclasses.fields(cls)}
        if not isinstance(values, dict) or values.get("format") not in READABLE:
            found = values.get("format") if isinstance(values, dict) else None
            raise InputError(
                f"{path} is no record of a run that this version ({__version__}) can read: format {found!r}, needed "
                f"{READABLE[0]} to {FORMAT}; read it with the version that wrote it, or run the scene with another "
                "output directory"
            )
        check_record(values, path)
        return cls(**{name: value for name, value in values.items() if name in names})

    @property
    def results(self) -> list[str]:
        """Names in `files` that runs write; a record is a file, too, and may list anything."""
        return [name for name in self.files if is_result(name)]

    def write(self, path: Path) -> None:
        """Write the record, atomically."""
        text = json.dumps(dataclasses.asdict(self) | {"format": FORMAT, "written": _now()}, indent=1)
        write_atomically(path, lambda temporary: temporary.write_text(text + "\n", encoding="utf-8"))

    def differences(self, other: "RunRecord", free: tuple[str, ...] = ()) -> list[str]:
        """Return the differences of another record in scene and files, `free` keys left out, as text."""
        mine, theirs = dict(leaves(self.scene)), dict(leaves(other.scene))
        keys = [key for key in dict.fromkeys([*mine, *theirs]) if mine.get(key) != theirs.get(key)]
        found = [
            f"{key} was {mine.get(key, 'not set')!r}, is {theirs.get(key, 'not set')!r}"
            for key in keys if key not in free
        ]  # fmt: skip
        names = dict.fromkeys([*self.inputs, *other.inputs])
        return found + [f"the file {name} changed" for name in names if self.inputs.get(name) != other.inputs.get(name)]


def _now() -> str:
    return datetime.now(UTC).strftime("%Y-%m-%dT%H:%M:%SZ")
