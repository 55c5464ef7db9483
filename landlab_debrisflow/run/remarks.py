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
    """Add the warnings of the package in a block to the record of a run, each once, as they come.

    An interruption is no warning: the state of the record tells it.
    """
    handler = _Noter(directory)
    log.addHandler(handler)
    try:
        yield
    finally:
        log.removeHandler(handler)


class _Noter(logging.Handler):
    """Handler that notes warnings in a record, so that a run that is killed has told them."""

    def __init__(self, directory: OutputDirectory):
        super().__init__(logging.WARNING)
        self._directory = directory

    def emit(self, record: logging.LogRecord) -> None:
        """Note a warning."""
        found, message = self._directory.record.warnings or [], record.getMessage()
        if record.module != "interruption" and message not in found:
            with contextlib.suppress(OSError):  # a full disk ends the run, not its warnings
                self._directory.note(warnings=[*found, message])
