"""Particles: variables are views of few blocks, whatever comes, goes or changes its place."""

import numpy as np
import pytest

from landlab_debrisflow.core.variables import Variable
from landlab_debrisflow.model.particles import Particles
from landlab_debrisflow.model.variables import PARTICLE_VARIABLES

VARIABLES = (*PARTICLE_VARIABLES, Variable("memory", "-", "memory of a column", width=2))


@pytest.fixture
def particles():
    """Return five particles, whose numbers tell them apart."""
    made = Particles(levels=3, variables=VARIABLES)
    made.append(5, x=np.arange(5.0), velocity=np.arange(15.0).reshape(3, 5), memory=np.arange(10.0).reshape(5, 2))
    made.append(0)
    return made


def numbers(particles):
    """Return the numbers given to particles, which must still go together."""
    x = particles.x
    assert np.array_equal(particles.velocity, [x, x + 5.0, x + 10.0])
    assert np.array_equal(particles.memory.T, [2.0 * x, 2.0 * x + 1.0])
    assert np.all(particles.excess_pore_pressure == 0.0) and particles.excess_pore_pressure.shape == (x.size, 3)
    for variable in VARIABLES:
        values = getattr(particles, variable.name)
        assert values.shape == variable.shape(x.size, levels=3) and values.dtype == np.dtype(variable.dtype)
        assert values.flags.c_contiguous, variable.name  # kernels are compiled for such arrays
    return x.tolist()


def test_all_variables_of_a_particle_go_with_it(particles):
    assert numbers(particles) == [0.0, 1.0, 2.0, 3.0, 4.0]
    particles.exchange(np.array([0, 1]), np.array([4, 2]))
    assert numbers(particles) == [4.0, 2.0, 1.0, 3.0, 0.0]
    particles.keep(np.array([True, False, True, True, True]))
    assert numbers(particles) == [4.0, 1.0, 3.0, 0.0] and particles.identity.tolist() == [4, 1, 3, 0]
    assert numbers(particles.at(np.array([3, 0]))) == [0.0, 4.0]
    particles.awake = 2
    some = {"x": [7.0], "velocity": [[7.0], [12.0], [17.0]], "memory": [[14.0, 15.0]]}
    assert particles.append(1, **some, of_another_law=3.0) == slice(2, 3) and particles.awake == 3
    assert numbers(particles) == [4.0, 1.0, 7.0, 0.0, 3.0] and particles.identity.tolist() == [4, 1, 5, 0, 3]


def test_a_copy_is_independent(particles):
    other = particles.copy()
    other.x[0], other.velocity[:, 0], other.still_steps[0] = 9.0, 9.0, 9
    assert numbers(particles) == [0.0, 1.0, 2.0, 3.0, 4.0] and particles.still_steps[0] == 0


def test_restored_particles_replace_all(particles):
    given = {variable.name: getattr(particles.at(np.array([2, 3])), variable.name) for variable in VARIABLES}
    particles.restore(given)
    given["x"][:] = -1.0
    assert numbers(particles) == [2.0, 3.0]


def test_values_that_are_set_go_where_the_particles_go(particles):
    particles.depth = np.arange(5.0)
    particles.light = True
    particles.keep(particles.x > 2.0)
    assert particles.depth.tolist() == [3.0, 4.0] and particles.light.tolist() == [True, True]
    with pytest.raises(ValueError, match="broadcast"):
        particles.depth = np.arange(5.0)
