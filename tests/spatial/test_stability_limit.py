"""The longest time step on a lattice: what the default Courant number is half of (docs/decisions.md, Flow 2)."""

import numpy as np
import pytest

from landlab_debrisflow import Numerics
from landlab_debrisflow.spatial.cells import sort_into_cells
from landlab_debrisflow.spatial.packing import Position
from landlab_debrisflow.spatial.summation import SMOOTHING_RATIO, SummationInput, Sums, sum_over_neighbours

SHIFT = 3e-3  # of one particle, in spacings: second-order terms are 1e-5, positions are rounded to 1e-7


def lattice(kind):
    """Return points with unit area each and the index of the one in the middle."""
    i, j = (index.ravel() for index in np.mgrid[-7:8, -7:8])
    if kind == "square":
        return i.astype(float), j.astype(float), 112
    side = np.sqrt(2.0 / np.sqrt(3.0))
    return side * (i + 0.5 * j), side * 0.5 * np.sqrt(3.0) * j, 112


def response(x, y, middle, axis):
    """Return how all accelerations change as the particle in the middle moves along an axis (g = h = 1)."""
    n, found = x.size, []
    for sign in (1.0, -1.0):
        moved = [x.copy(), y.copy()]
        moved[axis][middle] += sign * SHIFT
        cells = sort_into_cells(*moved, np.full(n, 2.0 * SMOOTHING_RATIO))
        one, zero, sums = np.ones(n), np.zeros(n), Sums(*np.empty((3, n)), np.empty((3, n)), np.empty(n))
        length = SMOOTHING_RATIO * one
        position, rest = Position(*moved, zero), np.zeros((3, n))
        given = SummationInput(position, rest, one, length, length, 0.5 * one, one, one, zero, one)
        sum_over_neighbours(cells, given, 0.0, sums)
        found.append(sums.acceleration[:2])
    return (found[0] - found[1]) / (2.0 * SHIFT)


@pytest.mark.parametrize("kind", ["square", "hexagonal"])
def test_the_default_step_is_half_of_what_leapfrog_bears(kind):
    x, y, middle = lattice(kind)
    jacobian = np.stack([response(x, y, middle, axis) for axis in (0, 1)])  # (axis, component, particle)
    waves = np.stack(np.meshgrid(*2 * [np.linspace(-1.2 * np.pi, 1.2 * np.pi, 61)]), -1).reshape(-1, 2)
    phase = np.cos(waves @ np.stack([x, y]))  # the lattice is symmetric
    stiffness = -np.einsum("wn,acn->wac", phase, jacobian)
    fastest = np.sqrt(np.linalg.eigvalsh(stiffness).max()) * SMOOTHING_RATIO  # in celerities per smoothing length
    # derived from the Hessian of the kernel: 1.633 hexagonal, 1.648 square; the wave numbers are 0.13 apart
    assert fastest == pytest.approx({"square": 1.648, "hexagonal": 1.633}[kind], abs=2e-3)
    limit = 2.0 / fastest
    assert Numerics().courant_number == pytest.approx(0.5 * limit, rel=0.03)  # rounded to one digit
