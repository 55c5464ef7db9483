"""Ledger of volumes of a run for its report."""

from .blocks import Block, Sentences, Table

CAME = {"released": "released", "inflow": "flowed in", "eroded": "eroded on the way"}
WENT = {"deposited": "deposited", "moving": "still moving", "outflow": "left the map over its edge"}


def ledger_blocks(budget: dict[str, float]) -> list[Block]:
    """Return the table of volumes: where mass came from, where it went, and the residual.

    Parameters
    ----------
    budget : dict of str to float
        Terms [m3] as in the record of a run.

    Returns
    -------
    list of Block
    """
    if not budget:
        return [Sentences(["The run has not come to its end: there is no ledger yet."])]
    came, went = (sum(budget.get(name, 0.0) for name in side) for side in (CAME, WENT))
    rows = [(words, _exact(budget.get(name, 0.0))) for name, words in CAME.items()]
    rows.append(("sum of these", _exact(came)))
    rows += [(words, _exact(budget.get(name, 0.0))) for name, words in WENT.items()]
    rows.append(("sum of these", _exact(went)))
    residual = budget.get("residual", came - went)
    rows.append(("residual", f"{residual:.2g}"))
    relative = abs(residual) / came if came else 0.0
    words = (
        f"The residual is {relative:.1g} of the volume that came: rounding."
        if relative < 1e-9
        else (f"The residual is {relative:.1g} of the volume that came: more than rounding, do not trust this run.")
    )
    return [Table(caption="Volumes", head=("", "m³"), rows=rows, numbers=(1,)), Sentences([words])]


def _exact(value: float) -> str:
    return f"{value:,.1f}".replace(",", "\N{NO-BREAK SPACE}")
