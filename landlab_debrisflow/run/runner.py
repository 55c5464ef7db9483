"""Run a scene from its first release to rest, and write its results."""

import contextlib
import os
from collections.abc import Callable
from pathlib import Path

from ..component import DebrisFlow
from ..core.jit import compilations
from ..record.monitor import COMPILING, Monitor
from .advance import advance
from .directory import OutputDirectory
from .files import SCENE
from .maps import write_results
from .observers import Observers
from .record import FAILED, FINISHED, INTERRUPTED, RUNNING, RunRecord
from .results import Results
from .scene import Scene


def run_scene(scene: Scene, *, overwrite: bool = False, monitor: Monitor | None = None) -> Results:
    """Run a scene to rest and write its results.

    Parameters
    ----------
    scene : Scene
    overwrite : bool
        Whether the results of an earlier run in its output directory may be removed.
    monitor : Monitor, optional
        Shows how the run gets on; by default a line on the terminal or in the notebook.

    Returns
    -------
    Results
        They appear in `Scene.output_directory` when all are complete.

    Raises
    ------
    InputError, ParameterError
        If something of the scene cannot be used, or the directory holds something else.
    OutputError, OSError
        If a file cannot be written. What was computed until the last checkpoint is kept.
    KeyboardInterrupt
        After the step. What was computed is kept.
    """
    _ = scene.releases  # what cannot be used is known before anything is written, and results of before removed
    with OutputDirectory.claimed(scene.output_directory) as directory:
        directory.begin(_record(scene, directory), overwrite)
        return _compute(scene, directory, scene.flow, monitor)


def _record(scene: Scene, directory: OutputDirectory) -> RunRecord:
    file = scene.file and os.path.relpath(Path(scene.file).resolve(), directory.path.resolve())
    return RunRecord.of(scene, file)


def _compute(scene: Scene, directory: OutputDirectory, build: Callable[..., DebrisFlow], monitor) -> Results:
    """Run the flow that `build` returns when it is given observers, and write the results of its scene."""
    monitor = monitor or Monitor()
    monitor.expect(scene.output_keys.max_duration, scene.setup.numerics.rest_energy)
    directory.note(state=RUNNING)
    if scene.file:
        text = Path(scene.file).read_bytes()
        directory.publish(lambda folder: (folder / SCENE).write_bytes(text))
    flow = None
    try:
        observers = Observers(scene, directory)
        with contextlib.closing(monitor), compilations(lambda: monitor.say(COMPILING)):
            flow = build(observers=[monitor, *observers.all])
            advance(flow, scene)
        directory.publish(lambda folder: _write(folder, flow, scene, observers))
    except BaseException as failure:
        time = 0.0 if flow is None else flow.elapsed_time
        state = INTERRUPTED if isinstance(failure, KeyboardInterrupt) else FAILED
        with contextlib.suppress(OSError, ValueError):  # the disk may be full
            if time == 0.0 and not directory.checkpoints:
                directory.remove_results()
            else:
                directory.note(state=state, elapsed_time=time, reason=f"{type(failure).__name__}: {failure}")
        raise
    directory.note(state=FINISHED, elapsed_time=flow.elapsed_time, at_rest=flow.at_rest, budget=flow.budget, reason="")
    return Results(directory.path)


def _write(folder: Path, flow: DebrisFlow, scene: Scene, observers: Observers) -> None:
    write_results(folder, flow.maps, scene)
    observers.write(folder)
