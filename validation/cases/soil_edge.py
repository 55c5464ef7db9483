"""A single particle that slides from rock onto soil: the order of erosion in the time step."""

from landlab_debrisflow import DebrisFlow

from ..grids import dry_block, inclined, release_slab

SLOPE, FRICTION, SPACING = 0.5, 0.2, 5.0
EDGE = 60.0  # soil begins here, along x [m]
DURATION = 8.0  # [s]
NUMBERS = {"courant_number": 0.6, "advective_courant_number": 0.5}


def cross_edge(shorter: float = 1.0):
    """Return volume [m3] and place along x [m] of the particle at the end, and the number of steps.

    Steps are `shorter` times as short as by default. At the end the particle is on the soil.
    """
    grid = inclined((15, 60), SPACING, SLOPE, soil=5.0)
    grid.at_node["soil__depth"][grid.x_of_node < EDGE] = 0.0
    release_slab(grid, (30.0, 35.0), 3.0, 1.0, on_top=True)
    numerics = {name: value / shorter for name, value in NUMBERS.items()}
    law = {"law": "growth", "growth_rate": 3e-3}
    flow = DebrisFlow(grid, **dry_block(FRICTION, law, particle_count=1, **numerics))
    flow.run_one_step(DURATION)
    p = flow._simulation.particles
    return float(p.volume[0]), float(p.x[0]), flow.diagnostics.steps
