"""A flow of one phase, whose grains carry their pore water: what `Mixture` does otherwise.

A simulation has one of the two as its ``matter``, and asks it wherever the number of phases makes a difference.
"""

import numpy as np

from ...physics.contracts import MIXTURE
from .. import walls
from ..kinematics import kick
from ..time_step import NOT_STIFF


class Single:
    """The one phase of a simulation.

    Parameters
    ----------
    physics : Setup
    """

    variables = ()

    parts = ((MIXTURE, 1.0),)
    """What of a volume goes into which particles: phase and part."""

    own_part = 1.0
    """What of the soil that a particle takes becomes its own; the rest goes to others."""

    sleeps = True
    """Whether what lies still may be left alone."""

    def __init__(self, physics):
        self._gravity = physics.material.gravity
        self._coefficient = np.array([physics.material.coefficient_of_consolidation])

    def density(self, p):
        """Return the density of what each particle is of, shape (n,) [kg m-3]."""
        return p.density

    def solid_volume(self, p):
        """Return the volume of the grains in each particle, shape (n,) [m3]."""
        return p.volume * (1.0 - p.porosity)

    def coefficient_of_consolidation(self, p, which: slice):
        """Return that of the columns of some particles, as long as they are many or of length 1 [m2 s-1]."""
        return self._coefficient

    def found(self, p, cells) -> None:
        """Note what the sums over neighbours found, and write the thickness of the whole."""
        p.thickness[:] = p.own_thickness

    def kick(self, sim, velocity, yield_stress, drag, rest_speed, dt: float) -> None:
        """Accelerate the particles that are awake along the bed for `dt` seconds, in place; see `kinematics.kick`."""
        p, m = sim.particles, sim.particles.awake
        mass = p.density[:m] * p.thickness[:m]
        kick(velocity, p.thrust, sim.ground, sim.cosine, yield_stress, drag, mass, self._gravity, rest_speed, dt)

    def held(self, sim, which: slice, yield_stress, drag):
        """Return which of some particles friction and walls would hold at rest."""
        p, n = sim.particles, yield_stress.size
        thrust, ground = np.ascontiguousarray(p.thrust[:, which]), np.ascontiguousarray(sim.ground[:, which])
        mass, none, pull = p.density[which] * p.thickness[which], np.zeros(n), np.zeros((3, n))
        kick(pull, thrust, ground, sim.cosine[which], none, none, mass, self._gravity, np.zeros(1), 1.0)
        walls.bear(sim, which, pull, ground)
        return np.sqrt((pull**2).sum(axis=0)) <= yield_stress / mass

    def refuse_soil(self, rate) -> None:
        """Set the rate of erosion to 0 where nobody could take all of the soil, in place."""

    def take_up(self, sim) -> None:
        """Pass on what of the soil is not the particles' own."""

    def force(self, sim, forced, dt: float):
        """Return the forcing of the columns with what phases make of it."""
        return forced

    def follow(self, sim, forced, dt: float) -> None:
        """Follow what of the columns acts on the flow, after they were advanced."""

    def celerity_squared(self, sim, dt: float):
        """Return by how much the square of the celerity is higher than weight makes it, (n,) or (1,) [m2 s-2]."""
        return NOT_STIFF
