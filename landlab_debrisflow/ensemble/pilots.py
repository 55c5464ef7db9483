"""Pilot runs of an ensemble: some members, spread over all."""

import dataclasses
from collections.abc import Callable
from typing import Any

import numpy as np
import xarray as xr

from ..core.errors import InputError
from ..fidelity.choices import choose_steps
from ..fidelity.constants import FAST_TOLERANCE, PILOTS
from ..fidelity.event import with_count
from ..fidelity.pilots import measure_pilot
from ..fidelity.planner import pilot_column
from ..physics.column import NoExcessPressure
from ..physics.registry import LAWS
from ..run.grids import build_grid
from ..run.planning import event_of
from ..scene.setup import Setup
from .basis import Basis
from .design import design_keys, member_values
from .member import prepare_member, run_member
from .plan import COUNTS, FEWEST_PILOTS, EnsemblePlan, PilotRuns, choose_resolution, with_steps
from .result import MemberResult

PILOT_MEMBERS = 8
"""Most members that are run as pilots."""

FAST = "fast"
"""Preset of steps that is tried."""


def spread_members(design: xr.Dataset, count: int) -> list[int]:
    """Return members that lie far from each other in the ranks of their values.

    The first is nearest to the middle of all; each further one has the largest distance to its nearest chosen one.

    Parameters
    ----------
    design : xarray.Dataset
    count : int
        Number of members wanted.

    Returns
    -------
    list of int
        In ascending order.
    """
    columns = [design[name].values for name in design_keys(design)]
    ranks = np.stack([np.argsort(np.argsort(column, kind="stable"), kind="stable") for column in columns], axis=1)
    places = ranks / max(1, len(ranks) - 1)
    chosen = [int(np.argmin(np.linalg.norm(places - 0.5, axis=1)))]
    nearest = np.linalg.norm(places - places[chosen[0]], axis=1)
    while len(chosen) < min(count, len(ranks)):
        chosen.append(int(np.argmax(nearest)))
        nearest = np.minimum(nearest, np.linalg.norm(places - places[chosen[-1]], axis=1))
    return sorted(chosen)


def plan_ensemble(basis: Basis, design: xr.Dataset, notify: Callable[[str], None]) -> EnsemblePlan:
    """Run pilots of some members of an ensemble in this process, and return its plan.

    The column is the finest that the rules of a plan choose for one of them. Steps are fast unless the setup has steps
    of its own, or maps tell fast from standard ones.

    Parameters
    ----------
    basis : Basis
    design : xarray.Dataset
    notify : callable
        Called with a text when the pilot runs of a member begin.

    Returns
    -------
    EnsemblePlan

    Raises
    ------
    InputError
        If fewer than three of the pilots came to their end.
    """
    members, notes, columns = spread_members(design, PILOT_MEMBERS), [], []
    written = basis.content.setup
    own_steps = choose_steps(written.numerics, FAST_TOLERANCE).value == written.numerics
    preset = "" if own_steps else FAST
    setup = with_steps(written, preset)
    for member in members:
        notify(f"ensemble: pilot run of member {member}, for the column")
        try:
            columns.append(_column(basis.with_setup(setup), design, member))
        except Exception as error:  # its further pilot runs tell of it
            notes.append(f"member {member} failed as a pilot: {type(error).__name__}: {error}")
    column = max(columns, key=_fineness, default=written.column)
    keep = type(column) not in LAWS["column"].values() or any(one.name.path[0] == "column" for one in basis.varied)
    if not keep:
        setup = dataclasses.replace(setup, column=column)
    found, runs = _runs(basis, design, members, setup, "" if own_steps else "standard", notify)
    if len(found) < FEWEST_PILOTS:
        raise InputError(
            f"ensemble: fidelity auto needs {FEWEST_PILOTS} pilot members that come to their end, got {len(found)} of "
            f"{len(members)}; {notes[0] if notes else 'give more members, or particle_count and fidelity: scene'}"
        )
    count, fast, maps = choose_resolution(runs)
    return EnsemblePlan(
        particles=count, preset="" if own_steps else FAST if fast else "standard",
        column=None if keep else setup.to_mapping()["column"], maps=maps, pilots=tuple(found), notes=tuple(notes),
    )  # fmt: skip


def _runs(
    basis: Basis, design: xr.Dataset, members: list[int], setup: Setup, other: str, notify: Callable[[str], None]
) -> tuple[list[int], PilotRuns]:
    """Return members whose pilot runs came to their end, and these runs; `other` is a preset to compare with, or ""."""
    setups = [with_count(setup, count) for count in COUNTS]
    if other:
        setups.append(with_steps(setups[0], other))
    found, rows = [], []
    for member in members:
        notify(f"ensemble: pilot runs of member {member} with {' and '.join(map(str, COUNTS))} particles")
        values = member_values(design, member)
        row = [run_member(basis.with_setup(one), member, values).result for one in setups]
        if not any(one.error for one in row):
            found.append(member)
            rows.append(row)
    parts: list[list[MemberResult]] = [list(part) for part in zip(*rows, strict=True)]
    return found, PilotRuns(*parts) if parts else PilotRuns([], [])


def _column(basis: Basis, design: xr.Dataset, member: int) -> Any:
    """Return the law of the column that the rules of a plan choose for a member."""
    prepared = prepare_member(basis, member_values(design, member))
    grid = build_grid(basis.terrain if prepared.terrain is None else prepared.terrain)
    event = event_of(grid, prepared.setup, prepared.releases, prepared.max_duration)
    choice, _ = pilot_column(event, prepared.setup, (), lambda setup: measure_pilot(event, setup, PILOTS[0]))
    return choice.value


def _fineness(column: Any) -> int:
    """Return the number of levels of a column law, 0 of a law without pore pressure."""
    return 0 if isinstance(column, NoExcessPressure) else int(getattr(column, "levels", 1))
