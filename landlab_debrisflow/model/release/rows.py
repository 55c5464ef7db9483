"""Order of the particles of a release in memory: neighbours lie near each other."""

import numpy as np

from ...spatial.cells import sort_into_cells
from ...spatial.summation import SMOOTHING_RATIO
from .placing import Placed


def in_rows(placed: Placed) -> Placed:
    """Return the particles of every site in the order of the cell list.

    Large flows need it: see docs/decisions/flow.md, Flow 19. A flow keeps enough of this order.

    Parameters
    ----------
    placed : Placed
        Particles of a release, those of a site one after the other.

    Returns
    -------
    Placed
    """
    support = 2.0 * SMOOTHING_RATIO * np.sqrt(placed.volume / placed.depth)
    order = sort_into_cells(placed.x, placed.y, support).order
    order = order[np.argsort(placed.site[order], kind="stable")]
    place = np.empty_like(order)
    place[order] = np.arange(order.size)
    particle = place[placed.particle]
    pairs = np.argsort(particle, kind="stable")
    of_particles, of_pairs = (values[order] for values in placed[:5]), (values[pairs] for values in placed[6:])
    return Placed(*of_particles, particle[pairs], *of_pairs)
