"""Run a scene from its first release to rest, or go on with a run, and write its results."""

import contextlib
import dataclasses
import logging
import math
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

from ..component import DebrisFlow
from ..core.compilations import compilations
from ..core.errors import InputError
from ..fidelity.plan import Plan
from ..fidelity.statement import Statement
from ..record.monitor import COMPILING, Monitor
from ..scene.releases import advance
from .advance import check_mass
from .directory import OutputDirectory
from .environment import environment
from .files import RECORD, REPORT, SCENE
from .maps import write_results
from .observers import Observers
from .record import FAILED, FINISHED, INTERRUPTED, RUNNING, RunRecord
from .remarks import noted_warnings, remarks
from .results import Results

log = logging.getLogger("landlab_debrisflow")


def run_scene(scene: Any, *, overwrite: bool = False, monitor: Monitor | None = None) -> Results:
    """Run a scene to rest and write its results.

    Parameters
    ----------
    scene : Scene
    overwrite : bool
        Whether the results of an earlier run in its output directory may be removed.
    monitor : Monitor, optional
        Shows the progress of the run; by default a line on the terminal or in the notebook.

    Returns
    -------
    Results
        The files appear in `Scene.output_directory` when all are complete.

    Raises
    ------
    InputError, ParameterError
        If a value or a file of the scene cannot be used, or the directory holds files of something else than this run.
    OutputError, OSError
        If a file cannot be written. The run is kept up to the last checkpoint.
    KeyboardInterrupt
        After the step. The run is kept up to this step: `resume_scene` goes on.
    """
    _ = scene.places
    check_mass(scene)  # before files are written, or earlier results removed
    with OutputDirectory.claimed(scene.output_directory) as directory:
        directory.begin(_record(scene, directory), overwrite)
        scene = _planned(scene, directory, monitor)
        return _compute(scene, directory, scene.flow, monitor)


def resume_scene(scene: Any, *, monitor: Monitor | None = None) -> Results:
    """Go on with the run of a scene from its last checkpoint, to the results of a run without interruption.

    Without a checkpoint the run begins anew. A run that had come to its end stays as it is, unless it still moved and
    the scene now has a longer `max_duration`.

    Parameters
    ----------
    scene : Scene
    monitor : Monitor, optional
        As in `run_scene`.

    Returns
    -------
    Results

    Raises
    ------
    InputError
        If there is no run of this scene, or the scene or a file of it has changed.
    OutputError, OSError, KeyboardInterrupt
        As in `run_scene`.
    """
    path = scene.output_directory
    if not (path / RECORD).is_file():
        raise InputError(f"{path} holds no run to go on with; landlab-debrisflow run begins one")
    with OutputDirectory.claimed(path) as directory:
        record = _record(scene, directory)
        directory.check_scene(record)
        longest = scene.output_keys.max_duration
        if directory.record.state == FINISHED and (
            directory.record.at_rest or longest <= directory.record.elapsed_time
        ):
            log.warning("the run in %s had come to its end; nothing is to be done", path)
            if directory.record.at_rest:
                directory.tidy()
            return Results(path)
        if not directory.checkpoints:
            log.warning("the run in %s had no checkpoint yet; it begins anew", path)
            directory.begin(dataclasses.replace(record, plan=directory.record.plan), overwrite=True)
            scene = _planned(scene, directory, monitor)
            return _compute(scene, directory, scene.flow, monitor)
        directory.note(scene=record.scene, digest=record.digest)
        scene = _planned(scene, directory, monitor)
        return _compute(scene, directory, lambda observers: _load(directory, observers), monitor)


def _planned(scene: Any, directory: OutputDirectory, monitor: Monitor | None) -> Any:
    """Return the scene with the plan of its run, if a plan is to choose the number of particles; make a missing one."""
    if not scene.setup.numerics.automatic:
        return scene
    if directory.record.plan is not None:
        return scene.with_plan(Plan.from_mapping(directory.record.plan, scene.setup))
    monitor = monitor or Monitor()
    try:
        with compilations(lambda: monitor.say(COMPILING)):
            plan = scene.plan(notify=monitor.say)
    except BaseException as failure:
        _note_failure(directory, failure, 0.0)
        raise
    finally:
        monitor.close()
    directory.note(plan=plan.to_mapping())
    return scene.with_plan(plan)


def _record(scene: Any, directory: OutputDirectory) -> RunRecord:
    file = scene.path and os.path.relpath(scene.path.resolve(), directory.path.resolve())
    return RunRecord.of(scene, file)


def _load(directory: OutputDirectory, observers: list) -> DebrisFlow:
    """Return the flow of the latest checkpoint that is whole."""
    *earlier, last = directory.checkpoints
    for path in earlier:
        try:
            return DebrisFlow.load(path, observers=observers)
        except InputError as error:
            log.warning("%s; the checkpoint before it is taken", error)
    return DebrisFlow.load(last, observers=observers)


def _compute(
    scene: Any, directory: OutputDirectory, build: Callable[..., DebrisFlow], monitor: Monitor | None
) -> Results:
    """Run the flow that `build` returns when it is given observers, and write the results of its scene."""
    monitor = monitor or Monitor()
    flow = None
    try:
        monitor.expect(scene.output_keys.max_duration, scene.setup.numerics.rest_energy)
        directory.remove_page()
        directory.note(
            state=RUNNING, environment=environment(), warnings=directory.record.warnings or [], **remarks(scene)
        )
        if scene.text is not None:
            directory.publish(lambda folder: (folder / SCENE).write_text(scene.text, encoding="utf-8"))
        observers = Observers(scene, directory)
        with compilations(lambda: monitor.say(COMPILING)), noted_warnings(directory):
            flow = build(observers=[monitor, *observers.all])
            advance(flow, scene.releases, scene.output_keys.max_duration)
        monitor.finish()
        directory.publish(lambda folder: _write(folder, flow, scene, observers))
        if not flow.at_rest:
            flow.save(directory.checkpoint)
        directory.note(
            state=FINISHED, reason="", elapsed_time=flow.elapsed_time, at_rest=flow.at_rest, budget=flow.budget,
            steps=flow.diagnostics.steps, statement=_statement(flow).to_mapping() if scene.adopted_plan else None,
        )  # fmt: skip
    except BaseException as failure:
        monitor.finish()
        if isinstance(failure, KeyboardInterrupt) and flow is not None and flow.unfinished_until is None:
            with contextlib.suppress(OSError, InputError):  # between two calls no observer has saved it
                flow.save(directory.checkpoint)
        _note_failure(directory, failure, 0.0 if flow is None else flow.elapsed_time)
        raise
    if flow.at_rest:
        directory.tidy()
    return Results(directory.path)


def _note_failure(directory: OutputDirectory, failure: BaseException, time: float) -> None:
    """Note why a run ended early at a time [s], and add to the failure how to go on."""
    state = INTERRUPTED if isinstance(failure, KeyboardInterrupt) else FAILED
    failure.__notes__ = [f"at {time:.6g} s"] if time > 0.0 else []  # replaces the note for callers of a flow
    with contextlib.suppress(OSError, ValueError):  # the disk may be full
        if not directory.checkpoints and time == 0.0:
            directory.remove_results()
            failure.add_note("nothing was kept")
            return
        directory.note(state=state, elapsed_time=time, reason=f"{type(failure).__name__}: {failure}")
    if directory.checkpoints:
        failure.add_note(f"a checkpoint is kept: landlab-debrisflow resume {directory.path} goes on from there")
    else:
        failure.add_note("there was no checkpoint yet: landlab-debrisflow run begins anew")


def _write(folder: Path, flow: DebrisFlow, scene: Any, observers: Observers) -> None:
    write_results(folder, flow.maps, scene)
    observers.write(folder)
    if scene.adopted_plan is not None:
        (folder / REPORT).write_text(f"{_statement(flow)}\n", encoding="utf-8")


def _statement(flow: DebrisFlow) -> Statement:
    return dataclasses.replace(flow.report(), seconds=math.nan)  # left out, so that equal runs write equal files
