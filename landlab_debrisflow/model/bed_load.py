"""The weight of the flow on a bed whose own pore pressure follows it."""

import numpy as np

from ..physics.contracts import WATER


def press(sim, dt: float | None = None) -> None:
    """Tell the bed what the flow weighs after a step, or, without one, what has lain there before."""
    p, bed, material = sim.particles, sim.bed.pore_pressure, sim.physics.material
    if bed is None or (p.count == 0 and dt is None):
        return
    # volume over depth is map area; g_n h_n is g h cos^2(theta). Of two phases the grains stand for the mixture
    weight = p.volume / p.share * material.gravity * (p.thickness / p.depth) ** 2
    weight[p.phase == WATER] = 0.0
    force = np.stack([weight * p.density, weight * (p.density - material.bearing_density)], axis=1)
    if dt is None:
        bed.stand(p.x, p.y, p.spread, force, sim.time)
    else:
        bed.carry(p.x, p.y, p.spread, force, sim.time + dt, dt)
