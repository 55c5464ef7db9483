"""Use of the files of a case, as by a user: read, build, run some steps."""

import contextlib
import dataclasses
import logging
import traceback
from pathlib import Path
from typing import NamedTuple

import numpy as np
from landlab import FieldError

from landlab_debrisflow import DebrisFlow, InputError, ParameterError, SimulationError
from landlab_debrisflow.run.scene import Scene

from . import checkpoints, records
from .cases import Case

REFUSALS = (InputError, ParameterError, FieldError)
MOST_STEPS = 5
PACKAGE = "landlab_debrisflow"


class Outcome(NamedTuple):
    """How a case ended: the class of the outcome, words for it, what was changed."""

    name: str
    words: str = ""
    done: str = ""


class _Enough(Exception):
    """Raised after some steps."""


class _Stopper:
    """Observer that ends a run after some steps."""

    interval = 1e9

    def __init__(self) -> None:
        self.steps = 0

    def observe(self, flow) -> None:
        """Do nothing."""

    def follow(self, particles, began, time) -> None:
        """Count a step."""
        self.steps += 1
        if self.steps > MOST_STEPS:
            raise _Enough


class _Warnings(logging.Handler):
    """Handler that keeps messages."""

    def __init__(self) -> None:
        super().__init__(logging.WARNING)
        self.messages: list[str] = []

    def emit(self, record) -> None:
        """Keep a message."""
        self.messages.append(record.getMessage())


@contextlib.contextmanager
def _kept_warnings():
    """Keep the warnings of the package in a block instead of showing them; yield the list of messages."""
    handler, logger = _Warnings(), logging.getLogger(PACKAGE)
    propagates, logger.propagate = logger.propagate, False
    logger.addHandler(handler)
    try:
        yield handler.messages
    finally:
        logger.removeHandler(handler)
        logger.propagate = propagates


def read(case: Case, folder: Path) -> Outcome:
    """Write and read the files of a case in an empty directory.

    Outcomes are "accepted", "warned", "refused", "diverged" (the simulation said so), and of those that must not be
    "error" (another exception), "not finite" and "written" (a reader wrote a file).
    """
    done = case.write(folder)
    before = sorted(folder.rglob("*"))
    try:
        try:
            with _kept_warnings() as messages:
                if case.kind == "checkpoint":
                    notes = _read_checkpoint(folder)
                elif case.kind == "record":
                    notes = records.read(folder)
                else:
                    notes = read_scene(folder, case.sampled)
        finally:
            written = [path.name for path in sorted(folder.rglob("*")) if path not in before]
    except REFUSALS as error:
        return Outcome("refused", str(error), done)
    except SimulationError as error:
        return Outcome("diverged", str(error), done)
    except BaseException as error:
        frames = [one for one in traceback.extract_tb(error.__traceback__) if f"/{PACKAGE}/" in one.filename]
        place = f"{frames[-1].filename.rpartition(PACKAGE)[2]}:{frames[-1].lineno}" if frames else "?"
        return Outcome("error", f"{type(error).__name__}: {error} at {place}\n{traceback.format_exc()}", done)
    if written and case.kind != "record":  # there a run begins
        return Outcome("written", ", ".join(written), done)
    notes = [*notes, *messages]
    if "not finite" in notes:
        return Outcome("not finite", "", done)
    return Outcome("warned" if notes else "accepted", "; ".join(notes), done)


def read_scene(folder: Path, run: bool) -> list[str]:
    """Read a scene and all its files; run a flow for some steps."""
    scene = Scene.from_file(folder / "scene.yaml")
    notes = list(scene.notes)
    scene.setup, scene.places, scene.digest(), scene.to_mapping(), repr(scene)
    grid = scene.grid()
    if not run:
        return notes
    stopper, numerics = _Stopper(), scene.setup.numerics
    scene.setup = dataclasses.replace(
        scene.setup, numerics=dataclasses.replace(numerics, particle_count=min(60, numerics.particle_count or 60))
    )
    flow = scene.flow(grid, observers=stopper)
    return notes + _run(flow)


def _read_checkpoint(folder: Path) -> list[str]:
    """Load a checkpoint; run the flow for some steps."""
    stopper = _Stopper()
    observers = checkpoints.observers()
    flow = DebrisFlow.load(folder / "checkpoint.nc", observers=observers)
    flow._observers = (*flow._observers, stopper)
    return _run(flow)


def _run(flow: DebrisFlow) -> list[str]:
    with contextlib.suppress(_Enough):
        flow.run_one_step(2.0)
    flow._repr_html_()
    found = [flow.particles[name].values for name in ("x", "y", "thickness") if name in flow.particles]
    found += [np.nan_to_num(flow.grid.at_node["debris_flow__depth"])]
    return [] if all(np.isfinite(values).all() for values in found) else ["not finite"]
