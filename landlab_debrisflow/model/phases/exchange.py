"""Grains and the water around them: the partners they keep, the weights of these, and the soil they share."""

import numpy as np

from ...core.jit import allocating_kernel, kernel
from ...physics.contracts import WATER
from ...spatial.partners import reverse


class Exchange:
    """Partners of the grains among the water, kept from step to step; in a flow of one phase there are none.

    Attributes
    ----------
    partners : Partners or None
        Partners of the grains among the water.
    grains : Partners or None
        The same pairs by the water: grains whose partner each water particle is.
    generation : tuple of int or None
        `Particles.generation` for which they were found.
    age : int
        Sums over neighbours since then.
    steps : int
        Number of updates of the mean pore pressure so far.
    """

    def __init__(self):
        self.partners, self.grains, self.generation, self.age, self.steps = None, None, None, 0, 0

    def copy(self) -> "Exchange":
        """Return an independent copy; partners are never changed, but replaced."""
        other = Exchange()
        vars(other).update(vars(self))
        return other

    def keep(self, partners, phase, generation) -> None:
        """Keep `partners`, found for the particles of a `generation`; `phase` is that of each particle, shape (n,)."""
        self.partners, self.grains = partners, reverse(partners, np.flatnonzero(phase == WATER))
        self.generation, self.age = generation, 0


MOST_SCALED = 2.0
"""Largest factor by which the fractions of a water particle that grains claim are raised so that they sum to 1. With
particles of both phases on lattices that do not match, the fractions sum to 0.5 to 1.4; water with still fewer grains
around it flows partly on its own."""


@allocating_kernel
def make_whole(partners, porosity, volume):
    """Scale the weights so that the volumes that grains claim of each water particle sum to its own, in place.

    Under stiff drag grains and water must end a kick with one velocity. They do so only if all of the water takes part:
    if grains claim a tenth too little of the water, a tenth of the kick is left unbalanced; if they claim a tenth too
    much, the error is the same with the opposite sign.

    Parameters
    ----------
    partners : Partners
        Its weights [-] are changed.
    porosity, volume : ndarray, shape (n,)
        [-], [m3]
    """
    of, first, index, weight = partners
    claimed = np.zeros(volume.size)
    for k in range(of.size):
        around = volume[of[k]] * porosity[of[k]] / (1.0 - porosity[of[k]])
        for s in range(first[k], first[k + 1]):
            claimed[index[s]] += around * weight[s]
    for i in range(volume.size):
        claimed[i] = min(volume[i] / claimed[i], MOST_SCALED) if claimed[i] != 0.0 else 1.0
    for s in range(index.size):
        weight[s] *= claimed[index[s]]


@allocating_kernel
def distribute_soil_water(partners, grains, entrained, water_ratio, volume, velocity, exponent):
    """Distribute the water of the entrained soil among the partners, in place.

    Parameters
    ----------
    partners : Partners
        Partners of the grains among the water.
    grains : Partners
        Grains whose partner each water particle is.
    entrained : ndarray, shape (n,)
        Volume of grains that each grain particle took from the soil [m3].
    water_ratio : float
        Water over grains in the soil [-].
    volume : ndarray, shape (n,)
        Volume of the particles [m3]; that of the water is raised.
    velocity : ndarray, shape (3, n)
        Velocity of the particles [m s-1]; that of the water is lowered, like volume^-`exponent`.
    exponent : float
        [-]
    """
    of, first, _, weight = partners
    soil = np.zeros(of.size)  # for a partner of weight 1
    for k in range(of.size):
        if entrained[of[k]] > 0.0:
            total = 0.0
            for s in range(first[k], first[k + 1]):
                total += weight[s]
            soil[k] = water_ratio * entrained[of[k]] / total
    of, first, index, weight = grains
    for k in range(of.size):
        taken, i = 0.0, of[k]
        for s in range(first[k], first[k + 1]):
            taken += weight[s] * soil[index[s]]
        if taken > 0.0:
            velocity_ratio = volume[i] / (volume[i] + taken)
            volume[i] += taken
            if exponent < 1.0:
                velocity_ratio **= exponent
            for d in range(3):
                velocity[d, i] *= velocity_ratio


@kernel
def leave_to_mixed(partners, water, rate):
    """Set the erosion rate to 0, in place, for water and for grains without water around.

    Parameters
    ----------
    partners : Partners
        Partners of the grains among the water.
    water : ndarray of int, shape (l,)
        Particles of water.
    rate : ndarray, shape (m,)
        Erosion rate of grains and of water between them [m s-1].
    """
    of, first, _, _ = partners
    for k in range(of.size):
        if first[k] == first[k + 1]:
            rate[of[k]] = 0.0
    for i in water:
        if i < rate.size:
            rate[i] = 0.0
