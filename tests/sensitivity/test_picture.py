"""The picture of sensitivities shows values, their order and their intervals."""

import numpy as np
import pytest

from landlab_debrisflow import InputError
from landlab_debrisflow.sensitivity import draw_sensitivity, rank_correlations, sobol_indices

from .functions import results_of

FUNCTIONS = {
    "max_speed": lambda a, b: a - 0.3 * b, "run_out": lambda a, b: a * b, "budget_inflow": lambda a, b: 0.0 * a,
    "area": lambda a, b: a, "volume": lambda a, b: a**2 + 0.2 * b,
}  # fmt: skip


def lengths(axes):
    """Return the lengths of the bars of both kinds in axes."""
    return [[bar.get_width() for bar in container] for container in axes.containers if hasattr(container, "patches")]


@pytest.mark.parametrize(("make", "sampling"), [(rank_correlations, "random"), (sobol_indices, "saltelli")])
def test_bars_are_the_sensitivities(make, sampling):
    found = make(results_of(FUNCTIONS, members=128, sampling=sampling))
    figure = draw_sensitivity(found, title="50 $ and 1 %")
    first, second = [str(name) for name in found if found[name].dims == ("measure", "parameter")]
    *panels, nothing, empty = figure.axes
    assert [axes.get_title(loc="left") for axes in panels] == [
        "max speed [m]", "run out [m]", "area [m]", "volume [m]"
    ]  # fmt: skip
    order = np.argsort(abs(found[second if "total_order" in found else first]).mean("measure").values)
    assert order.tolist() == [1, 0]  # the first value matters more, and is drawn on top
    above, below = ([bar.get_y() for bar in bars] for bars in panels[0].containers if hasattr(bars, "patches"))
    assert np.all(np.array(above) > below)
    for axes, measure in zip(panels, ("max_speed", "run_out", "area", "volume"), strict=True):
        there = found.sel(measure=measure)
        for widths, name in zip(lengths(axes), (first, second), strict=True):
            assert np.allclose(widths, there[name].values[order], equal_nan=True)
    names = [text.get_text() for text in panels[0].get_yticklabels()]
    assert names == [f"x{k + 1} [–]" for k in order]
    assert not nothing.axison and not empty.axison and figure.legends[0].get_title().get_text() == r"50 \$ and 1 %"


def test_intervals_are_drawn_where_there_are_any():
    found = rank_correlations(results_of(FUNCTIONS), ["max_speed"])
    (axes,) = draw_sensitivity(found).axes
    (lines,) = (container.lines[2][0] for container in axes.containers if not hasattr(container, "patches"))
    drawn = np.sort([segment[:, 0] for segment in lines.get_segments()], axis=0)
    assert drawn == pytest.approx(np.sort(found.rank_correlation_interval.values[0], axis=0))


def test_what_cannot_be_drawn_is_refused():
    found = rank_correlations(results_of(FUNCTIONS))
    with pytest.raises(InputError, match="give the Dataset of rank_correlations or sobol_indices"):
        draw_sensitivity(found.drop_vars("rank_correlation"))
    with pytest.raises(InputError, match=r"no measure 'max_sped' \(did you mean 'max_speed'\?\)"):
        draw_sensitivity(found, "max_sped")
    with pytest.raises(InputError, match="no measure has a sensitivity"):
        draw_sensitivity(found.sel(measure=["budget_inflow"]))
