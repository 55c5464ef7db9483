"""Rest is local: a body, that is all particles which feel each other, comes to rest by its own motion.

Where friction cannot hold what is left of a flow, it creeps for ever. So a body is arrested once its kinetic energy is
a negligible part of the most it had, and friction holds most of it. Where most could not stay, it is only turning, as
on a counter-slope. What is arrested stays until a body that moves touches it, or the ground is changed by others.
"""

import numpy as np

from ..core.jit import kernel
from ..spatial.cells import sort_into_cells

MOST_UNHELD = 0.5
"""Part of the volume of a body that may lie where friction does not hold it when it is arrested."""

STEPS_BETWEEN_LOOKS = 16
"""Steps after which bodies are told apart anew: it takes many to part or to meet."""

UNKNOWN = -1
"""Number of the body of a new particle."""


class Rest:
    """Bodies, the most that each has moved, and which of them rest.

    What is known of a body between two looks is kept per body; across a look it is carried by the particles, each of
    which has its part, by volume, of the most kinetic energy its body had.
    """

    def __init__(self):
        self.all = False  # whether nothing moves
        self.any = False  # whether anything is arrested
        self._peak = self._volume = np.zeros(0)  # most kinetic energy [m5 s-2] and volume [m3] of each body
        self._steps = self._known = 0  # since the last look; how many particles there had ever been then

    def look(self, p) -> None:
        """Tell the bodies of particles `p` apart; those that were arrested move with what has touched them."""
        self._steps, self._known = 0, p.roll[1]
        if p.count == 0:
            return
        peak = self._peak_of(p)
        p.body[:] = find_bodies(p.x, p.y, p.z, 2.0 * p.smoothing_length)
        bodies = int(p.body.max()) + 1
        self._volume = np.bincount(p.body, p.volume, bodies)
        self._peak = np.bincount(p.body, peak, bodies)
        touched = np.bincount(p.body, p.arrested == 0, bodies) > 0
        p.arrested[touched[p.body]] = 0
        self._note(p)

    def _peak_of(self, p):
        """Return the part each particle has of the most kinetic energy of its body [m5 s-2]; new ones have none."""
        known = p.body != UNKNOWN
        part = np.zeros(p.count)
        body, volume = p.body[known], p.volume[known]
        part[known] = self._peak[body] * (volume / np.bincount(body, volume, self._peak.size)[body])
        return part

    def judge(self, sim) -> None:
        """Arrest the bodies of a simulation that have come to rest in the last step."""
        p, part = sim.particles, sim.numerics.rest_energy
        self._steps += 1
        if self._steps >= STEPS_BETWEEN_LOOKS or p.roll[1] != self._known or self._is_touched(sim):
            self.look(p)
        if p.count == 0:
            self.all = self.any = False
            return
        energy = np.zeros(self._peak.size)
        slow, free = _measure(
            p.awake, p.volume, p.velocity, p.body, p.arrested, part, self._volume, energy, self._peak, p.rest_speed
        )  # fmt: skip
        self.all = free == 0
        if slow:
            self._arrest(sim, energy <= part * self._peak)

    def _is_touched(self, sim) -> bool:
        """Return whether something has changed in reach of what is arrested."""
        return self.any and bool(np.any(sim.computed & (sim.particles.arrested > 0)))

    def _arrest(self, sim, slow) -> None:
        """Stop those of the `slow` bodies that friction holds, and that do not move as prescribed."""
        p, awake = sim.particles, slice(sim.particles.awake)
        slow[p.body[sim.inflow.held(p)]] = False
        held = sim.held(awake, p.basal_excess_pore_pressure[awake])
        unheld = np.bincount(p.body[awake], p.volume[awake] * ~held, slow.size)
        resting = (slow & (unheld <= MOST_UNHELD * self._volume))[p.body]
        p.velocity[:, resting], p.entrainment_rate[resting], p.arrested[resting] = 0.0, 0.0, 1
        self._note(p)

    def set_free(self, p) -> None:
        """Let everything move again, as if it had never moved: the ground below has changed."""
        if self.any:
            arrested = p.arrested > 0
            p.body[arrested], p.arrested[arrested] = UNKNOWN, 0
            self._known = UNKNOWN
        self.all = self.any = False

    def _note(self, p) -> None:
        arrested = p.arrested > 0
        self.all, self.any = bool(arrested.all()), bool(arrested.any())


@kernel
def _measure(awake, volume, velocity, body, arrested, rest_energy, whole, energy, peak, rest_speed):
    """Measure every body; return how many particles of slow ones are not arrested, and how many of all.

    Written are the kinetic energy of each body, the most it had, and for every particle the speed at which a body has
    the part `rest_energy` of that: below it, one that is being slowed comes to rest if friction holds it [m s-1].
    """
    for i in range(awake):
        energy[body[i]] += volume[i] * (velocity[0, i] ** 2 + velocity[1, i] ** 2 + velocity[2, i] ** 2)
    for b in range(energy.size):
        peak[b] = max(peak[b], energy[b])
    slow = free = 0
    for i in range(volume.size):
        b = body[i]
        least = rest_energy * peak[b]
        rest_speed[i] = np.sqrt(least / whole[b])
        if arrested[i] == 0:
            free += 1
            if energy[b] <= least:
                slow += 1
    return slow, free


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


@kernel
def _join(x, y, z, support, columns, order, start, window, parent):
    """Join those that feel each other: write a particle that stands for its body for each of them."""
    rows = (start.size - 1) // columns
    for cell in range(start.size - 1):
        row, column, w = cell // columns, cell % columns, window[cell]
        for k in range(start[cell], start[cell + 1]):
            i = order[k]
            root = i
            while parent[root] != root:
                root = parent[root]
            for r in range(max(row - w, 0), min(row + w, rows - 1) + 1):
                for q in range(max(column - w, 0), min(column + w, columns - 1) + 1):
                    if (r, q) > (row, column):
                        continue  # a pair is looked at once
                    for s in range(start[r * columns + q], start[r * columns + q + 1]):
                        j = order[s]
                        other = j
                        while parent[other] != other:
                            parent[other] = parent[parent[other]]
                            other = parent[other]
                        if other == root:
                            continue
                        reach = max(support[i], support[j])
                        if (x[i] - x[j]) ** 2 + (y[i] - y[j]) ** 2 + (z[i] - z[j]) ** 2 < reach * reach:
                            parent[max(other, root)] = min(other, root)
                            root = min(other, root)
    for i in range(parent.size):
        root = i
        while parent[root] != root:
            root = parent[root]
        parent[i] = root
