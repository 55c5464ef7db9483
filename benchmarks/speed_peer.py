"""AvaFrame com1DFA 2.1 and ours on the similarity solution, at equal numbers of particles and at equal error.

Its number of particles follows from its kernel radius by its own law (validation/rivals/com1dfa.py). Ours are without
column and erosion. CPU time is that of the loop over time alone, one thread, for both. The norm is the relative L2 of
h at the true time. Its state lives on a raster, ours under particles; both are compared both ways.
"""

import math
from typing import NamedTuple

from landlab_debrisflow.exact import flows
from validation.cases.planes import similarity_body
from validation.measure import advance, body, norms
from validation.rivals import com1dfa

RADII = 5.0, 4.125, 3.0, 2.0  # kernel radii [m]: 5119, some 1e4, 30 629 and 126 110 particles
FEW = 16, 32, 64, 128, 256, 512, 1024


class Row(NamedTuple):
    """One run; errors are relative L2 of h [-]."""

    particles: int
    steps: int
    cpu: float  # [s]
    particle_error: float
    raster_error: float

    @property
    def rate(self) -> float:
        """Million particle-steps per CPU second."""
        return self.particles * self.steps / self.cpu / 1e6


def peer(python, radius) -> Row:
    """Run com1DFA."""
    found = com1dfa.similarity(python, radius)
    return Row(found.particles, found.steps, found.cpu, found.scalars["L2 of h at particles"], found.h.l2)


def ours(particles, repeats=1) -> Row:
    """Run ours; least CPU time of some."""
    cpus, cos = [], math.cos(math.radians(35.0))
    for _ in range(repeats):
        flow = similarity_body(particles)
        cpu, steps = advance(flow, 5.0)
        cpus.append(cpu)
    b, grid = body(flow), flow.grid
    at_particles = norms(b.volume / b.h, b.h, flows.similarity(b.x / cos, b.y, flow.elapsed_time)[0])
    depth = grid.at_node["debris_flow__depth"]
    at_nodes = norms(1.0, cos * depth, flows.similarity(grid.x_of_node / cos, grid.y_of_node, flow.elapsed_time)[0])
    return Row(particles, steps, min(cpus), at_particles.l2, at_nodes.l2)


def compare(python, radii, put):
    """Return rows of both at equal numbers, and ours as good as its best row, by particles and on the raster.

    Returns
    -------
    both : list of tuple
        Its row and ours.
    equal : dict
        What was compared: the error to reach, its row, and the first of ours that reaches it (or None), of few
        particles and of those at equal numbers.
    """
    both = []
    for radius in radii:
        its = peer(python, radius)
        mine = ours(its.particles, 3 if its.particles < 50_000 else 1)
        put(f"com1DFA, {its.particles} particles: {its.cpu:.2f} CPU s, ours {mine.cpu:.2f}")
        both.append((its, mine))
    best = min((its for its, _ in both), key=lambda its: its.raster_error)
    few = [ours(n, 3) for n in FEW]
    many = [mine for _, mine in both]

    def first(rows, error, field):
        return next((row for row in rows if getattr(row, field) <= error), None)

    return both, {
        "ours under particles, its raster": (best.raster_error, best, first(few, best.raster_error, "particle_error")),
        "under particles, both": (best.particle_error, best, first(few, best.particle_error, "particle_error")),
        "on the raster, both": (best.raster_error, best, first(few + many, best.raster_error, "raster_error")),
    }
