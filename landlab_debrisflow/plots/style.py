"""Style of all figures: colours, sizes of text, units as they are read, a new figure.

Nothing global is changed: figures are plain matplotlib objects, made without pyplot and without a display.
"""

import io
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine
from matplotlib.patheffects import AbstractPathEffect, withStroke

LINES = "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#000000"
"""Colours of lines that the colour-blind tell apart (Okabe & Ito, 2008), without its yellow, which is pale on white."""

DASHES = "-", "--", "-.", ":"
"""Dashes of lines of the same colour, and of lines in a print without colours."""

BEFORE, AFTER, PEAK, EROSION, DEPOSIT = "#6b6b6b", "#000000", "#0072B2", "#D55E00", "#56B4E9"
"""Colours of the ground before and after, of the peak surface, and of what was taken and left."""

MUTED = "#555555"
"""Colour of notes and of lines that only guide the eye."""

TITLE, LABEL, TICK, NOTE = 10.0, 9.0, 8.0, 7.5
"""Sizes of text [points]."""

UNITS = {
    "m s-1": "m/s", "m2 s-1": "m²/s", "m3 s-1": "m³/s", "m3": "m³", "m2": "m²", "m-1": "1/m", "kg m-3": "kg/m³",
    "m s-2": "m/s²", "1": "–", "-": "–", "": "–", "deg": "°", "degree": "°", "Pa m": "Pa·m",
}  # fmt: skip
"""Units as figures show them, by their names in the package and in files."""


def unit_text(unit: str) -> str:
    """Return a unit as figures show it.

    Parameters
    ----------
    unit : str
        As in the attribute ``units`` of a variable.

    Returns
    -------
    str

    Examples
    --------
    >>> unit_text("m3 s-1"), unit_text("1"), unit_text("kPa")
    ('m³/s', '–', 'kPa')
    """
    return UNITS.get(unit, unit)


def label_text(words: str, unit: str) -> str:
    """Return the label of an axis: words and unit.

    Parameters
    ----------
    words : str
        Name of the quantity.
    unit : str
        As in the attribute ``units`` of a variable.

    Returns
    -------
    str

    Examples
    --------
    >>> label_text("discharge", "m3 s-1")
    'discharge [m³/s]'
    """
    return f"{words} [{unit_text(unit)}]"


def plain_text(text: object) -> str:
    r"""Return text that matplotlib shows as it is: a name may hold dollar signs, which would begin a formula.

    Examples
    --------
    >>> print(plain_text("gauge $1"))
    gauge \$1
    """
    return str(text).replace("$", r"\$")


def number_text(value: float) -> str:
    """Return a number with four digits and thin spaces between thousands.

    Examples
    --------
    >>> number_text(20457.3), number_text(0.01234), number_text(3.0)
    ('20\u2009457', '0.01234', '3')
    """
    if abs(value) >= 1000.0:
        return f"{value:,.0f}".replace(",", "\u2009")
    return f"{value:.4g}"


class ShownFigure(Figure):
    """Figure that a notebook shows as the result of a cell, whether pyplot has been imported or not."""

    def _repr_png_(self) -> bytes:
        picture = io.BytesIO()
        self.savefig(picture, format="png", dpi=100)
        return picture.getvalue()


def new_figure(width: float, height: float) -> Figure:
    """Return an empty figure whose pieces are laid out without overlap.

    Parameters
    ----------
    width, height : float
        Size [inch].

    Returns
    -------
    matplotlib.figure.Figure
    """
    return ShownFigure(figsize=(width, height), layout=ConstrainedLayoutEngine(w_pad=0.06, h_pad=0.06))


def figure_of(axes: Axes) -> Figure:
    """Return the figure that axes are in, also of axes in a subfigure."""
    figure: Any = axes.figure
    while not isinstance(figure, Figure):
        figure = figure.figure  # of a subfigure
    return figure


def dress(axes: Axes, *, grid: bool = False) -> None:
    """Set sizes of ticks and the width of the frame of axes; draw faint grid lines if wanted.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    grid : bool
        Whether lines guide the eye to the ticks.
    """
    axes.tick_params(labelsize=TICK, width=0.6, length=3.0)
    for spine in axes.spines.values():
        spine.set_linewidth(0.6)
    if grid:
        axes.grid(True, color="0.9", linewidth=0.6)
        axes.set_axisbelow(True)
        for side in ("top", "right"):
            axes.spines[side].set_visible(False)


def legend_above(axes: Axes, columns: int) -> None:
    """Draw the legend of axes above them, where it covers nothing.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    columns : int
        Entries in a row.
    """
    axes.legend(
        loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=columns, frameon=False, fontsize=TICK, borderaxespad=0.2,
        handlelength=1.6, columnspacing=1.4,
    )  # fmt: skip


def title_above(axes: Axes, title: str | None) -> None:
    """Draw the title of axes, if there is one, above the legend that stands over them."""
    if title is not None:
        axes.set_title(plain_text(title), loc="left", fontsize=TITLE, pad=22.0)


def halo(width: float = 2.5) -> list[AbstractPathEffect]:
    """Return path effects that put a white rim around text or a line, so that it is legible on any ground.

    Parameters
    ----------
    width : float
        Width of the rim and the line within [points].
    """
    return [withStroke(linewidth=width, foreground="white")]


def line_style(number: int) -> dict[str, Any]:
    """Return colour and dashes of the line with a number, counted from 0: no two of 28 are alike."""
    return {"color": LINES[number % len(LINES)], "linestyle": DASHES[number // len(LINES) % len(DASHES)]}
