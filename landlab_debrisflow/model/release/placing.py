"""Places for particles of equal volume: a relaxed lattice, because the noise of random seeding weakens friction.

Failing cells are filled with samples that carry their volume. A k-d tree cuts the samples of every site into as many
parts of equal volume as it has particles; then the particles repel each other while the samples hold them in place.
"""

from typing import NamedTuple

import numpy as np

from ...spatial.cells import sort_into_cells
from ...spatial.packing import Position
from ...spatial.raster import nearest_line
from ...spatial.summation import SMOOTHING_RATIO, SummationInput, Sums, sum_over_neighbours
from ...terrain.surface import Surface
from .sites import Sites

THICKNESS_RANGE = 1.0 / 64.0
"""Thickness over the largest of a site, below which the smoothing length does not grow any more: it would grow without
bound at a particle without neighbours."""

SAMPLES_PER_PARTICLE = 4
STEP = 0.5
"""Length of one relaxation step in l^2 times the logarithmic gradient: half of the largest stable one."""

CYCLES, STAGES = 3, 4
"""Cycles of the relaxation, and stages of each: s stages go as far as s (s + 1)/2 steps (Meyer, Balsara & Aslam, 2014,
J. Comput. Phys. 257: Runge-Kutta-Legendre stages of the first order), so 12 sums over neighbours do the work of 30."""

WITHIN = 0.5 - 1e-6
"""Largest distance of a particle from the node with which it fails, over the node spacing: less than 1/2, so that the
nearest node is a failing one even after coordinates on the map are rounded."""


class Placed(NamedTuple):
    """Particles of a release, and the failing cells that each stands for.

    Attributes
    ----------
    x : ndarray, shape (n,)
        From the lower left node [m].
    y : ndarray, shape (n,)
        From the lower left node [m].
    depth : ndarray, shape (n,)
        Vertical thickness that fails in the cell in which each particle stands [m].
    volume : ndarray, shape (n,)
        Volume of each particle [m3].
    site : ndarray of int, shape (n,)
        Number of its site.
    particle : ndarray of int, shape (m,)
        Particle of each pair of particle and failing cell, sorted.
    cell : ndarray of int, shape (m,)
        Failing cell of each pair; the particle stands for a part of the cell.
    part : ndarray, shape (m,)
        Volume of that part [m3].
    """

    x: np.ndarray
    y: np.ndarray
    depth: np.ndarray
    volume: np.ndarray
    site: np.ndarray
    particle: np.ndarray
    cell: np.ndarray
    part: np.ndarray


class Samples(NamedTuple):
    """Points in failing cells that carry their volume.

    Attributes
    ----------
    x : ndarray, shape (m,)
        From the centre of the corner cell [m].
    y : ndarray, shape (m,)
        From the centre of the corner cell [m].
    volume : ndarray, shape (m,)
        Volume that each carries [m3].
    cell : ndarray of int, shape (m,)
        The failing cell.
    group : ndarray of int, shape (m,)
        Number of the group to which each belongs.
    """

    x: np.ndarray
    y: np.ndarray
    volume: np.ndarray
    cell: np.ndarray
    group: np.ndarray

    def take(self, places) -> "Samples":
        """Return the samples at some places, in the order of these."""
        return Samples(*(values[places] for values in self))

    def centres(self, count: int):
        """Return the centres of `count` groups, x and y [m], and their volumes [m3]."""
        total = np.bincount(self.group, self.volume, count)
        x, y = (np.bincount(self.group, self.volume * values, count) for values in (self.x, self.y))
        return x / total, y / total, total


def place_particles(sites: Sites, counts, surface: Surface) -> Placed:
    """Place particles so that each stands for an equal part of the volume of its site.

    Parameters
    ----------
    sites : Sites
    counts : ndarray of int, shape (sites,)
        Number of particles of each.
    surface : Surface
        The ground below the release.

    Returns
    -------
    Placed
    """
    count, site = int(counts.sum()), np.repeat(np.arange(counts.size), counts)
    volume = sites.volume[site] / counts[site]
    samples = cut_equally(fill_cells(sites, counts), counts)
    x, y, _ = samples.centres(count)
    # the centre of a group on both sides of a notch may lie outside of the site: use one of its samples
    outside = sites.at(x, y)[0] != site
    one = np.zeros(count, np.int64)
    one[samples.group] = np.arange(samples.x.size)
    x[outside], y[outside] = samples.x[one[outside]], samples.y[one[outside]]
    several = np.flatnonzero(counts[site] > 1)  # a single particle of a site stays at the centre
    if several.size:
        held_by = _coarsened(samples, count, site)
        held_by = held_by.take(counts[held_by.group] > 1)
        x[several], y[several] = _relax(
            x[several], y[several], volume[several], site[several], held_by, sites, surface
        )  # fmt: skip
    x, y, depth = _on_the_map(x, y, sites)
    particle, cell, part = _merged(samples, sites.of_cell.size)
    return Placed(x, y, depth, volume, site, particle, cell, part)


def fill_cells(sites: Sites, counts) -> Samples:
    """Fill every failing cell with samples, with a depth that varies linearly in the cell; samples are grouped by site.

    A cell has as many samples as in a site of uniform depth, and at least one for each particle that it makes. The
    slope inside a cell is limited (monotonised central), so no depth is negative and the volume of every cell is kept.
    """
    rows, columns, depth, of = sites.rows, sites.columns, sites.depth, sites.of_cell
    here, area = depth[rows, columns], sites.spacing[0] * sites.spacing[1]
    makes = counts[of] * here * area / sites.volume[of]
    wanted = np.maximum(SAMPLES_PER_PARTICLE * counts[of] / np.bincount(of)[of], makes)
    per_side = np.maximum(1, np.ceil(np.sqrt(wanted * (1.0 - 1e-9)))).astype(int)  # rounding must not ask for one more

    def slope(down, along):
        back, forth = here - depth[rows - down, columns - along], depth[rows + down, columns + along] - here
        limited = np.minimum(np.minimum(2.0 * abs(back), 2.0 * abs(forth)), 0.5 * abs(back + forth))
        return np.where(np.sign(back) == np.sign(forth), np.sign(forth) * limited, 0.0)

    slope_y, slope_x = slope(1, 0), slope(0, 1)
    # with both slopes the depth at the corners must not be negative
    fall = 0.5 * (abs(slope_x) + abs(slope_y))
    scale = np.minimum(1.0, here / np.maximum(fall, 1e-300))
    slope_y, slope_x = scale * slope_y, scale * slope_x
    cell = np.repeat(np.arange(rows.size), per_side**2)
    k = per_side[cell]
    number = np.arange(cell.size) - np.repeat(np.cumsum(per_side**2) - per_side**2, per_side**2)
    oy, ox = (number // k + 0.5) / k - 0.5, (number % k + 0.5) / k - 0.5
    volume = (here[cell] + slope_x[cell] * ox + slope_y[cell] * oy) * area / k**2
    x, y = (columns[cell] + ox) * sites.spacing[0], (rows[cell] + oy) * sites.spacing[1]
    return Samples(x, y, volume, cell, of[cell].astype(np.int64)).take(volume > 0.0)


def cut_equally(samples: Samples, parts) -> Samples:
    """Cut every group of samples into a number of parts of equal volume, always across its longer side (a k-d tree).

    A sample that a cut meets is divided, so the parts are equal whatever the samples are.

    Parameters
    ----------
    samples : Samples
    parts : ndarray of int, shape (groups,)
        Number of parts of each group.

    Returns
    -------
    Samples
        Grouped by part; the parts of a group follow each other.
    """
    parts = np.array(parts)
    while parts.max() > 1:
        group = samples.group
        low_x, high_x = _extent(samples.x, group, parts.size)
        low_y, high_y = _extent(samples.y, group, parts.size)
        wide = (high_x - low_x >= high_y - low_y)[group]
        along, across = np.where(wide, samples.x, samples.y), np.where(wide, samples.y, samples.x)
        samples = samples.take(np.lexsort((across, along, group)))
        group, volume = samples.group, samples.volume
        total = np.bincount(group, volume, parts.size)
        relative = volume / total[group]  # so that a small site is cut as exactly as a large one
        upto = (np.cumsum(relative, dtype=np.longdouble) - group).astype(float)  # parts differ by 1e-13, not 1e-11
        left_parts = parts // 2
        cut = (left_parts / parts)[group]
        left = np.clip((cut - (upto - relative)) / relative, 0.0, 1.0)  # fraction of each sample to the left of the cut
        left[left < SLIVER], left[left > 1.0 - SLIVER] = 0.0, 1.0
        left[(parts == 1)[group]] = 1.0
        first = np.cumsum(np.where(parts > 1, 2, 1)) - np.where(parts > 1, 2, 1)  # new number of each group
        goes_left, goes_right = np.flatnonzero(left > 0.0), np.flatnonzero(left < 1.0)
        both = np.concatenate([goes_left, goes_right])
        divided = np.concatenate([(left * volume)[goes_left], (volume - left * volume)[goes_right]])
        number = np.concatenate([first[group[goes_left]], first[group[goes_right]] + 1])
        samples = samples.take(both)._replace(volume=divided, group=number)
        split = np.ones(first[-1] + (2 if parts[-1] > 1 else 1), np.int64)
        split[first] = np.where(parts > 1, left_parts, 1)
        split[first[parts > 1] + 1] = (parts - left_parts)[parts > 1]
        parts = split
    return samples


SLIVER = 1e-13
"""Least fraction of a sample that is cut off: less is rounding."""


def _extent(values, group, groups):
    low, high = np.full(groups, np.inf), np.full(groups, -np.inf)
    np.minimum.at(low, group, values)
    np.maximum.at(high, group, values)
    return low, high


def _coarsened(samples: Samples, count: int, site) -> Samples:
    """Return samples grouped by site, merged to a few per particle if there are far more."""
    if samples.x.size > 2 * SAMPLES_PER_PARTICLE * count:
        samples = cut_equally(samples, np.full(count, SAMPLES_PER_PARTICLE))
        x, y, volume = samples.centres(SAMPLES_PER_PARTICLE * count)
        group = np.repeat(np.arange(count), SAMPLES_PER_PARTICLE)
        samples = Samples(x, y, volume, np.zeros(x.size, np.int64), group)
    return samples._replace(group=site[samples.group])


def _merged(samples: Samples, cells: int):
    """Return particle, cell and volume of every pair of which the particle stands for a part of the cell."""
    pair, place = np.unique(samples.group * cells + samples.cell, return_inverse=True)
    return *np.divmod(pair, cells), np.bincount(place, samples.volume)


def _on_the_map(x, y, sites: Sites):
    """Return coordinates from the lower left node [m], well inside the cell each particle stands in, and its depth."""
    placed = []
    for values, spacing, corner in ((x, sites.spacing[0], sites.corner[1]), (y, sites.spacing[1], sites.corner[0])):
        node = nearest_line(values, spacing) + corner
        placed.append(np.clip(values + corner * spacing, (node - WITHIN) * spacing, (node + WITHIN) * spacing))
    return *placed, sites.at(x, y)[1]


def _relax(x, y, volume, site, samples: Samples, sites: Sites, surface: Surface):
    """Let the particles repel each other while the samples, with negative volume, hold them in place.

    The force is the gradient of the distance between the particles' thickness and the samples', both smoothed by the
    kernel. At rest their thickness fits that of the samples best, at edges and with uneven depths, too. Particles, at
    x, y [m] with a volume [m3] and a site, all (n,), do not leave the failing cells of their site.
    """
    n, x0, y0 = x.size, sites.corner[1] * sites.spacing[0], sites.corner[0] * sites.spacing[1]
    per_particle = np.zeros(sites.volume.size)
    per_particle[site] = volume

    def length_and_ground(px, py, of):
        below = surface.sample(px + x0, py + y0)
        cosine = 1.0 / np.sqrt(1.0 + below.slope_x**2 + below.slope_y**2)
        here = np.maximum(sites.at(px, py)[1], THICKNESS_RANGE * sites.thickest[of])  # bounded as in a flow
        return SMOOTHING_RATIO * np.sqrt(per_particle[of] / (here * cosine)), cosine, below.elevation

    sample_length, _, sample_z = length_and_ground(samples.x, samples.y, samples.group)
    volumes = np.concatenate([volume, -samples.volume])
    rest, ones = np.zeros((3, volumes.size)), np.ones(volumes.size)
    sums = Sums(  # samples act on particles and do not move themselves
        thickness=np.empty(n), gradient_term=np.empty(n), next_length=np.empty(n), acceleration=np.empty((3, n)),
        convergence=np.empty(n),
    )  # fmt: skip
    push, x_before, y_before = sums.acceleration, x, y
    for stage in CYCLES * tuple(range(1, STAGES + 1)):
        length, cosine, z = length_and_ground(x, y, site)
        lengths = np.concatenate([length, sample_length])
        px, py = np.concatenate([x, samples.x]), np.concatenate([y, samples.y])
        pz = np.concatenate([z, sample_z])
        cells = sort_into_cells(px, py, 2.0 * lengths)
        given = SummationInput(
            position=Position(px, py, pz), velocity=rest, volume=volumes, smoothing_length=lengths, longest=lengths,
            pressure_coefficient=0.5 * ones, celerity=ones, thickness=ones, convergence=rest[0], inertia=ones,
        )  # fmt: skip
        sum_over_neighbours(cells, given, 0.0, sums)
        step, onward = (2.0 - 1.0 / stage) * STEP * length**2 / (sites.at(x, y)[1] * cosine), 1.0 - 1.0 / stage
        way_x, way_y = step * push[0] + onward * (x - x_before), step * push[1] + onward * (y - y_before)
        part = np.minimum(1.0, 0.2 * length / np.maximum(np.hypot(way_x, way_y), 1e-300))
        x_before, y_before, new_x, new_y = x, y, x + part * way_x, y + part * way_y
        inside = sites.at(new_x, new_y)[0] == site
        x, y = np.where(inside, new_x, x), np.where(inside, new_y, y)
    return x, y
