"""Record of a run of `tsing_shan.py`, and its measures."""

import numpy as np

from landlab_debrisflow import measures
from landlab_debrisflow.record import quantile

LOOK = 0.5
"""Time between two records of the particles [s], and the uncertainty of times since the front left erodible ground."""

TIMES = (0.0, 32.0, 66.0, 100.0, 160.0, 250.0, 400.0)
"""Times of the figures of Pastor et al. (2022), where 32 and 33 s, and 100 and 150 s, name the same plots; 17 has 160
[s]."""

SINCE = (0.0, 4.0, 8.0, 16.0, 32.0, 128.0)
"""Times since the front left erodible ground [s]; from 0 to 128 it is as long as from 32 to 160 in figure 17."""

PECLET_TIME = 40.0
"""Time of the map of Péclet numbers, figure 18 [s]."""

FRONT_FRACTION = 0.99
"""Fraction of the volume that lies behind the front: single particles far ahead do not count [-]."""

DEPOSIT = 0.1
"""Least depth that counts as deposit [m]."""

MEASURES = {
    "final": ("final volume [m3]", "{:.0f}"),
    "eroded": ("eroded [m3]", "{:.0f}"),
    "outflow": ("outflow over the edges [m3]", "{:.0f}"),
    "residual": ("residual of the balance [m3]", "{:.1e}"),
    "deepest": ("deepest erosion [m]", "{:.2f}"),
    "soil left": ("least soil left where there was any [m]", "{:.2f}"),
    "run-out": ("run-out of the front from the release [m]", "{:.1f}"),
    "beyond": ("  of it beyond erodible ground, to a node [m]", "{:.0f}"),
    "farthest": ("run-out of the farthest particle [m]", "{:.1f}"),
    "centre": ("run-out of the centre of mass [m]", "{:.1f}"),
    "angle": ("travel angle, crown to front [deg]", "{:.1f}"),
    "mean deposit": ("mean deposit beyond erodible ground [m]", "{:.3f}"),
    "area": ("area of that deposit [m2]", "{:.0f}"),
    "passing": ("the front leaves erodible ground at [s]", "{:.1f}"),
    "peclet": ("Pe_b of what erodes then, median by volume", "{:.3g}"),
    "peclet 5": ("  exceeded by 95 % of it", "{:.3g}"),
    "peclet 40": ("Pe_b of what erodes at 40 s, median", "{:.3g}"),
    "eroding 40": ("  share of the volume that erodes at 40 s", "{:.3f}"),
    "still": ("at rest since [s]", "{:.1f}"),
}
"""Words and format of each measure. Distances are in plan, from the centre of the release; the front is where
99 % of the volume lies behind; deposit counts nodes with at least 0.1 m."""


class Record:
    """A run: the ground before it, the places of particles against time, and their columns at some times.

    Parameters
    ----------
    grid : RasterModelGrid
        Before the run.

    Attributes
    ----------
    times, x, y
        Of every look [s, m]; arrays of shape (looks,) and (looks, particles).
    snapshots : dict
        For every time of `TIMES` and `PECLET_TIME` and every (``"since"``, time) of `SINCE`, what `snapshot` returns.
    passing : float or None
        Time of the look that first saw a particle beyond erodible ground [s].
    marked : int or None
        The particle whose column is shown: of those that erode then, the one in the middle of their distances.
    measures : dict
        Values of `MEASURES`.
    """

    def __init__(self, grid):
        self.shape, self.dx = grid.shape, grid.dx
        self.corner = np.array(grid.xy_of_lower_left)
        names = ("topographic__elevation", "soil__depth", "debris_flow__release_depth")
        self.elevation, self.soil, self.release = (grid.at_node[name].reshape(grid.shape).copy() for name in names)
        self.node_x, self.node_y = grid.x_of_node.reshape(grid.shape), grid.y_of_node.reshape(grid.shape)
        self.centre = np.array([np.average(axis, weights=self.release) for axis in (self.node_x, self.node_y)])
        self.times, self.x, self.y, self.snapshots = [], [], [], {}
        self.passing = self.marked = None

    def follow(self, flow, duration):
        """Run `flow` to its end and record it."""
        before = flow.maps
        flow.run_one_step(1e-6)  # takes the release
        self.look(flow, 0.0)
        self.snapshots[0.0] = self.snapshot(flow)
        self.still = np.nan
        ticks = np.arange(1, int(duration / LOOK) + 1) * LOOK
        for time in ticks:
            wanted = [t for t in (*TIMES, PECLET_TIME) if t == time]
            since = [s for s in SINCE if self.passing is not None and self.passing + s == time]
            if flow.at_rest and not wanted and not since and time < duration:
                continue  # at rest columns only consolidate
            flow.run_one_step(time - flow.elapsed_time)
            if flow.at_rest and np.isnan(self.still):
                self.still = time
            self.look(flow, time)
            if self.passing is None and not self.on_soil(flow.particles).all():
                self.passing, since = time, [0.0]
            if wanted or since:
                now = self.snapshot(flow)
                self.snapshots |= dict.fromkeys(wanted, now) | {("since", s): now for s in since}
                if self.marked is None and self.passing is not None:
                    self.marked = self.mark(now["particles"])
        self.maps, self.end = flow.maps, self.snapshot(flow)
        self.budget = flow.budget
        self.measures = self.measure(flow, before)

    def look(self, flow, time):
        """Keep the places of the particles."""
        now = flow.particles
        self.times.append(time)
        self.x.append(now.x.values)
        self.y.append(now.y.values)

    def snapshot(self, flow):
        """Return particles, pressures of the columns, and the depth of deposit and flow together."""
        depth, here = flow.grid.at_node["debris_flow__depth"], flow.grid.at_node["debris_flow__basal_peclet_number"]
        return {
            "time": round(flow.elapsed_time, 3), "particles": flow.particles,
            "columns": flow.columns["excess_pore_pressure"].values.astype(np.float32),
            "depth": depth.reshape(self.shape).copy(), "peclet": here.reshape(self.shape).copy(),
        }  # fmt: skip

    def marked_column(self, key):
        """Return pressure over height [Pa] of the marked particle in a snapshot, and its liquefaction pressure [Pa]."""
        now = self.snapshots[key]
        at = np.searchsorted(now["particles"].particle.values, self.marked)
        return now["columns"][at], float(now["particles"].liquefaction_pressure[at])

    def on_soil(self, particles):
        """Return whether the node nearest to each particle had soil."""
        column = np.rint((particles.x.values - self.corner[0]) / self.dx).astype(int)
        row = np.rint((particles.y.values - self.corner[1]) / self.dx).astype(int)
        row, column = np.clip(row, 0, self.shape[0] - 1), np.clip(column, 0, self.shape[1] - 1)
        return self.soil[row, column] > 0.0

    def distance(self, x, y):
        """Return the plan distance from the centre of the release [m]."""
        return np.hypot(x - self.centre[0], y - self.centre[1])

    def mark(self, particles):
        """Return the particle in the middle of the eroding part of the flow, by distance."""
        eroding = np.flatnonzero(particles.entrainment_rate.values > 0.0)
        if eroding.size == 0:
            return None
        far = self.distance(particles.x.values[eroding], particles.y.values[eroding])
        return int(particles.particle[eroding[np.argsort(far)[eroding.size // 2]]])

    # ---- measures ----

    def measure(self, flow, before):
        """Return `MEASURES` of the end of the run; `before` are the maps of the flow before it."""
        bare = self.soil == 0.0
        whole = measures(flow, before, front_fraction=FRONT_FRACTION)
        beyond = measures(self.maps, inside=bare, deposit_threshold=DEPOSIT)
        eroded = self.maps.debris_flow__eroded_depth.fillna(0.0).values  # closed nodes are missing
        crossed = bare & (self.maps.debris_flow__max_depth.values > 0.0)
        line = self.distance(self.node_x, self.node_y)[crossed].min(initial=np.inf)
        passing, forty = (self.peclet(self.snapshots.get(key)) for key in (("since", 0.0), PECLET_TIME))
        front = float(whole.run_out)
        return {
            "final": self.budget["moving"] + self.budget["deposited"], "eroded": self.budget["eroded"],
            "outflow": self.budget["outflow"], "residual": self.budget["residual"],
            "deepest": float(whole.max_eroded_depth),
            "soil left": (self.soil - self.release - eroded)[eroded > 0.0].min(initial=np.inf),
            "run-out": front, "beyond": front - line, "farthest": float(whole.farthest_run_out),
            "centre": float(whole.centre_run_out), "angle": float(whole.travel_angle),
            "passing": np.nan if self.passing is None else self.passing,
            "mean deposit": float(beyond.mean_deposit_depth), "area": float(beyond.deposit_area),
            "peclet": passing[0], "peclet 5": passing[1], "peclet 40": forty[0], "eroding 40": forty[2],
            "still": self.still,
        }  # fmt: skip

    @staticmethod
    def peclet(snapshot):
        """Return median and 5 % quantile, by volume, of the basal Péclet number of what erodes, and its share."""
        if snapshot is None:
            return np.nan, np.nan, np.nan
        p = snapshot["particles"]
        eroding = p.entrainment_rate.values > 0.0
        if not eroding.any():
            return np.nan, np.nan, 0.0
        number, volume = p.basal_peclet_number.values[eroding], p.volume.values[eroding]
        return quantile(number, volume, 0.5), quantile(number, volume, 0.05), volume.sum() / p.volume.values.sum()


def first_difference(one, other):
    """Return the time of the first look at which two runs differ in any bit of any position [s]; infinite if none."""
    for time, *places in zip(one.times, one.x, other.x, one.y, other.y, strict=False):
        if not (np.array_equal(*places[:2]) and np.array_equal(*places[2:])):
            return time
    return np.inf
