"""Numerical choices: resolution and tolerances, no physics."""

from typing import Any

from ..core.errors import ParameterError
from ..core.parameters import declared, parameter
from ..spatial.transfer import MOST_NODES_PER_STEP

PRESETS = {
    "standard": {"courant_number": 0.6, "advective_courant_number": 0.5, "rest_energy": 1e-4},
    "fast": {"courant_number": 1.0, "advective_courant_number": 1.0, "rest_energy": 1e-4},
    "fastest": {"courant_number": 1.0, "advective_courant_number": 1.0, "rest_energy": 1e-3},
}
"""Values of parameters that are not given, by preset. The accuracy that the fast presets cost is measured: see
docs/choosing.md, and `python -m benchmarks.fidelity presets`."""


AUTO = "auto"
"""Word for a number of particles that a plan finds (`DebrisFlow.plan`)."""

QUANTITIES = ("run_out", "speed", "depth", "area", "eroded", "pressure", "deposit")
"""Quantities of an event whose errors a plan states."""


@declared
class Numerics:
    """Numerical choices; the defaults are meant to be left alone.

    Exactly one of `particle_count` and `particle_spacing` rules; the released volume is exact with both.
    """

    particle_count: Any = parameter(
        "-", "target number of particles of a release; auto: found by pilot runs in run_until_rest", None, (1, None),
        kind=int, words=(AUTO,),
    )  # fmt: skip
    tolerance: float | None = parameter(
        "-", "largest error of the quantities in hold, for a number of particles found by pilot runs; 0.05 if not set",
        None, (1e-3, 0.5), remedy="0.05 are 5 %",
    )  # fmt: skip
    hold: Any = parameter(
        "-", "quantities whose error is to stay within the tolerance; run_out and speed if not set", None,
        choices=QUANTITIES, kind=tuple,
    )  # fmt: skip
    particle_spacing: float | None = parameter("m", "mean distance of particles at release", None, (1e-6, None))
    threads: int = parameter("-", "threads for the stages of a step, of 4000 particles or more", 1, (1, 256), kind=int)
    settle: bool = parameter("-", "lay the mass into the terrain when all is at rest", True, kind=bool)
    preset: str = parameter(
        "-", "values of courant_number, advective_courant_number and rest_energy that are not given: 0.6, 0.5 and 1e-4 "
        "of standard, 1, 1 and 1e-4 of fast, 1, 1 and 1e-3 of fastest", "standard", choices=tuple(PRESETS),
    )  # fmt: skip
    courant_number: float = parameter("-", "time step over smoothing length / celerity", None, (1e-6, 1.0))
    advective_courant_number: float = parameter(
        "-",
        "longest way of a particle in a step over node spacing where the ground bends or a wall is near; over even "
        "ground up to 1.9 times this, but no more than 0.95 if it is less",
        None,
        (1e-6, MOST_NODES_PER_STEP),
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
        for name in ("tolerance", "hold"):
            if getattr(self, name) is not None and not self.automatic:
                raise ParameterError(
                    f"Numerics: {name} is for a number of particles found by pilot runs, got {getattr(self, name)!r} "
                    f"with particle_count {self.particle_count!r}; give particle_count: {AUTO}, or leave out {name}"
                )
        for name, value in PRESETS[self.preset].items():
            if getattr(self, name) is None:
                object.__setattr__(self, name, value)

    @property
    def automatic(self) -> bool:
        """Whether the number of particles is still to be found by pilot runs."""
        return self.particle_count == AUTO

    def count_for(self, area: float) -> int:
        """Return the number of particles for a release from some map area.

        Parameters
        ----------
        area : float
            Map area of the nodes that fail [m2].

        Returns
        -------
        int
            By `particle_spacing` if it is set, at least 1; else `particle_count`, or 2000 if neither is set, or if the
            number is still to be found.
        """
        if self.particle_spacing is not None:
            return max(1, round(area / self.particle_spacing**2))
        return self.DEFAULT_COUNT if self.automatic else self.particle_count or self.DEFAULT_COUNT
