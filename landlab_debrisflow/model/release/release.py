"""Turn a depth of failing ground into particles.

All particles of a site have the same volume, because light particles beside heavy ones are shot out as jets.
"""

import logging

import numpy as np

from ...spatial.raster import CLOSED
from ...spatial.summation import SMOOTHING_RATIO
from ...terrain.surface import SurfaceSample
from .placing import THICKNESS_RANGE, Placed, place_particles
from .rows import in_rows
from .sites import find_sites, share_particles, volume_below_lips

log = logging.getLogger("landlab_debrisflow")

WORTH_SAYING = 0.01
"""Fraction of a release below the lip of its scar from which on a warning says so."""

LIGHT = 1.0 / 16.0
"""Volume over the usual one below which a particle is light. Even the smallest site has a particle. Buried by a flow,
such a particle would get a smoothing length as small as its volume, and would need equally short steps. So a light
particle keeps the usual smoothing length, and the limits by growth and convergence leave it out."""


def release_particles(p, origins, nodes, depth, bed, phases, numerics, velocity=None) -> slice:
    """Add particles for failing ground and return their places.

    Parameters
    ----------
    p : Particles
        All particles.
    origins : Origins
        Records the nodes from which the volume of every particle is taken.
    nodes : ndarray of int, shape (cells,)
        Where the ground fails, sorted.
    depth : ndarray, shape (cells,)
        Vertical thickness that fails there [m].
    bed : Bed
        Ground that is left below.
    phases : Phases
        Give the fractions of grains and water.
    numerics : Numerics
        Give the number or the spacing of particles [m].
    velocity : ndarray, shape (2, cells), optional
        Velocity over the map along x and y [m s-1]; by default the ground fails at rest.
    """
    material, whole = phases.material, _whole_volume(p, phases)
    sites = find_sites(nodes, depth, bed.raster)
    _warn_of_pits(bed, sites, nodes, depth)
    counts = share_particles(sites.volume, _particle_volume(whole, bed.raster.area, nodes, depth, numerics))
    placed = in_rows(place_particles(sites, counts, bed.surface))
    below = bed.surface.sample(placed.x, placed.y)
    normal = placed.depth / np.sqrt(1.0 + below.slope_x**2 + below.slope_y**2)
    thickest = np.zeros(sites.volume.size)
    np.maximum.at(thickest, placed.site, normal)
    least, first = THICKNESS_RANGE * thickest[placed.site], p.awake
    deepest = max(thickest.max(), p.thickness.max(initial=0.0))
    usual = _usual_volume(np.concatenate([placed.volume, whole]))
    moving = along_bed(placed, velocity, below)
    origin = origins.add(placed.x, placed.y, placed.particle, nodes[placed.cell], placed.part)
    for phase, part in phases.phase_fractions:
        p.append(
            placed.x.size, x=placed.x, y=placed.y, z=below.elevation, velocity=moving, phase=phase, share=part,
            volume=part * placed.volume, released_volume=part * placed.volume, depth=placed.depth, thickness=normal,
            own_thickness=part * normal, least_thickness=part * least, porosity=material.porosity,
            density=material.density, origin=origin, light=placed.volume < LIGHT * usual,
            smoothing_length=SMOOTHING_RATIO * np.sqrt(placed.volume / np.maximum(normal, least)),
            usual_length=SMOOTHING_RATIO * np.sqrt(usual / deepest),
        )  # fmt: skip
    return slice(first, p.awake)


def along_bed(placed: Placed, velocity, below: SurfaceSample):
    """Return the velocity of particles along the bed, shape (3, n) [m s-1], with the momentum of the ground that fails.

    Parameters
    ----------
    placed : Placed
        The n particles.
    velocity : ndarray, shape (2, cells), or None
        Velocity of the failing cells over the map [m s-1]; None: at rest.
    below : SurfaceSample
        Bed below the particles.
    """
    along = np.zeros((3, placed.x.size))
    if velocity is not None:
        for component, of_cells in zip(along, velocity, strict=False):
            component[:] = np.bincount(placed.particle, placed.part * of_cells[placed.cell], placed.x.size)
        along /= placed.volume
        along[2] = along[0] * below.slope_x + along[1] * below.slope_y
    return along


def _particle_volume(whole, area: float, nodes, depth, numerics) -> float:
    """Return the target volume of a particle [m3], at least the volume of the particles already there.

    `whole` are the volumes of the particles there [m3]; `area` is that of a node [m2]; `nodes` and `depth` [m], shape
    (n,), are those of the failing ground; `numerics` are `Numerics`.
    """
    wanted = depth.sum() * area / numerics.count_for(nodes.size * area)
    return max(wanted, float(np.median(whole))) if whole.size else wanted


def _whole_volume(p, phases):
    """Return the volume of particles with that of the other phase around them, shape (n,) [m3].

    `p` are the particles; `phases` tells how many phases there are.
    """
    part = np.ones(2)  # volume fraction by phase
    for phase, of_it in phases.phase_fractions:
        part[phase] = of_it
    return p.volume / part[p.phase]


def _usual_volume(volume) -> float:
    """Return the volume of the particles that most of the mass is in [m3]."""
    return (volume**2).sum() / volume.sum()


def _warn_of_pits(bed, sites, nodes, depth) -> None:
    volume = volume_below_lips(sites, nodes, depth, bed.elevation, bed.raster.status == CLOSED, bed.raster)
    if volume > WORTH_SAYING * sites.volume.sum():
        log.warning(
            "%.3g of the %.3g m3 released lie below the lowest ground beside their scar: a pit that they cannot leave "
            "by themselves. Let the depth taper towards the lower rim (failure_surface of landlab_debrisflow.scene), "
            "or lay the release on top of the ground (lay_on_top)",
            volume, sites.volume.sum(),
        )  # fmt: skip
