"""Pictures of a run, each as a file, from its directory or from a file of results."""

import contextlib
import logging
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from ..core.checks import in_range, require
from ..core.errors import InputError, OutputError
from ..core.hints import did_you_mean
from ..plots import (
    animate,
    draw_column,
    draw_gauges,
    draw_hydrographs,
    draw_map,
    draw_overview,
    draw_section,
    draw_time_distance,
    draw_tracks,
    draw_volumes,
    save_animation,
    save_figure,
)  # fmt: skip
from ..plots.animation import check_format
from ..plots.quantities import OVERVIEW, map_names
from .directory import OutputDirectory
from .files import PICTURES
from .recorded import Recorded, read_recorded

FORMATS = "png", "pdf", "svg"
ANIMATIONS = "gif", "mp4", "none"
ALL = "all"
"""Word for all maps."""

log = logging.getLogger("landlab_debrisflow")


def draw_pictures(
    path: str | Path,
    maps: Sequence[str] | None = None,
    *,
    form: str = "png",
    animation: str | None = None,
    to: str | Path | None = None,
    dpi: int = 150,
) -> Iterator[Path]:
    """Draw all that the results of a run can show; yield the path of each picture when it is written.

    Parameters
    ----------
    path : str or Path
        Directory of the results of a scene, or one file of results, such as ``maps.nc``. Of a run that was not
        finished its last checkpoint is drawn.
    maps : sequence of str, optional
        Names of maps, or ``all``; by default an overview, the maps of it, and those that the scene names.
    form : {"png", "pdf", "svg"}
        Format of pictures.
    animation : {"gif", "mp4", "none"}, optional
        Format of the animation of a series of maps; MP4 needs ffmpeg. By default GIF, if there is a series.
    to : str or Path, optional
        Directory of the pictures, which is made if that above exists; by default ``pictures`` in that of the results.
    dpi : int
        Dots per inch.

    Yields
    ------
    Path

    Raises
    ------
    InputError
        If there is nothing to draw, a map is not known, ffmpeg is missing, or an animation is wanted of no series.
    OutputError, OSError
        If a picture cannot be written.
    """
    require(form in FORMATS, "plot: format", f"be {', '.join(FORMATS)}", form, error=InputError)
    allowed = animation is None or animation in ANIMATIONS
    require(allowed, "plot: animation", f"be {', '.join(ANIMATIONS)}", animation, error=InputError)
    in_range("plot: dpi", dpi, 20, 1200, error=InputError)
    path = Path(path)
    recorded = read_recorded(path)
    moving = _format_of_animation(recorded, animation)
    drawings = _drawings(recorded, _chosen(recorded, maps), with_overview=maps is None or ALL in maps)
    with _folder(path, to) as (folder, note):
        for name, draw in drawings.items():
            file = folder / f"{name}.{form}"
            note(file)
            yield save_figure(draw(), file, dpi)
        if moving is not None:
            name = recorded.animated or "depth"
            file = folder / f"{name}.{moving}"
            note(file)
            series = animate(recorded.datasets["series"], recorded.maps, name, shapes=recorded.shapes)
            yield save_animation(series, file, dpi=min(dpi, 110))


def _format_of_animation(recorded: Recorded, wanted: str | None) -> str | None:
    """Return the format of the animation, None for none, or raise InputError if it cannot be made."""
    if wanted == "none" or (wanted is None and recorded.animated is None):
        return None
    if recorded.animated is None:
        raise InputError(
            f"plot: {recorded.path} holds no series of maps that could be animated; set output: interval in the scene, "
            "and run it anew with --overwrite"
        )
    form = wanted or "gif"
    check_format(f".{form}")
    return form


def _chosen(recorded: Recorded, names: Sequence[str] | None) -> list[str]:
    """Return the names of the maps to be drawn, or raise InputError if one is not there."""
    if recorded.maps is None:
        if names:
            raise InputError(f"plot: {recorded.path} holds no maps, and {', '.join(names)} cannot be drawn")
        return []
    there = map_names(recorded.maps)
    if names is None:
        return [name for name in there if name in (*OVERVIEW, *recorded.asked)]
    if ALL in names:
        return there
    names = [name.removeprefix("debris_flow__") for name in names]
    if unknown := [name for name in names if name not in there]:
        raise InputError(
            f"plot: no map {unknown[0]!r}{did_you_mean(unknown[0], [*there, ALL])}; there are {', '.join(there)}"
        )
    return list(dict.fromkeys(names))


def _drawings(recorded: Recorded, names: Sequence[str], with_overview: bool) -> dict[str, Callable[[], Any]]:
    """Return functions that return a figure, by the names of the files."""
    maps, found = recorded.maps, recorded.datasets
    drawings: dict[str, Callable[[], Any]] = {}
    if maps is not None:
        if with_overview and len([name for name in OVERVIEW if name in map_names(maps)]) > 1:
            drawings["overview"] = partial(draw_overview, maps, shapes=recorded.shapes)
        for name in names:
            places = _places(found) if name == "max_depth" else None
            drawings[re.sub(r"[^\w-]", "_", name)] = partial(
                draw_map, maps, name, shapes=recorded.shapes, places=places
            )
        if _moved(maps):
            drawings["section"] = partial(draw_section, maps, recorded.thalweg)
        if "tracks" in found:
            drawings["tracks"] = partial(draw_tracks, found["tracks"], maps)
    of_series = {
        "thalweg": ("time_distance", draw_time_distance),
        "sections": ("hydrographs", draw_hydrographs),
        "gauges": ("gauges", draw_gauges),
        "budget": ("volumes", draw_volumes),
        "columns": ("column", draw_column),
    }
    for name, (file, draw) in of_series.items():
        if name in found and found[name].sizes.get("time"):
            drawings[file] = partial(draw, found[name])
    if not drawings and "series" not in found:
        raise InputError(f"plot: {recorded.path} holds nothing that can be drawn: nothing was recorded in it")
    return drawings


def _places(found: Mapping[str, xr.Dataset]) -> dict[str, np.ndarray]:
    """Return lines of sections and points of gauges by name, each of shape (n, 2) [m]."""
    places: dict[str, np.ndarray] = {}
    if "sections" in found and "line_x" in found["sections"]:
        for section in found["sections"].section.values:
            one = found["sections"].sel(section=section)
            places[str(section)] = np.stack([one.line_x.values, one.line_y.values], axis=1)
    if "gauges" in found:
        gauges = found["gauges"]
        for name, x, y in zip(gauges.gauge.values, gauges.x.values, gauges.y.values, strict=True):
            places[str(name) if str(name) not in places else f"gauge {name}"] = np.array([[x, y]])
    return places


def _moved(maps: xr.Dataset) -> bool:
    """Return whether a long section can be drawn: the flow reached two nodes or more, and the ground is known."""
    depth = maps.get("debris_flow__max_depth")
    return "topographic__elevation" in maps and depth is not None and int((depth > 0.0).sum()) > 1


@contextlib.contextmanager
def _folder(path: Path, to: str | Path | None) -> Iterator[tuple[Path, Callable[[Path], None]]]:
    """Make the directory of the pictures; yield it, and a function that notes a picture in the record of the run."""
    if to is not None or not path.is_dir() or path.suffix == ".zarr":
        yield _made(Path(to) if to is not None else path.parent / f"{path.stem}_{PICTURES}"), lambda file: None
        return
    with OutputDirectory.claimed(path) as directory:
        yield _made(path / PICTURES), lambda file: directory.expect(f"{PICTURES}/{file.name}")


def _made(folder: Path) -> Path:
    try:
        folder.mkdir(exist_ok=True)
    except FileNotFoundError as error:
        raise InputError(f"cannot make {folder}: {folder.parent} does not exist; create it first (mkdir -p)") from error
    except FileExistsError as error:
        raise OutputError(f"cannot write pictures to {folder}: it is a file; choose another --output") from error
    except OSError as error:
        raise OutputError(f"cannot make {folder}: {error.strerror}; choose another --output") from error
    return folder
