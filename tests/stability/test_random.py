"""Scenes nobody thought of: rough terrain, walls, any body, any law."""

import numpy as np
import pytest
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st
from landlab import RasterModelGrid

from validation.grids import release
from validation.watch import Scene

pytestmark = pytest.mark.slow

LAWS = st.fixed_dictionaries(
    {
        "angle": st.sampled_from([0.0, 5.0, 20.0, 35.0, 60.0]),
        "voellmy": st.sampled_from([None, 10.0, 500.0]),
        "growth": st.sampled_from([0.0, 3e-3, 0.1, 10.0]),
        "column": st.sampled_from(["none", "ale", "classical", "constant_ratio"]),
        "bed_ratio": st.floats(0.0, 1.0),
        "consolidation": st.sampled_from([0.0, 4e-4, 0.4]),
        "water": st.sampled_from([0.0, 1000.0]),
        "count": st.sampled_from([1, 2, 5, 30, 120]),
        "courant": st.sampled_from([0.3, 0.6, 1.0]),
        "rest_energy": st.sampled_from([0.0, 1e-4]),
    }
)


def ground(roughest):
    """Strategy of terrains: `roughest` is the largest noise and step between two nodes, over their distance."""
    return st.fixed_dictionaries(
        {
            "seed": st.integers(0, 2**32 - 1),
            "shape": st.tuples(st.integers(8, 25), st.integers(8, 30)),
            "spacing": st.sampled_from([1.0, 5.0, 20.0]),
            "stretch": st.sampled_from([0.5, 1.0, 2.0]),
            "slope": st.sampled_from([0.0, 0.2, 0.5, 1.0]),
            "noise": st.floats(0.0, 0.3 * roughest),
            "cliff": st.sampled_from([0.0, 0.5, 1.0]).map(lambda v: v * roughest),
            "pit": st.sampled_from([0.0, 0.5, 1.0]).map(lambda v: v * roughest),
            "closed": st.sampled_from([0.0, 0.0, 0.05, 0.2]),
            "soil": st.sampled_from([None, 0.02, 1.0, 10.0]),
            "thickness": st.sampled_from([1e-2, 0.3, 3.0, 30.0]),
            "half_width": st.floats(0.6, 5.0),
        }
    )


def build(given_ground):
    """Return the grid, or None if all nodes that were to fail are closed."""
    g = given_ground
    random = np.random.default_rng(g["seed"])
    rows, columns = g["shape"]
    dx, dy = g["spacing"], g["spacing"] * g["stretch"]
    row, column = np.mgrid[:rows, :columns]
    z = g["slope"] * dx * np.maximum(0, 0.7 * columns - column) + random.normal(0.0, 1.0, row.shape) * g["noise"] * dx
    z -= g["cliff"] * dx * (column > columns // 2)
    z[rows // 2, columns // 2] -= g["pit"] * dx
    grid = RasterModelGrid((rows, columns), xy_spacing=(dx, dy))
    grid.add_field("topographic__elevation", z.ravel(), at="node")
    grid.status_at_node[random.random(grid.number_of_nodes) < g["closed"]] = grid.BC_NODE_IS_CLOSED
    if g["soil"] is not None:
        grid.add_full("soil__depth", g["soil"], at="node")
    x, y = random.integers(1, columns - 1) * dx, random.integers(1, rows - 1) * dy
    near = (abs(grid.x_of_node - x) < g["half_width"] * dx) & (abs(grid.y_of_node - y) < g["half_width"] * dy)
    near &= grid.status_at_node == grid.BC_NODE_IS_CORE
    if not near.any():
        return None
    release(grid, near * g["thickness"] * random.uniform(0.2, 1.0, near.size), on_top=True)
    return grid


def check(terrain, laws):
    grid = build(terrain)
    if grid is None:
        return
    friction = {"law": "coulomb", "basal_friction_angle": laws["angle"]}
    if laws["voellmy"]:
        friction |= {"law": "voellmy", "turbulent_coefficient": laws["voellmy"]}
    scene = Scene(
        grid, 10.0, count=laws["count"], looks=20, friction=friction,
        erosion={"law": "growth", "growth_rate": laws["growth"]}, column=laws["column"],
        material={
            "water_density": laws["water"], "bed_pressure_ratio": laws["bed_ratio"],
            "coefficient_of_consolidation": laws["consolidation"],
        },
        numerics={"courant_number": laws["courant"], "rest_energy": laws["rest_energy"]},
    ).run()  # fmt: skip
    assert scene.watch.finite
    assert scene.watch.excess <= 0.0
    fields = [n for n in grid.at_node if not n.endswith("peclet_number")]
    assert [name for name in fields if not np.isfinite(grid.at_node[name]).all()] == []


def scenes(count):
    return settings(
        max_examples=count, deadline=None, derandomize=True, database=None, phases=[Phase.generate],
        suppress_health_check=[HealthCheck.function_scoped_fixture],
    )  # fmt: skip


@scenes(40)
@given(terrain=ground(1.0), laws=LAWS)
def test_any_scene_on_terrain_as_a_dem_has_it(terrain, laws):
    """Up to 45 degrees between neighbours on top of slopes of up to 45."""
    check(terrain, laws)


@scenes(60)
@given(terrain=ground(10.0), laws=LAWS)
def test_any_scene_on_crevices(terrain, laws):
    """Up to 84 degrees between neighbours, and noise of three spacings."""
    check(terrain, laws)
