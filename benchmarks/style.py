"""The one style of the charts of benchmarks: colours that the colour-blind tell apart, sizes, grids."""

from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure

BLUE, ORANGE, GREEN, RED, PURPLE, SKY, YELLOW = (
    "#0072B2", "#E69F00", "#009E73", "#D55E00", "#CC79A7", "#56B4E9", "#B5A300",
)  # fmt: skip
"""After Okabe & Ito (2008), the yellow darker."""
GREY = "0.45"

DPI = 110


def panels(rows: int, columns: int, size: tuple[float, float], **words: Any) -> tuple[Figure, Any]:
    """Return a figure of a size [inch] and its axes, shape (rows, columns); `words` as of ``Figure.subplots``."""
    figure = Figure(figsize=size, layout="constrained")
    return figure, figure.subplots(rows, columns, squeeze=False, **words)


def finish(axes: Axes, **words: Any) -> None:
    """Set labels and scales as ``Axes.set`` does, with a light grid and small text."""
    axes.set(**words)
    axes.grid(color="0.9", linewidth=0.7)
    axes.set_axisbelow(True)
    axes.title.set_fontsize(10)


def legend_below(figure: Figure, axes: Axes, **words: Any) -> None:
    """Put the legend of some axes below all panels, where it covers no data."""
    handles, labels = axes.get_legend_handles_labels()
    figure.legend(handles, labels, **{"loc": "outside lower center", "frameon": False, "fontsize": 9} | words)
