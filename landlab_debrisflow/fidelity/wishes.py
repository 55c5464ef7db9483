"""Wishes for a plan: a tolerance, quantities to be held, and limits."""

from typing import Any

from ..core.errors import ParameterError
from ..core.parameters import declared, parameter
from ..model.numerics import QUANTITIES
from ..scene.setup import Setup
from .constants import HOLD, MOST_PARTICLES, NEVER_HELD, PILOTS, TOLERANCE


@declared
class Wishes:
    """Tolerance and quantities to be held, and limits of a plan."""

    keyword = "plan"

    tolerance: float = parameter(
        "-", "error that quantities to be held may have", TOLERANCE, (1e-3, 0.5), remedy="0.05 are 5 %"
    )
    hold: Any = parameter("-", "quantities to be held", HOLD, choices=QUANTITIES, kind=tuple)
    max_particles: int = parameter(
        "-", "most particles", MOST_PARTICLES, (PILOTS[-1], None), kind=int,
        remedy="the last pilot run has as many; with fewer, set particle_count and run",
    )  # fmt: skip
    max_cost: float | None = parameter("s", "longest CPU time of the run to come", None, (0.0, None), open_below=True)
    raster: bool | None = parameter(
        "-", "whether to run a pilot with every second node; not set: if cheap", None, kind=bool
    )

    def _agree(self):
        if not self.hold:
            raise ParameterError(f"plan: hold is empty; name at least one of {', '.join(QUANTITIES)}")


def wishes_of(setup: Setup, **others: Any) -> Wishes:
    """Return the wishes in the numerics of a setup, with further ones.

    Parameters
    ----------
    setup : Setup
    **others
        Attributes of `Wishes`, in place of the wishes of the setup; None: not given.

    Returns
    -------
    Wishes

    Raises
    ------
    ParameterError
        If a value is not allowed, or a quantity cannot be held; the message says why.
    """
    chosen = {"tolerance": setup.numerics.tolerance, "hold": setup.numerics.hold}
    chosen |= {name: value for name, value in others.items() if value is not None}
    hold = chosen["hold"]
    for name in (hold,) if isinstance(hold, str) else hold if isinstance(hold, tuple | list | set) else ():
        if name in NEVER_HELD:
            raise ParameterError(f"plan: hold: {name} cannot be held: {NEVER_HELD[name]}")
    return Wishes(**{name: value for name, value in chosen.items() if value is not None})
