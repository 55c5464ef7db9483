"""Remarks on a run for its record: notes on files, doubts about the scene, warnings while it runs."""

import contextlib
import logging
from collections.abc import Iterator
from typing import Any

from .directory import OutputDirectory
from .doubts import scene_doubts

log = logging.getLogger("landlab_debrisflow")


def remarks(scene: Any) -> dict[str, list[str]]:
    """Return notes and doubts about a `Scene` by their names in a record, as `check` prints them."""
    return {"notes": list(scene.notes), "doubts": list(scene_doubts(scene))}


@contextlib.contextmanager
def noted_warnings(directory: OutputDirectory) -> Iterator[None]:
    """Add the warnings of the package in a block to the record of a run, each once.

    An interruption is no warning: the state of the record tells it.
    """
    handler = _Collector()
    log.addHandler(handler)
    try:
        yield
    finally:
        log.removeHandler(handler)
        before = directory.record.warnings or []
        if (found := list(dict.fromkeys([*before, *handler.found]))) != directory.record.warnings:
            with contextlib.suppress(OSError):  # the disk is full: the run fails for that, if it has not failed yet
                directory.note(warnings=found)


class _Collector(logging.Handler):
    """Handler that keeps warnings."""

    def __init__(self) -> None:
        super().__init__(logging.WARNING)
        self.found: list[str] = []

    def emit(self, record: logging.LogRecord) -> None:
        """Keep a warning."""
        if record.module != "interruption":
            self.found.append(record.getMessage())
