"""Random releases as users have them, and what must hold for each of them; prints how many fail, kind by kind.

    python -m tests.model.release_fields [NUMBER_OF_EACH]

It uses the public interface only, so any installed version can be asked.
"""

import logging
import sys

import numpy as np
from landlab import RasterModelGrid
from scipy import ndimage

from landlab_debrisflow import DebrisFlow

SHAPE = (24, 30)


def mound(rng, x, y):
    """A Gaussian whose tail falls over at least six decades."""
    height, width = 10.0 ** rng.uniform(-1, 1.5), rng.uniform(2.0, 4.5)
    r2 = (x - rng.uniform(8, 20)) ** 2 + (y - rng.uniform(8, 15)) ** 2
    return height * np.exp(-r2 / width**2) * (r2 < 16.0 * width**2)


def isolated_cells(rng, x, y):
    """A few single cells far from each other, shallow and deep."""
    depth = np.zeros(x.shape)
    for _ in range(rng.integers(1, 9)):
        depth[3 * rng.integers(1, 7), 3 * rng.integers(1, 9)] = 10.0 ** rng.uniform(-1, 1)
    return depth


def ring(rng, x, y):
    """A ring one to three cells wide, sometimes with something in its middle."""
    r = np.hypot(x - 14, y - 11)
    depth = np.where(abs(r - rng.uniform(4, 8)) < rng.uniform(0.7, 1.6), rng.uniform(0.2, 4.0), 0.0)
    return depth + np.where(r < 1.2, rng.choice([0.0, 1.0]), 0.0)


def speckles(rng, x, y):
    """More than a hundred sites, as a factor of safety with noise marks them."""
    marked = (np.add.outer(np.arange(SHAPE[0]), np.arange(SHAPE[1])) % 2 == 0) & (rng.random(x.shape) < 0.7)
    return np.where(marked, rng.uniform(0.1, 3.0), 0.0)


def decades(rng, x, y):
    """Neighbouring cells whose depths differ by a factor of up to a million."""
    inside = np.hypot(x - 14, y - 11) < rng.uniform(2, 8)
    return np.where(inside, 10.0 ** rng.uniform(-5, 1, x.shape), 0.0) + np.where(inside & (x == 14), 10.0, 0.0)


def slivers(rng, x, y):
    """A slab, and cells where a difference of two rasters left some 1e-15 m, beside it and alone."""
    slab = (abs(x - 14) < rng.uniform(1, 6)) & (abs(y - 11) < rng.uniform(1, 5))
    return np.where(slab, rng.uniform(0.3, 3.0), np.where(rng.random(x.shape) < 0.1, 1e-15 * rng.random(x.shape), 0.0))


def towers(rng, x, y):
    """Thicker than wide: up to 200 m on one cell or a few."""
    c, r = rng.integers(5, 22), rng.integers(5, 16)
    depth = np.zeros(x.shape)
    depth[r : r + rng.integers(1, 3), c : c + rng.integers(1, 3)] = rng.uniform(30.0, 200.0)
    return depth


def everywhere(rng, x, y):
    """Every core node fails by a random depth."""
    return rng.random(x.shape)


def slab(rng, x, y):
    """A plain slab from 10 cm to 20 m."""
    inside = np.hypot(x - 14, (y - 11) * rng.uniform(0.5, 2)) < rng.uniform(1, 9)
    return np.where(inside, 10.0 ** rng.uniform(-1, 1.3), 0.0)


KINDS = (mound, isolated_cells, ring, speckles, decades, slivers, towers, everywhere, slab)


SPACINGS = ((5.0, 5.0), (5.0, 5.0), (0.5, 0.7), (1.0 / 3.0, 10.0), (17.3, 20.0))
"""Node spacings (dx, dy) [m]."""

_grids = {}


def empty_grid(spacing, offset):
    """Return a grid without fields and with open edges; each is made once, which takes longer than what is tested."""
    key = spacing, offset
    if key not in _grids:
        _grids[key] = RasterModelGrid(SHAPE, xy_spacing=spacing, xy_of_lower_left=offset)
    grid = _grids[key]
    for name in list(grid.at_node):
        grid.delete_field("node", name)
    grid.status_at_node[:] = grid.BC_NODE_IS_CORE
    grid.status_at_node[grid.perimeter_nodes] = grid.BC_NODE_IS_FIXED_VALUE
    return grid


def make(kind, seed):
    """Return a grid with a release of some kind, and numerics."""
    rng = np.random.default_rng([KINDS.index(kind), seed])
    spacing = SPACINGS[rng.integers(len(SPACINGS))]
    offset = (0.0, 0.0) if rng.random() < 0.5 else (587_312.7, 5_204_118.3)
    grid = empty_grid(spacing, offset)
    y, x = np.mgrid[0.0 : SHAPE[0], 0.0 : SHAPE[1]]
    slope = rng.uniform(-0.6, 0.6, 2)
    z = rng.choice([0.0, 2000.0]) + slope[0] * x * spacing[0] + slope[1] * y * spacing[1] + rng.normal(0, 0.1, SHAPE)
    if rng.random() < 0.4:
        grid.set_closed_boundaries_at_grid_edges(True, True, True, True)
    grid.add_field("topographic__elevation", z.ravel(), at="node")
    depth = np.where(grid.status_at_node == 0, kind(rng, x, y).ravel(), 0.0)
    if not depth.any():
        depth[12 * SHAPE[1] + 14] = 1.0
    grid.add_field("debris_flow__release_depth", depth, at="node")
    return grid, {"particle_count": int(np.ceil(10.0 ** rng.uniform(0, 2.3))), "settle": False}


def examine(kind, seed) -> None:
    """Release it and look at every site; raise if something does not hold."""
    grid, numerics = make(kind, seed)
    depth, area = grid.at_node["debris_flow__release_depth"].copy(), grid.dx * grid.dy
    site, sites = ndimage.label(depth.reshape(SHAPE) > 0.0)
    volume = np.bincount(site.ravel(), depth)[1:] * area
    flow = DebrisFlow(grid, numerics=numerics, erosion="none")
    flow.run_one_step(1e-9)
    p = flow.particles
    at = site.ravel()[grid.find_nearest_node((p.x.values, p.y.values))]
    if np.any(at == 0):
        raise AssertionError("a particle starts outside the failing cells")
    if np.any(np.bincount(at, minlength=sites + 1)[1:] == 0):
        raise AssertionError("a site has no particle")
    # a sum of n numbers is rounded to sqrt(n) eps, and each particle's volume once
    if np.any(abs(np.bincount(at, p.volume.values, sites + 1)[1:] / volume - 1.0) > 1e-13):
        raise AssertionError("a site has not its volume")
    for k in range(1, min(sites, 20) + 1):
        if np.ptp(p.volume.values[at == k]) > 0.0:
            raise AssertionError("particles of a site differ in volume")
    for name, values in p.data_vars.items():
        if not np.all(np.isfinite(values)):
            raise AssertionError(f"{name} is not finite")
    flow.run_one_step(0.05)
    left = flow.budget["outflow"]
    if not np.any(grid.status_at_node == 1) and left > 0.0:
        raise AssertionError("something passed a closed edge")


def main(number: int) -> None:
    """Print how many releases of each kind fail, and why."""
    logging.getLogger("landlab_debrisflow").setLevel(logging.ERROR)
    for kind in KINDS:
        reasons = {}
        for seed in range(number):
            try:
                examine(kind, seed)
            except Exception as error:
                reason = f"{type(error).__name__}: {str(error)[:60]}"
                reasons[reason] = reasons.get(reason, 0) + 1
        print(f"{kind.__name__:>15} {sum(reasons.values()):5d} of {number} fail  {reasons or ''}", flush=True)


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 100)
