"""The claims of Pastor et al. (2022), section 4.2, on the stand-in terrain with few particles.

All figures with the noise over particles and offsets: `python -m benchmarks.tsing_shan`.
"""

import numpy as np
import pytest

from landlab_debrisflow.scene.tsing_shan import tsing_shan_valley
from tests.test_examples import load

PARTICLES = 200
NOISE = 10.0
"""Run-out by which runs with other particles and offsets differ [m]: twice the standard deviation in the benchmark."""

DURATION = 45.0
"""By then fronts have stopped [s]; what creeps down the channel after them is no matter of run-out."""


@pytest.fixture(scope="module")
def example():
    return load("tsing_shan")


def both(example, c_v):
    return [example.run(tsing_shan_valley(), model, c_v, PARTICLES, duration=DURATION) for model in example.COLUMNS]


@pytest.fixture(scope="module")
def pair(example):
    """ALE and classical with the c_v of Tsing Shan and the default loading."""
    return both(example, 4e-4)


@pytest.mark.slow
def test_the_event_has_the_numbers_it_should(pair):
    for record in pair:
        m = record.measures
        assert record.release.sum() * 25.0 == pytest.approx(2350.0)
        assert m["final"] == pytest.approx(20_000.0, rel=0.1)
        assert m["outflow"] == 0.0
        assert m["soil left"] > 1.0  # erodible depth exhausted nowhere
        assert m["peclet 5"] > 100.0  # Pe_b >> 1 not just in the median


def test_both_are_one_until_the_first_particle_leaves_erodible_ground(pair):
    ale, classical = pair
    same = [np.array_equal(a, b) for a, b in zip(ale.x, classical.x, strict=False)]
    before = sum(time < ale.passing for time in ale.times)  # the last look that saw all particles on erodible ground
    assert ale.passing == classical.passing
    assert before > 30 and all(same[:before])
    assert not same[before + 3]  # a second and a half later they differ


def test_then_ale_runs_farther_and_lies_thinner(pair):
    ale, classical = (record.measures for record in pair)
    assert ale["run-out"] - classical["run-out"] > 10 * NOISE
    assert ale["mean deposit"] < classical["mean deposit"]
    # erosion is the same, but for what creeps over erodible ground after the models part
    assert ale["eroded"] == pytest.approx(classical["eroded"], rel=1e-3)


def test_the_marked_column_remembers_with_ale_only(pair):
    pressures = {}
    for since in (0.0, 4.0, 8.0):
        for model, record in zip(("ALE", "classical"), pair, strict=True):
            profile, load = record.marked_column(("since", since))
            pressures[model, since] = profile / load
    # still eroding: the same base, but what came in before lies above it with ALE only
    assert pressures["ALE", 0.0][0] == pytest.approx(0.65, abs=1e-6)
    assert pressures["classical", 0.0][0] == pytest.approx(0.65, abs=1e-6)
    assert pressures["ALE", 0.0].mean() > pressures["classical", 0.0].mean() + 0.2
    # and is what the base is left with
    for since in (4.0, 8.0):
        assert pressures["ALE", since][0] > pressures["classical", since][0] + 0.1


@pytest.mark.slow
def test_where_diffusion_wins_they_agree(example):
    # Pe_b = 0.4, as of the paper's second set; our flow is ten times as fast, which takes 4 m2/s instead of 0.4
    ale, classical = (record.measures for record in both(example, 4.0))
    assert 0.3 < ale["peclet"] < 0.5
    assert abs(ale["run-out"] - classical["run-out"]) < NOISE
