"""Flow of one phase, whose grains carry their pore water."""

import numpy as np

from ...physics.contracts import MIXTURE
from ...terrain.surface import SurfaceSample
from ..kinematics import kick
from ..time_step import NOT_STIFF
from ..walls import bear


class OnePhaseDynamics:
    """The `Phases` of a flow of one phase.

    Parameters
    ----------
    material : Material
    """

    variables = ()
    phase_fractions = ((MIXTURE, 1.0),)
    solid_fraction = 1.0
    sleeps = True

    def __init__(self, material):
        self.material = material
        self._coefficient = np.array([material.coefficient_of_consolidation])

    def density(self, p):
        """Return the density of the mixture, shape (n,) [kg m-3]."""
        return p.density

    def solid_volume(self, p):
        """Return the volume of the grains in each particle, shape (n,) [m3]."""
        return p.volume * (1.0 - p.porosity)

    def coefficient_of_consolidation(self, p, which: slice):
        """Return the coefficient of consolidation of the material, shape (1,) [m2 s-1]."""
        return self._coefficient

    def after_summation(self, p, exchange, cells) -> None:
        """Write the thickness, which is that of the only phase [m]."""
        p.thickness[:] = p.own_thickness

    def kick(self, p, exchange, velocity, yield_stress, drag, rest_speed, dt: float) -> None:
        """Accelerate the particles that are awake along the bed for `dt` seconds, in place; see `kinematics.kick`."""
        m = p.awake
        mass, gravity = p.density[:m] * p.thickness[:m], self.material.gravity
        kick(velocity, p.thrust, p.surface_sample, p.cos_slope, yield_stress, drag, mass, gravity, rest_speed, dt)

    def held_at_rest(self, p, exchange, which: slice, yield_stress, drag, walls):
        """Return whether friction and walls would hold each of some particles at rest, shape (n,)."""
        n = yield_stress.size
        thrust = np.ascontiguousarray(p.thrust[:, which])
        sample = SurfaceSample(*p.surface_values[:, which])
        mass, none, pull = p.density[which] * p.thickness[which], np.zeros(n), np.zeros((3, n))
        gravity = self.material.gravity
        kick(pull, thrust, sample, p.cos_slope[which], none, none, mass, gravity, np.zeros(1), 1.0)
        bear(p.x[which], p.y[which], pull, sample, walls)
        return np.sqrt((pull**2).sum(axis=0)) <= yield_stress / mass

    def limit_entrainment(self, exchange, rate) -> None:
        """Leave the erosion rate as it is: every particle can take soil."""

    def share_entrained(self, p, exchange) -> None:
        """Leave the entrained soil where it is: the eroding particle takes all of it."""

    def column_forcing(self, p, forcing, prescribed, dt: float):
        """Return the forcing of the columns as it is: porosity changes by erosion only."""
        return forcing

    def update_mean_pressure(self, p, exchange, forcing, profiles, dt: float) -> None:
        """Leave the mean pore pressure unknown: the pressure of the flow does not depend on it."""

    def celerity_squared(self, p, dt: float):
        """Return 0, shape (1,) [m2 s-2]: only weight drives waves."""
        return NOT_STIFF
