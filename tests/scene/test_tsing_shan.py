"""The stand-in for Tsing Shan has the numbers it claims."""

import re

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from landlab_debrisflow import DebrisFlow, InputError
from landlab_debrisflow.scene.tsing_shan import tsing_shan_valley


def fields(grid):
    names = ("topographic__elevation", "soil__depth", "debris_flow__release_depth")
    return (grid.at_node[name].reshape(grid.shape) for name in names)


@pytest.mark.slow
def test_release_has_the_volume_of_both_landslides_and_fits_into_the_soil():
    grid = tsing_shan_valley()
    _, soil, release = fields(grid)
    assert_allclose(release.sum() * 25.0, 2350.0, rtol=1e-13)
    assert np.all(release <= soil)
    columns = np.flatnonzero(release.any(axis=0))
    assert_array_equal(np.diff(columns), 1)  # the trigger touches the parent
    assert_array_equal(release, release[::-1])  # in the middle of the channel


def test_erodible_path_and_fall():
    grid = tsing_shan_valley()
    elevation, soil, release = fields(grid)
    thalweg = elevation[grid.shape[0] // 2]
    assert_array_equal(soil > 0.0, elevation >= 100.0)
    parent = np.argmax(release[grid.shape[0] // 2])
    above = thalweg[parent:][thalweg[parent:] >= 100.0]
    path = np.hypot(5.0, np.diff(above)).sum()
    assert abs(path - 714.0) < 2 * 5.0 / np.cos(np.radians(38.0))  # both ends lie between nodes
    crown = np.flatnonzero(release.any(axis=0))[0]
    assert_allclose(thalweg[crown] - thalweg[crown + 200], 490.0, rtol=0.02)


@pytest.mark.slow
@pytest.mark.parametrize("axis", [0, 1])
def test_curvature_is_continuous(axis):
    grid = tsing_shan_valley(spacing=1.0, width=60.0, runout_length=400.0)
    elevation = next(fields(grid))
    curvature = np.diff(elevation, 2, axis=axis)
    jumps = np.abs(np.diff(curvature, axis=axis))
    assert jumps.max() < 0.2 * np.abs(curvature).max()  # a kink or a jump of curvature gives 1


@pytest.mark.slow
def test_roughness_is_correlated_reproducible_and_as_strong_as_asked():
    smooth, rough, same, other = (
        next(fields(tsing_shan_valley(roughness=r, seed=s))) for r, s in ((0.0, 1), (0.4, 1), (0.4, 1), (0.4, 2))
    )
    assert_array_equal(rough, same)
    noise = rough - smooth
    assert_allclose(noise.std(), 0.4, rtol=1e-6)
    assert abs(np.corrcoef(noise.ravel(), (other - smooth).ravel())[0, 1]) < 0.2
    assert np.corrcoef(noise[:, 1:].ravel(), noise[:, :-1].ravel())[0, 1] > 0.9


@pytest.mark.slow
@pytest.mark.parametrize("axis", [0, 1])
def test_an_offset_moves_all_of_the_valley_between_the_nodes(axis):
    half = np.eye(2)[1 - axis] * 0.5  # eastward along axis 1
    further, back = (tuple(fields(tsing_shan_valley(offset=o))) for o in (half, -half))
    for one, other in zip(further, back, strict=True):
        one, other = np.moveaxis(one, axis, 0), np.moveaxis(other, axis, 0)
        assert_allclose(one[1:], other[:-1], rtol=1e-9, atol=1e-9)  # half a node either way: a whole one apart


@pytest.mark.slow
def test_event_stays_on_the_grid_and_never_reaches_the_bottom_of_the_soil():
    grid = tsing_shan_valley()
    flow = DebrisFlow(grid, numerics={"particle_count": 200})
    assert flow.run_until_rest()
    assert flow.budget["outflow"] == 0.0
    assert_allclose(flow.budget["deposited"], 20_000.0, rtol=0.05)
    assert grid.at_node["debris_flow__eroded_depth"].max() < 0.5 * 12.0


@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        ({"spacing": 0.0}, "spacing must be > 0 m, got 0.0"),
        ({"spacing": 100.0}, "spacing of 100 m"),
        ({"erodible_depth": 1.0}, "erodible_depth must be at least the thickness of the release"),
        ({"roughness": -1.0}, "roughness must be >= 0 m"),
        ({"slopes": (40.0, 95.0, 2.0)}, "slopes must be three angles"),
        ({"offset": (0.6, 0.0)}, "offset must be two numbers in [-0.5, 0.5], got (0.6, 0.0)"),
        ({"width": float("nan")}, "width must be > 0 m, got nan"),
    ],
)
def test_refusals(wrong, words):
    with pytest.raises(InputError, match=re.escape(words)):
        tsing_shan_valley(**wrong)
