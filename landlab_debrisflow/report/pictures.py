"""Pictures of a run for its report: figures as data URIs, each with a description as text."""

import base64
import io
from collections.abc import Iterator
from typing import Any

import numpy as np
import xarray as xr

from .blocks import Picture

DPI = 110
"""Resolution of the pictures in a page [dots per inch]."""

MAPS = (
    ("max_depth", "Peak depth", "viridis", "m"),
    ("max_speed", "Peak speed", "viridis", "m/s"),
    ("arrival_time", "Arrival time", "viridis", "s"),
    ("eroded_depth", "Erosion", "YlOrRd", "m"),
    ("deposit_depth", "Deposit", "YlGnBu", "m"),
)


def map_pictures(maps: xr.Dataset) -> Iterator[Picture]:
    """Yield maps of the end of a run over its relief."""
    from ..plots import Layer, draw_maps

    for name, words, colours, unit in MAPS:
        data = maps[f"debris_flow__{name}"]
        figure = draw_maps([Layer({words: data}, f"{words} [{unit}]", colours)], maps.topographic__elevation)
        most = float(np.nanmax(data.values)) if np.isfinite(data.values).any() else 0.0
        yield picture(figure, f"Map of {words.lower()}, at most {most:.3g} {unit}.", words)


def picture(figure: Any, text: str, caption: str) -> Picture:
    """Return a figure as a picture of a report.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
    text : str
        Words for people who cannot see it.
    caption : str

    Returns
    -------
    Picture
    """
    stream = io.BytesIO()
    figure.savefig(stream, format="png", dpi=DPI, metadata={"Software": None})
    return Picture(uri=data_uri(stream.getvalue(), "image/png"), text=text, caption=caption)


def data_uri(content: bytes, kind: str) -> str:
    """Return bytes of a media type as a URI that holds them.

    Examples
    --------
    >>> data_uri(b"GIF", "image/gif")
    'data:image/gif;base64,R0lG'
    """
    return f"data:{kind};base64,{base64.b64encode(content).decode('ascii')}"
