"""Numerical choices: resolution and tolerances, no physics."""

from ..core.errors import ParameterError
from ..core.parameters import declared, parameter


@declared
class Numerics:
    """Numerical choices; the defaults are meant to be left alone.

    Exactly one of `particle_count` and `particle_spacing` rules; the released volume is exact with both.
    """

    particle_count: int | None = parameter("-", "target number of particles of a release", None, (1, None), kind=int)
    particle_spacing: float | None = parameter("m", "mean distance of particles at release", None, (1e-6, None))
    threads: int = parameter("-", "threads for the sums over neighbours", 1, (1, 256), kind=int)
    settle: bool = parameter("-", "lay the mass into the terrain when all is at rest", True, kind=bool)
    courant_number: float = parameter("-", "time step over smoothing length / celerity", 0.6, (1e-6, 1.0))
    shock_viscosity: float = parameter("-", "strength of the viscosity at shocks", 1.0, (0.5, 10.0))
    rest_energy: float = parameter("-", "kinetic energy over its peak at which all is at rest", 1e-4, (0.0, 1.0))
    arrival_depth: float = parameter(
        "m", "depth that counts as arrival, and from which on peaks count", 0.01, (0.0, None)
    )

    DEFAULT_COUNT = 2000

    def _agree(self):
        if self.particle_spacing is not None and self.particle_count is not None:
            raise ParameterError("Numerics: give particle_count or particle_spacing, not both")

    def count_for(self, area: float) -> int:
        """Return the number of particles for a release from some map area.

        Parameters
        ----------
        area : float
            Map area of the nodes that fail [m2].

        Returns
        -------
        int
            By `particle_spacing` if it is set, at least 1; else `particle_count`, or 2000 if neither is set.
        """
        if self.particle_spacing is not None:
            return max(1, round(area / self.particle_spacing**2))
        return self.particle_count or self.DEFAULT_COUNT
