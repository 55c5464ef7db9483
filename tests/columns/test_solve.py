"""Columns by themselves: closed forms through the public function, what it puts out, what it refuses."""

import numpy as np
import pytest
import xarray as xr
from numpy.testing import assert_allclose, assert_array_equal
from scipy.integrate import trapezoid

from landlab_debrisflow import ParameterError, __version__, solve_column
from landlab_debrisflow.exact.columns import consolidation, growing_column
from landlab_debrisflow.physics.column.schemes.registry import ADVANCE

LOADING = 990.0 * 9.81
ROUNDING = 1e-12  # hundreds of operations at 2e-16 each, relative to the largest pressure
ETA = np.linspace(1.0, 0.0, 11)


def profile(ds, column=0, time=-1):
    return ds.excess_pore_pressure.values[time, column]


# ---- closed forms ----


@pytest.mark.slow
@pytest.mark.parametrize(
    "number, time, atol",
    [(0.01, 0.05, 6e-3), (0.01, 0.5, 1e-3), (1.0, 0.1, 3e-3), (1.0, 1.0, 3e-3), (1.0, 5.0, 3e-3), (10.0, 1.0, 1e-2)],
)
@pytest.mark.parametrize("advance", ["lazy", "every_step"])
def test_growing_column(number, time, atol, advance):
    ds = solve_column(entrainment_rate=number, coefficient_of_consolidation=1.0, times=[time], advance=advance)
    exact = growing_column(ds.level.values, time, number)
    if advance == "lazy":
        atol += 3e-3  # the tolerance of the law at 11 levels
    assert_allclose(profile(ds)[1:], exact[1:], atol=atol)
    assert_allclose(profile(ds)[0], exact[0], atol=max(atol, 0.04))  # a level that fills only at first
    assert_allclose(ds.basal_excess_pore_pressure, 1.0, rtol=ROUNDING)


def test_units_do_not_matter():
    """The same column, ten times as thick, a thousandth as diffusive, under another pressure."""
    ds = solve_column(
        thickness=10.0, entrainment_rate=1e-4, coefficient_of_consolidation=1e-3, basal_pressure=6e4, times=[1e5]
    )
    assert_allclose(ds.initial_peclet_number, 1.0, rtol=ROUNDING)
    assert_allclose(profile(ds) / 6e4, growing_column(ds.level.values, 1.0, 1.0), atol=6e-3)


@pytest.mark.parametrize("loading_source", ["overburden", "proportional"])
@pytest.mark.parametrize("coefficient", [0.0, 1e-3, 1.0])
def test_a_constant_ratio_survives_any_erosion(loading_source, coefficient):
    ds = solve_column(
        entrainment_rate=lambda t: 0.02 * (1.0 + np.sin(t) ** 2), coefficient_of_consolidation=coefficient,
        times=[3.0, 20.0], loading=LOADING, loading_source=loading_source, basal_pressure_ratio=0.65,
        initial="linear", bounded=True,
    )  # fmt: skip
    exact = 0.65 * LOADING * ds.thickness.values[..., None] * ETA
    assert_allclose(ds.excess_pore_pressure, exact, atol=ROUNDING * exact.max())
    assert_allclose(ds.basal_excess_pore_pressure, exact[..., 0], rtol=ROUNDING)


def test_the_law_of_a_constant_ratio():
    ds = solve_column(law="constant_ratio", loading=LOADING, basal_pressure_ratio=0.4, times=[0.0, 10.0], levels=5)
    exact = 0.4 * LOADING * ds.thickness.values[..., None] * np.linspace(1.0, 0.0, 5)
    assert_allclose(ds.excess_pore_pressure, exact, rtol=ROUNDING)
    assert_allclose(ds.basal_excess_pore_pressure, exact[..., 0], rtol=ROUNDING)


@pytest.mark.parametrize("scheme", ADVANCE)
@pytest.mark.parametrize("start, atol", [("linear", 2e-3), ("uniform", 1e-2)])  # uniform: the surface drops at once
def test_consolidation_over_an_impermeable_base(scheme, start, atol):
    times = np.array([0.05, 0.1, 0.2, 0.5, 1.0])
    ds = solve_column(
        entrainment_rate=0.0, coefficient_of_consolidation=1.0, basal_pressure=3.0, times=times, initial=start,
        scheme=scheme,
    )  # fmt: skip
    atol = 3.0 * (atol if scheme == "default" else 1e-2)  # the others are not exact in time
    shape = "linear" if start == "linear" else "basal_layer"
    for k, time in enumerate(times):
        assert_allclose(profile(ds, 0, k), 3.0 * consolidation(ds.level, time, shape), atol=atol)
        assert_allclose(ds.basal_excess_pore_pressure[k], 3.0 * consolidation(0.0, time, shape), atol=atol)


@pytest.mark.parametrize("thickness, coefficient", [(1.0, 1.0), (2.0, 0.4)])
def test_a_drained_base(thickness, coefficient):
    ds = solve_column(
        thickness=thickness, entrainment_rate=0.0, coefficient_of_consolidation=coefficient, times=[0.3, 1.0],
        initial="uniform", initial_pressure=5.0, base="drained",
    )  # fmt: skip
    waves = (2.0 * np.arange(100) + 1.0) * np.pi
    for k, time in enumerate(ds.time.values):
        decay = 4.0 / waves * np.exp(-(waves**2) * coefficient * time / thickness**2)
        assert_allclose(profile(ds, 0, k), 5.0 * np.sin(ds.level.values[:, None] * waves) @ decay, atol=5e-2)
    assert_array_equal(ds.basal_excess_pore_pressure, 0.0)


def test_a_base_that_is_prescribed_without_erosion():
    ds = solve_column(
        entrainment_rate=0.0, coefficient_of_consolidation=1.0, basal_pressure=2.0, times=[20.0], base="prescribed"
    )
    assert_allclose(profile(ds), 2.0 * ETA, atol=1e-9)
    assert_allclose(ds.basal_excess_pore_pressure, 2.0)


def test_a_base_that_is_impermeable_though_it_erodes():
    ds = solve_column(times=[10.0, 100.0], base="impermeable")
    assert_array_equal(ds.excess_pore_pressure, 0.0)
    assert_allclose(ds.thickness.values.ravel(), [1.1, 2.0])


def test_what_new_soil_brings():
    """Over a flux base the content is what came in, and nothing diffuses in from the bed."""
    ds = solve_column(
        coefficient_of_consolidation=1e-6, basal_pressure=3.0, times=[100.0], bed_contact="flux", levels=101
    )
    content = trapezoid(profile(ds), ds.level) * ds.thickness.values[0, 0]
    assert_allclose(content, 3.0 * 0.01 * 100.0, rtol=1e-2)


def test_undrained_loading_lifts_every_level_by_its_own_overburden():
    ds = solve_column(
        entrainment_rate=0.0, coefficient_of_consolidation=0.0, times=[10.0], initial=300.0 * ETA**2,
        divergence_rate=-0.05, loading=LOADING,
    )  # fmt: skip
    assert_allclose(ds.thickness, np.exp(0.5), rtol=ROUNDING)
    assert_allclose(profile(ds), 300.0 * ETA**2 + LOADING * (np.exp(0.5) - 1.0) * ETA, rtol=1e-10)


def test_no_loading_leaves_the_source_by_loading_out():
    ds = solve_column(
        entrainment_rate=0.0, coefficient_of_consolidation=0.0, times=[10.0], initial=3.0 * ETA**2,
        divergence_rate=[-0.05, 0.05],
    )  # fmt: skip
    assert_allclose(profile(ds, 0), 3.0 * ETA**2, atol=3.0 * ROUNDING)
    assert_allclose(profile(ds, 1), 3.0 * ETA**2, atol=3.0 * ROUNDING)


def test_the_literal_source_makes_pressure_out_of_nothing():
    """p = rho' g y ln(h/max(h_0, y)) (docs/theory.md#loading); without it a dry bed leaves a cold column cold."""
    given = {
        "coefficient_of_consolidation": 0.0,
        "basal_pressure": 0.0,
        "times": [100.0],
        "loading": LOADING,
        "levels": 101,
    }
    assert_allclose(profile(solve_column(**given)), 0.0, atol=ROUNDING * LOADING)
    ds = solve_column(**given, source_includes_erosion=True)
    depth = 2.0 * (1.0 - ds.level.values)
    assert_allclose(profile(ds), LOADING * depth * np.log(2.0 / np.maximum(1.0, depth)), atol=0.03 * LOADING)


@pytest.mark.parametrize("source", [3.0, lambda t: 0.06 * t])
def test_a_source_alone(source):
    """S2 without drainage: every grain gains S t."""
    ds = solve_column(entrainment_rate=0.0, coefficient_of_consolidation=0.0, times=[100.0], porosity_source=source)
    assert_allclose(profile(ds)[:-1], 300.0, rtol=1e-9)
    assert_array_equal(profile(ds)[-1], 0.0)


@pytest.mark.parametrize(
    "base, exact", [("impermeable", 0.5 * (1.0 - (1.0 - ETA) ** 2)), ("drained", 0.5 * ETA * (1 - ETA))]
)
@pytest.mark.parametrize("time", [30.0, 1e5])  # also far beyond what a law counts of diffusion at once
def test_a_source_that_drains_for_long(base, exact, time):
    ds = solve_column(
        entrainment_rate=0.0, coefficient_of_consolidation=0.1, times=[time], porosity_source=0.2, base=base,
        thickness=0.5,
    )  # fmt: skip
    assert_allclose(profile(ds), 0.2 * 0.25 / 0.1 * exact, atol=2e-3)


# ---- functions of time ----


def test_thickness_is_exact_for_constant_rates():
    times = np.array([0.0, 1.0, 7.0, 50.0])
    rate, strain = 0.03, np.array([0.05, -0.01, 0.0])
    ds = solve_column(thickness=2.0, entrainment_rate=rate, divergence_rate=strain, times=times)
    growth = np.where(strain == 0.0, times[:, None], -np.expm1(-strain * times[:, None]) / (strain + (strain == 0.0)))
    thickness = 2.0 * np.exp(-strain * times[:, None]) + rate * growth
    assert_allclose(ds.thickness, thickness, rtol=1e-10)
    # what did not come in is the old soil, thinned
    assert_allclose(ds.front_height, 1.0 - 2.0 * np.exp(-strain * times[:, None]) / thickness, atol=1e-10)


def test_functions_that_do_not_vary():
    given = {"thickness": 1.0, "times": [10.0, 30.0], "step": 0.5}
    one = solve_column(entrainment_rate=0.02, basal_pressure=2.0, divergence_rate=0.01, **given)
    other = solve_column(
        entrainment_rate=lambda t: 0.02, basal_pressure=lambda t: [2.0], divergence_rate=lambda t: np.array(0.01),
        base=lambda t: "by_erosion", porosity_source=lambda t: 0, **given,
    )  # fmt: skip
    xr.testing.assert_equal(one, other)


def test_erosion_that_stops():
    """Basal pressure after erosion, of a tight column: erosion left no slope at the base except by the load."""
    given = {
        "coefficient_of_consolidation": 4e-4, "loading": LOADING, "basal_pressure_ratio": 0.65, "initial": "linear",
        "times": [40.0, 43.2, 75.2, 203.2, 443.2], "bounded": True,
    }  # fmt: skip
    ds = solve_column(entrainment_rate=lambda t: 0.05 if t < 43.2 else 0.0, **given)
    assert_allclose(ds.thickness[-1], 3.16, atol=0.06)  # the step in which it stops is a four hundredth of all
    ratio = ds.basal_excess_pore_pressure[:, 0] / (LOADING * ds.thickness[:, 0])
    assert_allclose(ratio[:2], 0.65, rtol=1e-9)
    assert_allclose(ratio[2:] / 0.65, [0.96, 0.91, 0.86], atol=1e-2)
    assert_allclose(ds.front_age[:, 0], ds.time)
    assert_array_equal(ds.basal_peclet_number[2:], 0.0)
    held = solve_column(
        entrainment_rate=lambda t: 0.05 if t < 43.2 else 0.0,
        base=lambda t: "prescribed" if t < 43.2 else ["impermeable"], **given,
    )  # fmt: skip
    xr.testing.assert_allclose(held.excess_pore_pressure, ds.excess_pore_pressure)


def test_a_bed_pressure_that_rises():
    """After long, p = a [t eta - h^2/(6 c_v) (eta - eta^3)]."""
    for thickness, advance in ((1.0, "lazy"), (2.0, "every_step")):
        ds = solve_column(
            thickness=thickness, entrainment_rate=0.0, coefficient_of_consolidation=1.0, times=[20.0],
            basal_pressure=lambda t: 0.3 * t, base="prescribed", advance=advance,
        )  # fmt: skip
        exact = 0.3 * (20.0 * ETA - thickness**2 / 6.0 * (ETA - ETA**3))
        assert_allclose(profile(ds), exact, atol=6e-3)


@pytest.mark.slow
def test_a_bed_pressure_that_swings_is_not_skipped():
    """Lazily as at every step: half a wave and back leaves nothing unless it is seen."""
    given = {
        "entrainment_rate": 0.0, "coefficient_of_consolidation": 0.05, "times": [5.0, 10.0, 20.0], "base": "prescribed",
        "basal_pressure": lambda t: np.sin(0.1 * np.pi * t),
    }  # fmt: skip
    lazy, eager = solve_column(**given), solve_column(**given, advance="every_step", step=0.005)
    assert np.abs(eager.excess_pore_pressure[-1]).max() > 0.2
    assert_allclose(lazy.excess_pore_pressure, eager.excess_pore_pressure, atol=1e-2)


def test_functions_are_asked_within_the_times_only_and_often_enough():
    asked = []

    def rate(t):
        asked.append(t)
        return 1e-6

    solve_column(entrainment_rate=rate, times=[1.0, 7.0])
    assert min(asked) == 0.0 and max(asked) <= 7.0 and len(set(asked)) >= 400
    asked.clear()
    solve_column(entrainment_rate=rate, times=[1.0, 7.0], step=2.0)
    assert sorted(set(asked)) == [0.0, 0.5, 1.0, 2.0, 4.0, 6.0, 7.0]  # the middles, and the times of output


# ---- many columns, many times ----


@pytest.mark.parametrize("law", ["ale", "classical"])
def test_columns_do_not_mix(law):
    each = {
        "thickness": [1.0, 2.0, 0.5], "entrainment_rate": [0.02, 0.0, 0.1],
        "coefficient_of_consolidation": [1e-3, 1e-2, 0.0],
        "basal_pressure": [1e3, 2e3, 3e3], "divergence_rate": [0.01, 0.0, -0.01], "loading": [9e3, 8e3, 7e3],
        "porosity_source": [0.0, 1.0, -1.0], "initial_pressure": [1e3, 5e2, 0.0],
    }  # fmt: skip
    words = ["by_erosion", "drained", "prescribed"]
    same = {"times": [0.0, 3.0, 20.0], "initial": "linear", "bounded": True, "step": 0.05, "law": law}
    together = solve_column(**each, **same, base=words)
    for k in range(3):
        one = solve_column(**{name: values[k] for name, values in each.items()}, **same, base=words[k])
        for name, values in one.data_vars.items():
            assert_array_equal(values.isel(column=0), together[name].isel(column=k), err_msg=name)


def test_scalars_and_profiles_are_spread_over_columns():
    ds = solve_column(initial=np.outer([1.0, 2.0, 3.0], ETA), times=[0.0], thickness=[1.0, 1.0, 2.0])
    assert dict(ds.sizes) == {"time": 1, "column": 3, "level": 11}
    assert_allclose(ds.excess_pore_pressure[0, :, 0], [1.0, 2.0, 3.0])
    assert_allclose(ds.basal_excess_pore_pressure[0], [1.0, 2.0, 3.0])
    assert solve_column(initial=ETA, times=1.0, basal_pressure=[1.0, 2.0]).sizes["column"] == 2


@pytest.mark.parametrize("law", ["ale", "classical"])
def test_a_look_changes_nothing(law):
    given = {
        "entrainment_rate": 0.02, "coefficient_of_consolidation": 2e-3, "loading": LOADING, "law": law, "step": 0.25,
        "basal_pressure_ratio": 0.65, "divergence_rate": lambda t: 0.02 * np.sin(0.3 * t),
    }  # fmt: skip
    few, many = solve_column(times=[50.0], **given), solve_column(times=np.arange(201) * 0.25, **given)
    assert_array_equal(profile(few), profile(many))  # the steps are the same
    free = solve_column(times=[17.3, 50.0], **given | {"step": None})
    assert_allclose(profile(free), profile(few), atol=5e-3 * LOADING)


@pytest.mark.slow
@pytest.mark.parametrize("law", ["ale", "classical"])
def test_lazy_is_close_to_every_step(law):
    given = {
        "entrainment_rate": lambda t: 0.05 * (t % 20.0 < 12.0), "divergence_rate": lambda t: 0.05 * np.sin(0.5 * t),
        "coefficient_of_consolidation": 2e-3, "loading": LOADING, "basal_pressure_ratio": 0.65, "initial": "linear",
        "times": np.arange(1.0, 41.0), "levels": 41, "law": law,
    }  # fmt: skip
    lazy, eager = solve_column(**given), solve_column(**given, advance="every_step")
    load = LOADING * eager.thickness
    assert np.abs((lazy.basal_excess_pore_pressure - eager.basal_excess_pore_pressure) / load).max() < 1e-2
    assert np.abs((lazy.excess_pore_pressure - eager.excess_pore_pressure) / load).max() < 3e-2


# ---- start and bounds ----


@pytest.mark.parametrize("loading", [0.0, 100.0])
def test_starts(loading):
    given = {"times": [0.0], "levels": 5, "loading": loading, "initial_layer_fraction": 0.25, "basal_pressure": 50.0}
    for name, values in {
        "zero": [0.0, 0.0, 0.0, 0.0, 0.0],
        "linear": [50.0, 37.5, 25.0, 12.5, 0.0],
        "uniform": [50.0, 50.0, 50.0, 25.0 if loading else 50.0, 0.0],  # no more than liquefies the grains
        "basal_layer": [50.0, 25.0, 0.0, 0.0, 0.0],
    }.items():
        assert_allclose(profile(solve_column(initial=name, **given)), values, atol=1e-12)
    assert_allclose(profile(solve_column(initial="linear", initial_pressure=-8.0, **given))[:2], [-8.0, -6.0])
    assert_allclose(profile(solve_column(initial="uniform", initial_pressure=-8.0, **given))[3:], [-8.0, 0.0])
    assert_allclose(profile(solve_column(initial=[4.0, 9.0, 1.0, 2.0, 0.0], **given)), [4.0, 9.0, 1.0, 2.0, 0.0])


def test_a_function_of_the_bed_gives_the_start_at_time_0():
    ds = solve_column(basal_pressure=lambda t: 7.0 + t, initial="linear", times=[0.0, 1.0])
    assert_allclose(ds.basal_excess_pore_pressure[:, 0], [7.0, 8.0])


def test_bounds_are_held_and_counted():
    given = {"entrainment_rate": 0.0, "coefficient_of_consolidation": 0.0, "times": [0.0, 1.0], "loading": 100.0,
                 "initial": np.stack([150.0 * ETA, 50.0 * ETA, -150.0 * ETA])}  # fmt: skip
    free, held = solve_column(**given), solve_column(**given, bounded=True)
    assert_allclose(free.excess_pore_pressure[1], given["initial"], atol=1e-10)
    assert_array_equal(free.clipped_pressure, 0.0)
    suction = -100.0 * 1000.0 / 990.0
    assert_allclose(held.excess_pore_pressure[1], np.outer([100.0, 50.0, suction], ETA), atol=1e-10)
    assert_allclose(held.clipped_pressure[1], [25.0, 0.0, 0.0], atol=1e-10)  # suction that is lacking is no loss


# ---- what is put out ----


def test_diagnostics():
    ds = solve_column(
        thickness=[1.0, 2.0], entrainment_rate=lambda t: [0.01 * (t > 10.0), 0.0], times=[0.0, 10.0, 60.0],
        coefficient_of_consolidation=[1e-3, 0.0], step=0.5,
    )  # fmt: skip
    assert_allclose(ds.thickness[:, 0], [1.0, 1.0, 1.5])
    assert_allclose(ds.basal_peclet_number, [[0.0, 0.0], [0.0, 0.0], [15.0, 0.0]])
    assert_allclose(ds.initial_peclet_number, 0.0)
    assert_allclose(ds.front_height, [[0.0, 0.0], [0.0, 0.0], [1.0 / 3.0, 0.0]], atol=ROUNDING)
    assert_allclose(ds.front_age, [[np.nan, np.nan], [np.nan, np.nan], [50.0, np.nan]])
    assert_allclose(ds.consolidation_time, [[1e3, np.inf], [1e3, np.inf], [2250.0, np.inf]])
    assert_allclose(ds.erosion_time, [[np.inf, np.inf], [np.inf, np.inf], [150.0, np.inf]])
    assert_allclose(solve_column(times=[0.0], thickness=2.0).initial_peclet_number, 20.0)


def test_everything_has_units_and_a_name():
    ds = solve_column(times=[1.0], thickness=[1.0, 2.0], porosity_source=lambda t: 0.0)
    for name in [*ds.data_vars, *ds.coords]:
        assert ds[name].attrs["units"] and ds[name].attrs["long_name"], name
    assert ds.excess_pore_pressure.dims == ("time", "column", "level")
    assert ds.thickness.dims == ("time", "column") and ds.initial_peclet_number.dims == ("column",)
    assert_allclose(ds.level, np.linspace(0.0, 1.0, 11))
    assert (ds.attrs["law"], ds.attrs["scheme"], ds.attrs["levels"]) == ("ale", "default", 11)
    assert ds.attrs["version"] == __version__ and ds.attrs["entrainment_rate"] == 0.01
    assert ds.attrs["entrainment_rate_units"] == "m s-1" and "levels_units" not in ds.attrs
    assert "thickness" not in ds.attrs and not [key for key in ds.attrs if key.startswith("porosity_source")]


def test_a_file_keeps_everything(tmp_path):
    ds = solve_column(times=[0.0, 1.0], thickness=[1.0, 2.0], coefficient_of_consolidation=[1e-3, 0.0], bounded=False)
    ds.to_netcdf(tmp_path / "column.nc")
    with xr.open_dataset(tmp_path / "column.nc") as read:
        xr.testing.assert_identical(read.load(), ds)


# ---- what is refused ----


def after(value, time=5.0):
    """A function that goes wrong at a time."""
    return lambda t: 0.01 if t < time else value


@pytest.mark.parametrize(
    "given, words",
    [
        ({"times": None}, "times is missing: give the times of output [s], increasing and >= 0"),
        ({"times": []}, "times must be one number or one per output, got shape (0,)"),
        ({"times": [[1.0]]}, "got shape (1, 1)"),
        ({"times": "10"}, "times must be one number or one per output, got '10'"),
        ({"times": [1.0, np.nan]}, "times must lie in [0, inf) s, got nan for output 1"),
        ({"times": [-1.0, 2.0]}, "times must lie in [0, inf) s, got -1 for output 0"),
        ({"times": [1.0, 3.0, 3.0]}, "times must increase, got 3 s and then 3 s for output 2; use np.unique(times)"),
        ({"thickness": 0.0}, "thickness must lie in (0, inf) m, got 0; give the slope-normal thickness"),
        ({"thickness": [1.0, -2.0]}, "thickness must lie in (0, inf) m, got -2 for column 1"),
        ({"thickness": lambda t: 1.0}, "thickness must be one number or one per column, got <function"),
        ({"thickness": None}, "thickness must be one number or one per column, got None"),
        ({"thickness": True}, "thickness must be one number or one per column, got True"),
        ({"thickness": [[1.0]]}, "thickness must be one number or one per column, got shape (1, 1)"),
        ({"thickness": [[1.0], [1.0, 2.0]]}, "thickness must be one number or one per column, got [[1.0], "),
        ({"entrainment_rate": -0.1}, "entrainment_rate must lie in [0, inf) m s-1, got -0.1; a column that gets"),
        ({"entrainment_rate": np.inf}, "entrainment_rate must lie in [0, inf) m s-1, got inf"),
        ({"coefficient_of_consolidation": -1.0}, "coefficient_of_consolidation must lie in [0, inf) m2 s-1, got -1"),
        ({"basal_pressure": np.nan}, "basal_pressure must lie in (-inf, inf) Pa, got nan"),
        ({"divergence_rate": [0.0, np.nan]}, "divergence_rate must lie in (-inf, inf) s-1, got nan for column 1"),
        ({"porosity_source": "much"}, "porosity_source must be one number or one per column, got 'much'"),
        ({"loading": -1.0}, "loading must lie in [0, inf) Pa m-1, got -1; give rho' g cos(theta)"),
        ({"loading": [0.0, 1.0]}, "loading must be 0 in all columns or > 0 in all"),
        ({"basal_pressure_ratio": 1.1, "loading": 1.0}, "basal_pressure_ratio must lie in [0, 1], got 1.1"),
        ({"basal_pressure_ratio": 0.5}, "basal_pressure_ratio needs loading > 0 Pa m-1, got loading=0"),
        ({"basal_pressure_ratio": 0.5, "loading": 1.0, "basal_pressure": 2.0}, "basal_pressure must be left out"),
        ({"bounded": True}, "bounded=True needs loading > 0 Pa m-1, got loading=0; give loading=rho' g cos(theta)"),
        ({"bounded": 1}, "bounded must be true or false, got 1"),
        ({"loading_source": "proportional"}, "loading_source='proportional' needs loading > 0"),
        ({"source_includes_erosion": True}, "source_includes_erosion=True needs loading > 0"),
        ({"source_includes_erosion": True, "loading": 1.0, "loading_source": "none"}, "loading_source='overburden'"),
        ({"source_includes_erosion": "no"}, "source_includes_erosion must be true or false, got 'no'"),
        ({"law": "constant_ratio"}, "law='constant_ratio' needs loading > 0"),
        ({"law": "constant_ratio", "loading": 1.0}, "needs basal_pressure_ratio as one number in [0, 1], got None"),
        ({"law": "fast"}, "law must be one of ale, classical, constant_ratio; got 'fast'"),
        ({"law": ["ale"]}, "law must be one of ale, classical, constant_ratio; got ['ale']"),
        ({"advance": "often"}, "advance must be one of lazy, every_step; got 'often'"),
        ({"advance": "every_step", "tolerance": 0.01}, "tolerance is for advance='lazy' only, got 0.01"),
        ({"tolerance": 2.0}, "tolerance must lie in [0, 0.1], got 2.0"),
        ({"scheme": "fast"}, "scheme must be one of default"),
        ({"bed_contact": "loose"}, "bed_contact must be one of dirichlet, flux; got 'loose'"),
        ({"loading_source": "all"}, "loading_source must be one of overburden, proportional, none; got 'all'"),
        ({"levels": 2}, "levels must lie in [3, 1001], got 2"),
        ({"levels": 11.0}, "levels must be an integer"),
        ({"step": 0.0}, "step must lie in (0, inf) s, got 0; leave it None to have it chosen"),
        ({"step": [1.0, 2.0]}, "step must be one number, got [1.0, 2.0]"),
        ({"step": 1e-20}, "a step of 1e-20 s is needed, too short for times up to 10 s"),
        ({"initial_layer_fraction": 1.5}, "initial_layer_fraction must lie in [0, 1], got 1.5"),
        ({"base": "wet"}, "base must be one of by_erosion, prescribed, impermeable, drained, or one of these per"),
        ({"base": ["drained", 1]}, "got 1"),
        ({"base": [["drained"]]}, "got shape (1, 1)"),
        ({"initial": "cold"}, "initial must be one of zero, linear, uniform, basal_layer or an array"),
        ({"initial": np.zeros(5)}, "of shape (11,) or (column, 11) as levels=11, index 0 at the base; got shape (5,)"),
        ({"initial": None}, "got None"),
        ({"initial": ETA[::-1]}, "initial must be 0 Pa at the surface, the last level, got 1; index 0 is the base"),
        ({"initial": ETA * [np.nan, *ETA[1:]]}, "initial must be finite, got nan at index (0,)"),
        ({"initial_pressure": 1.0}, "initial_pressure must be left None where initial is 'zero', got 1.0"),
        ({"initial": ETA, "initial_pressure": 1.0}, "initial_pressure must be left None where initial is an array"),
        (
            {"thickness": [1.0, 2.0], "basal_pressure": lambda t: [1.0, 2.0, 3.0], "initial": np.zeros((4, 11))},
            "arguments of different numbers of columns: thickness (2,), basal_pressure (3,), initial (4,); give each",
        ),
        ({"entrainment_rate": after(np.nan)}, "entrainment_rate must lie in [0, inf) m s-1, got nan at t = 5."),
        ({"entrainment_rate": after([0.0, -1.0]), "thickness": [1.0, 2.0]}, "got -1 for column 1 at t = 5."),
        ({"entrainment_rate": after(-1.0, 0.0)}, "entrainment_rate must lie in [0, inf) m s-1, got -1 at t = 0 s"),
        ({"basal_pressure": after([1.0, 2.0])}, "basal_pressure returned shape (2,) at t = 5"),
        ({"basal_pressure": after([1.0, 2.0])}, "a function must return one number, or 1, one per column, at every"),
        ({"divergence_rate": after(None)}, "divergence_rate must be one number or one per column, got None at t = 5"),
        ({"base": lambda t: "drained" if t < 5.0 else "wet"}, "got 'wet' at t = 5."),
        (
            {"divergence_rate": [0.0, 1e3], "step": 0.1, "entrainment_rate": 0.0},
            "thickness of column 1 became 5.1482e-131 m, without strain 1 m, at t = 0.3 s; both must stay in (1e-100,",
        ),
        ({"divergence_rate": -300.0, "step": 1.0}, "thickness of column 0 became 1.94"),
    ],
)  # fmt: skip
def test_refusals(given, words):
    with pytest.raises(ParameterError) as refusal:
        solve_column(**{"times": [10.0]} | given)
    assert words in str(refusal.value)
    assert isinstance(refusal.value, ValueError)


@pytest.mark.parametrize("scheme", ["default", "upwind"])
def test_soil_that_comes_in_over_an_impermeable_base_loads_nobody(scheme):
    """It has the pressure of the base, which grows by nothing; old soil keeps its depth, where levels can see it."""
    ds = solve_column(
        coefficient_of_consolidation=0.0, basal_pressure=5.0, times=[100.0], initial="linear", initial_pressure=1.0,
        base="impermeable", loading=1.0, levels=41, scheme=scheme,
    )  # fmt: skip
    pressure = ds.excess_pore_pressure.values[0, 0]
    old = np.linspace(0.0, 1.0, 41) > 0.75  # the upper half is old soil; below it the kink is smoothed
    assert_allclose(pressure[old], 2.0 * (1.0 - np.linspace(0.0, 1.0, 41))[old], atol=0.03)
    assert_allclose(pressure[0], 1.0, atol=ROUNDING)  # 2 if the weight of new soil loaded the old
    assert pressure.min() >= 0.0 and pressure.max() <= 1.1


@pytest.mark.parametrize("scheme", ["default", "upwind"])
def test_over_a_flux_base_the_content_is_what_came_in_at_eleven_levels(scheme):
    ds = solve_column(
        coefficient_of_consolidation=0.0, basal_pressure=1.0, times=[50.0, 100.0, 300.0], bed_contact="flux",
        scheme=scheme,
    )  # fmt: skip
    pressure = ds.excess_pore_pressure.values[:, 0]
    content = (pressure[:, 1:].sum(axis=1) + 0.5 * pressure[:, 0]) / 10.0 * ds.thickness.values[:, 0]
    assert_allclose(content, [0.5, 1.0, 3.0], atol=0.012)  # a quarter of a half cell, lost where the base fills it
