"""Run a scene from its first release to rest, and write its results."""

from pathlib import Path
from typing import Any

from ..record.files import write_dataset
from ..scene.releases import set_release


def run_scene(scene: Any) -> Path:
    """Run a scene to rest and write its results; return the directory they are in."""
    directory = scene.output_directory
    flow = scene.flow()
    for release in scene.releases:
        if release.time > flow.elapsed_time:
            flow.run_until_rest(release.time - flow.elapsed_time)
            if release.time > flow.elapsed_time:
                flow.run_one_step(release.time - flow.elapsed_time)
            set_release(flow.grid, release)
    flow.run_until_rest(scene.output_keys.max_duration - flow.elapsed_time)
    directory.mkdir(exist_ok=True)
    write_dataset(directory / "maps.nc", flow.maps)
    return directory
