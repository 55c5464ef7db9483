"""Turn a depth of failing ground into particles.

All particles of a site have the same volume, because light particles beside heavy ones are shot out as jets.
"""

import logging

import numpy as np

from ..spatial.summation import SMOOTHING_RATIO
from .motion import CLOSED
from .placing import THICKNESS_RANGE, place_particles
from .sites import find_sites, share_particles, volume_below_lips

log = logging.getLogger("landlab_debrisflow")

WORTH_SAYING = 0.01
"""Part of a release that lies below the lip of its scar from which on it is said."""


def release_particles(sim, nodes, depth) -> slice:
    """Add particles for failing ground to a simulation and return their places; arguments as of its `release`."""
    raster, material = sim.bed.nodes, sim.physics.material
    sites = find_sites(nodes, depth, raster)
    _warn_of_pits(sim, sites, nodes, depth)
    placed = place_particles(sites, share_particles(sites.volume, _particle_volume(sim, nodes, depth)), sim.bed.surface)
    ground = sim.bed.surface.sample(placed.x, placed.y)
    normal = placed.depth / np.sqrt(1.0 + ground[1] ** 2 + ground[2] ** 2)
    thickest = np.zeros(sites.volume.size)
    np.maximum.at(thickest, placed.site, normal)
    least, first = THICKNESS_RANGE * thickest[placed.site], sim.particles.awake
    origin = sim.origins.add(placed.x, placed.y, placed.particle, nodes[placed.cell], placed.part)
    for phase, part in sim.matter.parts:
        sim.particles.append(
            placed.x.size, x=placed.x, y=placed.y, z=ground[0], phase=phase, share=part, volume=part * placed.volume,
            released_volume=part * placed.volume, depth=placed.depth, thickness=normal, own_thickness=part * normal,
            least_thickness=part * least, porosity=material.porosity, density=material.density, origin=origin,
            smoothing_length=SMOOTHING_RATIO * np.sqrt(placed.volume / np.maximum(normal, least)),
        )  # fmt: skip
    return slice(first, sim.particles.awake)


def _particle_volume(sim, nodes, depth) -> float:
    """Return the volume of a particle that is aimed at [m3]: that of what is there already, if that is more."""
    p, area = sim.particles, sim.bed.nodes.area
    wanted = depth.sum() * area / sim.numerics.count_for(nodes.size * area)
    if p.count == 0:
        return wanted
    part = np.ones(2)  # by phase
    for phase, of_it in sim.matter.parts:
        part[phase] = of_it
    return max(wanted, float(np.median(p.volume / part[p.phase])))


def _warn_of_pits(sim, sites, nodes, depth) -> None:
    bed = sim.bed
    volume = volume_below_lips(sites, nodes, depth, bed.elevation, sim.status == CLOSED, bed.nodes)
    if volume > WORTH_SAYING * sites.volume.sum():
        log.warning(
            "%.3g of the %.3g m3 released lie below the lowest ground beside their scar: a pit that they cannot leave "
            "by themselves. Let the depth taper towards the lower rim, or add the release to topographic__elevation "
            "(and soil__depth) first, which lays it on top of the ground",
            volume, sites.volume.sum(),
        )  # fmt: skip
