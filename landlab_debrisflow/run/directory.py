"""Directory of the results of a run: one run at a time, no file of another run, nothing half written."""

import contextlib
import dataclasses
import os
import re
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from ..core.errors import InputError, OutputError
from ..core.version import __version__
from ..record.checkpoint_file import previous_path
from ..record.files import check_directory
from .files import CHECKPOINT, LOCK, PAGE, PICTURES, RECORD, SERIES, SERIES_SUFFIX, UNFINISHED
from .record import FINISHED, FREE, RunRecord

WRITTEN = (
    ", a run or its pictures; wait for it, or choose another directory (output: directory in the scene, --output of "
    "plot)"
)
"""Words for a directory of results that another process has claimed."""

TEMPORARY = re.compile(r"\.(run|checkpoint|checkpoint\.previous|maps_\d+)\.\d+\.(json|nc)")
"""Names of files that are being written (record/files.py)."""


class OutputDirectory:
    """Directory of the results of one run.

    Parameters
    ----------
    path : Path
        It need not exist, but the directory above must.

    Attributes
    ----------
    record : RunRecord or None
        Record of the run whose results are there; None if there is none.
    """

    def __init__(self, path: Path):
        self.path = path
        self.record = RunRecord.read(path / RECORD) if (path / RECORD).is_file() else None

    @classmethod
    @contextlib.contextmanager
    def claimed(cls, path: Path) -> Iterator["OutputDirectory"]:
        """Claim a directory for the run in a block; it is made if it is missing, and removed if it stays empty.

        Raises
        ------
        OutputError
            If it cannot be made or written to, or another process has claimed it.
        """
        if path.exists() and not path.is_dir():
            raise OutputError(f"cannot write results to {path}: it is a file; set output: directory to another name")
        try:
            path.mkdir(exist_ok=True)
        except OSError as error:
            raise OutputError(f"cannot make the directory {path}: {error.strerror}; set output: directory") from error
        check_directory(path)
        try:
            with locked(path, WRITTEN):
                _remove_temporaries(path)
                yield cls(path)
        finally:
            with contextlib.suppress(OSError):  # the directory is not empty after a run
                path.rmdir()

    @property
    def checkpoint(self) -> Path:
        """Path of the checkpoint."""
        return self.path / CHECKPOINT

    @property
    def checkpoints(self) -> list[Path]:
        """Checkpoints in the directory, the latest first."""
        return checkpoints_in(self.path)

    def begin(self, record: RunRecord, overwrite: bool = False) -> None:
        """Begin a run here: refuse to lose results, remove them if they may go, write its record.

        Parameters
        ----------
        record : RunRecord
            Record of the run that begins.
        overwrite : bool
            Whether the results of an earlier run may be removed; other files stay.

        Raises
        ------
        InputError
            If there are results, or files of something else.
        """
        if self.record is None:
            if others := sorted(path.name for path in self.path.iterdir() if not path.name.startswith(".")):
                raise InputError(
                    f"{self.path} holds files that are no results of a run, such as {others[0]!r}; set output: "
                    "directory to another name, or move them"
                )
        elif not overwrite:
            self._refuse(record)
        self.remove_results()
        self.record = record
        self.note()

    def _refuse(self, record: RunRecord) -> None:
        found = self.record.differences(record)
        if found:
            raise InputError(
                f"{self.path} holds results of another scene: {listed(found)}; run with --overwrite (overwrite=True) "
                "to replace them, or set output: directory to another name"
            )
        if self.record.state == FINISHED:
            raise InputError(
                f"{self.path} holds the results of this scene already, until {self.record.elapsed_time:.6g} s; run "
                "with --overwrite (overwrite=True) to compute them anew"
            )
        if self.checkpoints:
            raise InputError(
                f"{self.path} holds a run of this scene that was not finished; landlab-debrisflow resume {self.path} "
                "goes on with it, run with --overwrite (overwrite=True) begins anew"
            )

    def check_scene(self, record: RunRecord) -> None:
        """Refuse to go on with another scene than that of the run.

        Parameters
        ----------
        record : RunRecord
            Record of the scene as it is now.

        Raises
        ------
        InputError
            If a difference changes results, or the scene is to end earlier than the run has come.
        """
        if found := self.record.differences(record, FREE):
            raise InputError(
                f"cannot go on with the run in {self.path}: the scene has changed since: {listed(found)}; undo that, "
                "or run it anew with --overwrite"
            )
        if self.record.version != __version__:
            raise InputError(
                f"cannot go on with the run in {self.path}: version {self.record.version} began it, this is "
                f"{__version__}; install that version, or run it anew with --overwrite"
            )

    def note(self, **changes: Any) -> None:
        """Change attributes of the record and write it."""
        self.record = dataclasses.replace(self.record, **changes)
        self.record.write(self.path / RECORD)

    def expect(self, *names: str) -> None:
        """Note names of files that are about to be written here, with ``*`` for any name."""
        if new := [name for name in names if name not in self.record.files]:
            self.note(files=[*self.record.files, *new])

    def publish(self, write: Callable[[Path], object]) -> list[str]:
        """Write files that appear in the directory together, when all are complete; return their names.

        Parameters
        ----------
        write : callable
            Called with an empty directory, into which it writes the files.
        """
        temporary = self.path / UNFINISHED
        shutil.rmtree(temporary, ignore_errors=True)
        temporary.mkdir()
        try:
            write(temporary)
            names = sorted(path.name for path in temporary.iterdir())
            self.expect(*names)
            for name in names:
                if (self.path / name).is_dir():
                    shutil.rmtree(self.path / name)
                os.replace(temporary / name, self.path / name)
        finally:
            shutil.rmtree(temporary, ignore_errors=True)
        return names

    def tidy(self) -> None:
        """Remove checkpoints and the single maps of a series, which only a run that goes on needs."""
        self._remove_checkpoints()
        if any((self.path / f"{SERIES}{suffix}").exists() for suffix in SERIES_SUFFIX.values()):
            for path in self.path.glob(f"{SERIES}/maps_*.nc"):
                path.unlink()
            with contextlib.suppress(OSError):  # it holds other files
                (self.path / SERIES).rmdir()

    def remove_page(self) -> None:
        """Remove report and pictures, which tell of a run as it was."""
        (self.path / PAGE).unlink(missing_ok=True)
        names = self.record.results if self.record else []
        for name in (name for name in names if name.startswith(f"{PICTURES}/")):
            (self.path / name).unlink(missing_ok=True)

    def _remove_checkpoints(self) -> None:
        for path in self.checkpoints:
            path.unlink()

    def remove_results(self) -> None:
        """Remove the files that the recorded run wrote here, and the page made of them; other files stay."""
        shutil.rmtree(self.path / UNFINISHED, ignore_errors=True)
        if self.record is None:
            return
        self._remove_checkpoints()
        self.remove_page()
        folder = self.path.resolve()
        for name in self.record.results:
            for path in sorted(self.path.glob(name)):
                if not path.parent.resolve().is_relative_to(folder):
                    continue
                if path.is_file() or path.is_symlink():
                    path.unlink()
                elif path.suffix == ".zarr" and (path / "zarr.json").is_file():
                    shutil.rmtree(path)
            with contextlib.suppress(OSError):  # it holds other files
                if (parent := (self.path / name).parent) != self.path:
                    parent.rmdir()
        (self.path / RECORD).unlink(missing_ok=True)


def checkpoints_in(directory: Path) -> list[Path]:
    """Return the checkpoints in a directory of results, the latest first."""
    latest = directory / CHECKPOINT
    return [path for path in (latest, previous_path(latest)) if path.is_file()]


def listed(words: list[str], most: int = 3) -> str:
    """Return the first words of a list as one text, with the number of the rest.

    Examples
    --------
    >>> listed(["a", "b", "c", "d", "e"])
    'a; b; c; and 2 more'
    """
    return "; ".join([*words[:most], *([f"and {len(words) - most} more"] if len(words) > most else [])])


def _remove_temporaries(directory: Path) -> None:
    """Remove files that a process was writing here when it was killed."""
    for path in (*directory.glob(".*"), *directory.glob(f"{SERIES}/.*")):
        if TEMPORARY.fullmatch(path.name) and not path.is_dir():
            path.unlink()


@contextlib.contextmanager
def locked(directory: Path, remedy: str, name: str = LOCK) -> Iterator[None]:
    """Hold a lock on a directory until the block or the process ends, even if the process is killed.

    Parameters
    ----------
    directory : Path
    remedy : str
        Words for the process that finds the directory locked.
    name : str
        File that is the lock, below the directory.

    Raises
    ------
    OutputError
        If another process holds the lock.
    """
    try:
        import fcntl
    except ImportError:  # on Windows two runs in one directory are not noticed
        yield
        return
    path = directory / name
    with path.open("w") as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError as error:
            raise OutputError(f"cannot write results to {directory}: another process writes there{remedy}") from error
        try:
            yield
        finally:
            path.unlink(missing_ok=True)
