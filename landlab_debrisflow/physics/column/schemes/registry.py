"""The ways to advance columns, by name, and what the two laws that have a choice of them share."""

from ....core.errors import ParameterError
from .choices import scheme_of
from .lax_wendroff import advance_lax_wendroff
from .lazy.advance import advance_columns, bring_columns
from .upwind import advance_upwind

ADVANCE = {"default": advance_columns, "lax_wendroff": advance_lax_wendroff, "upwind": advance_upwind}


def check_scheme(law) -> None:
    """Refuse what does not go together."""
    if law.scheme == "lax_wendroff" and law.bed_contact == "flux":
        raise ParameterError(
            f"{type(law).__name__}: bed_contact must be 'dirichlet' with scheme 'lax_wendroff', got 'flux': "
            "the paper's scheme knows a prescribed base only"
        )


def advance(law, stretching: bool, columns, forcing, dt: float, basal_pressure) -> None:
    """Advance columns as `law` says; see `ColumnLaw.advance`."""
    ADVANCE[law.scheme](columns, forcing, dt, basal_pressure, scheme_of(law, stretching))


def synchronise(law, stretching: bool, columns, forcing) -> None:
    """Turn columns into pressures at levels, as they are now; the other schemes always keep them so."""
    if law.scheme == "default":
        bring_columns(columns, forcing, scheme_of(law, stretching))
