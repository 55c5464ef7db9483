"""Rest is local: a body, that is all particles which feel each other, comes to rest by its own motion.

Where friction cannot hold what is left of a flow, it creeps for ever. So a body is arrested once its kinetic energy is
a negligible part of the most it had, and friction holds most of it. Where most could not stay, it is only turning, as
on a counter-slope. What is arrested stays until a body that moves touches it, or the ground is changed by others.
"""

import numpy as np

from ..core.jit import inner, kernel
from ..spatial.cells import sort_into_cells

MOST_UNHELD = 0.5
"""Part of the volume of a body that may lie where friction does not hold it when it is arrested."""

STEPS_BETWEEN_SEPARATIONS = 32
"""Steps after which bodies are told apart anew: it takes many to part or to meet."""

UNKNOWN = -1
"""Number of the body of a new particle."""


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

    def _measure(self, p, part):
        """Return the kinetic energy of each body [m5 s-2], and the results of the kernel `_measure`."""
        energy = np.zeros(self.peak.size)
        return energy, *_measure(
            p.awake, p.summed, p.volume, p.velocity, p.body, p.arrested, part, self.volume, energy, self.peak,
            p.rest_speed,
        )  # fmt: skip

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
def _measure(awake, summed, volume, velocity, body, arrested, part, whole, energy, peak, rest_speed):
    """Measure every body; return how many particles that are free to move are in slow ones, and how many there are.

    Also whether anything has changed in reach of one that is arrested. Written are the kinetic energy of each body, the
    most it had, and for every particle the speed at which a body has the part `part` of that: below it, one that is
    being slowed comes to rest if friction holds it [m s-1].
    """
    for i in range(awake):
        energy[body[i]] += volume[i] * (velocity[0, i] ** 2 + velocity[1, i] ** 2 + velocity[2, i] ** 2)
    for b in range(energy.size):
        peak[b] = max(peak[b], energy[b])
    slow, free, touched = 0, 0, False
    for i in range(volume.size):
        if arrested[i] == 0:
            b = body[i]
            least = part * peak[b]
            rest_speed[i] = np.sqrt(least / whole[b])
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
    _join(x, y, z, support, cells.columns, cells.order, cells.start, cells.window, parent)
    return np.unique(parent, return_inverse=True)[1]


@inner
def _root(parent, i):
    while parent[i] != i:
        parent[i] = parent[parent[i]]
        i = parent[i]
    return i


@inner
def _join_cells(x, y, z, support, order, first, last, start, stop, parent):
    """Join interacting particles of two cells; return whether the first cell is then of one body."""
    for k in range(first, last):
        i = order[k]
        root = _root(parent, i)
        for s in range(start, stop):
            j = order[s]
            if parent[j] == root:
                continue
            reach = max(support[i], support[j])
            if (x[i] - x[j]) ** 2 + (y[i] - y[j]) ** 2 + (z[i] - z[j]) ** 2 < reach * reach:
                met = _root(parent, j)
                parent[max(met, root)] = min(met, root)
                root = min(met, root)
    root, one = _root(parent, order[first]), True
    for k in range(first + 1, last):
        one &= _root(parent, order[k]) == root
    return one


@kernel
def _join(x, y, z, support, columns, order, start, window, parent):
    """Join interacting particles: write a particle of its body, one per body, for each of them."""
    one = np.zeros(start.size - 1, np.bool_)  # cells known to be of one body
    for cell in range(start.size - 1):
        row, column, w = cell // columns, cell % columns, window[cell]
        first, last = start[cell], start[cell + 1]
        if first == last:
            continue
        one[cell] = _join_cells(x, y, z, support, order, first, last, first, last, parent)
        for r in range(row, max(row - w, 0) - 1, -1):
            for q in range(max(column - w, 0), min(column + w, columns - 1) + 1):
                other = r * columns + q
                if other >= cell or start[other] == start[other + 1]:  # a pair is looked at once
                    continue
                if one[cell] and one[other] and _root(parent, order[first]) == _root(parent, order[start[other]]):
                    continue
                joined = _join_cells(x, y, z, support, order, first, last, start[other], start[other + 1], parent)
                one[cell] = joined
    for i in range(parent.size):
        parent[i] = _root(parent, i)
