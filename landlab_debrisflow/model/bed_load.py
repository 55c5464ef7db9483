"""Load of the flow on a bed whose own pore pressure follows the load."""

import numpy as np

from ..physics.contracts import WATER


def load_bed(p, bed, material, time: float, dt: float | None = None, footprints=None) -> None:
    """Load the bed with the weight of the flow.

    Parameters
    ----------
    p : Particles
        All particles.
    bed : Bed
        Ground below the flow, with a pore pressure that follows its load or without.
    material : Material
        Densities, porosity, gravity.
    time : float
        Now [s].
    dt : float, optional
        Time since the bed was loaded last [s]; without one the flow has lain there before.
    footprints : Footprints, optional
        Nodes on which the particles lie; by default those of their positions.
    """
    if bed.pore_pressure is None or (p.count == 0 and dt is None):
        return
    # volume over depth is map area; g_n h_n is g h cos^2(theta); in a flow of two phases the grains stand for the
    # mixture
    weight = p.volume / p.share * material.gravity * (p.thickness / p.depth) ** 2
    weight[p.phase == WATER] = 0.0
    force = np.stack([weight * p.density, weight * (p.density - material.bearing_density)], axis=1)
    footprints = bed.footprints(p) if footprints is None else footprints
    if dt is None:
        bed.pore_pressure.stand(footprints, force, time)
    else:
        bed.pore_pressure.carry(footprints, force, time, dt)
