"""Mass and momentum of what comes in: slip at the base, a bed of another density, rates that vary in space."""

import math

import numpy as np
import pytest

from landlab_debrisflow import DebrisFlow
from landlab_debrisflow.model import mixing, step
from validation.grids import centre_of_mass, dry_block, inclined, place, release_cap, release_slab

G, ANGLE, MU, RATE = 9.81, math.radians(30.0), 0.21, 3e-3
PULL = G * (math.sin(ANGLE) - MU * math.cos(ANGLE))
DURATION = 12.0
ROOM = {"particle_count": 60, "settle": False}


def block(step, **material):
    """Return way and speed along the slope, growth of volume, and the flow, of a block that erodes (test_block.py)."""
    grid = inclined((15, 40), 20.0, math.tan(ANGLE), soil=1.0)
    release_cap(grid, (100.0, 140.0), (60.0, 60.0), 1e-3, on_top=True)
    keywords = dry_block(MU, {"law": "growth", "growth_rate": RATE}, **ROOM)
    keywords["material"] |= material
    flow = place(DebrisFlow(grid, **keywords))
    start, _, volume = centre_of_mass(flow)
    for _ in range(round(DURATION / step)):
        flow.run_one_step(step)
    x, speed, grown = centre_of_mass(flow)
    assert abs(flow.budget["residual"]) < 1e-12 * grown
    return np.array([(x - start) / math.cos(ANGLE), speed / math.cos(ANGLE), grown / volume]), flow


@pytest.mark.slow
@pytest.mark.parametrize("slip", [0.0, 0.5, 0.8, 1.0])
def test_soil_that_slips_along_takes_less_of_the_momentum(slip):
    """v = sqrt(a/E') tanh(sqrt(a E') t), x = ln cosh(sqrt(a E') t)/E', h = h_0 exp(E x), E' = E (1 - slip)."""
    slowing = RATE * (1.0 - slip)
    if slowing > 0.0:
        phase = math.sqrt(PULL * slowing) * DURATION
        speed, way = math.sqrt(PULL / slowing) * math.tanh(phase), math.log(math.cosh(phase)) / slowing
    else:
        speed, way = PULL * DURATION, 0.5 * PULL * DURATION**2
    exact = np.array([way, speed, math.exp(RATE * way)])
    coarse, fine = (block(step, basal_slip_ratio=slip)[0] / exact - 1.0 for step in (0.125, 0.0625))
    assert_first_order(coarse, fine)
    if slip == 0.0:  # then the splitting is of second order
        assert abs(fine).max() < 5e-5


def assert_first_order(coarse, fine):
    """Errors of which the second come from steps half as long: what is left without the first order is small.

    The volume taken up in a step is that of its beginning, and what it slows is not, so the pair is of second order
    only where soil comes in at rest and as dense as the flow. Measured up to 1.6e-3; extrapolated up to 1.5e-5.
    """
    assert abs(fine).max() < 4e-3
    assert abs(2.0 * fine - coarse).max() < 5e-5


def speed_after(way, heavier):
    """Return v from d(m v)/dt = m a, m/m_0 = 1 + k (exp(E x) - 1), of which the integral of 2 a m^2 dx is m^2 v^2."""
    k, grown = heavier, math.exp(RATE * way)
    work = (1.0 - k) ** 2 * way + 2.0 * (1.0 - k) * k * (grown - 1.0) / RATE + k**2 * (grown**2 - 1.0) / (2.0 * RATE)
    return math.sqrt(2.0 * PULL * work) / (1.0 + k * (grown - 1.0))


@pytest.mark.slow
@pytest.mark.parametrize(("porosity", "bed_porosity"), [(0.5, 0.2), (0.2, 0.6)])
def test_a_heavier_bed_takes_more_of_the_speed(porosity, bed_porosity):
    heavier, errors = (1.0 - bed_porosity) / (1.0 - porosity), []
    for size in (0.125, 0.0625):
        (way, speed, growth), flow = block(size, porosity=porosity, bed_porosity=bed_porosity)
        exact = speed_after(way, heavier)
        errors.append(np.array([speed / exact, growth / math.exp(RATE * way)]) - 1.0)
    assert_first_order(*errors)
    assert abs(speed_after(way, 1.0) / exact - 1.0) > 0.04  # were the bed as dense as the flow
    p = flow.particles
    # all have grown by nearly the same
    np.testing.assert_allclose(p.porosity, (porosity + bed_porosity * (growth - 1.0)) / growth, rtol=1e-3)
    np.testing.assert_allclose(p.density, (1.0 - p.porosity) * 2650.0, rtol=1e-14)


@pytest.mark.slow
def test_grains_pores_and_momentum_are_what_they_were_with_what_came_in(monkeypatch):
    """The stage alone, saturated and with slip: n V, rho V and m^(1 - s) v, for every particle, to round-off."""
    slip, bed = 0.4, 0.3
    grid = inclined((15, 40), 5.0, 0.5, soil=5.0)
    release_slab(grid, (50.0, 35.0), 16.0, 1.5, on_top=True)
    material = {"bed_porosity": bed, "basal_slip_ratio": slip, "water_table_ratio": 0.8, "porosity": 0.45}
    flow = DebrisFlow(grid, material=material, erosion={"law": "growth", "growth_rate": 0.02}, numerics=ROOM)
    flow.run_one_step(3.0)
    entrain, looked = step.entrain, []
    soil = 2650.0 * (1.0 - bed) + 800.0 * bed

    def watched(p, *rest):
        pores, mass = p.porosity * p.volume, p.density * p.volume
        ratio = entrain(p, *rest)
        np.testing.assert_allclose(p.porosity * p.volume, pores + bed * p.entrained_volume, rtol=1e-14)
        np.testing.assert_allclose(p.density * p.volume, mass + soil * p.entrained_volume, rtol=1e-14)
        np.testing.assert_allclose(ratio, ((mass + soil * p.entrained_volume) / mass) ** (slip - 1.0), rtol=1e-14)
        looked.append(p.entrained_volume.sum())
        return ratio

    monkeypatch.setattr(step, "entrain", watched)
    flow.run_one_step(1.0)
    assert sum(looked) > 10.0 and len(looked) > 10
    assert flow.particles.porosity.min() < 0.44 and flow.particles.density.max() > 2650.0 * 0.55 + 800.0 * 0.45 + 10.0
    assert abs(flow.budget["residual"]) < 1e-12 * flow.budget["eroded"]


def test_by_hand():
    """3 m3 of porosity .4 take up 1 m3 of porosity .2: n = .35 and rho = .65 * 2650 + .35 * 1000 = 2072.5 kg/m3."""
    one = np.ones(1)
    volume, porosity, density, out = 3.0 * one, 0.4 * one, 1990.0 * one, [np.empty(1) for _ in range(3)]
    out[1][:] = np.nan
    slowed = np.full(1, np.nan)
    mixing.mix(
        0, 1, 1.0 * one, mixing.Soil(1.0, 0.5, 0.2, 2650.0, 1000.0),
        mixing.Layer(2.0 * one, 1.6 * one, one, 0.8 * one, 4e-4 * one),
        mixing.Mixture(volume, porosity, density), mixing.Erosion(*out), 7.0, 0.5, slowed,
    )  # fmt: skip
    rate, first, peclet, dilution = (float(values[0]) for values in (*out, slowed))
    assert (volume[0], porosity[0], density[0]) == pytest.approx((4.0, 0.35, 2072.5), rel=1e-15)
    assert dilution == pytest.approx(math.sqrt(3.0 * 1990.0 / (4.0 * 2072.5)), rel=1e-15)
    # 1 m3 in half a second from the 1.5 m2 that 3 m3, 2 m deep, cover; and times .8 * 1.6 m over c_v
    assert rate == pytest.approx(4.0 / 3.0, rel=1e-15) and first == 7.0
    assert peclet == pytest.approx(4.0 / 3.0 * 0.8 * 1.6 / 4e-4, rel=1e-14)


@pytest.mark.slow
def test_rates_from_a_field_hold_where_they_are():
    """Twice the rate on one side, nothing on the other, of a sheet that runs down the middle."""
    grid = inclined((31, 40), 5.0, math.tan(ANGLE), soil=1.0)
    release_slab(grid, (40.0, 75.0), 31.0, 0.05, on_top=True)
    rate = grid.add_zeros("growth_rate", at="node")
    side = grid.y_of_node - 75.0
    rate[side > 1.0], rate[abs(side) <= 1.0] = 0.004, 0.002
    rate[side < -15.0] = 0.0
    rate[(side >= -15.0) & (side < -1.0)] = 0.002
    keywords = dry_block(MU, {"law": "growth", "growth_rate": "growth_rate"}, particle_count=800, settle=False)
    flow = DebrisFlow(grid, **keywords)
    flow.run_one_step(5.0)
    eroded = grid.at_node["debris_flow__eroded_depth"].reshape(grid.shape).sum(axis=1)
    assert abs(flow.budget["residual"]) < 1e-12 * flow.budget["eroded"]
    across = (np.arange(31) - 15) * 5.0
    # a particle has the rate of the node nearest to it and a tent of two nodes on either side
    half, whole, none = eroded[abs(across + 7.5) < 4.0].mean(), eroded[abs(across - 15.0) < 6.0].mean(), across < -29.0
    assert not eroded[none].any() and half > 0.0
    assert whole / half == pytest.approx(2.0, rel=0.1)
