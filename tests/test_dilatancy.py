"""Dilatancy in a flow: what it refuses, what it shows and keeps, and how soil, inflow and bends of the bed come in."""

import json
import math

import numpy as np
import pytest

from landlab_debrisflow import DebrisFlow, ParameterError, Scene
from landlab_debrisflow.laws import ALE, Dilatancy
from landlab_debrisflow.model.basal import basal_resistance, basal_state
from landlab_debrisflow.model.column_forcing import column_forcing
from landlab_debrisflow.scene.setup import Setup
from validation.grids import COARSE, inclined, release_slab

COLUMN = {"law": "ale", "dilatancy": {"permeability": 1e-10, "grain_diameter": 2e-3}}


def slope(**keywords):
    grid = inclined((20, 60), 5.0, 0.5, soil=1.0, foot=150.0)
    release_slab(grid, (30.0, 48.0), 8.0, 1.0)
    return DebrisFlow(grid, **{"column": COLUMN, "numerics": COARSE, "erosion": "none"} | keywords)


@pytest.mark.parametrize(
    "keywords, words",
    [
        ({"material": {"coefficient_of_consolidation": 0.01}}, "must be left out with dilatancy, got 0.01"),
        ({"material": {"coefficient_of_consolidation": 4e-4}}, "must be left out with dilatancy, got 0.0004"),
        ({"flow": "two_phase"}, "dilatancy goes with one phase"),
        ({"material": {"water_density": 0.0}}, "water_density must be > 0"),
        ({"material": {"water_table_ratio": 0.5}}, "water_table_ratio must be 1"),
        ({"material": {"porosity": 0.8}}, r"porosity must lie in \[0.26, 0.7\] with dilatancy, got 0.8"),
        ({"material": {"bed_porosity": 0.1}}, "bed_porosity must lie in"),
        ({"column": COLUMN | {"scheme": "upwind"}}, "scheme must be left out with dilatancy"),
        ({"column": COLUMN | {"tolerance": 1e-3}}, "tolerance must be left out with dilatancy"),
        ({"column": COLUMN | {"source_includes_erosion": True}}, "source_includes_erosion must be left out"),
        ({"column": {"law": "classical", "dilatancy": {}}}, "unknown key 'dilatancy' .it is one of ale."),
        ({"column": {"law": "ale", "dilatancy": 3.0}}, "dilatancy must be a mapping with some of critical_solid"),
        ({"column": {"law": "ale", "dilatancy": {"permeabilty": 1e-9}}}, "did you mean 'permeability'"),
        ({"column": {"law": "ale", "dilatancy": {"permeability": "5e-9 m2"}}}, "permeability must be a number"),
        ({"column": {"law": "ale", "dilatancy": {"permeability": -1.0}}}, "permeability must lie in"),
    ],
)
def test_what_does_not_go_with_dilatancy_is_refused(keywords, words):
    with pytest.raises(ParameterError, match=words):
        slope(**keywords)


def test_a_setup_with_dilatancy_goes_through_mappings_files_and_scenes():
    setup = Setup(column=COLUMN)
    assert setup.column == ALE(dilatancy=Dilatancy(permeability=1e-10, grain_diameter=2e-3))
    mapping = json.loads(json.dumps(setup.to_mapping()))
    assert mapping["column"]["dilatancy"]["permeability"] == 1e-10
    assert Setup.from_mapping(mapping) == setup and Setup.from_mapping(mapping).digest() == setup.digest()
    assert Setup(column="ale").digest() != Setup(column={"law": "ale", "dilatancy": {}}).digest()
    scene = Scene.from_mapping(
        {"terrain": {"elevation": "dem.tif"}, "release": {"depth": 1.0, "polygons": "scar.gpkg"}, "column": COLUMN}
    )
    assert scene.setup == setup


def simulation_of(flow):
    """Return the simulation inside a flow: no output has the stress that friction reads."""
    return flow._simulation


def test_files_name_its_constants_and_no_coefficient_that_nothing_reads():
    flow = slope()
    flow.run_one_step(1.0)
    attributes = flow.maps.attrs
    assert attributes["column_dilatancy_permeability"] == 1e-10
    assert attributes["column_dilatancy_permeability_units"] == "m2"
    assert not [name for name in attributes if "coefficient_of_consolidation" in name]
    assert "coefficient_of_consolidation" not in attributes["setup"]
    assert Setup.from_dataset(flow.maps) == flow.setup
    columns = flow.columns
    assert columns.solid_fraction.dims == ("particle", "level") and columns.solid_fraction.attrs["units"] == "1"
    # T_c = h2/c_v with the coefficient of consolidation of the base
    law, base = flow.setup.column.dilatancy, columns.solid_fraction.values[:, 0]
    particles = simulation_of(flow).particles
    memory = particles.column_memory[np.argsort(particles.identity)]
    load, pressure = memory[:, 1], columns.excess_pore_pressure.values[:, 0]
    c_v = law.coefficient_of_consolidation(base, load - pressure)
    np.testing.assert_allclose(columns.consolidation_time * c_v, columns.thickness**2, rtol=1e-6)


def test_inflow_brings_debris_as_loose_as_the_material_says():
    surge = {
        "line_start": (20.0, 40.0), "line_end": (20.0, 60.0), "times": [0.0, 5.0], "discharge": [20.0, 20.0],
        "velocity": 4.0,
    }  # fmt: skip
    flow = DebrisFlow(
        inclined((20, 60), 5.0, 0.5, foot=150.0), column=COLUMN, inflow=surge, material={"porosity": 0.42},
        numerics=COARSE, erosion="none",
    )  # fmt: skip
    flow.run_one_step(0.5)
    fraction = flow.columns.solid_fraction.values
    assert len(fraction) > 5 and np.abs(fraction - 0.58).max() < 0.01 and (fraction > 0.58).any()


def test_stress_at_the_base_is_that_of_friction_on_a_bend_of_the_bed():
    """Friction sees the normal gravity of the bend, the liquefaction pressure that of a plane."""
    flow = slope(material={"initial_pressure_ratio": 0.0})
    flow.run_one_step(0.0)
    flow.run_one_step(4.0)
    simulation = simulation_of(flow)
    p, near = simulation.particles, simulation.surroundings
    everything, nothing = slice(p.count), np.zeros(p.count)
    state = basal_state(p, everything, near.friction)
    forcing = column_forcing(p, everything, near.columns, nothing, nothing)
    expected = np.maximum(forcing.shearing.load - p.basal_excess_pore_pressure, 0.0)
    np.testing.assert_allclose(state.stress.effective_normal, expected, atol=1e-9 * expected.max())
    bent = np.abs(forcing.shearing.load / p.liquefaction_pressure - 1.0)
    assert bent.max() > 0.01


def test_sheared_water_and_the_angle_of_dilatancy_resist():
    """On the same column: tan(phi + psi) of the stress, and 2 mu (1 - m)/h of the speed."""
    dense = {"porosity": 0.34, "initial_pressure_ratio": 0.9}
    flow = slope(friction={"law": "coulomb", "basal_friction_angle": 15.0}, material=dense)
    flow.run_one_step(1.0)
    simulation = simulation_of(flow)
    p, friction = simulation.particles, simulation.surroundings.friction
    awake = slice(p.awake)
    yield_stress, drag = basal_resistance(p, awake, friction)
    state, base = basal_state(p, awake, friction), flow.setup.column.at_base(p.column_memory[awake])
    angle = math.radians(15.0) + np.arctan(base.dilatancy)
    np.testing.assert_allclose(yield_stress, state.stress.effective_normal * np.tan(angle), rtol=1e-12)
    expected = 2.0 * 5e-3 * (1.0 - p.solid_fraction[awake, 0]) / p.thickness[awake]
    np.testing.assert_allclose(drag, expected, rtol=1e-12)
    assert base.dilatancy.max() > 0.01
