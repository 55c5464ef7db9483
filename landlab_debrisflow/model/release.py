"""Turn a depth of failing ground into particles of equal volume on a relaxed lattice.

Equal volumes, because light particles beside heavy ones are shot out as jets; a relaxed lattice,
because the noise of random seeding weakens Coulomb friction.
"""

import numpy as np

from ..spatial.cells import sort_into_cells
from ..spatial.summation import SMOOTHING_RATIO, Moving, Sums, sum_over_neighbours
from ..terrain.surface import Surface

THICKNESS_RANGE = 1.0 / 64.0
"""Thickness over that of the thickest part of the release, below which the smoothing length grows no more: a
particle without neighbours has no thickness of its own."""

SAMPLES_PER_PARTICLE = 4
SWEEPS = 30
STEP = 0.5
"""Length of one relaxation step in l^2 times the logarithmic gradient: half of what is stable."""


def release_particles(sim, nodes, depth) -> slice:
    """Add particles for failing ground to a simulation and return their places; arguments as of its `release`."""
    raster, material = sim.bed.nodes, sim.physics.material
    volume = depth.sum() * raster.area
    count = sim.numerics.count_for(nodes.size * raster.area)
    rows, columns = np.divmod(nodes, raster.columns)
    corner = rows.min(), columns.min()  # only the part of the raster that fails is looked at
    failing = np.zeros((rows.max() - corner[0] + 1, columns.max() - corner[1] + 1))
    failing[rows - corner[0], columns - corner[1]] = depth
    x, y, here = place_particles(failing, (raster.dx, raster.dy), corner, sim.bed.surface, count)
    ground = sim.bed.surface.sample(x, y)
    each = volume / count
    normal = here / np.sqrt(1.0 + ground[1] ** 2 + ground[2] ** 2)
    least, first = THICKNESS_RANGE * normal.max(), sim.particles.awake
    for phase, part in sim.matter.parts:
        sim.particles.append(
            count, x=x, y=y, z=ground[0], phase=phase, share=part, volume=part * each, released_volume=part * each,
            depth=here, thickness=normal, own_thickness=part * normal, least_thickness=part * least,
            porosity=material.porosity, density=material.density,
            smoothing_length=SMOOTHING_RATIO * np.sqrt(each / np.maximum(normal, least)),
        )  # fmt: skip
    return slice(first, sim.particles.awake)


def place_particles(depth, spacing, corner, surface: Surface, count: int):
    """Place `count` particles so that each stands for an equal part of the volume.

    Parameters
    ----------
    depth : ndarray, shape (rows, columns)
        Vertical thickness that fails [m]; 0 where nothing does.
    spacing : tuple of float
        Node spacing (dx, dy) [m].
    corner : tuple of int
        Row and column of its first node in the raster.
    surface : Surface
        The ground below the release.
    count : int
        Number of particles.

    Returns
    -------
    x, y : ndarray, shape (count,)
        Map coordinates [m].
    here : ndarray, shape (count,)
        Thickness that fails in the cell each stands in [m].
    """
    x, y, share = _samples(depth, spacing, SAMPLES_PER_PARTICLE * count)
    if x.size > 2 * SAMPLES_PER_PARTICLE * count:  # far more cells than particles: they need not see each of them
        x, y, share = _centres(x, y, share, _split_equally(x, y, share, SAMPLES_PER_PARTICLE * count))
    group = _split_equally(x, y, share, count)
    centre_x, centre_y, _ = _centres(x, y, share, group)
    # the centre of a group that straddles a notch may lie outside: use one of its samples
    outside = _depth_at(depth, spacing, centre_x, centre_y) <= 0.0
    one = np.zeros(count, np.int64)
    one[group] = np.arange(x.size)
    centre_x[outside], centre_y[outside] = x[one[outside]], y[one[outside]]
    x0, y0 = corner[1] * spacing[0], corner[0] * spacing[1]
    x, y = _relax(centre_x, centre_y, x, y, share, depth, spacing, lambda x, y: surface.sample(x + x0, y + y0))
    return x + x0, y + y0, _depth_at(depth, spacing, x, y)


def _centres(x, y, share, group):
    """Return the centres of groups of samples, and their volumes; a group may be empty where samples are uneven."""
    total, x, y = np.bincount(group, share), np.bincount(group, share * x), np.bincount(group, share * y)
    filled = total > 0.0
    return x[filled] / total[filled], y[filled] / total[filled], total[filled]


def _depth_at(depth, spacing, x, y):
    """Return the depth of the cell each point lies in [m]; outside the raster that of its edge."""
    rows = np.clip(np.floor(y / spacing[1] + 0.5).astype(int), 0, depth.shape[0] - 1)
    columns = np.clip(np.floor(x / spacing[0] + 0.5).astype(int), 0, depth.shape[1] - 1)
    return depth[rows, columns]


def _samples(depth, spacing, wanted):
    """Fill every failing cell with points that carry its volume, sloping with its neighbours.

    The slope inside a cell is limited (monotonised central), so no depth is negative and the volume
    of every cell is kept.
    """
    rows, columns = np.nonzero(depth > 0.0)
    k = max(2, int(np.ceil(np.sqrt(wanted / rows.size))))
    padded = np.pad(depth, 1)

    def slope(axis):
        r, c = rows + 1, columns + 1
        here = padded[r, c]
        back = here - (padded[r - 1, c] if axis == 0 else padded[r, c - 1])
        forth = (padded[r + 1, c] if axis == 0 else padded[r, c + 1]) - here
        limited = np.minimum(np.minimum(2.0 * abs(back), 2.0 * abs(forth)), 0.5 * abs(back + forth))
        return np.where(back * forth > 0.0, np.sign(forth) * limited, 0.0)

    slope_y, slope_x = slope(0), slope(1)
    # both slopes together must leave the corners above zero
    fall = 0.5 * (abs(slope_x) + abs(slope_y))
    scale = np.minimum(1.0, depth[rows, columns] / np.maximum(fall, 1e-300))
    offset = (np.arange(k) + 0.5) / k - 0.5
    oy, ox = (o.ravel() for o in np.meshgrid(offset, offset, indexing="ij"))
    local = depth[rows, columns][:, None] + scale[:, None] * (slope_x[:, None] * ox + slope_y[:, None] * oy)
    x, y = (columns[:, None] + ox) * spacing[0], (rows[:, None] + oy) * spacing[1]
    kept = local.ravel() > 0.0
    volume = local.ravel() * spacing[0] * spacing[1] / k**2
    return x.ravel()[kept], y.ravel()[kept], volume[kept]


def _split_equally(x, y, share, count):
    """Cut the samples into `count` groups of equal volume, always across the longer side (a k-d tree)."""
    group = np.zeros(x.size, np.int64)
    parts = np.array([count])  # how many particles each group still stands for
    while parts.max() > 1:
        low_x, high_x = _extent(x, group, parts.size)
        low_y, high_y = _extent(y, group, parts.size)
        along = np.where((high_x - low_x >= high_y - low_y)[group], x, y)
        across = np.where((high_x - low_x >= high_y - low_y)[group], y, x)
        order = np.lexsort((across, along, group))
        sorted_group, sorted_share = group[order], share[order]
        total = np.bincount(sorted_group, sorted_share, parts.size)
        before = np.concatenate([[0.0], np.cumsum(total)[:-1]])
        middle = np.cumsum(sorted_share) - 0.5 * sorted_share - before[sorted_group]
        left_parts = parts // 2
        goes_left = middle < (total * left_parts / parts)[sorted_group]
        first = np.cumsum(np.where(parts > 1, 2, 1)) - np.where(parts > 1, 2, 1)  # new number of each group
        group[order] = first[sorted_group] + np.where(goes_left, 0, parts[sorted_group] > 1)
        split = np.empty(first[-1] + (2 if parts[-1] > 1 else 1), np.int64)
        split[first] = np.where(parts > 1, left_parts, 1)
        split[first[parts > 1] + 1] = (parts - left_parts)[parts > 1]
        parts = split
    return group


def _extent(values, group, groups):
    low, high = np.full(groups, np.inf), np.full(groups, -np.inf)
    np.minimum.at(low, group, values)
    np.maximum.at(high, group, values)
    return low, high


def _relax(x, y, sample_x, sample_y, share, depth, spacing, read_ground):
    """Let the particles repel each other while the samples, with negative volume, hold them in place.

    The force is the gradient of the distance between the particles' thickness and the samples', both
    seen through the smoothing kernel, so edges and uneven depths are at rest when the particles stand
    for the samples best. Particles do not leave the failing cells.
    """
    n, volume = x.size, share.sum() / x.size

    def length_and_ground(px, py):
        ground = read_ground(px, py)
        cosine = 1.0 / np.sqrt(1.0 + ground[1] ** 2 + ground[2] ** 2)
        here = np.maximum(_depth_at(depth, spacing, px, py), THICKNESS_RANGE * depth.max())  # as in a flow
        return SMOOTHING_RATIO * np.sqrt(volume / (here * cosine)), cosine, ground[0]

    sample_length, _, sample_z = length_and_ground(sample_x, sample_y)
    volumes = np.concatenate([np.full(n, volume), -share])
    rest, ones = np.zeros((3, volumes.size)), np.ones(volumes.size)
    sums = Sums(np.empty(n), np.empty(n), np.empty(n), np.empty((3, n)), np.empty(n))  # holes are not moved
    push = sums.acceleration
    for _ in range(SWEEPS):
        length, cosine, z = length_and_ground(x, y)
        lengths = np.concatenate([length, sample_length])
        px, py = np.concatenate([x, sample_x]), np.concatenate([y, sample_y])
        pz = np.concatenate([z, sample_z])
        cells = sort_into_cells(px, py, 2.0 * lengths)
        moving = Moving(px, py, pz, rest, volumes, lengths, lengths, 0.5 * ones, ones, ones, rest[0], ones)
        sum_over_neighbours(cells, moving, 0.0, sums)
        step = STEP * length**2 / (_depth_at(depth, spacing, x, y) * cosine)
        step = step * np.minimum(1.0, 0.2 * length / np.maximum(step * np.hypot(push[0], push[1]), 1e-300))
        new_x, new_y = x + step * push[0], y + step * push[1]
        inside = _depth_at(depth, spacing, new_x, new_y) > 0.0
        x, y = np.where(inside, new_x, x), np.where(inside, new_y, y)
    return x, y
