"""Rest is local: a body, that is all particles which feel each other, comes to rest by its own motion.

Where friction cannot hold what is left of a flow, it creeps for ever. So a body is arrested once its kinetic energy is
a negligible part of the most it had, and friction holds most of it. Where most could not stay, it is only turning, as
on a counter-slope. What is arrested stays until a body that moves touches it, or the ground is changed by others.
"""

from typing import NamedTuple

import numpy as np

from ..core.jit import inner, kernel
from ..core.structs import struct
from ..spatial.cells import sort_into_cells

MOST_UNHELD = 0.5
"""Part of the volume of a body that may lie where friction does not hold it when it is arrested."""

STEPS_BETWEEN_SEPARATIONS = 32
"""Steps after which bodies are told apart anew: it takes many to part or to meet."""

UNKNOWN = -1
"""Number of the body of a new particle."""


@struct
class Members(NamedTuple):
    """Particles as members of bodies, arrays (n,): body, volume [m3], velocity (3, n) and rest speed [m s-1], flags."""

    body: np.ndarray  # (n,) int, number of the body
    volume: np.ndarray  # (n,) [m3]
    velocity: np.ndarray  # (3, n) [m s-1]
    summed: np.ndarray  # (n,) bool: something in reach has changed in the last step
    arrested: np.ndarray  # (n,) not 0 if its body was arrested
    rest_speed: np.ndarray  # (n,) below which a particle that is being slowed comes to rest [m s-1]; written


@struct
class BodyEnergies(NamedTuple):
    """Kinetic energies of bodies: volume [m3], volume times speed squared, now and most [m5 s-2], each (bodies,)."""

    volume: np.ndarray  # (bodies,) [m3]
    energy: np.ndarray  # (bodies,) now [m5 s-2]; 0 before, written
    peak: np.ndarray  # (bodies,) the most so far [m5 s-2], written


class Spheres(NamedTuple):
    """Neighbourhoods of n particles: position x, y, z and radius within which each feels its neighbours [m]."""

    x: np.ndarray  # (n,) position [m]
    y: np.ndarray  # (n,) [m]
    z: np.ndarray  # (n,) [m]
    support: np.ndarray  # (n,) radius within which each feels others [m]


class Bodies:
    """The bodies of a flow, the most that each has moved, and which of them rest.

    What is known of a body between two separations is kept per body; across one it is carried by the particles, each
    of which has its part, by volume, of the most kinetic energy its body had.

    Attributes
    ----------
    at_rest : bool
        Whether nothing moves.
    peak, volume : ndarray, shape (bodies,)
        Most kinetic energy so far [m5 s-2] and volume [m3] of each body.
    steps, known : int
        Steps since the last separation, and how many particles there had ever been then.
    """

    def __init__(self):
        self.at_rest = False
        self.peak = self.volume = np.zeros(0)
        self.steps = self.known = 0

    def copy(self) -> "Bodies":
        """Return an independent copy."""
        other = Bodies()
        vars(other).update(vars(self) | {"peak": self.peak.copy(), "volume": self.volume.copy()})
        return other

    def separate(self, p) -> None:
        """Find the bodies of particles `p` and set arrested particles free that another body has touched."""
        self.steps, self.known = 0, p.ever
        if p.count == 0:
            return
        peak = self._peak_of(p)
        p.body[:] = find_bodies(p.x, p.y, p.z, 2.0 * p.smoothing_length)
        bodies = int(p.body.max()) + 1
        self.volume = np.bincount(p.body, p.volume, bodies)
        self.peak = np.bincount(p.body, peak, bodies)
        touched = np.bincount(p.body, p.arrested == 0, bodies) > 0
        p.arrested[touched[p.body]] = 0
        p.rest_speed[:] = np.where(p.arrested > 0, np.inf, 0.0)
        self.at_rest = not touched.any()

    def _peak_of(self, p):
        """Return the part each particle has of the most kinetic energy of its body [m5 s-2]; new ones have none."""
        known = p.body != UNKNOWN
        part = np.zeros(p.count)
        body, volume = p.body[known], p.volume[known]
        part[known] = self.peak[body] * (volume / np.bincount(body, volume, self.peak.size)[body])
        return part

    def judge(self, p, rest_energy: float):
        """Find out which bodies have become slow in the last step.

        Parameters
        ----------
        p : Particles
        rest_energy : float
            Kinetic energy of a slow body over the most it had [-].

        Returns
        -------
        ndarray of bool, shape (bodies,), or None
            Bodies to be arrested where friction holds them; None: no particle that is free to move is in one.
        """
        self.steps += 1
        if p.count == 0:
            self.at_rest = False
            return None
        touched = True
        if self.steps < STEPS_BETWEEN_SEPARATIONS and p.ever == self.known:
            energy, slow, free, touched = self._measure(p, rest_energy)
        if touched:
            self.separate(p)
            energy, slow, free, _ = self._measure(p, rest_energy)
        self.at_rest = free == 0
        return energy <= rest_energy * self.peak if slow else None

    def _measure(self, p, rest_energy: float):
        """Return the kinetic energy of each body, and the result of the kernel `_measure`; the peak includes now."""
        energy = np.zeros(self.peak.size)
        members = Members(
            body=p.body, volume=p.volume, velocity=p.velocity, summed=p.summed, arrested=p.arrested,
            rest_speed=p.rest_speed,
        )  # fmt: skip
        bodies = BodyEnergies(volume=self.volume, energy=energy, peak=self.peak)
        return energy, *_measure(p.awake, members, bodies, rest_energy)

    def arrest(self, p, slow, held, prescribed) -> None:
        """Stop slow bodies that friction mostly holds, except particles of prescribed motion.

        Parameters
        ----------
        p : Particles
        slow : ndarray of bool, shape (bodies,)
            Changed in place.
        held : ndarray of bool, shape (awake,)
            Whether friction holds a particle.
        prescribed : ndarray of int
            Particles whose motion is prescribed.
        """
        slow[p.body[prescribed]] = False
        awake = slice(p.awake)
        unheld = np.bincount(p.body[awake], p.volume[awake] * ~held, slow.size)
        resting = (slow & (unheld <= MOST_UNHELD * self.volume))[p.body]
        p.velocity[:, resting], p.entrainment_rate[resting], p.arrested[resting] = 0.0, 0.0, 1
        p.rest_speed[resting] = np.inf
        self.at_rest = bool(p.arrested.all())

    def set_free(self, p) -> None:
        """Let everything move again, as if it had never moved: the ground below has changed."""
        arrested = p.arrested > 0
        p.body[arrested], p.arrested[arrested], p.rest_speed[arrested] = UNKNOWN, 0, 0.0
        self.at_rest, self.known = False, UNKNOWN if arrested.any() else self.known


@kernel
def _measure(awake, members, bodies, rest_energy):
    """Measure the kinetic energy of every body, and the speed at which its particles come to rest.

    Parameters
    ----------
    awake : int
        Number of particles that are awake.
    members : Members
    bodies : BodyEnergies
    rest_energy : float
        Kinetic energy of a slow body over the most it had [-].

    Returns
    -------
    slow, free : int
        Number of particles that are free to move, in slow bodies and in all.
    touched : bool
        Whether anything has changed in reach of a particle that is arrested.
    """
    body, volume, velocity, summed, arrested, rest_speed = members
    body_volume, energy, peak = bodies
    for i in range(awake):
        energy[body[i]] += volume[i] * (velocity[0, i] ** 2 + velocity[1, i] ** 2 + velocity[2, i] ** 2)
    for b in range(energy.size):
        peak[b] = max(peak[b], energy[b])
    slow, free, touched = 0, 0, False
    for i in range(volume.size):
        if arrested[i] == 0:
            b = body[i]
            least = rest_energy * peak[b]
            rest_speed[i] = np.sqrt(least / body_volume[b])
            free += 1
            if energy[b] <= least:
                slow += 1
        elif summed[i]:
            touched = True
    return slow, free, touched


def find_bodies(x, y, z, support):
    """Return the number of the body of every particle; two that feel each other are of one.

    Parameters
    ----------
    x, y, z, support : ndarray, shape (n,)
        Position, and the radius within which each feels others [m].

    Returns
    -------
    ndarray of int, shape (n,)

    Examples
    --------
    >>> find_bodies(np.array([0.0, 1.0, 9.0]), np.zeros(3), np.zeros(3), np.array([0.5, 2.0, 2.0]))
    array([0, 0, 1])
    """
    cells = sort_into_cells(x, y, support)
    parent = np.arange(x.size)
    spheres = Spheres(x=x, y=y, z=z, support=support)
    _join(spheres, cells.columns, cells.order, cells.start, cells.window, parent)
    return np.unique(parent, return_inverse=True)[1]


@inner
def _root(parent, i):
    """Return the particle that stands for the body of particle `i`; shorten the way to it."""
    while parent[i] != i:
        parent[i] = parent[parent[i]]
        i = parent[i]
    return i


@inner
def _join_cells(spheres, order, one, other, parent):
    """Join particles of two cells that feel each other; return whether all of the first one are then of one body.

    A cell is the first place and the one after the last in `order`, int, shape (n,); `parent`, int, shape (n,), leads
    from each particle to the one that stands for its body; `spheres` are the `Spheres` of the n particles.
    """
    x, y, z, support = spheres
    first, last = one
    for k in range(first, last):
        i = order[k]
        root = _root(parent, i)
        for s in range(other[0], other[1]):
            j = order[s]
            if parent[j] == root:
                continue
            reach = max(support[i], support[j])
            if (x[i] - x[j]) ** 2 + (y[i] - y[j]) ** 2 + (z[i] - z[j]) ** 2 < reach * reach:
                met = _root(parent, j)
                parent[max(met, root)] = min(met, root)
                root = min(met, root)
    root, whole = _root(parent, order[first]), True
    for k in range(first + 1, last):
        whole &= _root(parent, order[k]) == root
    return whole


@kernel
def _join(spheres, columns, order, start, window, parent):
    """Join particles that feel each other: write a particle that stands for its body for each of them.

    Parameters
    ----------
    spheres : Spheres
    columns, order, start, window
        As in `spatial.cells.Cells`.
    parent : ndarray of int, shape (n,)
        Each particle itself, on entry.
    """
    whole = np.zeros(start.size - 1, np.bool_)  # cells known to be of one body
    for cell in range(start.size - 1):
        row, column, w = cell // columns, cell % columns, window[cell]
        here = start[cell], start[cell + 1]
        if here[0] == here[1]:
            continue
        whole[cell] = _join_cells(spheres, order, here, here, parent)
        for r in range(row, max(row - w, 0) - 1, -1):
            for q in range(max(column - w, 0), min(column + w, columns - 1) + 1):
                other = r * columns + q
                if other >= cell or start[other] == start[other + 1]:  # a pair is looked at once
                    continue
                first, second = order[here[0]], order[start[other]]
                if whole[cell] and whole[other] and _root(parent, first) == _root(parent, second):
                    continue
                whole[cell] = _join_cells(spheres, order, here, (start[other], start[other + 1]), parent)
    for i in range(parent.size):
        parent[i] = _root(parent, i)
