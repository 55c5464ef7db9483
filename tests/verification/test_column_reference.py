"""The reference that columns are judged against, against closed forms it shares nothing with."""

from dataclasses import replace

import numpy as np
import pytest

from landlab_debrisflow.exact.columns import consolidation, growing_column
from validation.cases.column_reference import CASES, COARSE, solve

ERODED = np.array([1.0, 40.0, 400.0]) / 400.0
CLOSED = np.array([420.0, 440.0, 1200.0]) / 400.0
CLOSE = {"rel": 0.0, "abs": 1e-8}


def gauss(count):
    node, weight = np.polynomial.legendre.leggauss(count)
    return 0.5 * (node + 1.0), 0.5 * weight


@pytest.mark.slow
@pytest.mark.parametrize("name, peclet", [("A_cold", 1e-2), ("A_warm", 10.0), ("A_cold", 1e3)])
def test_growth_at_a_constant_rate_then_decay(name, peclet):
    unit, weight = gauss(1200)
    xi, weight = unit**3, 3.0 * unit**2 * weight  # crowded at the base
    base, mean, thickness = solve(CASES[name], peclet, np.append(ERODED, CLOSED), COARSE)  # 5e-11 from the fine one
    start = float(name == "A_warm")
    profiles = [growing_column(xi, t / peclet, peclet, start) for t in ERODED]
    assert mean[:3] == pytest.approx([profile @ weight for profile in profiles], **CLOSE)
    waves = (np.arange(500) + 0.5) * np.pi
    share = 2.0 * np.cos(np.outer(waves, xi)) @ (profiles[-1] * weight)
    decay = np.exp(-np.outer((CLOSED - 1.0) / peclet / 4.0, waves**2))  # the thickness is 2
    assert base[:3] == pytest.approx(1.0, **CLOSE)
    assert base[3:] == pytest.approx(decay @ share, **CLOSE)
    assert mean[3:] == pytest.approx(decay @ (share * np.sin(waves) / waves), **CLOSE)
    assert thickness == pytest.approx(np.append(1.0 + ERODED, [2.0] * 3), **CLOSE)


@pytest.mark.parametrize("peclet", [1.0, 1e3])
def test_classical_law_is_conduction_between_fixed_ends(peclet):
    _, mean, thickness = solve(CASES["H_classical_cold"], peclet, ERODED, COARSE)
    conducted = ERODED / thickness / peclet  # the integral of c_v / h^2
    waves = (2.0 * np.arange(1000) + 1.0) * np.pi
    share = np.exp(-np.outer(conducted, waves**2)) @ (8.0 / waves**2)
    assert mean == pytest.approx(0.5 * (1.0 - share), **CLOSE)


@pytest.mark.slow
@pytest.mark.parametrize("loading", ["none", "proportional", "overburden"])
@pytest.mark.parametrize("rate", [1.0, -0.5])
def test_closed_column_that_strains(loading, rate):
    # a linear profile consolidates over the integral of c_v / h^2; what is loaded later does so from then on
    peclet, times, load = 20.0, np.array([0.05, 2.0]), 0.8
    case = replace(CASES["A_cold"], erosion_rate=lambda t: 0.0, divergence_rate=lambda t: rate, start="linear",
                   start_base=0.4, switches=(), loading=loading, load_per_thickness=load)  # fmt: skip
    base, mean, thickness = solve(case, peclet, times, COARSE)
    assert thickness == pytest.approx(np.exp(-rate * times), **CLOSE)
    xi, weight = gauss(60)
    points, conducted = np.append(0.0, xi), np.expm1(2.0 * rate * times) / (2.0 * rate * peclet)
    for i, t in enumerate(times):
        expected = 0.4 * consolidation(points, conducted[i])
        if loading == "proportional":
            expected *= np.exp(-rate * t)
        elif loading == "overburden":
            # the answer to a young load goes like the root of its age: over that root it is smooth
            for root, share in zip(*gauss(40), strict=True):
                then = t * (1.0 - root**2)
                source = -load * rate * np.exp(-rate * then)
                passed = conducted[i] - np.expm1(2.0 * rate * then) / (2.0 * rate * peclet)
                expected += 2.0 * t * root * share * source * consolidation(points, passed)
        assert base[i] == pytest.approx(expected[0], **CLOSE)
        assert mean[i] == pytest.approx(expected[1:] @ weight, **CLOSE)


@pytest.mark.slow
@pytest.mark.parametrize("loading", ["overburden", "proportional"])
def test_erosion_and_loading_keep_a_profile_in_step_with_the_overburden(loading):
    # p = r h (1 - xi) solves both laws of loading: dh/dt = e - D h is the balance of its mean
    share = 0.65
    case = replace(CASES[f"G_loading_while_eroding_{loading}"], start_base=share, load_per_thickness=share)
    base, mean, thickness = solve(case, 100.0, ERODED, COARSE)
    assert thickness == pytest.approx(3.0 * np.exp(0.5 * ERODED) - 2.0, **CLOSE)
    assert base == pytest.approx(share * thickness, **CLOSE)
    assert mean == pytest.approx(0.5 * share * thickness, **CLOSE)
