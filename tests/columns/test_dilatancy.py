"""`solve_column` with dilatancy: what it puts out, what it refuses."""

import numpy as np
import pytest
import xarray as xr
from numpy.testing import assert_allclose, assert_array_equal

from landlab_debrisflow import ParameterError, solve_column
from landlab_debrisflow.exact.dilatancy import equilibrium_solid_fraction, equilibrium_stress, stress_after_strain
from landlab_debrisflow.laws import Dilatancy

LOADING = 9000.0
GIVEN = {"thickness": 0.5, "entrainment_rate": 0.0, "loading": LOADING, "times": [0.0, 1.0], "dilatancy": {}}
TIGHT = GIVEN | {"dilatancy": {"permeability": 0.0}}


@pytest.mark.parametrize("shear_rate", [20.0, lambda t: 20.0, lambda t: [20.0]])
def test_loose_tight_debris_keeps_the_stress_of_its_fluid(shear_rate):
    column = solve_column(**TIGHT, solid_fraction=0.61, shear_rate=shear_rate)
    left = LOADING * 0.5 - column.basal_excess_pore_pressure.values[1, 0]
    assert_allclose(left, equilibrium_stress(0.61, 20.0), atol=2e-3)  # (s + sigma_0) to 1e-6
    assert_array_equal(column.solid_fraction, 0.61)


def test_the_shear_of_a_history_counts_as_its_strain():
    """Without viscosity stress depends on the strain alone, the integral of a rate that rises evenly from 0 to 2e4."""
    given = TIGHT | {"dilatancy": {"permeability": 0.0, "pore_fluid_viscosity": 1e-5, "grain_diameter": 1.0}}
    column = solve_column(**given | {"times": [1e-4]}, solid_fraction=0.62, shear_rate=lambda t: 2e4 * (t / 1e-4))
    left = LOADING * 0.5 - column.basal_excess_pore_pressure.values[0, 0]
    # 400 steps whose change of 2e-3 of 2800 Pa is wrong by half its square, if it is not iterated
    assert_allclose(left, stress_after_strain(1.0, LOADING * 0.5, 0.62), atol=2.0)


@pytest.mark.slow
def test_the_default_step_is_short_enough():
    """Soon after shear begins, while debris liquefies within 0.1 s, and long after."""
    given = GIVEN | {"solid_fraction": 0.61, "dilatancy": {"permeability": 1e-10}, "shear_rate": 20.0}
    for times in ([0.02, 0.05, 0.2, 4.0], [0.05, 50.0]):
        given["times"] = times
        free, fine = solve_column(**given), solve_column(**given, step=times[-1] / 8000.0)
        error = np.abs(free.excess_pore_pressure - fine.excess_pore_pressure).max() / (LOADING * 0.5)
        assert error < 2e-2
        assert np.abs(free.solid_fraction - fine.solid_fraction).max() < 2e-4


def test_diagnostics_follow_from_the_state():
    column = solve_column(**GIVEN | {"entrainment_rate": 0.01, "solid_fraction": 0.62, "shear_rate": [0.0, 30.0]})
    k_w = 5e-9 / 0.005 * np.exp((0.6 - 0.62) / 0.04)
    c_v = k_w * 0.62 * (LOADING * 0.5 + 1000.0) / 0.017
    assert_allclose(column.coefficient_of_consolidation[0], c_v, rtol=1e-7)
    assert_allclose(column.initial_peclet_number, 0.01 * 0.5 / c_v, rtol=1e-7)
    thickness, now = column.thickness, column.coefficient_of_consolidation
    assert_allclose(column.consolidation_time, thickness**2 / now)
    assert_allclose(column.basal_peclet_number, 0.01 * thickness / now)
    assert_allclose(column.dilatancy_angle[0, 0], np.degrees(np.arctan(0.62 - 0.64)), rtol=1e-12)
    assert np.all(now[1] != now[0])
    # of the state at the base, where collisions of grains count
    stress, packing = (
        LOADING * thickness[1, 1] - column.basal_excess_pore_pressure[1, 1],
        column.solid_fraction[1, 1, 0],
    )
    dilatancy = float(packing) - equilibrium_solid_fraction(float(stress), 30.0)
    assert_allclose(column.dilatancy_angle[1, 1], np.degrees(np.arctan(dilatancy)), rtol=1e-9)
    for name in ("solid_fraction", "dilatancy_angle", "coefficient_of_consolidation"):
        assert column[name].attrs["units"] and column[name].attrs["long_name"]
    assert column.solid_fraction.dims == ("time", "column", "level")
    assert "solid_fraction" not in solve_column(times=[0.0])


def test_files_keep_the_parameters(tmp_path):
    column = solve_column(**GIVEN | {"dilatancy": {"permeability": 1e-11}})
    assert column.attrs["dilatancy_permeability"] == 1e-11 and column.attrs["dilatancy_permeability_units"] == "m2"
    assert column.attrs["dilatancy_critical_solid_fraction"] == 0.64 and column.attrs["solid_fraction"] == 0.6
    assert "coefficient_of_consolidation" not in column.attrs
    assert solve_column(times=[0.0]).attrs["coefficient_of_consolidation"] == 1e-3
    column.to_netcdf(tmp_path / "column.nc")
    with xr.open_dataset(tmp_path / "column.nc") as read:
        xr.testing.assert_identical(read.load(), column)


def test_columns_do_not_mix():
    each = {"thickness": [0.1, 0.5, 2.0], "solid_fraction": [0.58, 0.62, 0.66], "shear_rate": [50.0, 0.0, 5.0]}
    same = GIVEN | {"step": 0.01, "entrainment_rate": 0.01, "soil_solid_fraction": 0.6, "basal_pressure_ratio": 0.65}
    together = solve_column(**same | each)
    for k in range(3):
        one = solve_column(**same | {name: values[k] for name, values in each.items()})
        for name, values in one.data_vars.items():
            assert_array_equal(values.isel(column=0), together[name].isel(column=k), err_msg=name)


def test_soil_brings_its_solid_fraction():
    given = TIGHT | {"entrainment_rate": 0.5, "basal_pressure_ratio": 0.3, "initial": "linear"}
    column = solve_column(**given, solid_fraction=0.6, soil_solid_fraction=0.66)
    assert_allclose(column.solid_fraction[1, 0, :4], 0.66, atol=1e-3)
    assert_allclose(column.solid_fraction[1, 0, 8:], 0.6, atol=1e-3)
    assert_allclose(solve_column(**given, solid_fraction=0.66).solid_fraction, 0.66, rtol=1e-12)


@pytest.mark.parametrize("base", ["prescribed", "impermeable", "drained"])
def test_bases(base):
    given = GIVEN | {"dilatancy": {"permeability": 1e-10}, "solid_fraction": 0.6, "shear_rate": 5.0}
    column = solve_column(**given, base=base, basal_pressure=1000.0)
    pressure = column.basal_excess_pore_pressure.values[1, 0]
    if base == "impermeable":
        assert pressure > 3000.0
    else:
        assert_allclose(pressure, 1000.0 * (base == "prescribed"), atol=1e-9)


def test_a_law_object_is_as_good_as_a_mapping():
    given = GIVEN | {"shear_rate": 3.0}
    xr.testing.assert_identical(
        solve_column(**given | {"dilatancy": Dilatancy(permeability=1e-10)}),
        solve_column(**given | {"dilatancy": {"permeability": 1e-10}}),
    )


@pytest.mark.parametrize(
    "given, words",
    [
        ({"coefficient_of_consolidation": 1e-3}, "coefficient_of_consolidation must be left out with dilatancy, got 0"),
        ({"coefficient_of_consolidation": [1e-3, 1.0]}, "coefficient_of_consolidation must be left out with dilatancy"),
        ({"loading": 0.0}, "dilatancy needs loading > 0 Pa m-1, got loading=0; give loading=rho' g cos(theta)"),
        ({"law": "classical"}, "dilatancy needs law='ale', got 'classical'"),
        ({"law": "constant_ratio", "basal_pressure_ratio": 0.5}, "dilatancy needs law='ale', got 'constant_ratio'"),
        ({"scheme": "upwind"}, "scheme must be left out with dilatancy"),
        ({"tolerance": 1e-3}, "tolerance must be left out with dilatancy"),
        ({"source_includes_erosion": True}, "source_includes_erosion must be left out with dilatancy"),
        ({"porosity_source": 1.0}, "porosity_source must be left out with dilatancy, got 1.0"),
        ({"porosity_source": lambda t: 0.0}, "porosity_source must be left out with dilatancy"),
        ({"shear_rate": -1.0}, "shear_rate must lie in [0, inf) s-1, got -1; give twice the mean velocity"),
        ({"shear_rate": [1.0, np.nan]}, "shear_rate must lie in [0, inf) s-1, got nan for column 1"),
        ({"shear_rate": lambda t: 1.0 - 5.0 * t}, "shear_rate must lie in [0, inf) s-1, got -"),
        ({"solid_fraction": 0.2}, "solid_fraction must lie in [0.3, 0.74], got 0.2; give 1 less the porosity"),
        ({"solid_fraction": lambda t: 0.6}, "solid_fraction must be one number or one per column, got <function"),
        ({"solid_fraction": "loose"}, "solid_fraction must be one number or one per column, got 'loose'"),
        ({"soil_solid_fraction": 0.9}, "soil_solid_fraction must lie in [0.3, 0.74], got 0.9"),
        ({"soil_solid_fraction": [0.6, 0.6]}, "soil_solid_fraction must be one number"),
        ({"solid_fraction": [0.6, 0.62], "entrainment_rate": 0.1}, "soil_solid_fraction must be given where columns"),
        ({"solid_density": 0.0}, "solid_density must lie in [1, 100000] kg m-3, got 0"),
        ({"solid_density": None}, "solid_density must be one number or one per column, got None"),
        ({"dilatancy": {"permeabilty": 1e-9}}, "did you mean"),
        ({"dilatancy": {"permeability": -1.0}}, "permeability must lie in [0, 0.001] m2"),
        ({"dilatancy": 0.64}, "dilatancy must be a mapping with some of critical_solid_fraction"),
        ({"dilatancy": None, "shear_rate": 2.0}, "shear_rate needs dilatancy, got 2.0 without it"),
        ({"dilatancy": None, "solid_fraction": 0.62}, "solid_fraction needs dilatancy, got 0.62"),
        ({"dilatancy": None, "soil_solid_fraction": 0.62}, "soil_solid_fraction needs dilatancy, got 0.62"),
        ({"dilatancy": None, "solid_density": 2700.0}, "solid_density needs dilatancy, got 2700.0"),
        ({"step": 0.0}, "step must lie in (0, inf) s"),
    ],
)  # fmt: skip
def test_refusals(given, words):
    with pytest.raises(ParameterError) as refusal:
        solve_column(**GIVEN | given)
    assert words in str(refusal.value), str(refusal.value)
