"""Pictures of a run for its report: figures as data URIs, each with words in place of the picture."""

import base64
import io
from collections.abc import Iterator
from typing import Any

import numpy as np
import xarray as xr

from ..plots import (
    draw_column,
    draw_gauges,
    draw_hydrographs,
    draw_map,
    draw_section,
    draw_time_distance,
    draw_volumes,
)
from ..plots.style import unit_text
from ..run.recorded import Recorded
from .blocks import Picture
from .numbers import rounded

DPI = 130
"""Resolution of the pictures in a page [dots per inch]."""

MAPS = {
    "max_depth": "Largest vertical depth of moving mass at each place, over the whole run.",
    "max_speed": "Largest speed at each place, over the whole run.",
    "arrival_time": "Time at which the first centimetre arrived, with lines of equal time.",
    "elevation_change": "Ground after the event less the ground before: erosion and the scar of the release in red, "
    "deposit in blue.",
    "max_basal_pressure_ratio": "Largest excess pore pressure at the base, over the pressure at which the grains bear "
    "no weight any more: at 1 the debris is liquefied.",
    "max_basal_peclet_number": "Largest basal Péclet number: where it is far above 1, eroded soil keeps its pore "
    "pressure in the flow; where it is far below 1, the pressure drains at once.",
    "max_impact_pressure": "Largest density × speed²: a measure of how hard the flow presses, no load of a structure.",
    "max_run_up": "Largest height of the surface of the flow above the lowest ground that it came over.",
    "eroded_depth": "Depth of soil that was eroded, without the release.",
    "deposit_depth": "Depth of the deposit.",
}
"""Maps of a report, with captions; from the seventh on a map is drawn if the scene names it."""

ALWAYS = 6


def map_pictures(recorded: Recorded, maps: xr.Dataset) -> Iterator[Picture]:
    """Yield maps of the end of a run: the first ones of `MAPS`, and further ones that its scene names."""
    for number, (name, words) in enumerate(MAPS.items()):
        if number >= ALWAYS and name not in recorded.asked:
            continue
        if name != "elevation_change" and f"debris_flow__{name}" not in maps:
            continue
        figure = draw_map(maps, name, shapes=recorded.shapes)
        title = figure.axes[0].get_title(loc="left")
        yield picture(figure, f"Map: {title}. {_range_words(maps, name)}", words)


def section_pictures(recorded: Recorded, maps: xr.Dataset) -> Iterator[Picture]:
    """Yield the long section along the thalweg of a run or the deepest way of its flow, and the way of its front."""
    if not bool((maps.debris_flow__max_depth > 0.0).any()):
        return
    line = recorded.thalweg
    along = "the deepest way of the flow, down from its release" if line is None else "the thalweg of the scene"
    words = f"Long section along {along}: the ground before and after, and the highest surface of the flow."
    yield picture(draw_section(maps, line), words, words)
    if (front := recorded.datasets.get("thalweg")) is not None:
        words = "Distance of the front along the thalweg against time: the steeper, the faster."
        yield picture(draw_time_distance(front), f"{words} {_front_words(front)}", words)


def series_pictures(recorded: Recorded) -> Iterator[Picture]:
    """Yield hydrographs at sections and series at gauges, if the run has any."""
    if (sections := recorded.datasets.get("sections")) is not None:
        words = "Hydrographs at the sections of the scene: discharge, depth and speed against time."
        yield picture(draw_hydrographs(sections), f"{words} {_crossed_words(sections)}", words)
    if (gauges := recorded.datasets.get("gauges")) is not None:
        words = "Depth, speed and excess pore pressure at the base, at the gauges of the scene, against time."
        yield picture(draw_gauges(gauges), words, words)


def column_pictures(recorded: Recorded) -> Iterator[Picture]:
    """Yield the pore pressure of a marked column against time, if the run followed any."""
    columns = recorded.datasets.get("columns")
    if columns is not None and columns.sizes.get("time") and bool(columns.excess_pore_pressure.notnull().any()):
        words = (
            "Excess pore pressure within the column of one particle: on the left over height and time, where the "
            "upper edge is the surface of the flow; on the right its profile at some times."
        )
        yield picture(draw_column(columns), words, words)


def volume_pictures(recorded: Recorded) -> Iterator[Picture]:
    """Yield the volumes of a run against time."""
    budget = recorded.datasets.get("budget")
    if budget is not None and budget.sizes.get("time", 0) > 1:
        words = "Volumes against time: released, inflow and eroded above each other, deposit and outflow as lines."
        yield picture(draw_volumes(budget), words, words)


def picture(figure: Any, text: str, caption: str) -> Picture:
    """Return a figure as a picture of a report.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
    text : str
        Words in place of the picture, for readers with a screen reader.
    caption : str

    Returns
    -------
    Picture
    """
    stream = io.BytesIO()
    figure.savefig(stream, format="png", dpi=DPI)
    return Picture(uri=data_uri(stream.getvalue(), "image/png"), text=text, caption=caption)


def data_uri(content: bytes, kind: str) -> str:
    """Return bytes of a media type as a URI that holds them.

    Examples
    --------
    >>> data_uri(b"GIF", "image/gif")
    'data:image/gif;base64,R0lG'
    """
    return f"data:{kind};base64,{base64.b64encode(content).decode('ascii')}"


def _range_words(maps: xr.Dataset, name: str) -> str:
    data = maps.get(f"debris_flow__{name}")
    if data is None or not np.isfinite(data.values).any():
        return ""
    unit = str(data.attrs.get("units", "1"))
    return f"Largest value: {rounded(float(data.max()), '' if unit == '1' else unit_text(unit))}."


def _front_words(thalweg: xr.Dataset) -> str:
    front = thalweg.front_distance.values
    return f"It ends at {rounded(float(front[-1]), 'm')}." if front.size and np.isfinite(front[-1]) else ""


def _crossed_words(sections: xr.Dataset) -> str:
    volumes = zip(sections["section"].values, sections.crossed_volume.values, strict=True)
    return "; ".join(f"{rounded(float(value), 'm³')} crossed {name}" for name, value in volumes) + "."
