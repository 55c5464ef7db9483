"""Stated errors of a run for its report."""

from ..fidelity.quantities import UNITS
from ..fidelity.table import WORDS, percent
from ..run.results import Results
from .blocks import Block, Sentences, Table, Verbatim

UNPLANNED = (
    "How large the errors of these numbers are has not been stated: the number of particles was given and not planned "
    "(numerics: particle_count: auto states them)."
)
MEANT = (
    "Each error is meant to hold in 95 % of scenes. The error of particles falls with their number, the error of the "
    "raster with a finer terrain."
)


def error_blocks(results: Results) -> list[Block]:
    """Return the table of stated errors of a run by a plan, or the sentence that there are none.

    Parameters
    ----------
    results : Results

    Returns
    -------
    list of Block
    """
    statement = results.record.statement
    if statement is None:
        return [Verbatim(results.report)] if results.report else [Sentences([UNPLANNED])]
    errors, raster = statement.get("errors") or {}, statement.get("raster_errors") or {}
    nan = float("nan")
    rows = [
        (WORDS.get(name, name), percent(nan if error is None else error), percent(raster.get(name)))
        for name, error in errors.items() if name in UNITS
    ]  # fmt: skip
    head = ("quantity", "of particles", "of the raster")
    return [
        Table(caption="Stated errors", head=head, rows=rows, numbers=(1, 2)),
        Sentences([MEANT]),
    ]
