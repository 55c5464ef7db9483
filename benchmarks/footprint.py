"""Areas of bodies whose area is known, from the footprints of their particles: python -m benchmarks.footprint

Bodies that end steeply, roundly, with a slope and with a film; streams of such sections; nodes of 1 m. Their particles
have equal volumes and the depth that the sums over neighbours find. Table: error of the area deeper than 0.1 m, and of
the depth (sum of all differences over the volume) in %, with whole hat functions and with footprints as they are, which
are sharpened at the edge. Takes two minutes.
"""

import argparse

import numpy as np
from scipy.spatial import cKDTree

from landlab_debrisflow.spatial.cells import sort_into_cells
from landlab_debrisflow.spatial.footprints import on_nodes
from landlab_debrisflow.spatial.packing import Position
from landlab_debrisflow.spatial.raster import CORE, Raster
from landlab_debrisflow.spatial.summation import SMOOTHING_RATIO, SummationInput, Sums, sum_over_neighbours
from landlab_debrisflow.spatial.transfer import WIDEST, Cover, scatter

SIZE, SEEN = 91, 0.1  # nodes along a side; depth that counts [m]
FINE = 0.05  # of the points by which a body is known [m]
SWEEPS, SAMPLES, DISORDER = 30, 60, 0.06  # of the relaxation; points a particle; displacement over spacing
BODIES = {
    "disc": lambda x, y: 1.0 * (np.hypot(x, y) < 22.0),
    "round": lambda x, y: 1.5 * np.sqrt(np.maximum(0.0, 1.0 - (x**2 + y**2) / 22.0**2)),
    "cap": lambda x, y: 2.0 * np.maximum(0.0, 1.0 - (x**2 + y**2) / 24.0**2),
    "film": lambda x, y: 3.0 * np.maximum(0.0, 1.0 - (x**2 + y**2) / 28.0**2) ** 2,
    "stream, parabolic": lambda x, y: 1.5 * np.maximum(0.0, 1.0 - (y / 6.0) ** 2) * (abs(x) < 34.0),
    "stream, triangular": lambda x, y: 2.0 * np.maximum(0.0, 1.0 - abs(y) / 4.0) * (abs(x) < 34.0),
    "stream, round": lambda x, y: 1.5 * np.sqrt(np.maximum(0.0, 1.0 - (y / 3.0) ** 2)) * (abs(x) < 34.0),
    "stream, rectangular": lambda x, y: 1.0 * (abs(y) < 2.5) * (abs(x) < 34.0),
}
"""Depth [m] at points [m] from the middle."""


def place(depth, count, rng):
    """Return x, y, shape (count,) [m], and volume [m3] of particles of a body: centres of cells of equal volume."""
    line = np.arange(-44.0, 44.0, FINE)
    points = np.stack([values.ravel() for values in np.meshgrid(line, line)], axis=1)
    here = depth(*points.T)
    total, points, here = here.sum() * FINE**2, points[here > 0.0], here[here > 0.0]
    chosen = rng.choice(here.size, min(here.size, SAMPLES * count), replace=False)
    points, here = points[chosen] + rng.uniform(-0.5, 0.5, (chosen.size, 2)) * FINE, here[chosen]
    cell = here.size and total / here.sum()  # map area of a point [m2]
    centre = points[rng.choice(here.size, count, replace=False, p=here / here.sum())]
    lift = np.zeros(count)  # a cell grows with it: power diagram
    for sweep in range(SWEEPS):
        tree = cKDTree(np.column_stack([centre, np.sqrt(lift.max() - lift)]))
        _, owner = tree.query(np.column_stack([points, np.zeros(here.size)]))
        weight, number = np.bincount(owner, here, count), np.bincount(owner, minlength=count)
        moved = np.stack([np.bincount(owner, here * values, count) for values in points.T], axis=1)
        centre = np.where(weight[:, None] > 0.0, moved / np.maximum(weight, 1e-300)[:, None], centre)
        if sweep > 4:
            area = np.maximum(number, 0.2 * here.size / count) * cell
            lift += 0.35 * area / np.pi * (1.0 - weight * count / here.sum())
    spacing = np.sqrt(np.maximum(number, 1) * cell)
    return *(centre + rng.normal(0.0, DISORDER, centre.shape) * spacing[:, None]).T, total / count


def summed_depth(x, y, volume, least=1.0 / 64.0):
    """Return the depth that sums over neighbours find, shape (n,) [m], of particles of a volume [m3] at x, y [m]."""
    n = x.size
    zeros, ones, thickness = np.zeros((3, n)), np.ones(n), np.full(n, 1.0)
    sums = Sums(thickness=np.empty(n), gradient_term=np.empty(n), next_length=np.empty(n),
                acceleration=np.empty((3, n)), convergence=np.empty(n))  # fmt: skip
    for _ in range(12):
        length = SMOOTHING_RATIO * np.sqrt(volume / np.maximum(thickness, least))
        given = SummationInput(
            position=Position(x, y, zeros[0]), velocity=zeros, volume=np.full(n, volume), smoothing_length=length,
            longest=length, pressure_coefficient=ones, celerity=ones, thickness=thickness, convergence=zeros[0],
            inertia=ones,
        )  # fmt: skip
        sum_over_neighbours(sort_into_cells(x, y, 2.0 * length), given, 0.0, sums)
        thickness = np.sqrt(thickness * sums.thickness)
    return thickness


def whole(raster, x, y, volume, depth):
    """Return the volume at nodes, shape (nodes,) [m3], of particles as whole hat functions."""
    half_width = np.clip(2.0 * np.sqrt(volume / depth), 1.0, WIDEST)[:, None]
    across, along = (
        np.maximum(0.0, 1.0 - abs(values[:, None] - np.arange(count)) / half_width)
        for values, count in ((x, raster.columns), (y, raster.rows))
    )
    across, along = (values / values.sum(axis=1)[:, None] for values in (across, along))
    return np.einsum("nr,nc->rc", volume[:, None] * along, across).ravel()


def sharpened(raster, x, y, volume, depth):
    """Return the volume at nodes, shape (nodes,) [m3], of particles with footprints that end at the edge."""
    sums = np.zeros((raster.status.size, 1))
    footprints = Cover(raster).footprints(x, y, volume, depth, np.ones(x.size))
    scatter(on_nodes(footprints), volume[:, None], sums, np.empty(raster.status.size, np.int64))
    return sums[:, 0]


def errors(body, count, seed):
    """Return spacing over that of nodes [-], and errors of area and depth [%], (2, 2): whole hat functions, footprints.

    `body` is a key of `BODIES`, of which `count` particles are made; direction and place on the nodes are random.
    """
    rng = np.random.default_rng([count, seed])
    angle, middle = rng.uniform(0.0, np.pi), 0.5 * (SIZE - 1) + rng.uniform(-0.5, 0.5, 2)
    cosine, sine = np.cos(angle), np.sin(angle)

    def depth(x, y):
        return BODIES[body](x * cosine + y * sine, y * cosine - x * sine)

    x, y, volume = place(depth, count, rng)
    found, line = summed_depth(x, y, volume), np.arange(-44.0, 44.0, 0.1)
    area = np.count_nonzero(depth(*np.meshgrid(line, line)) > SEEN) * 0.01
    nodes = np.arange(SIZE)
    exact = depth(*np.meshgrid(nodes - middle[0], nodes - middle[1])).ravel()
    raster = Raster.from_status(np.full((SIZE, SIZE), CORE), (1.0, 1.0))
    table = []
    for spread in (whole, sharpened):
        shown = spread(raster, x + middle[0], y + middle[1], np.full(count, volume), found)
        table.append((np.count_nonzero(shown > SEEN) / area - 1.0, abs(shown - exact).sum() / exact.sum()))
    return np.median(np.sqrt(volume / found)), 100.0 * np.array(table)


def main(arguments=None) -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.footprint", description=__doc__.splitlines()[0])
    parser.add_argument("--particles", default="250,500,1000,2000,4000", help="numbers with commas between them")
    parser.add_argument("--seeds", type=int, default=2, help="bodies of each kind")
    options = parser.parse_args(arguments)
    print(f"{'body':20} particles spacing   area: whole  sharp   depth: whole sharp")
    for count in map(int, options.particles.split(",")):
        squares = []
        for body in BODIES:
            number = count // 2 if body.startswith("stream") else count
            runs = [errors(body, number, seed) for seed in range(options.seeds)]
            spacing, found = np.mean([run[0] for run in runs]), np.mean([run[1] for run in runs], axis=0)
            squares.append(found[:, 0] ** 2)
            print(f"{body:20} {number:9} {spacing:7.2f} {found[0, 0]:+13.1f} {found[1, 0]:+6.1f} "
                  f"{found[0, 1]:13.1f} {found[1, 1]:5.1f}", flush=True)  # fmt: skip
        mean = np.sqrt(np.mean(squares, axis=0))
        print(f"{'root mean square':20} {'':9} {'':7} {mean[0]:13.1f} {mean[1]:6.1f}\n", flush=True)


if __name__ == "__main__":
    main()
