"""Maps of a run: values where they are, in units that are told, over a relief that shows its form."""

import numpy as np
import pytest
import xarray as xr
from matplotlib import pyplot
from matplotlib.collections import LineCollection
from matplotlib.colors import LogNorm
from matplotlib.contour import ContourSet
from numpy.testing import assert_allclose

from landlab_debrisflow import InputError
from landlab_debrisflow.plots import draw_map, draw_overview
from landlab_debrisflow.plots.map_frame import coordinate_text
from landlab_debrisflow.plots.relief import hillshade

from .drawing import cone, event, on_map, outside, overlaps, panels, values_of

UTM = (400_000.0, 5_200_000.0)


def shown(axes):
    return np.ma.filled(values_of(axes).get_array().astype(float), np.nan)


@pytest.mark.parametrize(
    ("name", "unit", "largest"),
    [
        ("max_depth", "m", 2.0), ("debris_flow__max_speed", "m/s", 9.0), ("arrival_time", "s", 56.0),
        ("elevation_change", "m", 0.8), ("max_basal_pressure_ratio", "–", 0.6), ("eroded_depth", "m", 0.5),
    ],
)  # fmt: skip
def test_a_map_has_words_a_unit_and_map_coordinates(name, unit, largest):
    maps, before = event(origin=UTM)
    figure = draw_map(maps, name, before=before)
    axes = panels(figure)[0]
    assert axes.get_title(loc="left") and [bar.get_title(loc="left") for bar in axes.child_axes] == [f"[{unit}]"]
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("x [m]", "y [m]")
    assert_allclose(np.nanmax(shown(axes)), largest)
    west, east = axes.get_xlim()
    assert UTM[0] - 10.0 < west < UTM[0] + 35.0 and east < UTM[0] + 400.0  # the flow is from 40 to 325 m
    labels = [tick.get_text() for tick in axes.get_xticklabels() if tick.get_text()]
    assert all(label.startswith("400\u2009") and len(label) == 7 for label in labels)
    assert axes.xaxis.get_offset_text().get_text() == "" == axes.yaxis.get_offset_text().get_text()
    assert overlaps(figure) == [] and outside(figure) == [] and pyplot.get_fignums() == []


def test_where_nothing_came_nothing_is_shown():
    maps, before = event()
    for name in ("max_depth", "arrival_time", "elevation_change", "max_basal_peclet_number"):
        axes = panels(draw_map(maps, name, before=before, extent=(-5, 395, -5, 195)))[0]
        there = np.isfinite(shown(axes))
        assert there.any() and not there[:, :3].any() and not there[:, 34:].any()


def test_thin_films_are_missing_and_what_is_masked_already_stays():
    maps, _ = event()
    maps.debris_flow__max_depth[10, 30] = 0.04
    assert np.isnan(shown(panels(draw_map(maps, "max_speed", extent=(-5, 395, -5, 195)))[0])[10, 30])
    everything = draw_map(maps, "max_speed", extent=(-5, 395, -5, 195), least_depth=0.0)
    assert shown(panels(everything)[0])[10, 30] == 9.0
    with pytest.raises(InputError, match="least_depth must lie in"):
        draw_map(maps, least_depth=-1.0)


def test_a_thin_film_is_fainter_and_paler_than_a_deep_flow():
    """Over level ground, which is grey, a film is no darker line around the flow and no bright one."""
    for name in ("max_depth", "max_speed", "max_basal_pressure_ratio"):
        colours = values_of(panels(draw_map(event()[0], name))[0]).cmap
        red, green, blue, opacity = np.array([colours(0.0), colours(1.0)]).T
        grey = 0.89
        seen = opacity * (0.3 * red + 0.6 * green + 0.1 * blue) + (1.0 - opacity) * grey
        assert abs(seen[0] - grey) < 0.06 and seen[1] < 0.45


def test_the_peclet_number_is_on_a_logarithmic_scale():
    axes = panels(draw_map(event()[0], "max_basal_peclet_number"))[0]
    norm = values_of(axes).norm
    assert isinstance(norm, LogNorm) and (norm.vmin, norm.vmax) == (1.0, 100.0)
    with pytest.raises(InputError, match="above 0"):
        draw_map(event()[0], "max_basal_peclet_number", limits=(0.0, 10.0))


def test_arrival_has_isochrones_with_their_times():
    figure = draw_map(event()[0], "arrival_time")
    times = {text.get_text() for text in panels(figure)[0].texts}
    assert {"20", "40"} <= times
    assert overlaps(figure) == []


def test_change_of_elevation_knows_the_scar_only_with_the_ground_before():
    maps, before = event()
    whole = {"extent": (-5, 395, -5, 195)}
    without = shown(panels(draw_map(maps, "elevation_change", **whole))[0])
    known = shown(panels(draw_map(maps, "elevation_change", before=before, **whole))[0])
    assert_allclose([known[10, 5], known[10, 15], known[10, 28]], [-1.0, -0.5, 0.8])
    assert_allclose(without[10, [5, 15, 28]], [np.nan, -0.5, 0.8])
    moving, _ = event(settled=False)  # the deposit is not in the ground yet
    assert_allclose(shown(panels(draw_map(moving, "elevation_change", before=before, **whole))[0]), known)


def test_the_release_is_outlined_where_it_is_known():
    maps, before = event()
    figure = draw_map(maps, before=before)
    rims = [lines for lines in panels(figure)[0].collections if isinstance(lines, LineCollection)]
    assert_allclose([np.min(rims[-1].get_segments(), axis=(0, 1))], [(35.0, 65.0)])
    assert not any(isinstance(lines, LineCollection) for lines in panels(draw_map(maps))[0].collections)


def test_shapes_and_places_are_drawn():
    house = {"type": "Polygon", "coordinates": [[[200, 80], [220, 80], [220, 100], [200, 80]]]}
    figure = draw_map(event()[0], shapes=[house], places={"bridge $1": [[150, 60], [150, 140]], "tower": [250, 100]})
    axes = panels(figure)[0]
    assert {"bridge \\$1", "tower"} <= {text.get_text() for text in axes.texts}
    assert any(len(lines.get_segments()) == 1 for lines in axes.collections if isinstance(lines, LineCollection))
    assert overlaps(figure) == []
    with pytest.raises(InputError, match="map coordinates"):
        draw_map(event()[0], shapes=7)


def test_maps_of_a_gis_lie_where_they_are():
    """A raster of a GIS begins in the north."""
    maps, before = event()
    turned, turned_before = maps.isel(y=slice(None, None, -1)), before.isel(y=slice(None, None, -1))
    for name in ("max_depth", "elevation_change"):
        one, other = (draw_map(*m, before=b) for m, b in (((maps, name), before), ((turned, name), turned_before)))
        assert_allclose(shown(panels(one)[0]), shown(panels(other)[0]))


@pytest.mark.parametrize(("spacing", "unit", "bar"), [(10.0, "m", "50 m"), (500.0, "km", "2 km")])
def test_unit_and_scale_bar_follow_the_size(spacing, unit, bar):
    axes = panels(draw_map(event(spacing)[0]))[0]
    assert axes.get_xlabel() == f"x [{unit}]" and bar in {text.get_text() for text in axes.texts}


def test_the_scale_bar_is_where_least_is_drawn():
    maps, _ = event()
    axes = panels(draw_map(maps, extent=(-5, 395, 65, 175)))[0]  # the flow is at the lower edge
    heights = [line.get_ydata()[0] for line in axes.lines if line.get_label() == "_scale bar"]
    assert heights and heights[0] > 0.5


def test_a_map_is_drawn_into_given_axes():
    figure = pyplot.figure()
    try:
        given = figure.add_subplot()
        assert draw_map(event()[0], axes=given, title="mine") is figure
        assert given.get_title(loc="left") == "mine" and given.images
    finally:
        pyplot.close(figure)


def test_what_cannot_be_drawn_is_refused():
    maps, before = event()
    with pytest.raises(InputError, match=r"no map 'max_deth' \(did you mean 'max_depth'\?\)"):
        draw_map(maps, "max_deth")
    over_time = maps.expand_dims(time=[0.0, 1.0])
    with pytest.raises(InputError, match=r"has time, too; choose one, such as maps.isel\(time=-1\)"):
        draw_map(over_time, "max_depth")
    with pytest.raises(InputError, match="before must be over the same nodes"):
        draw_map(maps, "elevation_change", before=before.isel(x=slice(0, 9)))
    with pytest.raises(InputError, match="west < east"):
        draw_map(maps, extent=(10, 0, 0, 10))


def test_nothing_to_show_is_said():
    maps, _ = event()
    axes = panels(draw_map(maps * 0.0 + maps.topographic__elevation.min(), "eroded_depth"))[0]
    assert axes is not None
    nothing = maps.assign(debris_flow__eroded_depth=0.0 * maps.debris_flow__eroded_depth)
    assert "nothing to show" in {text.get_text() for text in panels(draw_map(nothing, "eroded_depth"))[0].texts}


def test_an_overview_has_six_maps_of_one_extent():
    maps, before = event(origin=UTM)
    figure = draw_overview(maps, before=before)
    shown_panels = panels(figure)
    assert len(shown_panels) == 6
    assert len({(axes.get_xlim(), axes.get_ylim()) for axes in shown_panels}) == 1
    assert figure.get_suptitle() == "28 m³ released; after 66 s"
    assert overlaps(figure) == [] and outside(figure) == []
    few = draw_overview(maps[["topographic__elevation", "debris_flow__max_depth"]])
    assert len(panels(few)) == 1


def test_light_comes_from_the_north_west_and_level_ground_is_light():
    shade = hillshade(on_map(cone()))
    assert shade[15, 10] > 0.9 > 0.8 > shade[5, 20]  # rows run northwards
    level = hillshade(on_map(np.full((9, 9), 50.0)))
    assert np.ptp(level) == 0.0 and 0.85 < level[0, 0] < 0.93
    gap = on_map(cone())
    gap[3, 3] = np.nan
    assert np.isnan(hillshade(gap)).sum() == 1


def test_a_fan_and_a_wall_both_show_their_form():
    """A cone of three degrees has light and shade as well as one of 27."""
    for steepness in (0.1, 1.0):
        shade = hillshade(on_map(steepness * cone()))
        assert np.ptp(shade) > 0.2


def test_coordinates_are_whole_numbers():
    assert coordinate_text(5_200_140.0) == "5\u2009200\u2009140" and coordinate_text(-50.0) == "\u221250"


def test_a_very_long_valley_and_a_tall_one_stay_legible():
    x, y = 500_000.0 + 10.0 * np.arange(1500), 5_200_000.0 + 10.0 * np.arange(30)
    depth = np.where(abs(np.arange(30) - 15)[:, None] + 0 * x < 3, 2.0, 0.0) * (x < x[1300])
    fields = {"topographic__elevation": 0.02 * (x[-1] - x) + 0.0 * y[:, None], "debris_flow__max_depth": depth}
    fields |= {"debris_flow__max_speed": depth, "debris_flow__max_basal_pressure_ratio": 0.1 * depth}
    long = xr.Dataset({name: (("y", "x"), values) for name, values in fields.items()}, {"y": y, "x": x})
    tall = long.rename(x="y", y="x").transpose("y", "x")
    for maps in (long, tall):
        for figure in (draw_map(maps), draw_overview(maps)):
            axes = panels(figure)[0]
            sides = sorted([np.diff(axes.get_xlim())[0], np.diff(axes.get_ylim())[0]])
            assert sides[1] / sides[0] < 6.01
            assert overlaps(figure) == [] and outside(figure) == []


def test_noise_of_a_plain_has_no_contours():
    noise = np.random.default_rng(0).normal(0.0, 0.05, (20, 40))
    maps, _ = event()
    plain = maps.assign(topographic__elevation=(("y", "x"), noise))
    assert not [one for one in panels(draw_map(plain))[0].collections if isinstance(one, ContourSet)]
    assert [one for one in panels(draw_map(maps))[0].collections if isinstance(one, ContourSet)]


def test_a_notebook_shows_a_figure_without_pyplot():
    """IPython asks results of cells for this method; the plain figures of matplotlib have none."""
    maps, _ = event()
    assert draw_map(maps, "max_depth")._repr_png_().startswith(b"\x89PNG")
