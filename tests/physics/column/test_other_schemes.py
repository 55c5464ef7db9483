"""The paper's Lax-Wendroff scheme and the implicit upwind one: what they reproduce, and how they fail."""

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from scipy.special import erfc

from landlab_debrisflow.core.errors import ParameterError
from landlab_debrisflow.exact.columns import consolidation, growing_column
from landlab_debrisflow.physics.column import ALE, Classical
from landlab_debrisflow.physics.column_contracts import BaseContact

from .driver import LOAD_PER_METRE, WATER_TO_BUOYANT, Columns, eta

UNIT = {"ratio": 1e-9, "load": 1e9}  # a bed of 1 Pa, far from any bound
ROUNDING = 1e-12
LAX_WENDROFF, UPWIND = "lax_wendroff", "upwind"
both = pytest.mark.parametrize("scheme", [LAX_WENDROFF, UPWIND])


def unloaded(scheme, profile, coefficient=0.0, thickness=1.0, contact="dirichlet"):
    law = ALE(levels=profile.size, scheme=scheme, loading_source="none", bed_contact=contact)
    return Columns(law, profile[None], [thickness], [UNIT["load"]], coefficient)


def loaded(law, ratios, coefficient=0.0):
    return Columns(law, LOAD_PER_METRE * ratios[None], [1.0], None, coefficient)


@pytest.mark.parametrize(
    "scheme, number, times, cells, order",
    [(LAX_WENDROFF, 1, (0.2, 0.5), 40, 2), (LAX_WENDROFF, 10, (0.1, 0.5), 40, 2), (UPWIND, 3e3, (3e-3, 4e-3), 160, 1)],
)
def test_order_in_levels(scheme, number, times, cells, order):
    """From a smooth start; with some sub-steps in each step, or at a cell Péclet number well above two."""
    errors, span = [], times[1] - times[0]
    for n in (cells, 2 * cells):
        xi, steps = 1.0 - eta(n + 1), n**2 // 20 if order == 2 else 10 * n
        columns = unloaded(scheme, growing_column(xi, times[0], number), 1.0, 1.0 + number * times[0])
        for _ in range(steps):
            columns.step(span / steps, entrained=number * span / steps, **UNIT)
        errors.append(np.abs(columns.profile()[0] - growing_column(xi, times[1], number)).mean())
    assert_allclose(np.log2(errors[0] / errors[1]), order, atol=0.1)
    assert errors[0] < (1e-3 if order == 2 else 1e-2)


@both
@pytest.mark.parametrize("coefficient", [0.0, 1e-4, 1.0])
@pytest.mark.parametrize("ratio, by, strain", [(0.6, "overburden", 0), (1, "overburden", 3), (0.6, "proportional", 3)])
def test_a_constant_ratio_survives_erosion(scheme, coefficient, ratio, by, strain):
    """p = r_b rho' g y, under strain too where it should; upwind has its error where it does not diffuse."""
    columns = loaded(ALE(scheme=scheme, loading_source=by), ratio * eta(11), coefficient)
    columns.state.memory[:] = 0.0  # a new column may erode in its first step
    for step in range(300):
        burst = 0.3 * (step == 150 and scheme == LAX_WENDROFF)  # in three sub-steps
        columns.step(0.05, 1e-3 * (1.0 + np.sin(0.1 * step) ** 2) + burst, 0.01 * strain * np.sin(0.3 * step), ratio)
    atol = ROUNDING if scheme == LAX_WENDROFF else (1e-5 if coefficient == 1.0 else 2e-2)
    assert_allclose(columns.profile()[0], ratio * columns.load * eta(11), atol=atol * columns.load[0])
    assert_array_equal(columns.base, columns.bed)


def test_lax_wendroff_moves_a_prescribed_base_evenly():
    """From 1 Pa to 0 in one step of many sub-steps, below 0.2 Pa that a change of porosity made."""
    columns, z = unloaded(LAX_WENDROFF, eta(41), 1.0), (1.0 - eta(41)) / np.sqrt(0.08)
    columns.forcing.base[0], columns.forcing.porosity_source[0] = BaseContact.PRESCRIBED, 10.0
    columns.step(0.0, **UNIT)
    columns.step(0.02, ratio=0.0, load=UNIT["load"])
    fallen = (1.0 + 2.0 * z**2) * erfc(z) - 2.0 * z * np.exp(-(z**2)) / np.sqrt(np.pi)
    assert_allclose(columns.profile()[0], eta(41) - fallen + 0.2 * (1.0 - erfc(z) - erfc(z[::-1])), atol=0.015)


@both
@pytest.mark.parametrize("levels, atol", [(11, 4e-3), (41, 1e-3)])
@pytest.mark.parametrize("time", [0.05, 0.2, 1.0])
def test_consolidation_over_an_impermeable_base(scheme, levels, atol, time):
    columns = unloaded(scheme, eta(levels), 1.0)
    for _ in range(400):
        columns.step(time / 400.0, load=UNIT["load"])
    assert_allclose(columns.profile()[0], consolidation(1.0 - eta(levels), time), atol=atol)


@pytest.mark.parametrize("contact", ["dirichlet", "flux"])
@pytest.mark.parametrize("levels", [3, 11, 41])
def test_upwind_makes_no_new_extreme(levels, contact):
    """For steps of any length and growth, c_v dt / h^2 up to 1e4."""
    rng = np.random.default_rng(3)
    columns = unloaded(UPWIND, rng.random(levels) * (eta(levels) > 0.0), 1.0, contact=contact)
    for _ in range(1000):
        columns.step(1.0, load=UNIT["load"], strain=1.0 / columns.thickness - 1.0)  # lets it fall to any level
        dt, entrained = 10.0 ** rng.uniform(-6, 4), 10.0 ** rng.uniform(-6, 0.5) * (rng.random() < 0.7)
        columns.step(dt, entrained * columns.volume, ratio=1e-9 * rng.integers(0, 2), load=UNIT["load"])
        assert columns.profile().min() >= 0.0 and columns.profile().max() <= 1.0 + ROUNDING


@both
def test_only_lax_wendroff_overshoots_at_a_sharp_front(scheme):
    """Cell Péclet number 300 and more, Courant number 0.03: the failure it is known for."""
    columns, highest = unloaded(scheme, np.zeros(11), 1e-4), 0.0
    while columns.volume[0] < 2.5:
        columns.step(0.01, entrained=0.003 * columns.volume, **UNIT)
        highest = max(highest, columns.profile().max())
    assert (1.05 < highest < 1.3) if scheme == LAX_WENDROFF else highest <= 1.0 + ROUNDING


@pytest.mark.parametrize("passed, grown, fails", [(499.0, 0.0, 0), (501.0, 0.0, 1), (0.0, 9e3, 0), (0.0, 1.1e4, 1)])
def test_lax_wendroff_gives_up_beyond_its_substeps(passed, grown, fails):
    columns = unloaded(LAX_WENDROFF, eta(11), passed)
    base = columns.step(1.0, entrained=grown, **UNIT)
    assert np.all(np.isnan(columns.profile()) == fails) and np.isnan(base[0]) == fails


@both
@pytest.mark.parametrize("name", ["volume", "thickness", "liquefaction_pressure", "coefficient_of_consolidation"])
def test_what_is_not_a_number_is_seen(scheme, name):
    columns = loaded(ALE(scheme=scheme), 0.3 * eta(11), 0.01)
    columns.forcing = columns.forcing._replace(**{name: getattr(columns.forcing, name) * np.nan})
    assert np.isnan(columns.step(0.1, load=columns.load)).all()


@both
@pytest.mark.parametrize("law", [ALE, Classical])
@pytest.mark.parametrize("source", ["overburden", "proportional", "none"])
def test_undrained_strain(scheme, law, source):
    """Lifts every level by its own overburden, or keeps its ratio, or does nothing."""
    columns = loaded(law(scheme=scheme, loading_source=source), 0.3 * eta(11) ** 2)
    for step in range(50):
        columns.step(0.05, strain=0.02 * np.cos(step))
    gained = {"overburden": eta(11), "proportional": 0.3 * eta(11) ** 2, "none": 0.0}[source] * (columns.thickness - 1)
    assert_allclose(columns.profile()[0] / LOAD_PER_METRE, 0.3 * eta(11) ** 2 + gained, atol=ROUNDING)
    assert_array_equal(columns.base, columns.profile()[:, 0])


@both
@pytest.mark.parametrize("literal", [False, True])
def test_only_the_literal_source_makes_pressure_out_of_nothing(scheme, literal):
    """Cold, over a dry bed that erodes: p = rho' g y ln(h/max(h_0, y)) from eq. 38 to the letter."""
    columns = loaded(ALE(levels=41, scheme=scheme, source_includes_erosion=literal), np.zeros(41))
    for _ in range(400):
        columns.step(0.05, entrained=0.0025, ratio=0.0)
    exact = literal * 2.0 * eta(41) * -np.log(np.maximum(0.5, eta(41)))  # with a kink at h_0
    assert_allclose(columns.profile()[0] / LOAD_PER_METRE, exact, atol=0.08 if literal else ROUNDING)


@both
def test_porosity_and_a_base_that_is_prescribed(scheme):
    """A change of porosity makes pressure everywhere but at a base that is prescribed, as a drained one is."""
    columns = unloaded(scheme, np.zeros(11))
    columns.forcing.porosity_source[0] = 2.0
    assert columns.step(0.25, load=UNIT["load"])[0] == 0.5
    columns.forcing.base[0] = BaseContact.PRESCRIBED
    assert columns.step(0.25, ratio=0.0, load=UNIT["load"])[0] == 0.0
    assert_array_equal(columns.profile()[0], eta(11) % 1.0 > 0.0)


@both
def test_what_is_clipped_is_counted(scheme):
    columns = loaded(ALE(scheme=scheme), np.zeros(11))
    columns.step(0.1, strain=-0.9)
    assert columns.state.clipped[0] == 0.0  # no less is seen than suction, and nothing taken off
    assert_allclose(columns.base, -WATER_TO_BUOYANT * columns.load, rtol=ROUNDING)
    columns.forcing.porosity_source[0] = 140.0 * columns.load[0]
    columns.step(0.1)
    assert_allclose(columns.profile()[0], columns.load * eta(11), rtol=ROUNDING)
    # 14 loads at all levels but the surface, on -9 loads at the base; half a cell there: eta has the mean 0.5
    removed = 0.1 * (14.0 * 0.95 - 0.5 * (9.0 + 1.0)) * columns.load[0]
    assert_allclose(columns.state.clipped[0], removed, rtol=ROUNDING)


@pytest.mark.parametrize("coefficient", [0.0, 0.01, 1.0])
def test_upwind_balances_what_flows_in_and_out(coefficient):
    """d content = e_R p_b dt - c_v p_x dt at the surface, to rounding."""
    columns = unloaded(UPWIND, eta(11) ** 2, coefficient, contact="flux")
    for dt in (0.001, 0.1, 0.3, 1.0):
        before, entrained = columns.content()[0], 0.03 * dt
        columns.step(dt, entrained, ratio=3e-9, load=UNIT["load"])
        # the last face is half a cell below the surface, and soil moves through that as well
        moved = 0.05 * entrained * (0.5 if coefficient > 0.0 else 1.0)
        out = (coefficient * dt * 10.0 / columns.thickness[0] + moved) * columns.profile()[0, -2]
        assert_allclose(columns.content()[0] - before, 3.0 * entrained - out, rtol=1e-10)


def test_without_diffusion_a_flux_from_the_bed_does_what_its_pressure_does():
    """What differs is the half cell that has to be filled first."""
    one, other = (unloaded(UPWIND, np.zeros(41), contact=contact) for contact in ("dirichlet", "flux"))
    for columns in (one, other) * 200:
        columns.step(0.1, entrained=0.01, **UNIT)
    assert_allclose(other.base, 1.0, atol=1e-6)
    assert_allclose(other.profile(), one.profile(), atol=0.1)
    with pytest.raises(ParameterError, match="bed_contact"):
        ALE(scheme=LAX_WENDROFF, bed_contact="flux")


@both
def test_the_classical_column_does_not_advect(scheme):
    columns = loaded(Classical(scheme=scheme), 0.65 * eta(11) ** 2)
    columns.step(0.05, entrained=2.0)
    assert_allclose(columns.profile()[0, 1:] / LOAD_PER_METRE, 0.65 * eta(11)[1:] ** 2, atol=ROUNDING)
