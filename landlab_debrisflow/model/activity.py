"""Sleep of particles at rest: the steps leave them out until something in reach could move them.

A particle falls asleep if it has no speed, nothing in reach moves, and friction would hold it even if the excess pore
pressure at its base rose to the highest value in its column. A column into which nothing enters never exceeds this
value (maximum principle of diffusion). A particle wakes in the same step in which its sums over neighbours are computed
again. Its column is then advanced over the whole time asleep at once, as it is for output. Particles asleep are kept
behind the particles awake, so that the stages of a step work on one contiguous range of every array.
"""

import numpy as np

from .basal import BasalLaw, held_at_rest
from .column_forcing import ColumnPhysics, column_forcing, column_state, present_profiles

STEPS_BETWEEN_CHECKS = 16
"""Number of steps between two searches for particles that may fall asleep: a search costs little, but not nothing."""

NONE = np.empty(0, np.int64)
"""Places of no particles."""


def disturbed(p):
    """Return the places of particles asleep whose sums over neighbours are redone in this step."""
    return NONE if p.awake == p.count else p.awake + np.flatnonzero(p.summed[p.awake :])


def wake(p, places) -> None:
    """Wake particles at sorted places; their columns must have caught up."""
    if places.size == 0:
        return
    first, last = p.awake, p.awake + places.size
    # particles already in the range keep their places; the others of the sorted places lie beyond it
    p.exchange(np.setdiff1d(np.arange(first, last), places), places[places >= last])
    p.awake = last


def wake_all(p, time: float, columns: ColumnPhysics) -> None:
    """Wake every particle, its column brought to `time` [s].

    `p` are all particles; `columns` is the law of the columns with its surroundings.
    """
    places = np.arange(p.awake, p.count)
    catch_up(p, time, columns, places)
    wake(p, places)


def catch_up(p, time: float, columns: ColumnPhysics, places=None) -> None:
    """Advance columns of particles asleep, at some places or all, to `time` [s], under the load they slept under.

    `p` are all particles; `places` are sorted places of particles asleep, int; None: all of these.
    """
    places = np.arange(p.awake, p.count) if places is None else places
    if places.size == 0:
        return
    since = p.asleep_since[places]
    for began in np.unique(since[since < time]):
        for place in _stretches(places[since == began]):
            none = np.zeros(place.stop - place.start)
            forcing = column_forcing(p, place, columns, none, none)
            base = p.basal_excess_pore_pressure[place]
            columns.law.advance(column_state(p, place), forcing, time - began, base)
            p.asleep_since[place] = time


def fall_asleep(p, time: float, columns: ColumnPhysics, friction: BasalLaw, exchange, walls) -> None:
    """Let particles fall asleep that nothing in their column can set free.

    Parameters
    ----------
    p : Particles
        All particles.
    time : float
        Elapsed time of the event [s].
    columns : ColumnPhysics
        Law, material and boundary of the columns.
    friction : BasalLaw
        Law of friction and its parameters.
    exchange : Exchange
        State of the exchange between grains and water.
    walls : Raster or None
        Raster with closed nodes; None where no node is closed.
    """
    lying = ~np.any(p.velocity[:, : p.awake], axis=0) & ~p.summed[: p.awake]
    places = np.flatnonzero(lying)
    if places.size == 0:
        return
    last = p.awake
    first = last - places.size
    p.exchange(places[places < first], np.setdiff1d(np.arange(first, last), places))
    which = slice(first, last)
    highest = np.maximum(present_profiles(p, which, columns).max(axis=1), p.basal_excess_pore_pressure[which])
    held = held_at_rest(p, which, np.maximum(highest, 0.0), friction, columns.phases, exchange, walls)
    held |= p.arrested[which] > 0
    # particles held at rest move to the end of the range
    free, place = first + np.flatnonzero(~held), first + np.arange(held.size)
    middle = first + free.size
    p.exchange(place[: free.size][held[: free.size]], free[free >= middle])
    p.awake = middle
    p.asleep_since[middle:last] = time
    for nothing_enters in (p.entrainment_rate, p.entrained_volume, p.entrained_ratio):
        nothing_enters[middle:last] = 0.0


def _stretches(places):
    """Yield slices of consecutive places that together cover sorted `places`, int, shape (n,)."""
    for part in np.split(places, np.flatnonzero(np.diff(places) != 1) + 1):
        yield slice(int(part[0]), int(part[-1]) + 1)
