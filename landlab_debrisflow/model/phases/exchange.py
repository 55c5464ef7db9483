"""Grains and the water around them: the partners they keep, the weights of these, and the soil they share."""

import numpy as np

from ...core.jit import kernel


class Exchange:
    """Partners of the grains among the water, kept from step to step; in a flow of one phase there are none.

    Attributes
    ----------
    partners : Partners or None
        Partners of the grains among the water.
    generation : tuple of int or None
        `Particles.generation` for which they were found.
    age : int
        Sums over neighbours since then.
    steps : int
        Number of updates of the mean pore pressure so far.
    """

    def __init__(self):
        self.partners, self.generation, self.age, self.steps = None, None, 0, 0

    def copy(self) -> "Exchange":
        """Return an independent copy; partners are never changed, but replaced."""
        other = Exchange()
        vars(other).update(vars(self))
        return other


MOST_SCALED = 2.0
"""Largest factor by which the fractions of a water particle that grains claim are raised so that they sum to 1. With
particles of both phases on lattices that do not match, the fractions sum to 0.5 to 1.4; water with still fewer grains
around it flows partly on its own."""


@kernel
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
    of, count, index, weight = partners
    claimed = np.zeros(volume.size)
    for k in range(of.size):
        around = volume[of[k]] * porosity[of[k]] / (1.0 - porosity[of[k]])
        for s in range(count[k]):
            claimed[index[k, s]] += around * weight[k, s]
    for k in range(of.size):
        for s in range(count[k]):
            j = index[k, s]
            weight[k, s] *= min(volume[j] / claimed[j], MOST_SCALED)


@kernel
def distribute_soil_water(partners, entrained, water_ratio, volume, velocity, exponent):
    """Distribute the water of the entrained soil among the partners, in place.

    Parameters
    ----------
    partners : Partners
        Partners of the grains among the water.
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
    of, count, index, weight = partners
    taken = np.zeros(volume.size)
    for k in range(of.size):
        soil = water_ratio * entrained[of[k]]
        if soil > 0.0:
            soil /= np.sum(weight[k, : count[k]])
            for s in range(count[k]):
                taken[index[k, s]] += weight[k, s] * soil
    for i in range(volume.size):
        if taken[i] > 0.0:
            velocity_ratio = volume[i] / (volume[i] + taken[i])
            volume[i] += taken[i]
            if exponent < 1.0:
                velocity_ratio **= exponent
            for d in range(3):
                velocity[d, i] *= velocity_ratio
