"""Picture of sensitivities: bars with their intervals, a panel for each measure."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..core.errors import InputError
from ..core.hints import did_you_mean
from ..plots.style import LABEL, LINES, TICK, TITLE, dress, label_text, new_figure, plain_text


class Kind(NamedTuple):
    """Kind of sensitivity, as it is drawn.

    Attributes
    ----------
    names, words : tuple of str
        Variables of the Dataset and their words, the upper bar first.
    order : str
        Variable by which values are ordered.
    axis : str
        Label of the axis.
    ends, ticks : tuple of float
        Ends and ticks of the axis.
    """

    names: tuple[str, str]
    words: tuple[str, str]
    order: str
    axis: str
    ends: tuple[float, float]
    ticks: tuple[float, ...]


KINDS = (
    Kind(
        ("rank_correlation", "partial_rank_correlation"), ("rank correlation", "partial rank correlation"),
        "rank_correlation", "correlation", (-1.05, 1.05), (-1.0, -0.5, 0.0, 0.5, 1.0),
    ),
    Kind(
        ("first_order", "total_order"), ("first order: alone", "total order: alone and with others"),
        "total_order", "share of the variance", (-0.25, 1.25), (0.0, 0.5, 1.0),
    ),
)  # fmt: skip

COLUMNS = 3
"""Most panels beside each other."""


def draw_sensitivity(
    sensitivities: xr.Dataset, measures: str | Sequence[str] | None = None, *, title: str | None = None
) -> Figure:
    """Draw sensitivities of measures to varied values: bars with intervals, the most important value on top.

    Importance is the mean of the rank correlation, without its sign, or of the total index, over the measures that are
    drawn. Intervals end at the edge of a panel if they are longer.

    Parameters
    ----------
    sensitivities : xarray.Dataset
        From `rank_correlations` or `sobol_indices`.
    measures : str or sequence of str, optional
        Names of measures; by default those of which a sensitivity is known.
    title : str, optional
        Title of the figure.

    Returns
    -------
    matplotlib.figure.Figure

    Raises
    ------
    InputError
        If the Dataset is another one, a measure is unknown, or none has a sensitivity.
    """
    kind = next((one for one in KINDS if one.order in sensitivities), None)
    if kind is None:
        raise InputError("draw_sensitivity: give the Dataset of rank_correlations or sobol_indices")
    found = _chosen(sensitivities, kind.order, measures)
    importance = abs(found[kind.order]).mean("measure").fillna(0.0)
    found = found.isel(parameter=np.argsort(importance.values, kind="stable"))  # the first bar is the lowest
    count, values = found.sizes["measure"], found.sizes["parameter"]
    columns = min(count, COLUMNS)
    rows = -(-count // columns)
    figure = new_figure(1.9 + 2.3 * columns, 0.7 + rows * (0.6 + 0.42 * values))
    panels = figure.subplots(rows, columns, sharex=True, sharey=True, squeeze=False)
    for k, axes in enumerate(panels.flat):
        if k < count:
            _draw_panel(axes, found.isel(measure=k), kind)
            axes.tick_params(labelbottom=k + columns >= count)  # also above a place that stays empty
        else:
            axes.set_axis_off()
    panels[0, 0].set_xlim(kind.ends)
    panels[0, 0].set_xticks(kind.ticks)
    legend = figure.legend(
        *panels[0, 0].get_legend_handles_labels(), loc="outside upper left", ncols=2, frameon=False, fontsize=TICK,
        alignment="left", title_fontsize=TITLE,
    )  # fmt: skip
    if title is not None:
        legend.set_title(plain_text(title))
    figure.supxlabel(kind.axis, fontsize=LABEL)
    return figure


def _chosen(sensitivities: xr.Dataset, name: str, measures: str | Sequence[str] | None) -> xr.Dataset:
    """Return the sensitivities of the measures that are drawn."""
    there = [str(name) for name in sensitivities["measure"].values]
    if measures is None:
        known = sensitivities[name].notnull().any("parameter").values
        chosen = [name for name, is_known in zip(there, known, strict=True) if is_known]
        if not chosen:
            raise InputError("draw_sensitivity: no measure has a sensitivity: all are constant, or too few members ran")
    else:
        chosen = [measures] if isinstance(measures, str) else list(measures)
    for measure in chosen:
        if measure not in there:
            raise InputError(f"draw_sensitivity: there is no measure {measure!r}{did_you_mean(measure, there)}")
    return sensitivities.sel(measure=chosen)


def _draw_panel(axes: Axes, found: xr.Dataset, kind: Kind) -> None:
    """Draw the bars of one measure."""
    places = np.arange(found.sizes["parameter"])
    for name, words, offset, colour in zip(kind.names, kind.words, (0.2, -0.2), LINES, strict=False):
        values = found[name].values
        axes.barh(places + offset, values, 0.36, color=colour, alpha=0.8, label=words)
        if f"{name}_interval" not in found:
            continue
        interval = found[f"{name}_interval"].values
        axes.errorbar(
            values, places + offset, xerr=abs(interval.T - values), fmt="none", ecolor="black", elinewidth=0.9,
            capsize=2.0, capthick=0.9,
        )  # fmt: skip
    axes.axvline(0.0, color="black", linewidth=0.6)
    labels = zip(found["parameter"].values, found["parameter_units"].values, strict=True)
    # a dotted name is long: the part after the first dot stands in a line of its own
    axes.set_yticks(places, [label_text(plain_text(str(key).replace(".", ".\n", 1)), unit) for key, unit in labels])
    axes.set_title(
        label_text(str(found["measure"].item()).replace("_", " "), str(found["measure_units"].item())),
        loc="left", fontsize=LABEL,
    )  # fmt: skip
    dress(axes, grid=True)
    axes.tick_params(axis="y", length=0.0)
