"""A component in a few lines: its state, its laws and its budget, as text and as a table for notebooks."""

from html import escape
from typing import Any

from ..physics.registry import LAWS, law_name


def text(flow: Any) -> str:
    """Return state, laws and budget, one line each."""
    if (rows := _rows(flow)) is None:
        return object.__repr__(flow)
    return "\n  ".join([f"DebrisFlow: {rows.pop('state')}", *(f"{name}: {words}" for name, words in rows.items())])


def html(flow: Any) -> str:
    """Return state, laws and budget as a table."""
    rows = _rows(flow) or {"state": "under construction"}
    cells = "".join(
        f'<tr><th style="text-align:left">{escape(name)}</th><td style="text-align:left">{escape(words)}</td></tr>'
        for name, words in rows.items()
    )
    return f"<table><caption>DebrisFlow</caption>{cells}</table>"


def _rows(flow) -> dict[str, str] | None:
    """Return names and values to show, or None if the component is not complete."""
    if "_call" not in vars(flow):
        return None
    budget = ", ".join(f"{name} {volume:.6g}" for name, volume in flow.budget.items())
    laws = ", ".join(f"{kind} {law_name(kind, getattr(flow.setup, kind)).split('.')[-1]}" for kind in LAWS)
    rows, columns = flow.grid.shape
    return {
        "state": f"{_state(flow)} at {flow.elapsed_time:.6g} s",
        "particles": f"{flow._simulation.particles.count} on {rows} x {columns} nodes",
        "laws": laws,
        "budget [m3]": budget,
    }


def _state(flow) -> str:
    simulation, budget = flow._simulation, flow.budget
    if not simulation.idle:
        return "moving"
    if not simulation.inflow.over:
        return "waiting for inflow"
    if simulation.particles.count:
        return "at rest, not settled"
    return "at rest" if budget["released"] + budget["inflow"] > 0.0 else "nothing released yet"
