"""Flow of one phase, whose grains carry their pore water."""

import numpy as np

from ...core.threads import over_particles
from ...physics.column_contracts import is_dilatant
from ...physics.contracts import MIXTURE
from ..kinematics import Resistance, kick
from ..time_step import NOT_STIFF
from ..walls import bear


class OnePhaseDynamics:
    """The `Phases` of a flow of one phase.

    Parameters
    ----------
    material : Material
        Densities, porosity, gravity.
    column : ColumnLaw
        Law of the columns; one with dilatancy knows its coefficient of consolidation.
    """

    variables = ()
    phase_fractions = ((MIXTURE, 1.0),)
    solid_fraction = 1.0
    sleeps = True

    def __init__(self, material, column):
        self.material, self._column = material, column if is_dilatant(column) else None
        self._coefficient = np.array([material.coefficient_of_consolidation])

    def bearing(self, p) -> slice:
        """Return the places of the particles that bear on the bed: of all that are awake."""
        return slice(p.awake)

    def density(self, p):
        """Return the density of the mixture, shape (n,) [kg m-3]."""
        return p.density

    def solid_volume(self, p):
        """Return the volume of the grains in each particle, shape (n,) [m3]."""
        return p.volume * (1.0 - p.porosity)

    def coefficient_of_consolidation(self, p, which: slice):
        """Return the coefficient of consolidation, shape (1,); of debris with dilatancy at the base, (n,) [m2 s-1].

        `p` are all particles and `which` places of n.
        """
        if self._column is not None:
            # a copy without gaps: kernels are compiled for arrays without gaps, and anew for any other
            return self._column.at_base(p.column_memory[which]).coefficient_of_consolidation.copy()
        return self._coefficient

    def after_summation(self, p, exchange, cells) -> None:
        """Write the thickness, which is that of the only phase [m].

        `p` are all particles; `exchange` and `cells` matter with two phases only.
        """
        p.thickness[:] = p.own_thickness

    def kick(self, p, exchange, velocity, yield_stress, drag, rest_speed, dt: float, threads: int = 1) -> None:
        """Accelerate the particles that are awake along the bed for `dt` seconds, in place; see `kinematics.kick`.

        `velocity`, shape (3, n), is changed [m s-1]; `yield_stress` [Pa], `drag` [Pa s m-1] and `rest_speed` [m s-1]
        have shape (n,); `exchange` is not used; `threads` is the number of threads.
        """

        def kick_some(which: slice) -> None:
            resistance = Resistance(
                yield_stress=yield_stress[which], drag=drag[which], mass=p.density[which] * p.thickness[which],
                rest_speed=rest_speed[which] if rest_speed.size > 1 else rest_speed,
            )  # fmt: skip
            slope = p.slope_x, p.slope_y
            kick(which.start, velocity, p.thrust, slope, p.cos_slope, resistance, self.material.gravity, dt)

        over_particles(kick_some, p.awake, threads)

    def held_at_rest(self, p, exchange, which: slice, yield_stress, drag, walls):
        """Return whether friction and walls would hold each of some particles at rest, shape (n,).

        `which` are places of n particles; `yield_stress` [Pa] is of shape (n,), `walls` a `Raster` or None; `exchange`
        and `drag` are not used.
        """
        n = yield_stress.size
        thrust = np.ascontiguousarray(p.thrust[:, which])
        sample = tuple(values[which] for values in p.surface_sample)
        mass, none, pull = p.density[which] * p.thickness[which], np.zeros(n), np.zeros((3, n))
        free = Resistance(yield_stress=none, drag=none, mass=mass, rest_speed=np.zeros(1))
        kick(0, pull, thrust, sample[1:3], p.cos_slope[which], free, self.material.gravity, 1.0)
        bear(p.x[which], p.y[which], pull, sample, walls)
        return np.sqrt((pull**2).sum(axis=0)) <= yield_stress / mass

    def limit_entrainment(self, exchange, rate) -> None:
        """Leave the erosion rate as it is: every particle can take soil."""

    def share_entrained(self, p, exchange) -> None:
        """Leave the entrained soil where it is: the eroding particle takes all of it."""

    def column_forcing(self, p, forcing, prescribed, dt: float):
        """Return the forcing of the columns as it is: porosity changes by erosion only.

        `p`, `prescribed` and `dt` matter with two phases only.
        """
        return forcing

    def update_mean_pressure(self, p, exchange, forcing, profiles, dt: float) -> None:
        """Leave the mean pore pressure unknown: the pressure of the flow does not depend on it.

        The arguments, as in `Phases.update_mean_pressure`, matter with two phases only.
        """

    def celerity_squared(self, p, dt: float):
        """Return 0, shape (1,) [m2 s-2]: only weight drives waves.

        `p` and `dt` [s] matter with two phases only.
        """
        return NOT_STIFF
