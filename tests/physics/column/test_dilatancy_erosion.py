"""Soil that comes into columns with dilatancy, and what is below them (docs/theory.md#dilatancy)."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from landlab_debrisflow.physics.column import ALE
from landlab_debrisflow.physics.column.driver import Columns
from landlab_debrisflow.physics.column_contracts import BaseContact

from .dilatant import LOADING, dilatant_columns, mean, stresses

ETA = np.linspace(1.0, 0.0, 11)


@pytest.mark.parametrize("contact", ["dirichlet", "flux"])
@pytest.mark.parametrize("loading_source", ["overburden", "proportional", "none"])
def test_soil_like_the_column_changes_nothing_but_its_thickness(contact, loading_source):
    """The same ratio, the same solid fraction, no shear, no conduction: any erosion leaves the ratio as it is."""
    columns = dilatant_columns(
        {"permeability": 0.0}, 1.0, 0.61, profile=0.4 * LOADING * ETA[None], bed_contact=contact,
        loading_source=loading_source,
    )  # fmt: skip
    for gain in (0.01, 0.3, 2.0):
        load = columns.forcing.liquefaction_pressure * (1.0 + gain)
        columns.step(0.1, gain * columns.forcing.volume, bed_pressure=0.4 * load)
        assert_allclose(columns.state.profile, 0.4 * load[:, None] * ETA, rtol=1e-9, atol=1e-9)
        assert_allclose(columns.state.solid_fraction, 0.61, rtol=1e-12)


@pytest.mark.parametrize("loading_source", ["overburden", "proportional", "none"])
def test_a_column_that_thickens_is_loaded_as_one_without_dilatancy(loading_source):
    """By strain, undrained, at rest: pressure rises by the load, in proportion to it, or not at all."""
    profile, load = 0.4 * LOADING * ETA[None], 1.5 * LOADING * ETA
    columns = dilatant_columns({"permeability": 0.0}, 1.0, 0.61, profile=profile, loading_source=loading_source)
    columns.step(
        0.1, thickness=np.array([1.5]), volume=np.array([1.0]), liquefaction_pressure=np.array([1.5 * LOADING])
    )
    gained = {"overburden": 0.5 * LOADING * ETA, "proportional": 0.4 * 0.5 * LOADING * ETA, "none": 0.0}[loading_source]
    assert_allclose(columns.state.profile, np.minimum(profile + gained, load), rtol=1e-9, atol=1e-9)


CONTACTS = {
    "dirichlet": {}, "flux": {"bed_contact": "flux"}, "sealed": {"base": BaseContact.IMPERMEABLE},
    "prescribed": {"base": BaseContact.PRESCRIBED},
}  # fmt: skip


def after_erosion(levels, kind, steps=40):
    """Return a column that doubled by soil of fraction 0.66 and ratio 0.7 in `steps` steps, from 0.6 and ratio 0.2."""
    eta = np.linspace(1.0, 0.0, levels)
    columns = dilatant_columns(
        {"permeability": 0.0}, 1.0, 0.6, profile=0.2 * LOADING * eta[None], levels=levels, soil_solid_fraction=0.66,
        bed_pressure=0.2 * LOADING, **CONTACTS[kind],  # so that a bed that prescribes its pressure compacts nothing
    )  # fmt: skip
    for _ in range(steps):
        load = LOADING * (columns.forcing.thickness + 1.0 / steps)
        columns.step(0.01, 1.0 / steps, bed_pressure=0.7 * load)
    return columns


@pytest.mark.parametrize("start, bed", [(0.0, 0.0), (0.4, 0.4), (0.2, 0.7)])
@pytest.mark.parametrize("kind", CONTACTS)
def test_tight_debris_at_rest_erodes_as_that_without_dilatancy(kind, start, bed):
    """Nothing is made and nothing moves: the profile is that of ALE without diffusion, remapped."""
    profile, given = start * LOADING * ETA[None], dict(CONTACTS[kind])
    law = ALE(bed_contact=given.pop("bed_contact", "dirichlet"))
    if "base" in given:
        given["bed_pressure"] = bed * LOADING
    one = Columns(law, profile, [1.0], liquefaction_pressure=[LOADING], **given)
    other = dilatant_columns({"permeability": 0.0}, 1.0, 0.61, profile=profile, **CONTACTS[kind] | given)
    for _ in range(20):
        load = LOADING * (one.forcing.thickness + 0.05)
        one.step(0.1, 0.05, bed_pressure=bed * load)
        other.step(0.1, 0.05, bed_pressure=bed * load)
    far = np.abs(ETA - 0.5) > 0.15 if bed != start else np.full(11, True)  # the front between old soil and new
    # the old base level, half a cell, is at the front when soil comes in below a base that is closed
    atol = {"sealed": 0.01}.get(kind, 1e-12 if bed == start else 0.01) * one.forcing.liquefaction_pressure[0]
    assert_allclose(other.profile()[0, far], one.profile()[0, far], atol=atol)


@pytest.mark.parametrize("kind", CONTACTS)
def test_soil_brings_its_solid_fraction_and_its_pressure(kind):
    """Half of the column is old, half is soil; the error of the content is a fraction of a level, and falls with it."""
    errors = []
    for levels in (11, 21, 41, 81):
        columns = after_erosion(levels, kind)
        eta = np.linspace(1.0, 0.0, levels)
        fraction, load = columns.state.solid_fraction[0], columns.forcing.liquefaction_pressure[0]
        exact = np.where(eta > 0.5, 0.66, 0.6)
        far = np.abs(eta - 0.5) > 3.0 / levels
        assert_allclose(fraction[far & (eta < 1.0)], exact[far & (eta < 1.0)], atol=1e-3)
        if kind != "sealed":
            # sigma' of grains: 0.8 rho' g y where old, 0.3 where new
            stress = np.where(eta > 0.5, 0.3, 0.8) * eta * load
            assert_allclose(stresses(columns)[0][far], stress[far], atol=0.06 * load)
        errors.append(mean(columns.state.solid_fraction)[0] - 0.63)
    errors = np.abs(errors)
    assert errors[0] < 0.06 * 0.5 / 10 and errors[3] < 0.35 * errors[0] + 1e-6


@pytest.mark.parametrize("kind", CONTACTS)
def test_soil_of_one_large_step_is_all_alike(kind):
    """The column doubles: what lies below the middle is soil, as it lay in the bed."""
    columns = after_erosion(21, kind, steps=1)
    assert_allclose(columns.state.solid_fraction[0, :10], 0.66, rtol=1e-12)
    assert_allclose(columns.state.solid_fraction[0, 10:], 0.6, rtol=1e-12)


def test_a_drained_base_lets_water_out_below():
    """Debris under the same shear compacts from the base, too, which bears the whole load."""
    one = dilatant_columns({"permeability": 1e-10}, 0.3, 0.6, 10.0)
    both = dilatant_columns({"permeability": 1e-10}, 0.3, 0.6, 10.0, base=BaseContact.PRESCRIBED, bed_pressure=0.0)
    for _ in range(200):
        one.step(0.02)
        both.step(0.02)
    assert_allclose(both.basal_pressure, 0.0, atol=1e-12)
    assert one.basal_pressure[0] > 0.5 * LOADING * 0.3
    assert mean(both.state.solid_fraction)[0] > mean(one.state.solid_fraction)[0] + 5e-4
    assert both.state.solid_fraction[0, 0] > one.state.solid_fraction[0, 0] + 0.01


def at_base_of_sheared(dt, kind):
    """Return solid fraction of the base, and mean ratio of stress to load, after 2 s of erosion and shear at 10 s-1."""
    columns = dilatant_columns(
        {"permeability": 1e-10}, 1.0, 0.62, 10.0, profile=0.3 * LOADING * ETA[None], soil_solid_fraction=0.62,
        **CONTACTS[kind],
    )  # fmt: skip
    for _ in range(round(2.0 / dt)):
        load = LOADING * (columns.forcing.thickness + 0.01 * dt)
        columns.step(dt, 0.01 * dt, bed_pressure=0.3 * load)
    return columns.state.solid_fraction[0, 0], mean(stresses(columns))[0] / columns.forcing.liquefaction_pressure[0]


@pytest.mark.parametrize("kind", CONTACTS)
def test_the_length_of_a_step_does_not_count_while_sheared_debris_erodes(kind):
    """Soil is sheared for as long as it takes to fill the half cell above the base, not for a step."""
    exact = np.array(at_base_of_sheared(0.001, kind))
    errors = [abs(np.array(at_base_of_sheared(dt, kind)) - exact) for dt in (0.1, 0.05, 0.01)]
    assert errors[0][0] < 1e-3 and errors[0][1] < 0.02
    assert np.all(errors[2] < 0.3 * errors[0] + 1e-5)
