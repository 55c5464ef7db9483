"""Styles of maps for QGIS: classes of values of practical use, in colours that the colour-blind can tell apart."""

import os
from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path
from typing import NamedTuple
from xml.etree import ElementTree

import numpy as np

from ..core.errors import InputError
from ..grid.fields import OUTPUT_PREFIX
from ..record.files import write_atomically


class Style(NamedTuple):
    """Classes of a map and their colours.

    Attributes
    ----------
    bounds : tuple of float
        Values between two classes, increasing; values below the first and above the last have classes, too.
    colours : str
        Name of a matplotlib colour map whose lightness changes in one direction.
    factor : float
        Divisor of the values in labels.
    unit : str
        Unit of the labels.
    labels : tuple of str
        Text of every class; by default made of the bounds.
    shades : tuple of str
        Colour of every class as ``#rrggbb``, instead of the colour map.
    """

    bounds: tuple[float, ...]
    colours: str
    factor: float = 1.0
    unit: str = ""
    labels: tuple[str, ...] = ()
    shades: tuple[str, ...] = ()


DEPTHS = 0.05, 0.5, 1.0, 2.0, 5.0, 10.0
"""Depths between two classes [m]: a film, the knee, the waist, above a door, a storey and a half, three storeys."""

SPEEDS = 1.0, 3.0, 5.0, 10.0, 20.0, 30.0
"""Speeds between two classes [m s-1]: walking, running, and faster than anybody flees."""

PROBABILITIES = Style((0.01, 0.05, 0.1, 0.25, 0.5, 0.75, 0.95), "YlOrRd", 0.01, "%")
"""Style of probabilities; the palest classes are those of rare events."""

STANDARD_ERRORS = Style((0.01, 0.02, 0.05, 0.1, 0.2), "Purples", 0.01, "%")
"""Style of standard errors of probabilities."""

STYLES = {
    "depth": Style(DEPTHS, "YlGnBu", unit="m"),
    "max_depth": Style(DEPTHS, "YlGnBu", unit="m"),
    "solid_depth": Style(DEPTHS, "YlGnBu", unit="m"),
    "max_run_up": Style(DEPTHS, "YlGnBu", unit="m"),
    "eroded_depth": Style((0.05, 0.25, 0.5, 1.0, 2.0, 5.0), "YlOrBr", unit="m"),
    "deposit_depth": Style(DEPTHS, "PuBu", unit="m"),
    "speed": Style(SPEEDS, "YlOrRd", unit="m/s"),
    "max_speed": Style(SPEEDS, "YlOrRd", unit="m/s"),
    "max_impact_pressure": Style((3e3, 1e4, 3e4, 1e5, 3e5, 1e6), "YlOrRd", 1e3, "kPa"),
    "basal_excess_pore_pressure": Style((1e3, 2e3, 5e3, 1e4, 2e4, 5e4), "GnBu", 1e3, "kPa"),
    "max_basal_pressure_ratio": Style((0.2, 0.4, 0.6, 0.8, 0.95), "GnBu"),
    "arrival_time": Style((5.0, 10.0, 20.0, 30.0, 60.0, 120.0, 300.0, 600.0), "cividis", unit="s"),
}
"""Style of every map by its name without ``debris_flow__``; the others are divided evenly."""


def style_for(name: str, values: np.ndarray) -> Style:
    """Return the style of a map: one for each kind, so that maps of two runs can be compared.

    Parameters
    ----------
    name : str
        Name of the map, with or without ``debris_flow__``.
    values : ndarray
        Values of the map in its unit, whose range is divided evenly if the map has no style of its own.

    Returns
    -------
    Style

    Examples
    --------
    >>> style_for("max_depth", np.array([0.3, 1.7, np.nan])).bounds
    (0.05, 0.5, 1.0, 2.0, 5.0, 10.0)
    >>> class_labels(style_for("probability_of_reached", np.array([0.5])))[:2]
    ['< 1 %', '1 – 5 %']
    """
    short = name.removeprefix(OUTPUT_PREFIX)
    if short.startswith("probability_of_"):
        return STANDARD_ERRORS if short.endswith("_standard_error") else PROBABILITIES
    if (style := STYLES.get(short.removeprefix("quantile_of_").removeprefix("mean_of_"))) is not None:
        return style
    shown = values[np.isfinite(values)]
    low, high = (float(shown.min()), float(shown.max())) if shown.size else (0.0, 0.0)
    return Style(tuple(np.linspace(low, high if high > low else low + 1.0, 7)[1:-1].tolist()), "viridis")


def class_colours(style: Style) -> list[tuple[int, int, int]]:
    """Return red, green and blue, each 0 to 255, of every class, of which there is one more than bounds.

    Parameters
    ----------
    style : Style
        Classes and colour map.

    Returns
    -------
    list of tuple of int
    """
    from matplotlib import colormaps

    if style.shades:
        return [(int(one[1:3], 16), int(one[3:5], 16), int(one[5:7], 16)) for one in style.shades]
    # the palest tones of the colour map cannot be seen on a white page
    places = np.linspace(0.12, 1.0, len(style.bounds) + 1)
    shades = colormaps[style.colours](places)[:, :3]
    return [(int(r), int(g), int(b)) for r, g, b in np.rint(255.0 * shades)]


def class_labels(style: Style) -> list[str]:
    """Return the text of every class in the legend.

    Parameters
    ----------
    style : Style
        Classes, and the unit of the labels.

    Returns
    -------
    list of str

    Examples
    --------
    >>> class_labels(Style((1e3, 3e4), "YlOrRd", 1e3, "kPa"))
    ['< 1 kPa', '1 – 30 kPa', '> 30 kPa']
    """
    if style.labels:
        return list(style.labels)
    shown, unit = [f"{bound / style.factor:g}" for bound in style.bounds], f" {style.unit}".rstrip()
    between = [f"{low} – {high}{unit}" for low, high in pairwise(shown)]
    return [f"< {shown[0]}{unit}", *between, f"> {shown[-1]}{unit}"]


def write_style(path: str | os.PathLike[str], style: Style, transparent_below: bool = False) -> Path:
    """Write a style as a QGIS layer style, atomically: QGIS applies a ``.qml`` file beside a raster by itself.

    Parameters
    ----------
    path : str or os.PathLike
        The file, with the name of the raster and the suffix ``.qml``.
    style : Style
        Classes and colours.
    transparent_below : bool
        Whether the class below the first bound is left transparent.

    Returns
    -------
    pathlib.Path
        Where it is.

    Raises
    ------
    InputError
        If the bounds do not increase, or the file cannot be written.
    """
    bounds: Sequence[float] = style.bounds
    if not bounds or any(high <= low for low, high in pairwise(bounds)):
        raise InputError(f"write_style: bounds must increase, at least one, got {bounds!r}")
    tree = ElementTree.Element("qgis", version="3.28.0", styleCategories="Symbology")
    pipe = ElementTree.SubElement(tree, "pipe")
    renderer = ElementTree.SubElement(
        pipe, "rasterrenderer", type="singlebandpseudocolor", band="1", opacity="1", alphaBand="-1", nodataColor="",
        classificationMin=repr(bounds[0]), classificationMax=repr(bounds[-1]),
    )  # fmt: skip
    ElementTree.SubElement(renderer, "rasterTransparency")
    shader = ElementTree.SubElement(renderer, "rastershader")
    ramp = ElementTree.SubElement(
        shader, "colorrampshader", colorRampType="DISCRETE", classificationMode="1", clip="0",
        minimumValue=repr(bounds[0]), maximumValue=repr(bounds[-1]),
    )  # fmt: skip
    uppers = [*map(repr, bounds), "inf"]
    for k, (upper, label, shade) in enumerate(zip(uppers, class_labels(style), class_colours(style), strict=True)):
        alpha = "0" if k == 0 and transparent_below else "255"
        colour = "#{:02x}{:02x}{:02x}".format(*shade)
        ElementTree.SubElement(ramp, "item", value=upper, label=label, color=colour, alpha=alpha)
    ElementTree.indent(tree)
    text = "<!DOCTYPE qgis PUBLIC 'http://mrcc.com/qgis.dtd' 'SYSTEM'>\n" + ElementTree.tostring(tree, "unicode") + "\n"
    return write_atomically(path, lambda temporary: temporary.write_text(text, encoding="utf-8"))
