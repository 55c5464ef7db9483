"""Gauges, front, tracks and marked columns tell what maps, particles and columns tell."""

import numpy as np
import pytest

from landlab_debrisflow import DebrisFlow, InputError
from landlab_debrisflow.record import Front, Gauges, MarkedColumns, Tracks, quantile
from validation.grids import inclined, release_slab

WEST, SOUTH = 4000.0, 9000.0


class Every:
    """Observer that keeps what a function returns."""

    def __init__(self, interval, function):
        self.interval, self._function, self.kept = interval, function, []

    def observe(self, flow):
        self.kept.append(self._function(flow))


def slope(*observers, **keywords):
    grid = inclined((24, 60), 5.0, 0.5, soil=1.0, foot=150.0, xy_of_lower_left=(WEST, SOUTH))
    release_slab(grid, (WEST + 30.0, SOUTH + 60.0), 8.0, 1.0)
    return DebrisFlow(grid, observers=observers, **{"numerics": {"particle_count": 80}} | keywords)


def test_a_gauge_shows_what_the_maps_show():
    points = {"at a node": (WEST + 60.0, SOUTH + 60.0), "between": (WEST + 62.0, SOUTH + 61.0)}
    gauges, maps = Gauges(points, 1.0), Every(1.0, lambda flow: flow.maps)
    flow = slope(gauges, maps)
    flow.run_until_rest()
    data = gauges.dataset
    assert data.time.values == pytest.approx([one.attrs["elapsed_time"] for one in maps.kept], abs=0.0)
    assert data.x.values.tolist() == [WEST + 60.0, WEST + 62.0]
    wet = 0
    for k, one in enumerate(maps.kept):
        now, node = data.isel(time=k, gauge=0), one.sel(x=WEST + 60.0, y=SOUTH + 60.0)
        assert float(now.depth) == pytest.approx(float(node.debris_flow__depth), rel=1e-14)
        assert float(now.bed_elevation) == pytest.approx(float(node.topographic__elevation), rel=1e-14)
        between = one.interp(x=WEST + 62.0, y=SOUTH + 61.0)
        assert float(data.depth[k, 1]) == pytest.approx(float(between.debris_flow__depth), rel=1e-9, abs=1e-12)
        if float(now.depth) > 0.0:
            wet += 1
            assert float(now.speed) == pytest.approx(float(node.debris_flow__speed), rel=1e-12)
            assert float(now.discharge_per_width) == pytest.approx(float(now.depth * now.speed), rel=1e-12)
            pressure = float(node.debris_flow__basal_excess_pore_pressure)
            assert float(now.basal_excess_pore_pressure) == pytest.approx(pressure, rel=1e-12)
            assert float(now.solid_fraction) == pytest.approx(1.0 - flow.setup.material.porosity, rel=1e-12)
        else:
            assert np.isnan(now.speed) and float(now.discharge_per_width) == 0.0
    assert 0 < wet < len(maps.kept)


def test_a_gauge_has_the_solid_fraction_of_columns_with_dilatancy():
    gauges = Gauges({"at a node": (WEST + 60.0, SOUTH + 60.0)}, 1.0)
    flow = slope(gauges, column={"law": "ale", "dilatancy": {}}, erosion="none")
    flow.run_one_step(5.0)
    node = float(flow.maps.debris_flow__solid_fraction.sel(x=WEST + 60.0, y=SOUTH + 60.0))
    assert float(gauges.dataset.solid_fraction[-1, 0]) == pytest.approx(node, rel=1e-12)
    assert abs(node - 0.6) > 1e-3  # grains have moved together or apart since the start


@pytest.mark.slow
def test_a_gauge_tells_grains_from_water():
    gauges = Gauges({"a": (WEST + 60.0, SOUTH + 60.0)}, 1.0)
    slope(gauges, flow="two_phase").run_one_step(8.0)
    solid = gauges.dataset.solid_fraction.values
    assert np.nanmin(solid) > 0.2 and np.nanmax(solid) < 0.9


@pytest.mark.slow
def test_a_gauge_beside_a_wall_does_not_see_it():
    grid = inclined((24, 60), 5.0, 0.5, soil=1.0, foot=150.0, xy_of_lower_left=(WEST, SOUTH))
    wall = np.isclose(grid.x_of_node, WEST + 60.0)
    grid.status_at_node[wall] = grid.BC_NODE_IS_CLOSED
    release_slab(grid, (WEST + 30.0, SOUTH + 60.0), 8.0, 1.0)
    gauges = Gauges({"a": (WEST + 57.0, SOUTH + 60.0)}, 1.0)
    flow = DebrisFlow(grid, observers=gauges, numerics={"particle_count": 80})
    flow.run_one_step(5.0)
    node = float(flow.maps.debris_flow__depth.sel(x=WEST + 55.0, y=SOUTH + 60.0))
    assert float(gauges.dataset.depth[-1, 0]) == pytest.approx(node, rel=1e-12) and node > 0.0


def test_the_front_is_the_quantile_of_the_volume():
    thalweg = [(WEST, SOUTH + 60.0), (WEST + 100.0, SOUTH + 60.0), (WEST + 300.0, SOUTH + 60.0)]
    front, particles = Front(thalweg, 1.7), Every(1.7, lambda flow: flow.particles)
    flow = slope(front, particles)
    flow.run_until_rest()
    data = front.dataset
    assert float(data.time[0]) == 0.0 and float(data.time[-1]) == flow.elapsed_time
    for one, now in zip(particles.kept, data.isel(time=slice(1, None)).front_distance.values, strict=True):
        assert now == pytest.approx(quantile(one.x.values - WEST, one.volume.values, 0.99), rel=1e-12)
    assert np.all(data.farthest_distance >= data.front_distance)
    assert float(data.front_distance[0]) < 50.0 < float(data.front_distance[-1])
    assert float(data.front_elevation[0]) > float(data.front_elevation[-1])


@pytest.mark.slow
def test_tracks_are_the_particles():
    tracks, chosen, particles = Tracks(1.0, np.int64(7)), Tracks(1.0, [3, 11]), Every(1.0, lambda flow: flow.particles)
    flow = slope(tracks, chosen, particles)
    flow.run_until_rest()
    data = tracks.dataset
    assert data.sizes["particle"] == 7 and float(data.time[-1]) == flow.elapsed_time
    assert chosen.dataset.particle.values.tolist() == [3, 11]
    for k, one in enumerate(particles.kept):
        for followed in (data, chosen.dataset):
            now, there = followed.isel(time=k + 1), one.reindex(particle=followed.particle)
            for name in ("x", "y", "z", "depth", "basal_excess_pore_pressure", "volume"):
                assert np.array_equal(now[name], there[name], equal_nan=True), name
            speed = np.sqrt(there.velocity_x**2 + there.velocity_y**2 + there.velocity_z**2)
            assert now.speed.values == pytest.approx(speed.values, rel=1e-14, nan_ok=True)


@pytest.mark.slow
def test_a_particle_that_left_has_no_place():
    grid = inclined((24, 30), 5.0, 0.5, soil=1.0, xy_of_lower_left=(WEST, SOUTH))
    release_slab(grid, (WEST + 30.0, SOUTH + 60.0), 8.0, 1.0)
    tracks, columns = Tracks(1.0, [*range(60), 10**6]), MarkedColumns(2.0, [0, 10**6])
    flow = DebrisFlow(grid, observers=(tracks, columns), numerics={"particle_count": 80})
    flow.run_until_rest()
    assert flow.budget["outflow"] > 0.0
    x = tracks.dataset.x.values
    assert np.isfinite(x[0, :60]).all() and np.isnan(x[:, 60]).all()
    gone = np.isnan(x[:, :60])
    assert gone[-1].any() and np.all(np.diff(gone.astype(int), axis=0) >= 0)
    assert np.isfinite(columns.dataset.excess_pore_pressure[0, 0]).all()
    assert np.isnan(columns.dataset.excess_pore_pressure[:, 1]).all()


def test_marked_columns_are_those_of_the_flow():
    columns = MarkedColumns(2.0, [4, 9])
    flow = slope(columns)
    flow.run_one_step(4.0)
    data = columns.dataset
    now = flow.columns.sel(particle=[4, 9])
    assert np.array_equal(data.excess_pore_pressure[-1], now.excess_pore_pressure)
    assert np.array_equal(data.thickness[-1], now.thickness) and np.array_equal(data.level, now.level)
    assert data.excess_pore_pressure.attrs["units"] == "Pa" and data.sizes["time"] == 2


def test_a_run_that_goes_on_ends_with_the_same_series():
    def observers():
        thalweg = [(WEST, SOUTH + 60.0), (WEST + 290.0, SOUTH + 60.0)]
        point = {"a": (WEST + 60.0, SOUTH + 60.0)}
        return Gauges(point, 1.0), Front(thalweg, 1.0), Tracks(1.0, 5), MarkedColumns(2.0, [3])

    once, first, second = observers(), observers(), observers()
    flow = slope(*once, *first)
    flow.run_one_step(5.0)
    for one, other in zip(first, second, strict=True):
        state = one.state()
        assert all(isinstance(value, np.ndarray | float | int | str) for value in state.values())
        if hasattr(other, "prepare"):
            other.prepare(flow.grid, flow.setup)
        other.restore(state)
    flow._observers = (*once, *second)
    flow.run_one_step(5.0)
    for one, other in zip(once, second, strict=True):
        assert other.dataset.identical(one.dataset) and one.dataset.sizes["time"] >= 4


def test_series_can_be_written(tmp_path):
    gauges, tracks = Gauges({"Brücke": (WEST + 60.0, SOUTH + 60.0)}, 1.0), Tracks(1.0, 5)
    slope(gauges, tracks).run_one_step(3.0)
    for one in (gauges, tracks):
        one.dataset.to_netcdf(tmp_path / "series.nc")


@pytest.mark.parametrize(
    "make, words",
    [
        (lambda: Gauges({"a": (0.0, 0.0, 0.0)}, 1.0), "a point needs map coordinates x, y"),
        (lambda: Gauges({"a": (0.0, 0.0)}, -1.0), "Gauges: interval must be a finite number of seconds > 0"),
        (lambda: Front([(0.0, 0.0)], 1.0), "a line needs at least two different vertices"),
        (lambda: Front([(0.0, 0.0), (1.0, 1.0)], 1.0, 0.0), r"fraction must lie in \(0, 1\], got 0.0"),
        (lambda: Tracks(1.0, 0), "the number of particles must be at least 1, got 0"),
        (lambda: Tracks(1.0, [1, 1]), "a particle is twice among"),
        (lambda: Tracks(1.0, "all"), "particles must be whole numbers >= 0"),
        (lambda: MarkedColumns(1.0, []), "particles must be whole numbers >= 0"),
        (lambda: MarkedColumns(1.0, [-1]), "particles must be whole numbers >= 0"),
        (lambda: MarkedColumns(1.0, [[1], [2, 3]]), "particles must be whole numbers >= 0"),
    ],
)  # fmt: skip
def test_refusals(make, words):
    with pytest.raises(InputError, match=words):
        make()


@pytest.mark.parametrize(
    "observer, words",
    [
        (Gauges({"a": (10.0, 20.0)}, 1.0), r"Gauges: 'a': \(10, 20\) m is outside the grid"),
        (Gauges({"a": (WEST, SOUTH)}, 1.0), r"\(4000, 9000\) m is among closed or boundary nodes"),
        (Front([(0.0, 0.0), (1.0, 0.0)], 1.0), "thalweg: .* is outside the grid"),
    ],
)
def test_places_outside_are_refused_when_the_flow_is_built(observer, words):
    with pytest.raises(InputError, match=words):
        slope(observer)
