"""The moving mass: a struct of arrays, one entry per particle."""

import numpy as np

from .variables import PARTICLE_VARIABLES


class Particles:
    """Arrays of declared variables as attributes.

    Scalars have shape (n,), vectors (components, n), columns (n, levels), their memory (n, width). The first
    ``awake`` particles are awake, the others sleep (model/activity.py); ``identity`` numbers them for ever.
    ``departed`` are the particles that left the grid in the last step, where they went, or None.

    Parameters
    ----------
    levels : int
        Levels of a pore-pressure column.
    variables : sequence of Variable, optional
        As `variables.particle_variables` returns them; by default those that every flow has.

    Examples
    --------
    >>> particles = Particles(levels=11)
    >>> particles.append(3, volume=2.0)
    slice(0, 3, None)
    >>> particles.count, float(particles.volume.sum()), particles.velocity.shape
    (3, 6.0, (3, 3))
    """

    def __init__(self, levels: int, variables=PARTICLE_VARIABLES):
        self.levels, self.variables = levels, tuple(variables)
        self.awake = self.ever = 0  # number of particles awake; number of all particles made so far
        self.departed: Particles | None = None
        for variable in self.variables:
            setattr(self, variable.name, self._new(variable, 0))

    def _new(self, variable, count):
        return np.full(variable.shape(count, self.levels), variable.initial, variable.dtype)

    @property
    def count(self) -> int:
        """Number of particles."""
        return self.volume.size

    @property
    def generation(self) -> tuple[int, int]:
        """Number of particles now, and of all particles ever made; the pair changes whenever particles come or go."""
        return self.volume.size, self.ever

    @property
    def surface_sample(self):
        """Elevation, slopes and curvatures of the bed below, the arrays themselves in the order of `SurfaceSample`."""
        return self.z, self.slope_x, self.slope_y, self.curvature_xx, self.curvature_xy, self.curvature_yy

    @property
    def spacing(self):
        """Spacing of particles of one phase, (V/h)^(1/2) with the depth h of this phase; shape (n,) [m]."""
        return np.sqrt(self.volume / (self.depth * self.share))

    def append(self, count: int, **values) -> slice:
        """Add particles that are awake and return their places; variables not given get their initial value."""
        first, n = self.awake, self.count
        values["identity"] = self.ever + np.arange(count)
        self.ever += count
        for variable in self.variables:
            new = self._new(variable, count)
            if variable.name in values:
                new[:] = values[variable.name]
            setattr(self, variable.name, np.concatenate([getattr(self, variable.name), new], variable.axis))
        self.awake += count
        moved = min(count, n - first)  # particles asleep whose places the new particles take
        self.exchange(first + np.arange(moved), n + count - moved + np.arange(moved))
        return slice(first, first + count)

    def exchange(self, these, those) -> None:
        """Exchange the particles at two arrays of int with their places, which have no place in common.

        `these` and `those`, int, have shape (k,).
        """
        if these.size == 0:
            return
        to, of = np.concatenate([these, those]), np.concatenate([those, these])
        for variable in self.variables:
            values = getattr(self, variable.name)
            if variable.components:
                values[:, to] = values[:, of]
            else:
                values[to] = values[of]

    def keep(self, mask) -> None:
        """Remove all particles where `mask` is False."""
        self.awake = int(np.count_nonzero(mask[: self.awake]))
        for variable in self.variables:
            setattr(self, variable.name, np.compress(mask, getattr(self, variable.name), variable.axis))

    def copy(self) -> "Particles":
        """Return an independent copy."""
        return self._like(lambda variable: getattr(self, variable.name).copy())

    def at(self, places) -> "Particles":
        """Return a copy of the particles at `places`, an array of int."""
        return self._like(lambda variable: np.take(getattr(self, variable.name), places, variable.axis))

    def _like(self, values) -> "Particles":
        """Return particles with new `values` of every variable, which a function returns."""
        other = object.__new__(Particles)
        vars(other).update(vars(self))
        for variable in self.variables:
            setattr(other, variable.name, values(variable))
        return other
