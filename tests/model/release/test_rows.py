"""Particles of a release in the order of rows: the same particles, with the same parts of cells."""

import numpy as np

from landlab_debrisflow.model.release.placing import Placed
from landlab_debrisflow.model.release.rows import in_rows


def test_particles_of_a_site_stand_in_rows_and_keep_their_cells():
    rng = np.random.default_rng(3)
    n = 400
    site, x, y = np.repeat([0, 1], 200), rng.uniform(0.0, 40.0, n), rng.uniform(0.0, 40.0, n)
    particle = np.repeat(np.arange(n), 2)
    placed = Placed(
        x, y, np.full(n, 1.5), rng.uniform(3.0, 4.0, n), site, particle, rng.integers(0, 99, 2 * n), rng.random(2 * n)
    )
    found = in_rows(placed)
    np.testing.assert_array_equal(found.site, site)
    assert np.all(np.diff(found.particle) >= 0)
    cells = [
        {(p.x[k], p.y[k], p.volume[k]): sorted(zip(p.cell[p.particle == k], p.part[p.particle == k], strict=True))
         for k in range(n)}
        for p in (placed, found)
    ]  # fmt: skip
    assert cells[0] == cells[1]
    # mean distance to the next in memory: 40 / 3 * sqrt(2) or so at random, a spacing of 2.8 or so in rows
    step = [np.median(np.hypot(np.diff(p.x[:200]), np.diff(p.y[:200]))) for p in (placed, found)]
    assert step[1] < 0.4 * step[0]
