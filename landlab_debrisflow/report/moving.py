"""Animation of a run for its report, if maps were written as it went."""

import tempfile
from collections.abc import Iterator
from pathlib import Path

import xarray as xr

from ..core.errors import InputError
from ..plots import animate, save_animation
from ..run.files import SERIES
from ..run.results import Results
from .blocks import Picture
from .pictures import data_uri

FRAMES, DPI, FRAMES_PER_SECOND = 60, 80, 6
"""Most times, dots per inch and times in a second of an animation: a page of a few MB can still be sent."""

NAMES = "depth", "speed"
"""Maps of which the first that a series holds is animated."""


def moving_pictures(results: Results, maps: xr.Dataset) -> Iterator[Picture]:
    """Yield the animation of the maps that a run wrote as it went, if it wrote any.

    Parameters
    ----------
    results : Results
    maps : xarray.Dataset
        Maps of the end.

    Yields
    ------
    Picture

    Raises
    ------
    InputError
        If the series of maps is damaged.
    """
    path = next((path for end in (".nc", ".zarr") if (path := results.directory / f"{SERIES}{end}").exists()), None)
    if path is None:
        return
    try:
        with xr.open_dataset(path, engine="netcdf4" if path.suffix == ".nc" else "zarr", chunks=None) as series:
            name = next((name for name in NAMES if f"debris_flow__{name}" in series), None)
            if name is None or series.sizes.get("time", 0) < 2:
                return
            content = _gif(series, maps, name)
            first, last = float(series["time"][0]), float(series["time"][-1])
    except (OSError, RuntimeError, KeyError) as error:
        raise InputError(
            f"cannot read {path}: {error}; the series of maps is damaged, run the scene anew with --overwrite"
        ) from error
    except ImportError as error:
        raise InputError(
            f'cannot read {path}: {error}; install the library: pip install "landlab_debrisflow[geo]"'
        ) from error
    words = f"Animation of the {name} of the flow from {first:.0f} to {last:.0f} s."
    yield Picture(uri=data_uri(content, "image/gif"), text=words, caption=words, moving=True)


def _gif(series: xr.Dataset, maps: xr.Dataset, name: str) -> bytes:
    with tempfile.TemporaryDirectory() as folder:
        animation = animate(series, maps, name, frames=FRAMES)
        path = save_animation(animation, Path(folder) / "flow.gif", frames_per_second=FRAMES_PER_SECOND, dpi=DPI)
        return path.read_bytes()
