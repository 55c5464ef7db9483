"""Numerical choices: resolution and tolerances, no physics."""

from ..core.errors import ParameterError
from ..core.parameters import declared, parameter
from ..spatial.transfer import MOST_NODES_PER_STEP

PRESETS = {
    "standard": {"courant_number": 0.6, "advective_courant_number": 0.5, "rest_energy": 1e-4},
    "fast": {"courant_number": 1.0, "advective_courant_number": 1.0, "rest_energy": 1e-3},
}
"""Values of parameters that are not given, by preset. What the fast one costs in accuracy is measured
(`python -m benchmarks.fidelity`)."""


@declared
class Numerics:
    """Numerical choices; the defaults are meant to be left alone.

    Exactly one of `particle_count` and `particle_spacing` rules; the released volume is exact with both.
    """

    particle_count: int | None = parameter("-", "target number of particles of a release", None, (1, None), kind=int)
    particle_spacing: float | None = parameter("m", "mean distance of particles at release", None, (1e-6, None))
    threads: int = parameter("-", "threads for the sums over neighbours", 1, (1, 256), kind=int)
    settle: bool = parameter("-", "lay the mass into the terrain when all is at rest", True, kind=bool)
    preset: str = parameter(
        "-", "values of courant_number, advective_courant_number and rest_energy that are not given: 0.6, 0.5 and 1e-4 "
        "of standard, 1, 1 and 1e-3 of fast", "standard", choices=tuple(PRESETS),
    )  # fmt: skip
    courant_number: float = parameter("-", "time step over smoothing length / celerity", None, (1e-6, 1.0))
    advective_courant_number: float = parameter(
        "-", "longest way of a particle in a step over node spacing", None, (1e-6, MOST_NODES_PER_STEP)
    )
    shock_viscosity: float = parameter("-", "strength of the viscosity at shocks", 1.0, (0.5, 10.0))
    rest_energy: float = parameter("-", "kinetic energy over its peak at which all is at rest", None, (0.0, 1.0))
    arrival_depth: float = parameter(
        "m", "depth that counts as arrival, and from which on peaks count", 0.01, (0.0, None)
    )

    DEFAULT_COUNT = 2000

    def _agree(self):
        if self.particle_spacing is not None and self.particle_count is not None:
            raise ParameterError("Numerics: give particle_count or particle_spacing, not both")
        for name, value in PRESETS[self.preset].items():
            if getattr(self, name) is None:
                object.__setattr__(self, name, value)

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
