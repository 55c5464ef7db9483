"""Record of a scene: heads, energy and steps, by the public interface only.

Bounds. A body has the energy V (v^2/2 + g z + g cos(theta) h/2), summed over its particles; friction, shocks and walls
only take from it. A single particle may be pushed by others: along a characteristic |v| + 2 c is handed on, so the
front of a body that falls with U and opens runs at U + 2 c (Ritter; on a slope Mangeney: there v^2/2 - g dz
is at most 2 g h0 cos(theta)), and U is at most what the fall from the highest surface allows. Hence

    |v| <= (2 g (top + rise - z))^(1/2) + 2 (g h)^(1/2)

with the greatest thickness h of the body so far. `rise`: a step crosses at most a quarter of a node spacing,
on the steepest gradient between two nodes that is a height of gradient x spacing / 4; within it the work of gravity
along a bed that bends is not resolved.
"""

import time

import numpy as np

from landlab_debrisflow import DebrisFlow
from landlab_debrisflow.physics.column import NoExcessPressure
from landlab_debrisflow.physics.flow import OnePhase

G = 9.81


FINITE = ("x", "y", "z", "velocity_x", "velocity_y", "velocity_z", "volume", "depth", "thickness", "smoothing_length",
          "basal_excess_pore_pressure")  # fmt: skip
"""What must stay a number under every particle; a Péclet number is infinite where nothing consolidates."""


class Steps:
    """A column law that passes everything on to another, and keeps the lengths of the steps [s]."""

    def __init__(self, column=None):
        self.column, self.lengths = column or NoExcessPressure(), []
        self.levels, self.memory_size = self.column.levels, self.column.memory_size

    def advance(self, columns, forcing, dt, basal_pressure):
        if dt > 0.0:
            self.lengths.append(dt)
        self.column.advance(columns, forcing, dt, basal_pressure)

    def synchronise(self, columns, forcing):
        self.column.synchronise(columns, forcing)


class NoThrust:
    """A flow law without inner forces: particles have a thickness, and move alone."""

    def interact(self, state, cells, shock_viscosity, threads, sums):
        OnePhase().interact(state, cells, shock_viscosity, threads, sums)
        sums.acceleration[:], sums.convergence[:] = 0.0, 0.0


def unresolved_rise(grid):
    """Return a quarter of a node spacing on the steepest gradient between two nodes that are not closed [m]."""
    z = grid.at_node["topographic__elevation"].copy()
    z[grid.status_at_node == grid.BC_NODE_IS_CLOSED] = np.nan
    z = z.reshape(grid.shape)
    steepest = [np.nanmax(abs(np.diff(z, axis=axis)), initial=0.0) for axis in (0, 1)]
    return 0.25 * float(max(steepest))


class Watch:
    """An observer that measures heads and energy at every look.

    Attributes
    ----------
    energy, kinetic : list of float
        Of the body per weight, a head [m], as long as nothing has left.
    excess : float
        Largest speed over the bound of this module so far, negative: below [m/s].
    pressure : float
        The part of the energy at the first look that is in the thickness [m].
    head : float
        Largest z + v^2/2g of any particle over the top of the body before it moved [m].
    speed, allowed : float
        Largest speed, and what the fall alone allows that particle, (2 g (top - z))^(1/2) [m/s].
    """

    def __init__(self, grid, interval, gravity=G, keep=()):
        self.interval, self.g, self.rise = interval, gravity, unresolved_rise(grid)
        release, z = grid.at_node["debris_flow__release_depth"], grid.at_node["topographic__elevation"]
        # the ground before it fails is the surface of the body; a failing cell reaches half a spacing beyond its node
        self.pressure = 0.0
        self.top = float(z[release > 0.0].max()) + 2.0 * self.rise
        self.energy, self.kinetic, self.times, self.centre = [], [], [], []
        self.thickest, self.excess, self.head = float(release.max()), -np.inf, -np.inf
        self.speed, self.allowed, self.finite = 0.0, 0.0, True
        self.kept, self.keep = [], keep

    def observe(self, flow):
        p = flow.particles
        if p.sizes["particle"] == 0:
            return
        z, h, volume = p.z.values, p.thickness.values, p.volume.values
        speed = np.sqrt(p.velocity_x.values**2 + p.velocity_y.values**2 + p.velocity_z.values**2)
        self.thickest = max(self.thickest, float(h.max()))
        kinetic, cosine, mass = 0.5 * speed**2 / self.g, h / p.depth.values, volume.sum()
        self.times.append(flow.elapsed_time)
        if not self.energy:
            self.pressure = float((volume * 0.5 * cosine * h).sum() / mass)
        if flow.budget["outflow"] == 0.0:
            self.kinetic.append(float((volume * kinetic).sum() / mass))
            self.energy.append(float((volume * (kinetic + z + 0.5 * cosine * h)).sum() / mass))
            self.centre.append([float((volume * p[k].values).sum() / mass) for k in "xyz"])
        fall = np.sqrt(2.0 * self.g * np.maximum(self.top - z, 0.0))
        bound = np.sqrt(2.0 * self.g * np.maximum(self.top + self.rise - z, 0.0)) + 2.0 * np.sqrt(
            self.g * self.thickest
        )
        self.excess = max(self.excess, float((speed - bound).max()))
        self.head = max(self.head, float((z + kinetic).max()) - self.top)
        self.finite &= all(np.isfinite(p[name].values).all() for name in FINITE)
        fastest = int(np.argmax(speed))
        if speed[fastest] > self.speed:
            self.speed, self.allowed = float(speed[fastest]), float(fall[fastest])
        if self.keep:
            self.kept.append({name: p[name].values.copy() for name in self.keep})

    @property
    def gain(self):
        """Largest rise of the body's energy above what it had been before [m of head]."""
        energy = np.array(self.energy)
        return float((energy - np.minimum.accumulate(energy)).max())


class Scene:
    """A flow that is watched: built, made to appear, and run."""

    def __init__(self, grid, duration, angle=0.0, count=500, looks=50, keep=(), **keywords):
        self.grid, self.duration, self.steps, self.cpu = grid, duration, Steps(), 0.0
        material = {"water_density": 0.0, **keywords.pop("material", {})}
        numerics = {"settle": False, "rest_energy": 0.0, "particle_count": count, **keywords.pop("numerics", {})}
        self.watch = Watch(grid, duration / looks, material.get("gravity", G), keep)
        friction = {"law": "coulomb", "basal_friction_angle": angle}
        keywords = {"friction": friction, "erosion": "none", "column": self.steps, **keywords}
        self.flow = DebrisFlow(grid, material=material, numerics=numerics, observers=(self.watch,), **keywords)

    def run(self):
        self.flow.run_one_step(1e-9)  # what fails appears, in a step too short to move it
        self.watch.observe(self.flow)
        start = time.process_time()
        self.flow.run_one_step(self.duration)
        self.cpu = time.process_time() - start
        return self

    @property
    def imbalance(self):
        """Residual of the volume over what took part [-]."""
        b = self.flow.budget
        return abs(b["residual"]) / (b["released"] + b["eroded"])

    @property
    def speeds(self):
        p = self.flow.particles
        return np.sqrt(p.velocity_x.values**2 + p.velocity_y.values**2 + p.velocity_z.values**2)
