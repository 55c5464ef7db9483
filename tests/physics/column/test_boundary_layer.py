"""The layer over a base whose pressure has just changed."""

import math

import pytest

from landlab_debrisflow.physics.column.schemes.lazy.boundary_layer import BEYOND, boundary_layer


@pytest.mark.parametrize("growth", [0.0, 1e-6, 0.02, 0.3])
@pytest.mark.parametrize("diffusion", [1e-8, 1e-5, 1e-3])
def test_it_ends_where_it_is_rounding(growth, diffusion):
    """Ogata & Banks: at six diffusive lengths beyond the soil that came in 3e-17 of the jump are left, or less."""
    length = 2.0 * math.sqrt(diffusion)
    places = (growth + part * length for part in (BEYOND + 1e-3, BEYOND - 1e-3))
    beyond, within = (boundary_layer(place, growth, diffusion) for place in places)
    assert beyond == 0.0 < within < 3e-17
    assert boundary_layer(growth + 0.5 * length, growth, diffusion) > 0.2
