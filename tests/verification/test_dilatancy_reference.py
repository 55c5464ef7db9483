"""Columns with dilatancy against the same equations solved by lines (docs/theory.md#dilatancy)."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from landlab_debrisflow import solve_column
from landlab_debrisflow.exact.dilatancy import DilatantDebris, equilibrium_solid_fraction

LOADING, THICKNESS = 9000.0, 0.2
DEBRIS = DilatantDebris()


def by_lines(levels, time, permeability, fraction, shear_rate, ratio):
    """Return stress [Pa] and solid fraction at levels below the surface, to 1e-8, by backward differentiation.

    Unknown are the stress and the logarithm of the solid fraction of every level, all but the surface.
    """
    cells, width = levels - 1, THICKNESS / (levels - 1)
    y = width * np.arange(1, levels)
    room = np.where(np.arange(1, levels) == cells, 0.5, 1.0)

    def rates(_, state):
        stress, m = state[:cells], np.exp(state[cells:])
        faces = 0.5 * (np.append(m[0], m[:-1]) + m)
        k_w = permeability / DEBRIS.pore_fluid_viscosity * np.exp((0.6 - faces) / 0.04)
        up = k_w * np.diff(np.append(0.0, LOADING * y - stress)) / width  # pressure falls upwards: flux through faces
        spread = (np.append(up[1:], 0.0) - up) / width / room  # (k_w p_y)_y
        tangent = m - equilibrium_solid_fraction(np.maximum(stress, 0.0), shear_rate, DEBRIS)
        alpha = DEBRIS.compressibility / (m * (stress + DEBRIS.reference_stress))
        return np.concatenate([(shear_rate * tangent - spread) / alpha, -spread])

    start = np.concatenate([(1.0 - ratio) * LOADING * y, np.full(cells, np.log(fraction))])
    end = solve_ivp(rates, (0.0, time), start, "BDF", rtol=1e-8, atol=1e-8).y[:, -1]
    assert np.all((end[:cells] > 0.0) & (end[:cells] < 2.0 * LOADING * y))  # no bound is met
    return end[:cells], np.exp(end[cells:])


def by_column(levels, step, time, permeability, fraction, shear_rate, ratio):
    """Return the same by `solve_column`."""
    column = solve_column(
        THICKNESS, entrainment_rate=0.0, times=[time], loading=LOADING, initial="linear", levels=levels, step=step,
        initial_pressure=ratio * LOADING * THICKNESS, solid_fraction=fraction, shear_rate=shear_rate,
        dilatancy={"permeability": permeability},
    ).isel(time=0, column=0)  # fmt: skip
    load = LOADING * THICKNESS * np.linspace(1.0, 0.0, levels)
    stress, m = load - column.excess_pore_pressure.values, column.solid_fraction.values
    return stress[-2::-1], m[-2::-1]


CASES = {
    "consolidates": (2.0, 1e-9, 0.60, 0.0, 0.9),
    "contracts": (1.0, 1e-9, 0.63, 2.0, 0.3),
    "dilates": (1.0, 1e-9, 0.645, 0.5, 0.0),
}


@pytest.mark.parametrize("case", CASES)
def test_the_error_of_a_step_is_of_first_order(case):
    """The same levels: what is left is the error of backward Euler."""
    given = CASES[case]
    stress, m = by_lines(11, *given)
    errors = []
    for steps in (25, 100, 400):
        s, fraction = by_column(11, given[0] / steps, *given)
        errors.append((np.abs(s - stress).max() / stress.max(), np.abs(fraction - m).max()))
    errors = np.array(errors)
    assert np.all(errors[1:] < errors[:-1] / 3.0)
    assert errors[-1, 0] < 1e-3 and errors[-1, 1] < 1e-5


@pytest.mark.slow
@pytest.mark.parametrize("case", CASES)
def test_levels_converge(case):
    given = CASES[case]
    stress, m = by_lines(161, *given)
    errors = []
    for levels in (11, 21, 41):
        s, fraction = by_column(levels, given[0] / 2000, *given)
        every = 160 // (levels - 1)
        lower = slice((levels - 1) // 2, None)  # below the layer at the surface that the coarse levels do not resolve
        stress_error = np.abs(s - stress[every - 1 :: every])[lower].max() / stress.max()
        errors.append((stress_error, np.abs(fraction - m[every - 1 :: every])[lower].max()))
    errors = np.array(errors)
    assert np.all(errors[1:] < errors[:-1] / 1.8)
    assert np.all(errors[-1] < (3e-4, 3e-6))
