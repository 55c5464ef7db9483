"""Charts of benchmarks in the style of `landlab_debrisflow.plots`: its colours, and grids and legends of charts."""

from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from landlab_debrisflow.plots.style import LINES, TITLE

BLUE, RED, GREEN, PURPLE, SKY, ORANGE, _ = LINES
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
    axes.title.set_fontsize(TITLE)


def legend_below(figure: Figure, axes: Axes, **words: Any) -> None:
    """Put the legend of some axes below all panels, where it covers no data."""
    handles, labels = axes.get_legend_handles_labels()
    figure.legend(handles, labels, **{"loc": "outside lower center", "frameon": False, "fontsize": 9} | words)
