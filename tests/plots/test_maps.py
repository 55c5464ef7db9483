"""Maps show what is in the data, where it is, with units."""

import numpy as np
import pytest
import xarray as xr
from matplotlib import pyplot
from matplotlib.collections import LineCollection
from numpy.testing import assert_allclose

from landlab_debrisflow import InputError
from landlab_debrisflow.plots.maps import Layer, draw_maps, save_figure


def on_map(values, spacing=10.0, origin=(0.0, 0.0)):
    rows, columns = values.shape
    x, y = origin[0] + spacing * np.arange(columns), origin[1] + spacing * np.arange(rows)
    return xr.DataArray(values, {"y": y, "x": x}, ("y", "x"))


def cone(rows=21, columns=31):
    y, x = np.mgrid[0.0:rows, 0.0:columns]
    return -5.0 * np.hypot(x - columns // 2, y - rows // 2) + 100.0


def depth(row=5, column=8, value=2.0):
    values = np.zeros((21, 31))
    values[row, column], values[row, column + 1] = value, 0.001
    return on_map(values)


def panels(figure):
    return [axes for axes in figure.axes if len(axes.images) == 2]


def test_one_panel_per_run_with_shared_colours_and_a_unit():
    layers = [
        Layer({"a": depth(), "b": depth(value=4.0)}, "depth [m]"),
        Layer({"a": depth(), "b": depth()}, "speed [m/s]", "plasma", (0.0, 1.0)),
    ]
    figure = draw_maps(layers, on_map(cone()))
    shown = panels(figure)
    assert [axes.get_title() for axes in shown] == ["a", "b", "a", "b"]
    assert [axes.images[1].get_clim() for axes in shown] == [(0.0, 4.0)] * 2 + [(0.0, 1.0)] * 2
    assert all(axes.get_aspect() == 1.0 for axes in shown)
    labels = {axes.get_ylabel() for axes in figure.axes} - {""}
    assert labels == {"depth [m]", "speed [m/s]"}
    assert figure.get_supxlabel() == "x [m]" and figure.get_supylabel() == "y [m]"
    assert pyplot.get_fignums() == []


def test_values_lie_at_their_place_and_small_ones_are_transparent():
    figure = draw_maps([Layer({"": depth(row=5, column=8)}, "depth [m]")], on_map(cone()))
    image = panels(figure)[0].images[1]
    assert image.origin == "lower"
    west, east, south, north = image.get_extent()
    assert (west, east, south, north) == (-5.0, 305.0, -5.0, 205.0)
    seen = np.ma.masked_invalid(image.get_array())
    assert seen.count() == 1 and seen[5, 8] == 2.0


def test_light_comes_from_the_north_west():
    figure = draw_maps([Layer({"": depth()}, "depth [m]")], on_map(cone()))
    shade = panels(figure)[0].images[0].get_array()
    assert shade[15, 10] > 0.9 > 0.5 > shade[5, 20]  # rows run northwards


def test_extent_is_that_of_the_data_with_a_margin():
    figure = draw_maps([Layer({"": depth(row=10, column=15)}, "depth [m]")], on_map(cone()), margin=30.0)
    axes = panels(figure)[0]
    assert_allclose([axes.get_xlim(), axes.get_ylim()], [(120.0, 180.0), (70.0, 130.0)])


def test_outline_is_the_rim_of_the_cells():
    source = on_map(np.zeros((21, 31), bool))
    source[5, 8] = source[5, 9] = True
    figure = draw_maps([Layer({"": depth()}, "depth [m]")], on_map(cone()), outline=source)
    rim = next(c for c in panels(figure)[0].collections if isinstance(c, LineCollection)).get_segments()
    assert len(rim) == 6
    assert_allclose(np.min(rim, axis=(0, 1)), (75.0, 45.0))
    assert_allclose(np.max(rim, axis=(0, 1)), (95.0, 55.0))


@pytest.mark.parametrize(("spacing", "unit", "length"), [(10.0, "m", 50.0), (1000.0, "km", 5.0)])
def test_unit_and_scale_bar_follow_the_size(spacing, unit, length):
    relief = on_map(cone(), spacing)
    values = on_map(depth().values, spacing)
    figure = draw_maps([Layer({"": values}, "depth [m]")], relief, extent=(0.0, 29 * spacing, 0.0, 20 * spacing))
    axes = panels(figure)[0]
    assert figure.get_supxlabel() == f"x [{unit}]"
    bar = axes.lines[0].get_xdata()
    assert_allclose(bar[1] - bar[0], length)
    assert axes.texts[0].get_text() == f"{length:g} {unit}"


def test_large_map_coordinates_are_told_once_and_the_axes_start_at_the_corner():
    origin = (361020.0, 70230.0)
    relief, values = on_map(cone(), origin=origin), on_map(depth().values, origin=origin)
    figure = draw_maps([Layer({"": values}, "depth [m]")], relief)
    assert panels(figure)[0].get_xlim() == (30.0, 130.0)
    assert "lower left node at (361020, 70230) m" in figure.texts[-1].get_text()


def test_nothing_to_show_and_values_beyond_the_scale():
    nothing = draw_maps([Layer({"": on_map(np.zeros((21, 31)))}, "depth [m]")], on_map(cone()))
    assert panels(nothing)[0].get_xlim() == (0.0, 300.0)
    beyond = draw_maps([Layer({"": depth(value=9.0)}, "dz [m]", "RdBu", (-5.0, 5.0))], on_map(cone()))
    assert panels(beyond)[0].images[1].colorbar.extend == "both"


def test_figure_is_saved_or_refused(tmp_path):
    figure = draw_maps([Layer({"": depth()}, "depth [m]")], on_map(cone()), contours=(50.0,))
    path = save_figure(figure, tmp_path / "map.png", dpi=50)
    assert path.read_bytes()[:4] == b"\x89PNG"
    with pytest.raises(InputError, match="does not exist"):
        save_figure(figure, tmp_path / "missing" / "map.png")
