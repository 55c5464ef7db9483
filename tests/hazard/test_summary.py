"""Sentences on what hazard maps rest on."""

import numpy as np
import pytest

from landlab_debrisflow.hazard import hazard_maps, hazard_summary
from landlab_debrisflow.hazard.summary import variance_ratio

from .fakes import fake_results


def depths(*values):
    return [one if isinstance(one, str) else {"max_depth": np.full((2, 2), one)} for one in values]


def test_a_random_sample_needs_a_hundred_members_for_a_twentieth():
    words = " ".join(hazard_summary(hazard_maps(fake_results(depths(*[0.0, 2.0] * 20, "Boom: no")))))
    assert "shares of 40 of 41 members (random)" in words and "1 members failed (2.4 %)" in words
    assert "takes 100 members; 60 more are needed" in words
    words = " ".join(hazard_summary(hazard_maps(fake_results(depths(*[0.0, 2.0] * 60)))))
    assert "takes 100 members; so many are there" in words


def test_replicates_that_scatter_less_need_fewer_members():
    """Of eight replicates with 8 members, shares of 3/8 and 5/8: the variance of the mean is 1/448, of 1/256."""
    values, replicate = [], []
    for k in range(8):
        count = 3 if k % 2 else 5
        values += [2.0] * count + [0.0] * (8 - count)
        replicate += [k] * 8
    maps = hazard_maps(fake_results(depths(*values), "latin_hypercube", replicate), {"max_depth": [0.5]})
    assert variance_ratio(maps) == pytest.approx(256 / 448, rel=1e-5)
    words = " ".join(hazard_summary(maps))
    assert "has 0.57 times the variance" in words and "takes 58 members on the average; so many are there" in words


def test_errors_that_are_not_known_are_told():
    words = " ".join(hazard_summary(hazard_maps(fake_results(depths(0.0, 2.0), "factorial"))))
    assert "Sampling errors are not known: a factorial design is no sample" in words
