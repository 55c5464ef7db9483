"""Rest is local: each body, a set of particles connected as neighbours, comes to rest by its own motion.

A body of which friction cannot hold a small remainder would creep for ever. So a body is arrested once its kinetic
energy is a negligible fraction of its peak and friction holds most of its volume. If friction does not hold most of a
slow body, the body either turns round, as on a counter-slope, or creeps, as a heap at its angle of repose that drains
through a throat. A body that turns gains speed; a body that creeps does not, and is arrested, too, once it has been
slow for longer than an unbalanced force would leave it so slow. An arrested body stays until a moving body touches it,
or another component changes the ground.
"""

from typing import NamedTuple

import numpy as np

from ..core.jit import allocating_kernel
from ..core.structs import struct
from .connection import find_bodies

MOST_UNHELD = 0.5
"""Largest fraction of the volume of a body that friction need not hold for the body to be arrested."""

LEAST_HELD = 1e-9
"""Least fraction of the volume of a creeping body that friction must hold: a body that friction holds nowhere is water
that moves slowly."""

CREEP = 10.0
"""Most kinetic energy of a body that creeps over that of one which friction stops [-]."""

MOST_CREEP = 1e-3
"""Most kinetic energy of a body that creeps over its peak, if more than that of rest [-]: 3 % of the speed."""

IMBALANCE = 1e-3
"""Acceleration over gravity from which on the forces on a body count as unbalanced [-]: that on a surface which falls 1
m per kilometre more steeply than friction holds."""

REST_OF_PARTICLE = 1e-4
"""Kinetic energy per volume, over that at the peak of its body, below which a particle that slows down where friction
holds it is stopped. The limit for whole bodies may be larger: single particles are stopped all the time, and a larger
limit would slow the flow."""

STEPS_BETWEEN_SEPARATIONS = 32
"""Number of steps between two searches for bodies: bodies take many steps to part or to meet."""

UNKNOWN = -1
"""Number of the body of a new particle."""


@struct
class Members(NamedTuple):
    """Particles as members of bodies, arrays (n,): body, volume [m3], velocity (3, n) and rest speed [m s-1], flags."""

    body: np.ndarray  # (n,) int, number of the body
    volume: np.ndarray  # (n,) [m3]
    velocity: np.ndarray  # (3, n) [m s-1]
    summed: np.ndarray  # (n,) bool: a neighbour has changed in the last step
    arrested: np.ndarray  # (n,) not 0 if the body of the particle was arrested
    rest_speed: np.ndarray  # (n,) below which a particle that is being slowed comes to rest [m s-1]; written


@struct
class BodyEnergies(NamedTuple):
    """Energies of bodies, (bodies,): volume [m3], volume times speed squared [m5 s-2], time of becoming slow [s]."""

    volume: np.ndarray  # (bodies,) [m3]
    energy: np.ndarray  # (bodies,) now [m5 s-2]; 0 before, written
    peak: np.ndarray  # (bodies,) the most so far [m5 s-2], written
    # (bodies,) time since when a body has been slow enough to creep [s], infinite if it is faster; written
    slow_since: np.ndarray


PER_BODY = "peak", "volume", "slow_since"
"""Arrays of `Bodies`, shape (bodies,)."""


class Bodies:
    """The bodies of a flow, the peak of the kinetic energy of each, and whether they rest.

    Between two searches for bodies, values are kept per body. From one search to the next the particles carry them:
    each particle has its fraction, by volume, of the peak energy of its body.

    Attributes
    ----------
    at_rest : bool
        Whether nothing moves.
    peak, volume : ndarray, shape (bodies,)
        Most kinetic energy so far [m5 s-2] and volume [m3] of each body.
    slow_since : ndarray, shape (bodies,)
        Time since when a body has had no more energy than one that creeps [s]; infinite if it has more.
    steps, known : int
        Steps since the last search for bodies, and the number of all particles made until then.
    """

    def __init__(self):
        self.at_rest = False
        self.peak = self.volume = self.slow_since = np.zeros(0)
        self.steps = self.known = 0

    def copy(self) -> "Bodies":
        """Return an independent copy."""
        other = Bodies()
        vars(other).update(vars(self) | {name: getattr(self, name).copy() for name in PER_BODY})
        return other

    def separate(self, p) -> None:
        """Find the bodies of particles `p` and set arrested particles free that another body has touched."""
        self.steps, self.known = 0, p.ever
        if p.count == 0:
            return
        peak, slow_since = self._peak_of(p), np.full(p.count, np.inf)
        known = p.body != UNKNOWN
        slow_since[known] = self.slow_since[p.body[known]]
        p.body[:] = find_bodies(p.x, p.y, p.z, 2.0 * p.smoothing_length)
        bodies = int(p.body.max()) + 1
        self.volume = np.bincount(p.body, p.volume, bodies)
        self.peak = np.bincount(p.body, peak, bodies)
        self.slow_since = np.zeros(bodies)
        np.maximum.at(self.slow_since, p.body, slow_since)
        touched = np.bincount(p.body, p.arrested == 0, bodies) > 0
        p.arrested[touched[p.body]] = 0
        p.rest_speed[:] = np.where(p.arrested > 0, np.inf, 0.0)
        self.at_rest = not touched.any()

    def _peak_of(self, p):
        """Return the fraction of each particle in the peak energy of its body [m5 s-2]; 0 for new particles."""
        known = p.body != UNKNOWN
        part = np.zeros(p.count)
        body, volume = p.body[known], p.volume[known]
        part[known] = self.peak[body] * (volume / np.bincount(body, volume, self.peak.size)[body])
        return part

    def judge(self, p, rest_energy: float, gravity: float, time: float):
        """Find the bodies to be arrested after the last step, and the volume of each that friction must hold.

        Parameters
        ----------
        p : Particles
        rest_energy : float
            Kinetic energy of a slow body over the most it had [-].
        gravity : float
            Acceleration by gravity [m s-2].
        time : float
            Time now [s].

        Returns
        -------
        ndarray, shape (bodies,), or None
            Largest volume of each body that friction need not hold for the body to be arrested [m3]; negative if the
            body moves. None: no particle that is free to move is in a body that is slow or creeps.
        """
        self.steps += 1
        if p.count == 0:
            self.at_rest = False
            return None
        creep_energy = max(rest_energy, min(CREEP * rest_energy, MOST_CREEP))
        limits = rest_energy, creep_energy, time
        touched = True
        if self.steps < STEPS_BETWEEN_SEPARATIONS and p.ever == self.known:
            energy, slow, free, touched = self._measure(p, *limits)
        if touched:
            self.separate(p)
            energy, slow, free, _ = self._measure(p, *limits)
        self.at_rest = free == 0
        if not slow:
            return None
        part = np.where(energy <= rest_energy * self.peak, MOST_UNHELD, -1.0)
        speed = np.sqrt(creep_energy * self.peak / self.volume)
        part[time - self.slow_since > speed / (IMBALANCE * gravity)] = 1.0 - LEAST_HELD
        stoppable = (part >= 0.0) & (np.bincount(p.body, p.arrested == 0, part.size) > 0.0)
        return part * self.volume if stoppable.any() else None

    def _measure(self, p, rest_energy: float, creep_energy: float, time: float):
        """Return the kinetic energy of each body, and the result of the kernel `_measure`; the peak includes now."""
        energy = np.zeros(self.peak.size)
        members = Members(
            body=p.body, volume=p.volume, velocity=p.velocity, summed=p.summed, arrested=p.arrested,
            rest_speed=p.rest_speed,
        )  # fmt: skip
        bodies = BodyEnergies(volume=self.volume, energy=energy, peak=self.peak, slow_since=self.slow_since)
        return energy, *_measure(p.awake, members, bodies, min(rest_energy, REST_OF_PARTICLE), creep_energy, time)

    def arrest(self, p, most_unheld, held, prescribed) -> None:
        """Stop bodies of which friction holds enough, except where the motion of particles is prescribed.

        Parameters
        ----------
        p : Particles
        most_unheld : ndarray, shape (bodies,)
            As `judge` returns it [m3]; changed in place.
        held : ndarray of bool, shape (awake,)
            Whether friction holds a particle.
        prescribed : ndarray of int
            Particles whose motion is prescribed.
        """
        most_unheld[p.body[prescribed]] = -1.0
        awake = slice(p.awake)
        unheld = np.bincount(p.body[awake], p.volume[awake] * ~held, most_unheld.size)
        resting = (unheld <= most_unheld)[p.body]
        p.velocity[:, resting], p.entrainment_rate[resting], p.arrested[resting] = 0.0, 0.0, 1
        p.rest_speed[resting] = np.inf
        self.at_rest = bool(p.arrested.all())

    def set_free(self, p) -> None:
        """Set all bodies free and forget their peaks, because the ground below has changed."""
        arrested = p.arrested > 0
        p.body[arrested], p.arrested[arrested], p.rest_speed[arrested] = UNKNOWN, 0, 0.0
        self.at_rest, self.known = False, UNKNOWN if arrested.any() else self.known


@allocating_kernel
def _measure(awake, members, bodies, rest_energy, creep_energy, time):
    """Measure the kinetic energy of every body, and the speed at which its particles come to rest.

    Parameters
    ----------
    awake : int
        Number of particles that are awake.
    members : Members
    bodies : BodyEnergies
    rest_energy, creep_energy : float
        Kinetic energy of a slow particle, and of a body that may creep, over the most of its body [-].
    time : float
        Time now [s].

    Returns
    -------
    slow, free : int
        Number of particles that are free to move, in bodies that may creep and in all.
    touched : bool
        Whether a neighbour of an arrested particle has changed.
    """
    body, volume, velocity, summed, arrested, rest_speed = members
    body_volume, energy, peak, slow_since = bodies
    for i in range(awake):
        energy[body[i]] += volume[i] * (velocity[0, i] ** 2 + velocity[1, i] ** 2 + velocity[2, i] ** 2)
    creeps, least = np.zeros(energy.size, np.int64), np.empty(energy.size)
    for b in range(energy.size):
        peak[b] = max(peak[b], energy[b])
        if energy[b] <= creep_energy * peak[b]:
            slow_since[b], creeps[b] = min(slow_since[b], time), 1
        else:
            slow_since[b] = np.inf
        least[b] = np.sqrt(rest_energy * peak[b] / body_volume[b])
    slow, free, touched = 0, 0, False
    for i in range(volume.size):
        if arrested[i] == 0:
            rest_speed[i] = least[body[i]]
            free += 1
            slow += creeps[body[i]]
        elif summed[i]:
            touched = True
    return slow, free, touched
