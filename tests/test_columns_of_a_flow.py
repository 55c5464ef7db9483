"""The columns under a flow: drained beds, and what is told of each column."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from landlab_debrisflow import DebrisFlow
from landlab_debrisflow.core.errors import InputError

from .grids import COARSE, inclined, release_cap


def sloping():
    grid = inclined((30, 60), 5.0, 0.6, soil=2.0, foot=250.0)
    release_cap(grid, (50.0, 72.5), (25.0, 25.0), 2.0)
    return grid


def test_a_drained_bed_takes_the_pressure_and_shortens_the_way():
    fronts = {}
    for drained in (0, 1):
        grid = sloping()
        grid.add_field("bed__drained", np.where(grid.x_of_node > 100.0, float(drained), 0.0), at="node")
        flow = DebrisFlow(grid, numerics=COARSE)
        flow.run_one_step(8.0)
        below = flow.particles.x > 105.0  # the nearest node is drained
        assert below.sum() > 20
        base = flow.particles.basal_excess_pore_pressure[below]
        assert_allclose(base, 0.0, atol=0.0) if drained else np.testing.assert_array_less(0.0, base.median())
        fronts[drained] = float(flow.particles.x.max())
    assert fronts[1] < fronts[0] - 5.0  # a cell


def test_a_drain_is_there_or_not():
    grid = sloping()
    grid.add_full("bed__drained", 0.5, at="node")
    with pytest.raises(InputError, match=r"bed__drained must be 0 or 1, got 0\.5 at node"):
        DebrisFlow(grid, numerics=COARSE).run_one_step(1.0)


def test_columns_tell_what_shapes_them():
    flow = DebrisFlow(sloping(), numerics=COARSE, material={"coefficient_of_consolidation": 1e-3})
    flow.run_one_step(6.0)
    columns, particles = flow.columns, flow.particles
    assert_allclose(columns.consolidation_time, particles.thickness**2 / 1e-3)
    eroding = particles.entrainment_rate.values > 0.0
    assert eroding.sum() > 20
    # consolidation time over erosion time, both with the slope-normal thickness
    assert_allclose(
        (columns.consolidation_time / columns.erosion_time)[eroding], columns.basal_peclet_number[eroding], rtol=0.02
    )
    released = float(particles.volume.sum()) - flow.budget["eroded"]
    assert_allclose((particles.volume * (1.0 - columns.front_height)).sum(), released, rtol=1e-9)
    assert_allclose(columns.initial_peclet_number, columns.basal_peclet_number * (1.0 - columns.front_height))
    age = columns.front_age.values
    assert np.all((age[eroding] > 0.0) & (age[eroding] <= 6.0))
    assert np.isnan(age[(columns.front_height == 0.0).values]).all()
    assert np.all(columns.clipped_pressure >= 0.0)
    assert all(columns[name].attrs["units"] for name in columns)
