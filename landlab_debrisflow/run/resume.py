"""Go on with a run, given its directory or its scene file."""

import os
from pathlib import Path

from ..core.errors import InputError
from ..record.monitor import Monitor
from .results import Results
from .runner import resume_scene
from .scene import Scene


def resume(path: str | Path, *, monitor: Monitor | None = None) -> Results:
    """Go on with a run, given the directory of its results or its scene file; see `resume_scene`.

    Parameters
    ----------
    path : str or Path
    monitor : Monitor, optional

    Returns
    -------
    Results
    """
    path = Path(path)
    if path.is_dir():
        file = Results(path).record.scene_file
        if file is None:
            raise InputError(f"{path}: the run came from no scene file; go on with Scene(...).resume() in Python")
        scene = Scene.from_file(Path(os.path.normpath(path / file)))
        if scene.output_directory.resolve() != path.resolve():
            raise InputError(
                f"{path} was written by {file}, which now writes to {scene.output_directory}; change output: directory"
            )
    else:
        scene = Scene.from_file(path)
    return resume_scene(scene, monitor=monitor)
