"""Series against time: every place a line with its name, every axis a unit."""

import numpy as np
import pytest
import xarray as xr
from matplotlib.figure import Figure
from numpy.testing import assert_allclose

from landlab_debrisflow import InputError, solve_column
from landlab_debrisflow.plots import (
    draw_column,
    draw_gauges,
    draw_hydrographs,
    draw_section,
    draw_time_distance,
    draw_tracks,
    draw_volumes,
)  # fmt: skip
from landlab_debrisflow.record import Front, Gauges, MarkedColumns, Sections, Tracks

from .drawing import event, outside, overlaps

TIME = np.arange(0.0, 50.0, 10.0)


def sections(names=("Brücke <1>", "$weir")):
    shape = len(names), TIME.size
    flow = np.arange(float(np.prod(shape))).reshape(shape)
    depth = np.where(flow > 2.0, 0.1 * flow, np.nan)
    return xr.Dataset(
        {
            "discharge": (("section", "time"), flow, {"units": "m3 s-1"}),
            "depth": (("section", "time"), depth, {"units": "m"}),
            "speed": (("section", "time"), depth, {"units": "m s-1"}),
            "crossed_volume": ("section", 10.0 * flow.sum(axis=1)),
        },
        {"section": list(names), "time": TIME},
    )


def test_hydrographs_have_names_volumes_and_units():
    figure = draw_hydrographs(sections(), title="Hydrographs")
    assert [axes.get_ylabel() for axes in figure.axes] == ["discharge [m³/s]", "depth [m]", "speed [m/s]"]
    assert figure.axes[-1].get_xlabel() == "time [s]"
    labels = [text.get_text() for text in figure.axes[0].get_legend().get_texts()]
    assert labels == ["Brücke <1>: 100 m³", "\\$weir: 350 m³"]
    assert_allclose(figure.axes[0].lines[1].get_ydata(), [5.0, 6.0, 7.0, 8.0, 9.0])
    assert np.isnan(figure.axes[1].lines[0].get_ydata()[0])
    assert overlaps(figure) == [] and outside(figure) == []


def test_legends_stand_above_the_data():
    front = xr.Dataset(dict.fromkeys(("front_distance", "farthest_distance"), ("time", TIME)), {"time": TIME})
    terms = ("released", "inflow", "eroded", "deposited", "outflow")
    budget = xr.Dataset(dict.fromkeys(terms, ("time", TIME)), {"time": TIME})
    for figure in (
        draw_hydrographs(sections()),
        draw_time_distance(front),
        draw_volumes(budget),
        draw_section(event()[0]),
    ):
        figure.draw_without_rendering()
        legends = [(axes, axes.get_legend()) for axes in figure.axes if axes.get_legend() is not None]
        assert legends
        for axes, legend in legends:
            assert legend.get_window_extent().y0 >= axes.get_window_extent().y1 - 1.0  # pixels


def test_no_two_lines_are_alike():
    lines = draw_hydrographs(sections([f"place {k}" for k in range(20)])).axes[0].lines
    assert len({(line.get_color(), line.get_linestyle()) for line in lines}) == 20


def test_hydrographs_are_drawn_into_given_axes_or_refused():
    figure = Figure()
    assert draw_hydrographs(sections(), axes=figure.add_subplot()) is figure and len(figure.axes) == 1
    with pytest.raises(InputError, match=r"no variable 'sped' over time and section \(did you mean 'speed'"):
        draw_hydrographs(sections(), variables=["sped"])
    with pytest.raises(InputError, match="one for each of 3 variables, got 2"):
        draw_hydrographs(sections(), axes=list(Figure().subplots(2, 1)))


def test_what_saw_nothing_is_drawn_empty():
    """Observers of a run that ended before its first step."""
    for figure in (
        draw_hydrographs(Sections({"a": [(0, 0), (1, 1)]}).dataset),
        draw_gauges(Gauges({"a": (0, 0)}, 1.0).dataset),
        draw_time_distance(Front([(0, 0), (1, 1)], 1.0).dataset),
        draw_tracks(Tracks(1.0, [0]).dataset, event()[0]),
    ):
        assert outside(figure) == []
    with pytest.raises(InputError, match="nothing is known of the column"):
        draw_column(MarkedColumns(1.0, [0]).dataset)


def test_gauges_are_in_kilopascal():
    shape = TIME.size, 1
    names = ("depth", "speed", "basal_excess_pore_pressure")
    data = {name: (("time", "gauge"), np.full(shape, 2000.0)) for name in names}
    figure = draw_gauges(xr.Dataset(data, {"time": TIME, "gauge": ["weir"]}))
    assert figure.axes[2].get_ylabel() == "basal excess\npore pressure [kPa]"
    assert_allclose(figure.axes[2].lines[0].get_ydata(), 2.0)
    assert overlaps(figure) == [] and outside(figure) == []


def test_the_front_is_told_by_its_percentage():
    words = {"long_name": "distance along the thalweg behind which 95 % of the volume lies"}
    front = xr.Dataset(
        {"front_distance": ("time", 3.0 * TIME, words), "farthest_distance": ("time", 4.0 * TIME)}, {"time": TIME}
    )
    figure = draw_time_distance(front, title="Front")
    labels = [text.get_text() for text in figure.axes[0].get_legend().get_texts()]
    assert labels == ["farthest particle", "front: 95 % of the volume lies behind"]
    assert figure.axes[0].get_ylabel() == "distance along the thalweg [m]"
    assert overlaps(figure) == [] and outside(figure) == []
    with pytest.raises(InputError, match="lacks front_distance"):
        draw_time_distance(sections())


def test_volumes_stand_on_each_other():
    terms = {"released": 100.0, "inflow": 0.0, "eroded": 5.0 * TIME, "deposited": 0.0, "outflow": 0.5 * TIME}
    budget = xr.Dataset({name: ("time", np.broadcast_to(v, TIME.shape)) for name, v in terms.items()}, {"time": TIME})
    axes = draw_volumes(budget).axes[0]
    assert [text.get_text() for text in axes.get_legend().get_texts()] == ["released", "eroded", "left the grid"]
    assert axes.dataLim.y1 == 300.0 and axes.get_ylabel() == "volume [m³]"
    with pytest.raises(InputError, match="lacks outflow"):
        draw_volumes(budget.drop_vars("outflow"))


def test_a_column_is_as_high_as_it_is_thick_and_in_kilopascal():
    times = np.linspace(0.0, 40.0, 21)
    columns = solve_column(
        times=times, thickness=[1.0, 2.0], entrainment_rate=[0.02, 0.0], coefficient_of_consolidation=1e-2
    )
    figure = draw_column(columns, 0, title="One of two")
    image, profiles = figure.axes[:2]
    assert image.get_ylabel() == "height above the base [m]" and profiles.get_xlabel() == "excess pore pressure [kPa]"
    assert_allclose(image.lines[0].get_ydata(), columns.thickness[:, 0])
    shown = image.collections[0].get_array()
    assert_allclose(shown, 1e-3 * columns.excess_pore_pressure[:, 0].values)
    assert overlaps(figure) == [] and outside(figure) == []
    with pytest.raises(InputError, match="no column 7; there are 0, 1"):
        draw_column(columns, 7)
    with pytest.raises(InputError, match="lacks excess_pore_pressure"):
        draw_column(sections())


def test_a_column_that_comes_late_and_thins_is_drawn_from_its_arrival():
    thickness = np.array([np.nan, 1.0, 0.4, 0.0, 0.6])
    pressure = np.where(np.isnan(thickness), np.nan, 1e3)[:, None, None] * np.linspace(1.0, -0.5, 5)
    columns = xr.Dataset(
        {
            "excess_pore_pressure": (("time", "particle", "level"), pressure),
            "thickness": (("time", "particle"), thickness[:, None]),
        },
        {"time": TIME, "particle": [3], "level": np.linspace(0.0, 1.0, 5)},
    )
    image = draw_column(columns).axes[0]
    assert image.get_title(loc="left") == "Excess pore pressure, particle 3"
    assert_allclose(image.lines[0].get_xdata(), TIME[1:])
    drawn = image.collections[0]
    assert (drawn.norm.vmin, drawn.norm.vmax) == (-0.5, 1.0)
    assert_allclose(drawn.cmap(drawn.norm(0.0))[:3], 1.0, atol=0.05)  # suction is blue, nothing is white


def test_tracks_lie_over_the_relief():
    maps, _ = event()
    x = np.linspace(50.0, 300.0, TIME.size)
    places = {name: (("time", "particle"), values[:, None]) for name, values in
              {"x": x, "y": 0.0 * x + 100.0, "speed": np.where(TIME < 40.0, 5.0, np.nan)}.items()}  # fmt: skip
    figure = draw_tracks(xr.Dataset(places, {"time": TIME, "particle": [0]}), maps)
    lines = next(c for c in figure.axes[0].collections if c.get_array() is not None and len(c.get_array()) == 3)
    assert_allclose(lines.get_array(), 5.0)
    assert overlaps(figure) == [] and outside(figure) == []
    with pytest.raises(InputError, match="lacks x"):
        draw_tracks(sections(), maps)
