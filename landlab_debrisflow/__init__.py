"""Landslides and debris flows that pick up wet ground, as a Landlab component.

Public are the names below and those of `calibration` (values found from an observed event), `ensemble` (many runs of a
scene), `exact` (closed forms), `laws` (classes of laws, names for the author of one), `plots` (figures), `record`
(observers and files), `report` (the report of a run), `scene` (setup, terrains) and `triggers` (landslides of other
components as a release). Deeper modules may change at any time.
"""

from typing import TYPE_CHECKING, Any

from . import exact
from .columns.solve import solve_column
from .component import DebrisFlow
from .core.errors import InputError, ParameterError, SimulationError
from .core.version import __version__
from .model.inflow.hydrograph import Hydrograph
from .model.numerics import Numerics
from .physics.material import Material
from .record.measures import measures
from .scene.setup import Setup

if TYPE_CHECKING:
    from .fidelity.plan import Plan
    from .run.scene import Scene
    from .run.simulate import simulate

__all__ = [
    "DebrisFlow",
    "Hydrograph",
    "InputError",
    "Material",
    "Numerics",
    "ParameterError",
    "Plan",
    "Scene",
    "Setup",
    "SimulationError",
    "__version__",
    "exact",
    "measures",
    "simulate",
    "solve_column",
]


def __getattr__(name: str) -> Any:
    """Import the names of scenes and plans when they are first used: the readers of files load slowly."""
    if name == "Plan":
        from .fidelity.plan import Plan

        return Plan
    if name == "Scene":
        from .run.scene import Scene

        return Scene
    if name == "simulate":
        from .run.simulate import simulate

        return simulate
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    """Return the public names, whether they have been imported or not."""
    return sorted({*globals(), *__all__})
