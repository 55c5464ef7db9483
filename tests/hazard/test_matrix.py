"""Danger levels, after matrices and scales written down by hand."""

import numpy as np
import pytest

from landlab_debrisflow import ParameterError
from landlab_debrisflow.hazard import (
    SWISS,
    SWISS_LEVELS,
    HazardClass,
    HazardMatrix,
    HazardScale,
    hazard_maps,
    hazard_matrix,
)

from .fakes import fake_results

MAPS = "max_depth", "max_speed"


def ensemble(*members):
    """Return results of members with depth and speed at four nodes of a row."""
    drawn = [{name: np.array([values, [0.0] * 4]) for name, values in zip(MAPS, one, strict=True)} for one in members]
    return fake_results(drawn, maps=MAPS)


def test_the_greatest_level_of_all_periods_counts():
    """Nodes: medium at 30; strong at 300 alone; medium at 300; strong in a member of three."""
    frequent = ensemble(([0.5, 0, 0, 0], [3, 0, 0, 0]), ([0.5, 0, 0, 0], [9, 0, 0, 0]), ([2, 0, 0, 0], [0.5, 0, 0, 0]))
    rare = ensemble(
        ([0.5, 2, 2, 2], [3, 2, 0.9, 2]), ([0.5, 2, 0.2, 0], [9, 2, 9, 0]), ([2, 2, 0.1, 0], [0.5, 2, 3, 0])
    )  # fmt: skip
    found = hazard_matrix({300: rare, 30: frequent})
    assert found.period.values.tolist() == [30.0, 300.0]
    assert found.class_number.values[:, 0].tolist() == [[1, 0, 0, 0], [1, 2, 1, 0]]
    assert found.danger_level.values[0].tolist() == [3, 4, 2, 0]
    assert "Ticino" in found.attrs["hazard_matrix_source"] and "32N" in found.spatial_ref.attrs["crs_wkt"]
    careful = hazard_matrix({300: rare, 30: frequent}, probability=0.3)
    assert careful.danger_level.values[0].tolist() == [3, 4, 2, 4]
    maps = hazard_maps(rare, scale=SWISS)
    assert hazard_matrix({300: maps}).danger_level.values[0].tolist() == [2, 4, 2, 0]


def test_beyond_the_longest_period_a_residual_danger_is_left():
    flow = ensemble(([2, 0, 0, 0], [3, 0, 0, 0]))
    assert hazard_matrix({1000: flow}).danger_level.values[0].tolist() == [1, 0, 0, 0]


def test_scales_and_matrices_of_ones_own():
    scale = HazardScale(
        "two depths", (HazardClass("knee", ({"max_depth": 0.5},)), HazardClass("head", ({"max_depth": 1.8},))), "us"
    )
    matrix = HazardMatrix(
        "ours", ("some", "much"), ("#ffff00", "#ff0000"), (100.0,), {"knee": ("some",), "head": ("much",)}, "us"
    )
    flow = ensemble(([0.2, 0.7, 2.0, 0], [0, 0, 0, 0]))
    assert hazard_matrix({50: flow}, scale, matrix).danger_level.values[0].tolist() == [0, 1, 2, 0]
    with pytest.raises(ParameterError, match=r"return period must lie in \(0, 100\] a, got 300"):
        hazard_matrix({300: flow}, scale, matrix)
    with pytest.raises(ParameterError, match="has no class 'knee' of two depths"):
        hazard_matrix({50: flow}, scale)
    with pytest.raises(ParameterError, match="has no level 'lots'"):
        hazard_matrix({50: flow}, scale, matrix._replace(table={"knee": ("some",), "head": ("lots",)}))
    with pytest.raises(ParameterError, match="a level for each of 4 periods, got 1"):
        hazard_matrix({50: flow}, SWISS, SWISS_LEVELS._replace(table={"medium": ("low",), "strong": ("high",)}))
    with pytest.raises(ParameterError, match="lack the classes of two depths"):
        hazard_matrix({50: hazard_maps(flow)}, scale, matrix)
    with pytest.raises(ParameterError, match="by return period"):
        hazard_matrix([flow])
    other = fake_results([{name: np.ones((2, 3)) for name in MAPS}], maps=MAPS)
    with pytest.raises(ParameterError, match="the same nodes"):
        hazard_matrix({30: flow, 100: other})
