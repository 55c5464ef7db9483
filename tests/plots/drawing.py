"""Maps to draw, and what stands in a figure."""

import itertools

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.text import Text


def on_map(values, spacing=10.0, origin=(0.0, 0.0)):
    """Return values of shape (rows, columns) over map coordinates."""
    rows, columns = values.shape
    x, y = origin[0] + spacing * np.arange(columns), origin[1] + spacing * np.arange(rows)
    return xr.DataArray(values, {"y": y, "x": x}, ("y", "x"))


def cone(rows=21, columns=31):
    y, x = np.mgrid[0.0:rows, 0.0:columns]
    return -5.0 * np.hypot(x - columns // 2, y - rows // 2) + 100.0


def event(spacing=10.0, origin=(0.0, 0.0), settled=True):
    """Return maps of an event down a plane, and its ground before: 1 m fails, 0.5 m is eroded, 0.8 m is left."""
    x, y = origin[0] + spacing * np.arange(40), origin[1] + spacing * np.arange(20)
    column = np.arange(40)
    lane = (abs(np.arange(20) - 10) <= 3)[:, None]
    fails, erodes, leaves = ((low <= column) & (column < high) & lane for low, high in ((4, 8), (8, 25), (25, 33)))
    before = 0.3 * spacing * (40.0 - column) + 0.02 * spacing * abs(np.arange(20) - 10)[:, None]
    bed = before - 1.0 * fails - 0.5 * erodes
    passed = fails | erodes | leaves
    fields = {
        "topographic__elevation": bed + 0.8 * leaves if settled else bed,
        "debris_flow__max_depth": 2.0 * passed,
        "debris_flow__max_speed": 9.0 * passed,
        "debris_flow__arrival_time": np.where(passed, 2.0 * (column - 4), -1.0),
        "debris_flow__eroded_depth": 0.5 * erodes,
        "debris_flow__deposit_depth": 0.8 * leaves,
        "debris_flow__max_basal_pressure_ratio": 0.6 * passed,
        "debris_flow__max_basal_peclet_number": np.where(erodes, 10.0 ** (column / 8.0 - 1.0), 0.0),
        "debris_flow__depth": np.where(settled, 0.0, 0.8 * leaves),
    }
    attributes = {"budget_moving": 0.0 if settled else 44.8, "budget_released": 28.0, "elapsed_time": 66.0}
    maps = xr.Dataset({name: (("y", "x"), v) for name, v in fields.items()}, {"y": y, "x": x}, attributes)
    ground = {"topographic__elevation": before, "debris_flow__release_depth": 1.0 * fails}
    return maps, xr.Dataset({name: (("y", "x"), v) for name, v in ground.items()}, {"y": y, "x": x})


def values_of(axes):
    """Return the image of the values in a panel of a map."""
    return next(image for image in axes.images if image.get_label() == "values")


def panels(figure):
    """Return the axes of maps in a figure."""
    return [axes for axes in figure.axes if any(image.get_label() == "values" for image in axes.images)]


def overlaps(figure):
    """Return the pairs of texts in a figure that cover each other, as they will be drawn."""
    return [
        (one, other) for (one, a), (other, b) in itertools.combinations(_boxes(figure), 2)
        if min(a.x1, b.x1) - max(a.x0, b.x0) > 1.0 and min(a.y1, b.y1) - max(a.y0, b.y0) > 1.0
    ]  # fmt: skip


def outside(figure):
    """Return the texts of a figure that are cut off by its edge."""
    page = figure.bbox
    return [
        text for text, box in _boxes(figure)
        if box.x0 < -1.0 or box.y0 < -1.0 or box.x1 > page.x1 + 1.0 or box.y1 > page.y1 + 1.0
    ]  # fmt: skip


def _boxes(figure):
    """Return every text that is seen in a figure, with its box on the page [pixels]."""
    figure.draw_without_rendering()
    renderer, unseen = FigureCanvasAgg(figure).get_renderer(), set()
    for axes in figure.findobj(Axes):
        for axis in (axes.xaxis, axes.yaxis):
            low, high = sorted(axis.get_view_interval())
            slack = 1e-9 * (high - low)
            for tick in [*axis.get_major_ticks(), *axis.get_minor_ticks()]:
                if not axes.get_visible() or not low - slack <= tick.get_loc() <= high + slack:
                    unseen |= {id(tick.label1), id(tick.label2)}
        if not axes.get_visible():
            unseen |= {id(text) for text in axes.findobj(Text)}
    return [
        (text.get_text(), text.get_window_extent(renderer)) for text in figure.findobj(Text)
        if text.get_text().strip() and text.get_visible() and id(text) not in unseen
    ]  # fmt: skip
