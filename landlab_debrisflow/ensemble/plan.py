"""Plan of an ensemble: one number of particles, column and steps for all members, from pilot runs of some."""

import dataclasses
import math
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from ..core.words import grouped
from ..fidelity.choices import column_words
from ..fidelity.constants import MOST_PARTICLES
from ..fidelity.event import with_count
from ..fidelity.table import Printed, Table, percent
from ..model.numerics import PRESETS
from ..physics.registry import build_law
from ..scene.setup import Setup
from .result import ARRIVAL, MemberResult, common_window

COUNTS = (500, 1000)
"""Particles of the pilot runs whose maps are compared."""

SPREAD_FRACTION = 0.2
"""Largest numerical error of a map over the spread between members: it widens this spread by 2 %, because variances add
and sqrt(1 + 0.2^2) = 1.02."""

ORDER = 0.5
"""Power of the number of particles by which errors of maps fall: the least of the orders of depth, speed and deposit in
fidelity/constants.py, and that of the noise of particles."""

ROUND = 100
"""Numbers of particles are multiples of this number."""

FEWEST_PILOTS, FEWEST_NODES = 3, 12
"""Least number of pilot members, because a scatter is estimated; and of nodes that all of them reach, for arrival."""


class Difference(NamedTuple):
    """Difference of the maps of two runs of the pilot members, root mean squares over nodes in the unit of the map.

    Attributes
    ----------
    systematic : float
        Mean over members, without the part that the scatter of so few members leaves in it.
    scatter : float
        Standard deviation over members.
    """

    systematic: float
    scatter: float

    @property
    def error(self) -> float:
        """Error of the finer of two runs, of which the other has half the particles.

        Of an error C n^(-p) the difference is C n^(-p) (2^p - 1); of independent errors of that size the standard
        deviation of the difference is (1 + 2^(2p))^(1/2) times theirs.
        """
        systematic, scatter = self.systematic / (2.0**ORDER - 1.0), self.scatter / math.sqrt(1.0 + 4.0**ORDER)
        return math.hypot(systematic, scatter)


class HeldMap(NamedTuple):
    """Map of the members with its spread and its error, root mean squares over the nodes in the unit of the map.

    Attributes
    ----------
    spread : float
        Standard deviation over the pilot members.
    error : float
        Numerical error with the particles and steps of the plan.
    """

    spread: float
    error: float

    @property
    def ratio(self) -> float:
        """Numerical error over spread [-]."""
        return self.error / self.spread if self.spread > 0.0 else math.inf


class PilotRuns(NamedTuple):
    """Results of the pilot members, each in the order of the members.

    Attributes
    ----------
    coarse, fine : sequence of MemberResult
        With the particles of `COUNTS` and the steps that are to be chosen.
    standard : sequence of MemberResult
        With the particles of the coarse runs and standard steps; empty if steps are not to be chosen.
    """

    coarse: Sequence[MemberResult]
    fine: Sequence[MemberResult]
    standard: Sequence[MemberResult] = ()


@dataclasses.dataclass(frozen=True, kw_only=True, repr=False)
class EnsemblePlan(Printed):
    """Particles, column and steps of all members of an ensemble; it prints itself.

    Attributes
    ----------
    particles : int
        Number of particles.
    preset : str
        Preset of the steps; empty: steps of the scene.
    column : dict or None
        Law of the column as plain values; None: column of the scene.
    maps : dict of str to HeldMap
        Spread and error of the maps that are kept.
    pilots : tuple of int
        Members that were run as pilots.
    notes : tuple of str
        Doubts.
    """

    particles: int
    preset: str
    column: dict[str, Any] | None
    maps: dict[str, HeldMap]
    pilots: tuple[int, ...]
    notes: tuple[str, ...] = ()

    def applied(self, setup: Setup) -> Setup:
        """Return a setup with particles, column and steps of the plan.

        Parameters
        ----------
        setup : Setup
            Setup of the scene.
        """
        column = setup.column if self.column is None else build_law("column", self.column)
        return with_steps(with_count(dataclasses.replace(setup, column=column), self.particles), self.preset)

    def to_mapping(self) -> dict[str, Any]:
        """Return the plan as plain values, of which `from_mapping` builds an equal one."""
        values = {field.name: getattr(self, field.name) for field in dataclasses.fields(self)}
        held = {name: list(one) for name, one in self.maps.items()}
        return values | {"maps": held, "pilots": list(self.pilots), "notes": list(self.notes)}

    @classmethod
    def from_mapping(cls, mapping: Mapping[str, Any]) -> "EnsemblePlan":
        """Build a plan from the plain values of `to_mapping`.

        Parameters
        ----------
        mapping : mapping

        Returns
        -------
        EnsemblePlan
        """
        held = {name: HeldMap(*map(float, one)) for name, one in mapping["maps"].items()}
        lists = {name: tuple(mapping[name]) for name in ("pilots", "notes")}
        return cls(**{**mapping, "maps": held, **lists})

    def _table(self) -> Table:
        column = "of the scene" if self.column is None else column_words(build_law("column", self.column))
        rows = [
            ("particles", f"{grouped(self.particles)} in every member, by pilot runs of {len(self.pilots)} members"),
            ("column", column), ("steps", self.preset or "of the scene"),
        ]  # fmt: skip
        for name, one in self.maps.items():
            verdict = "held" if one.ratio <= SPREAD_FRACTION else "not held"
            words = f"numerical error {percent(one.ratio)} of the spread between members"
            rows.append((name, f"{words} ({percent(SPREAD_FRACTION)} allowed: {verdict})"))
        return Table(title="Plan of an ensemble", rows=rows, notes=self.notes)


def with_steps(setup: Setup, preset: str) -> Setup:
    """Return a setup with the steps of a preset, or as it is if the preset is empty."""
    if not preset:
        return setup
    values: dict[str, Any] = {"preset": preset} | PRESETS[preset]
    return dataclasses.replace(setup, numerics=dataclasses.replace(setup.numerics, **values))


def choose_resolution(runs: PilotRuns, most: int = MOST_PARTICLES) -> tuple[int, bool, dict[str, HeldMap]]:
    """Choose the number of particles with which the errors of all maps stay below a fifth of their spread.

    Parameters
    ----------
    runs : PilotRuns
    most : int
        Most particles.

    Returns
    -------
    count : int
        The least number that does, in hundreds, from that of the coarse pilot runs on.
    fast : bool
        Whether the chosen steps may stay: they differ from standard steps, the scatter between members aside, by less
        than half the error that is allowed.
    maps : dict of str to HeldMap
    """
    window = common_window([*runs.coarse, *runs.fine, *runs.standard])
    names = list(runs.fine[0].maps)
    coarse, fine, standard = ({name: _stack(part, name, window) for name in names} for part in runs)
    found, of_steps = {}, {}
    for name in names:
        nodes = _compared(name, coarse[name], fine[name])
        if nodes.sum() < (FEWEST_NODES if name == ARRIVAL else 1):
            continue
        spread = math.sqrt(np.mean(np.var(fine[name][:, nodes], axis=0, ddof=1)))
        if spread == 0.0:
            continue
        found[name] = HeldMap(spread, difference(fine[name][:, nodes], coarse[name][:, nodes]).error)
        both = nodes & _compared(name, coarse[name], standard[name]) if runs.standard else nodes & False
        values = (coarse[name][:, both], standard[name][:, both]) if both.any() else None
        of_steps[name] = difference(*values).systematic if values is not None else 0.0
    fast = all(of_steps[name] <= 0.5 * SPREAD_FRACTION * one.spread for name, one in found.items())
    of_steps = of_steps if fast else dict.fromkeys(of_steps, 0.0)
    asked = [float(COUNTS[0])]
    for name, one in found.items():
        allowed = math.sqrt((SPREAD_FRACTION * one.spread) ** 2 - of_steps[name] ** 2)
        asked.append(COUNTS[-1] * (one.error / allowed) ** (1.0 / ORDER))
    count = min(ROUND * math.ceil(max(asked) / ROUND - 1e-9), most)
    return count, fast, {
        name: HeldMap(one.spread, math.hypot(one.error * (COUNTS[-1] / count) ** ORDER, of_steps[name]))
        for name, one in found.items()
    }  # fmt: skip


def difference(one: np.ndarray, other: np.ndarray) -> Difference:
    """Return the difference between two runs of some members.

    Parameters
    ----------
    one, other : ndarray, shape (members, nodes)

    Returns
    -------
    Difference

    Examples
    --------
    >>> one, other = np.array([[1.0, 2.0], [3.0, 4.0]]), np.array([[0.0, 1.0], [2.0, 3.0]])
    >>> difference(one, other)
    Difference(systematic=1.0, scatter=0.0)
    """
    between = one.astype(float) - other
    variance = np.var(between, axis=0, ddof=1)
    systematic = np.mean(np.mean(between, axis=0) ** 2 - variance / len(between))
    return Difference(math.sqrt(max(0.0, float(systematic))), math.sqrt(float(np.mean(variance))))


def _stack(results: Sequence[MemberResult], name: str, window: tuple[slice, slice]) -> np.ndarray:
    """Return a map of some members over a window, shape (members, nodes)."""
    shape = window[0].stop, window[1].stop
    return np.array([one.on_lattice(name, shape)[window].ravel() for one in results])


def _compared(name: str, one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Return the nodes that count: reached by a member, or for the arrival time by all, shape (nodes,)."""
    if name == ARRIVAL:
        return np.all(np.isfinite(one) & np.isfinite(other), axis=0)
    return np.any((one != 0.0) | (other != 0.0), axis=0)
