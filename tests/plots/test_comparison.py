"""Comparisons show what is in the data, where it is, with units."""

import numpy as np
import pytest
from matplotlib import pyplot
from matplotlib.collections import LineCollection
from numpy.testing import assert_allclose

from landlab_debrisflow import InputError
from landlab_debrisflow.plots import Layer, draw_maps

from .drawing import cone, on_map, outside, overlaps, panels, values_of


def depth(row=5, column=8, value=2.0):
    values = np.zeros((21, 31))
    values[row, column], values[row, column + 1] = value, 0.001
    return on_map(values)


def test_one_panel_per_run_with_shared_colours_and_a_unit():
    layers = [
        Layer({"a": depth(), "b": depth(value=4.0)}, "depth [m]"),
        Layer({"a": depth(), "b": depth()}, "speed [m/s]", "YlOrRd", (0.0, 1.0)),
    ]
    figure = draw_maps(layers, on_map(cone()))
    shown = panels(figure)
    assert [axes.get_title() for axes in shown] == ["a", "b", "a", "b"]
    assert [values_of(axes).get_clim() for axes in shown] == [(0.0, 4.0)] * 2 + [(0.0, 1.0)] * 2
    assert all(axes.get_aspect() == 1.0 for axes in shown)
    bars = {child.get_ylabel() for axes in shown for child in axes.child_axes}
    assert bars == {"depth [m]", "speed [m/s]"}
    assert figure.get_supxlabel() == "x [m]" and figure.get_supylabel() == "y [m]"
    assert pyplot.get_fignums() == []
    assert overlaps(figure) == [] and outside(figure) == []


def test_values_lie_at_their_place_and_small_ones_are_missing():
    figure = draw_maps([Layer({"": depth(row=5, column=8)}, "depth [m]")], on_map(cone()), extent=(-5, 305, -5, 205))
    image = values_of(panels(figure)[0])
    assert image.origin == "lower"
    assert tuple(image.get_extent()) == (-5.0, 305.0, -5.0, 205.0)
    seen = np.ma.masked_invalid(image.get_array())
    assert seen.count() == 1 and seen[5, 8] == 2.0


def test_extent_is_that_of_the_data_with_a_margin():
    figure = draw_maps([Layer({"": depth(row=10, column=15)}, "depth [m]")], on_map(cone()), margin=30.0)
    axes = panels(figure)[0]
    assert_allclose([axes.get_xlim(), axes.get_ylim()], [(115.0, 185.0), (65.0, 135.0)])


def test_outline_is_the_rim_of_the_cells():
    source = on_map(np.zeros((21, 31), bool))
    source[5, 8] = source[5, 9] = True
    figure = draw_maps([Layer({"": depth()}, "depth [m]")], on_map(cone()), outline=source)
    rim = next(c for c in panels(figure)[0].collections if isinstance(c, LineCollection)).get_segments()
    assert len(rim) == 6
    assert_allclose(np.min(rim, axis=(0, 1)), (75.0, 45.0))
    assert_allclose(np.max(rim, axis=(0, 1)), (95.0, 55.0))
    assert figure.get_supxlabel().endswith("(outlined: source)")


def test_nothing_to_show_and_values_beyond_the_scale():
    nothing = draw_maps([Layer({"": on_map(np.zeros((21, 31)))}, "depth [m]")], on_map(cone()))
    assert panels(nothing)[0].get_xlim() == (-5.0, 305.0)
    beyond = draw_maps([Layer({"": depth(value=9.0)}, "dz [m]", "RdBu", (-5.0, 5.0))], on_map(cone()))
    image = values_of(panels(beyond)[0])
    assert image.colorbar.extend == "max"
    assert image.cmap(0.5)[3] < 0.05 < image.cmap(1.0)[3]  # no change is transparent


def test_dashed_lines_are_named_below():
    figure = draw_maps([Layer({"": depth()}, "depth [m]")], on_map(cone()), contours=(50.0,))
    assert outside(figure) == [] and figure.get_supxlabel().endswith("(dashed: 50 m contour)")


def test_maps_of_other_nodes_and_no_layers_are_refused():
    with pytest.raises(InputError, match=r"shape \(20, 31\), the relief has \(21, 31\)"):
        draw_maps([Layer({"": depth()[1:]}, "depth [m]")], on_map(cone()))
    with pytest.raises(InputError, match="at least one Layer"):
        draw_maps([], on_map(cone()))
    with pytest.raises(InputError, match="two increasing numbers"):
        draw_maps([Layer({"": depth()}, "depth [m]", limits=(1.0, 1.0))], on_map(cone()))
