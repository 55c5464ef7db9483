"""Schemes by name, and the methods of the laws that have a choice of them."""

import numpy as np

from ....core.errors import ParameterError
from ...column_contracts import is_dilatant
from . import dilatant, stepwise
from .lax_wendroff import advance_lax_wendroff
from .lazy import state
from .lazy.advance import advance_columns, synchronise_columns
from .upwind import advance_upwind

ADVANCE = {"default": advance_columns, "lax_wendroff": advance_lax_wendroff, "upwind": advance_upwind}
MEMORY_SIZE = {"default": state.SIZE, "lax_wendroff": stepwise.SIZE, "upwind": stepwise.SIZE}
"""Number of floats of a column in `ColumnState.memory`, by scheme."""


def memory_size(law) -> int:
    """Return the number of floats of a column of `law` in `ColumnState.memory`."""
    return dilatant.SIZE if is_dilatant(law) else MEMORY_SIZE[law.scheme]


def check_scheme(law) -> None:
    """Refuse choices of a law that do not go together.

    Raises
    ------
    ParameterError
        If the paper's scheme is combined with ``bed_contact="flux"``.
    """
    if law.scheme == "lax_wendroff" and law.bed_contact == "flux":
        raise ParameterError(
            f"{type(law).__name__}: bed_contact must be 'dirichlet' with scheme 'lax_wendroff', got 'flux': "
            "the paper's scheme has a prescribed base only"
        )


def advance(law, columns, forcing, dt: float, basal_pressure) -> None:
    """Advance `columns` by `dt` [s] with the scheme of a `law`; write `basal_pressure` [Pa] as `ColumnLaw.advance`."""
    if is_dilatant(law):
        constants = law.dilatancy.constants(forcing.shearing.solid_density)
        dilatant.advance_dilatant(columns, forcing, dt, basal_pressure, law.choices, constants)
    else:
        ADVANCE[law.scheme](columns, forcing, dt, basal_pressure, law.choices)


def synchronise(law, columns, forcing) -> None:
    """Turn columns into pressures at levels, as they are now, at least suction; for output, of a copy.

    `law` is a declared column law, `columns` a `ColumnState`, changed in place [Pa]; `forcing` is the last one. Schemes
    other than the default keep pressures at levels anyway, and columns with dilatancy keep them within their bounds.
    """
    if is_dilatant(law):
        return
    if law.scheme == "default":
        synchronise_columns(columns, forcing, law.choices)
    if forcing.bounded:
        suction = -forcing.water_to_buoyant * forcing.liquefaction_pressure
        least = np.multiply.outer(suction, np.linspace(1.0, 0.0, law.levels))
        np.maximum(columns.profile, least, out=columns.profile)
