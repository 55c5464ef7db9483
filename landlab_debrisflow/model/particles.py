"""The moving mass: a struct of arrays, one entry per particle, whose arrays are views of few blocks of memory."""

from typing import ClassVar

import numpy as np

from .particle_blocks import blocks_of
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

    _indices: ClassVar[dict] = {}  # index of every variable in its block

    def __init__(self, levels: int, variables=PARTICLE_VARIABLES):
        self.levels, self.variables = levels, tuple(variables)
        self.awake = self.ever = 0  # number of particles awake; number of all particles made so far
        self.departed: Particles | None = None
        self._blocks = blocks_of(self.variables, levels)
        self._indices = {name: index for block in self._blocks for name, index in block.indices.items()}
        self._put([block.new(0, {}) for block in self._blocks])

    def __setattr__(self, name, value):
        """Write the values of a variable into its block, of which the attribute is a view; set any other attribute."""
        if name in self._indices:
            getattr(self, name)[...] = value
        else:
            object.__setattr__(self, name, value)

    def _put(self, arrays) -> None:
        """Take the arrays of all blocks; attributes become views of these."""
        self._arrays = arrays
        for block, array in zip(self._blocks, arrays, strict=True):
            vars(self).update({name: array[index] for name, index in block.indices.items()})

    def __getstate__(self) -> dict:
        """Return the attributes for a pickle, without views of the blocks: a pickle would make arrays of the views."""
        views = {name for block in self._blocks for name in block.indices}
        return {name: value for name, value in vars(self).items() if name not in views}

    def __setstate__(self, state) -> None:
        """Take the attributes from a pickle; variables become views of the blocks."""
        vars(self).update(state)
        self._put(self._arrays)

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
    def curvature(self):
        """Second derivatives of the bed below, xx, xy and yy, the arrays themselves; each of shape (n,) [m-1]."""
        return self.curvature_xx, self.curvature_xy, self.curvature_yy

    @property
    def spacing(self):
        """Spacing of particles of one phase, (V/h)^(1/2) with the depth h of this phase; shape (n,) [m]."""
        return np.sqrt(self.volume / (self.depth * self.share))

    def append(self, count: int, **values) -> slice:
        """Add particles that are awake and return their places; variables not given get their initial value."""
        first, n = self.awake, self.count
        values["identity"] = self.ever + np.arange(count)
        self.ever += count
        blocks = zip(self._blocks, self._arrays, strict=True)
        self._put([np.concatenate([array, block.new(count, values)], block.axis) for block, array in blocks])
        self.awake += count
        moved = min(count, n - first)  # particles asleep whose places the new particles take
        self.exchange(first + np.arange(moved), n + count - moved + np.arange(moved))
        return slice(first, first + count)

    def restore(self, values) -> None:
        """Replace all particles: `values` maps the name of every variable to its array, of any number of particles."""
        self._put([block.new(values["identity"].size, values) for block in self._blocks])

    def exchange(self, these, those) -> None:
        """Exchange the particles at two arrays of int with their places, which have no place in common.

        `these` and `those`, int, have shape (k,).
        """
        if these.size == 0:
            return
        to, of = np.concatenate([these, those]), np.concatenate([those, these])
        for block, array in zip(self._blocks, self._arrays, strict=True):
            if block.axis:
                array[:, to] = array[:, of]
            else:
                array[to] = array[of]

    def keep(self, mask) -> None:
        """Remove all particles where `mask` is False."""
        self.awake = int(np.count_nonzero(mask[: self.awake]))
        self._put(self._taken(np.flatnonzero(mask)))

    def copy(self) -> "Particles":
        """Return an independent copy."""
        return self._with([array.copy() for array in self._arrays])

    def at(self, places) -> "Particles":
        """Return a copy of the particles at `places`, an array of int."""
        return self._with(self._taken(places))

    def _taken(self, places) -> list:
        """Return copies of the arrays of all blocks with the particles at `places`, an array of int."""
        return [np.take(array, places, block.axis) for block, array in zip(self._blocks, self._arrays, strict=True)]

    def _with(self, arrays) -> "Particles":
        """Return particles with other arrays of all blocks."""
        other = object.__new__(Particles)
        vars(other).update(vars(self))
        other._put(arrays)
        return other
