"""Long sections: surfaces that fit each other, along a line that is given or found."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from landlab_debrisflow import InputError
from landlab_debrisflow.plots import draw_section, trace_thalweg

from .drawing import event, outside, overlaps

LINE = [(5.0, 100.0), (385.0, 100.0)]


def line(axes, words):
    found = next(line for line in axes.lines if line.get_label().startswith(words))
    return np.array(found.get_xdata()), np.array(found.get_ydata())


def heights(axes):
    """Return distance and height of the outermost vertices of failed or eroded ground and of the deposit."""
    taken, left = (collection.get_paths() for collection in axes.collections[:2])
    return [np.concatenate([path.vertices for path in paths]) for paths in (taken, left)]


@pytest.mark.parametrize("settled", [True, False])
@pytest.mark.parametrize("stacked", [True, False])
def test_surfaces_lie_where_ground_was_lost_and_left(settled, stacked):
    maps, before = event(settled=settled)
    maps = maps.drop_attrs() if stacked else maps
    upper, lower = draw_section(maps, LINE, before=before).axes
    distance, ground = line(upper, "ground before")
    assert_allclose(ground, 0.3 * (400.0 - (distance + 5.0)), rtol=1e-12)
    after = line(upper, "ground after")[1] - ground
    inside = [np.abs(distance + 5.0 - place).argmin() for place in (60.0, 150.0, 280.0, 350.0)]
    assert_allclose(after[inside], [-1.0, -0.5, 0.8, 0.0], atol=1e-9)
    peak = line(upper, "peak surface")[1] - ground
    assert_allclose(peak[inside], [1.0, 1.5, 2.0, np.nan], atol=1e-9)
    taken, left = heights(lower)
    assert_allclose([taken[:, 1].min(), left[:, 1].max()], [-1.0, 0.8], atol=1e-9)


def test_without_the_ground_before_the_scar_is_said_to_be_in_it():
    upper = draw_section(event()[0], LINE).axes[0]
    assert line(upper, "ground before, with the scar")


def test_axes_have_units_and_nothing_overlaps():
    maps, before = event(origin=(400_000.0, 5_200_000.0))
    figure = draw_section(maps, before=before, title="a title that is rather long for a section " * 2)
    upper, lower = figure.axes
    assert upper.get_ylabel() == "elevation [m]" and lower.get_ylabel().endswith("[m]")
    assert lower.get_xlabel() == "distance along the line [m]"
    assert overlaps(figure) == [] and outside(figure) == []


def test_a_section_is_drawn_into_one_or_two_axes():
    from matplotlib.figure import Figure

    maps, _ = event()
    for count in (1, 2):
        figure = Figure()
        axes = figure.subplots(count, 1)
        assert draw_section(maps, LINE, axes=axes) is figure and len(figure.axes) == count
    with pytest.raises(InputError, match="axes must be one, or two"):
        draw_section(maps, LINE, axes=list(Figure().subplots(3, 1)))


def test_the_line_leads_down_the_deepest_way():
    maps, before = event()
    depth = maps.debris_flow__max_depth
    depth[:] = np.where(depth > 0.0, 0.2, 0.0)
    depth[12, 4:33] = 2.0  # a channel beside the middle
    found = trace_thalweg(maps, before)
    assert found[0, 0] == 40.0 and found[-1, 0] == 320.0
    middle = (found[:, 0] > 80.0) & (found[:, 0] < 280.0)
    assert_allclose(found[middle, 1], 120.0, atol=5.0)
    assert np.all(np.diff(found[:, 0]) >= 0.0)


def test_what_has_no_section_is_refused():
    maps, before = event()
    with pytest.raises(InputError, match="does not come over the ground"):
        draw_section(maps, [(5000.0, 0.0), (6000.0, 0.0)])
    with pytest.raises(InputError, match="at least two different vertices"):
        draw_section(maps, [(5.0, 0.0), (5.0, 0.0)])
    with pytest.raises(InputError, match="reached fewer than two nodes"):
        draw_section(maps.assign(debris_flow__max_depth=0.0 * maps.debris_flow__max_depth))
    with pytest.raises(InputError, match="lack topographic__elevation"):
        draw_section(maps.drop_vars("topographic__elevation"), LINE)
    assert before is not None
