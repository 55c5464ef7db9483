"""The moving mass: a struct of arrays, one entry per particle."""

import numpy as np

from ..core.variables import PARTICLE_VARIABLES


class Particles:
    """Arrays of `core.variables.PARTICLE_VARIABLES` as attributes.

    Scalars have shape (n,), vectors (3, n), columns (n, levels), their memory (n, width). The first
    ``awake`` particles are awake, the others sleep (model/activity.py); ``identity`` tells who is who.

    Parameters
    ----------
    levels : int
        Levels of a pore-pressure column.

    Examples
    --------
    >>> particles = Particles(levels=11)
    >>> particles.append(3, volume=2.0)
    slice(0, 3, None)
    >>> particles.count, float(particles.volume.sum()), particles.velocity.shape
    (3, 6.0, (3, 3))
    """

    def __init__(self, levels: int):
        self.levels = levels
        self.awake = self._next_identity = 0
        for variable in PARTICLE_VARIABLES:
            setattr(self, variable.name, self._new(variable, 0))

    def _new(self, variable, count):
        width = self.levels if variable.per_level else variable.width
        shape = (3, count) if variable.vector else (count, width) if width else (count,)
        return np.full(shape, variable.initial, variable.dtype)

    @property
    def count(self) -> int:
        """Number of particles."""
        return self.volume.size

    @property
    def ever(self) -> int:
        """Number of particles that there have been so far."""
        return self._next_identity

    @property
    def roll(self):
        """What differs whenever particles came or went: their number, and how many there ever were."""
        return self.volume.size, self._next_identity

    @property
    def spread(self):
        """Half-width of the tents in which they show on the nodes: twice their spacing (V/h)^(1/2), shape (n,) [m]."""
        return 2.0 * np.sqrt(self.volume / (self.depth * self.share))

    def append(self, count: int, **values) -> slice:
        """Add particles that are awake, and return their places; what is not named gets its declared initial value."""
        first, n = self.awake, self.count
        values["identity"] = self._next_identity + np.arange(count)
        self._next_identity += count
        for variable in PARTICLE_VARIABLES:
            new = self._new(variable, count)
            if variable.name in values:
                new[:] = values[variable.name]
            axis = 1 if variable.vector else 0
            setattr(self, variable.name, np.concatenate([getattr(self, variable.name), new], axis))
        self.awake += count
        moved = min(count, n - first)  # those asleep whose places the new ones take
        self.exchange(first + np.arange(moved), n + count - moved + np.arange(moved))
        return slice(first, first + count)

    def exchange(self, these, those) -> None:
        """Let particles at `these` places and at `those`, arrays of int without common places, change places."""
        if these.size == 0:
            return
        to, of = np.concatenate([these, those]), np.concatenate([those, these])
        for variable in PARTICLE_VARIABLES:
            values = getattr(self, variable.name)
            if variable.vector:
                values[:, to] = values[:, of]
            else:
                values[to] = values[of]

    def keep(self, mask) -> None:
        """Remove all particles where `mask` is False."""
        self.awake = int(np.count_nonzero(mask[: self.awake]))
        for variable in PARTICLE_VARIABLES:
            axis = 1 if variable.vector else 0
            setattr(self, variable.name, np.compress(mask, getattr(self, variable.name), axis))

    def copy(self) -> "Particles":
        """Return an independent copy."""
        other = Particles(self.levels)
        other.awake, other._next_identity = self.awake, self._next_identity
        for variable in PARTICLE_VARIABLES:
            setattr(other, variable.name, getattr(self, variable.name).copy())
        return other
