"""Animation of a run for its report, if maps were written as it went."""

import tempfile
from collections.abc import Iterator
from pathlib import Path

from ..plots import animate, save_animation
from ..run.recorded import Recorded
from .blocks import Picture
from .pictures import data_uri

FRAMES, DPI, FRAMES_PER_SECOND = 60, 80, 6
"""Most times, dots per inch and times in a second of an animation: a page of a few MB can still be sent."""


def moving_pictures(recorded: Recorded) -> Iterator[Picture]:
    """Yield the animation of the maps that a run wrote as it went, if it wrote two or more times.

    Parameters
    ----------
    recorded : Recorded

    Yields
    ------
    Picture
    """
    name, series = recorded.animated, recorded.datasets.get("series")
    if name is None or series is None or series.sizes["time"] < 2:
        return
    with tempfile.TemporaryDirectory() as folder:
        animation = animate(series, recorded.maps, name, frames=FRAMES)
        path = save_animation(animation, Path(folder) / "flow.gif", frames_per_second=FRAMES_PER_SECOND, dpi=DPI)
        content = path.read_bytes()
    first, last = float(series["time"][0]), float(series["time"][-1])
    words = f"Animation of the {name.replace('_', ' ')} of the flow from {first:.0f} to {last:.0f} s."
    yield Picture(uri=data_uri(content, "image/gif"), text=words, caption=words, moving=True)
