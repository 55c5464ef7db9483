"""Particles that lie still sleep: nothing is computed for them until something could set them free.

A particle falls asleep when it has no speed, nothing in reach moves, and it would be held even if the
excess pore pressure at its base rose to the highest anywhere in its column: a column that nothing enters never
exceeds that (maximum principle of diffusion). It wakes in the very step in which its sums over neighbours
are done again. Its column is advanced by the time it slept, at once: then, and whenever anybody looks.

Those asleep are kept behind those awake, so the stages of a step work on one stretch of every array.
"""

import numpy as np

from ..physics.contracts import ColumnState
from . import step

STEPS_BETWEEN_LOOKS = 16
"""Steps after which those that may fall asleep are looked for: looking is cheap, but not free."""


def disturbed(sim):
    """Return the places of those asleep whose sums over neighbours are done again in this step."""
    p = sim.particles
    return p.awake + np.flatnonzero(sim.computed[p.awake :])


def wake(sim, places) -> None:
    """Wake particles at sorted places; their columns must have caught up."""
    p = sim.particles
    if places.size == 0:
        return
    first, last = p.awake, p.awake + places.size
    # those already there stay where they are: places are sorted, so the others are the last ones
    _exchange(sim, np.setdiff1d(np.arange(first, last), places), places[places >= last])
    p.awake = last
    none = np.zeros(places.size)
    sim.granted, sim.granted_ratio = np.concatenate([sim.granted, none]), np.concatenate([sim.granted_ratio, none])


def wake_all(sim) -> None:
    """Wake everybody."""
    p = sim.particles
    places = np.arange(p.awake, p.count)
    catch_up(sim, places)
    wake(sim, places)


def catch_up(sim, places=None) -> None:
    """Advance columns of those asleep, at some places or all, to the present, under the load they slept under."""
    p, law = sim.particles, sim.physics.column
    places = np.arange(p.awake, p.count) if places is None else places
    since = p.asleep_since[places]
    for began in np.unique(since[since < sim.time]):
        for place in _stretches(places[since == began]):
            none = np.zeros(place.stop - place.start)
            forced = step.forcing(sim, place, none, none)
            law.advance(step.columns(p, place), forced, sim.time - began, p.basal_excess_pore_pressure[place])
            p.asleep_since[place] = sim.time


def fall_asleep(sim) -> None:
    """Let those fall asleep whom nothing in their column can set free."""
    p = sim.particles
    lying = ~np.any(p.velocity[:, : p.awake], axis=0) & ~sim.computed[: p.awake]
    places = np.flatnonzero(lying)
    if places.size == 0:
        return
    last = p.awake
    first = last - places.size
    _exchange(sim, places[places < first], np.setdiff1d(np.arange(first, last), places))
    held = _held(sim, slice(first, last)) | (p.arrested[first:last] > 0)
    # held ones last
    free, place = first + np.flatnonzero(~held), first + np.arange(held.size)
    middle = first + free.size
    _exchange(sim, place[: free.size][held[: free.size]], free[free >= middle])
    p.awake = middle
    p.asleep_since[middle:last] = sim.time
    p.entrainment_rate[middle:last] = 0.0
    sim.granted, sim.granted_ratio = sim.granted[:middle], sim.granted_ratio[:middle]


def _held(sim, which: slice):
    """Return whether friction holds particles under the highest pressure their columns can bring to the base."""
    p, physics = sim.particles, sim.physics
    n = which.stop - which.start
    none = np.zeros(n)
    # looking must not change how a law keeps its columns
    now = ColumnState(*(values.copy() for values in step.columns(p, which)))
    physics.column.synchronise(now, step.forcing(sim, which, none, none))
    highest = np.maximum(now.profile.max(axis=1), p.basal_excess_pore_pressure[which])
    return step.held(sim, which, np.maximum(highest, 0.0))


def _exchange(sim, these, those) -> None:
    """Let particles change places, with what the stages of a step hand on about them."""
    if these.size == 0:
        return
    sim.particles.exchange(these, those)
    to, of = np.concatenate([these, those]), np.concatenate([those, these])
    for values in (sim.ground, sim.cosine, sim.computed, sim.node):
        values[..., to] = values[..., of]
    # an order of sorted places is not kept: it is made anew in every step


def _stretches(places):
    """Yield slices that cover sorted places."""
    for part in np.split(places, np.flatnonzero(np.diff(places) != 1) + 1):
        yield slice(int(part[0]), int(part[-1]) + 1)
