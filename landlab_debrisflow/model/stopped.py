"""Volume stopped by closed nodes: every particle counts once, with its volume when first stopped."""

import numpy as np


class Stopped:
    """Volume stopped since it was last reported.

    Attributes
    ----------
    volume : float
        Volume stopped since the account was last begun [m3].
    first, last : float
        Times at which the first and the last particle was stopped [s].
    where : tuple of float
        Position of the first stopped particle, from the lower left node [m].
    """

    def __init__(self):
        self.forget()

    def forget(self) -> None:
        """Begin anew; particles that were counted are not counted again."""
        self.volume, self.first, self.last, self.where = 0.0, np.inf, -np.inf, (np.nan, np.nan)

    def copy(self) -> "Stopped":
        """Return an independent copy of the account."""
        other = Stopped()
        vars(other).update(vars(self))
        return other

    def count(self, p, time: float) -> None:
        """Count the particles that a wall has stopped and that were not counted before, at some time [s]."""
        new = np.flatnonzero(p.touched_wall > p.counted_at_wall)
        if new.size:
            if self.volume == 0.0:
                self.first, self.where = time, (float(p.x[new[0]]), float(p.y[new[0]]))
            self.volume += float(p.volume[new].sum())
            self.last = time
            p.counted_at_wall[new] = 1
