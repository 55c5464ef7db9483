"""Turn a depth of failing ground into particles.

All particles of a site have the same volume, because light particles beside heavy ones are shot out as jets.
"""

import logging

import numpy as np

from ...spatial.summation import SMOOTHING_RATIO
from ..kinematics import CLOSED
from .placing import THICKNESS_RANGE, place_particles
from .sites import find_sites, share_particles, volume_below_lips

log = logging.getLogger("landlab_debrisflow")

WORTH_SAYING = 0.01
"""Part of a release that lies below the lip of its scar from which on it is said."""

LIGHT = 1.0 / 16.0
"""Volume over the usual one below which a particle is light. A site has a particle however small it is; buried by a
flow that would get as short as it is light, and ask for such steps. So it has the usual smoothing length for ever, and
no say in the limits by growth and convergence."""


def release_particles(sim, nodes, depth) -> slice:
    """Add particles for failing ground to a simulation and return their places; arguments as of its `release`."""
    raster, material = sim.bed.nodes, sim.physics.material
    sites = find_sites(nodes, depth, raster)
    _warn_of_pits(sim, sites, nodes, depth)
    counts = share_particles(sites.volume, _particle_volume(sim, nodes, depth))
    placed = place_particles(sites, counts, sim.bed.surface)
    ground = sim.bed.surface.sample(placed.x, placed.y)
    normal = placed.depth / np.sqrt(1.0 + ground[1] ** 2 + ground[2] ** 2)
    thickest = np.zeros(sites.volume.size)
    np.maximum.at(thickest, placed.site, normal)
    least, first = THICKNESS_RANGE * thickest[placed.site], sim.particles.awake
    usual, deepest = _usual(sim, placed.volume, thickest)
    origin = sim.origins.add(placed.x, placed.y, placed.particle, nodes[placed.cell], placed.part)
    for phase, part in sim.matter.parts:
        sim.particles.append(
            placed.x.size, x=placed.x, y=placed.y, z=ground[0], phase=phase, share=part, volume=part * placed.volume,
            released_volume=part * placed.volume, depth=placed.depth, thickness=normal, own_thickness=part * normal,
            least_thickness=part * least, porosity=material.porosity, density=material.density, origin=origin,
            smoothing_length=SMOOTHING_RATIO * np.sqrt(placed.volume / np.maximum(normal, least)),
            light=placed.volume < LIGHT * usual, usual_length=SMOOTHING_RATIO * np.sqrt(usual / deepest),
        )  # fmt: skip
    return slice(first, sim.particles.awake)


def _particle_volume(sim, nodes, depth) -> float:
    """Return the volume of a particle that is aimed at [m3]: that of what is there already, if that is more."""
    area = sim.bed.nodes.area
    wanted = depth.sum() * area / sim.numerics.count_for(nodes.size * area)
    return max(wanted, float(np.median(_whole_volume(sim)))) if sim.particles.count else wanted


def _whole_volume(sim):
    """Return the volume of particles with that of the other phase around them, shape (n,) [m3]."""
    part = np.ones(2)  # by phase
    for phase, of_it in sim.matter.parts:
        part[phase] = of_it
    return sim.particles.volume / part[sim.particles.phase]


def _usual(sim, volume, thickest):
    """Return volume [m3] of the particles that most of the mass is in, and the largest thickness, old and new [m]."""
    volume = np.concatenate([volume, _whole_volume(sim)])
    return (volume**2).sum() / volume.sum(), max(thickest.max(), sim.particles.thickness.max(initial=0.0))


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
