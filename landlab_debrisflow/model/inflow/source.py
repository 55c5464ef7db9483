"""Line across which a hydrograph flows in, and the volume that has crossed it at any time."""

import numpy as np

from ...core.errors import InputError
from ...spatial.summation import SMOOTHING_RATIO
from .hydrograph import Hydrograph, Integral

LEAST_FALL = 1e-6
"""Slope across the line below which the ground counts as level, so that the direction of the flow must be given [-]."""

PARTS_OF_A_ROW = 4
"""Number of parts of a row, of equal volume, over which its thickness is averaged."""


class Source:
    """One hydrograph: its line, and its rows one after the other.

    Parameters
    ----------
    hydrograph : Hydrograph
        Line [m], discharge [m3 s-1] and velocity [m s-1] against time.
    particle_volume : float
        Wanted volume of a particle [m3].
    lower_left : array_like, shape (2,)
        Map coordinates of the lower left node [m].
    """

    def __init__(self, hydrograph: Hydrograph, particle_volume: float, lower_left):
        self.hydrograph = hydrograph
        self.start, self.end = np.subtract([hydrograph.line_start, hydrograph.line_end], lower_left)
        self.times = np.array(hydrograph.times)
        self.discharge, self.velocity = hydrograph.series("discharge", "velocity")
        self.entered, self.way = Integral(self.times, self.discharge), Integral(self.times, self.velocity)
        self.particles = max(1, round(self.entered.total / particle_volume))
        self.particle_volume = self.entered.total / self.particles
        self.strip = 2.0 * SMOOTHING_RATIO * np.sqrt(self.particle_volume / hydrograph.largest_thickness)

    @property
    def y_range(self):
        """Least and largest y from the lower left node where the flow may enter [m]."""
        ends = self.start[1], self.end[1]
        return min(ends) - self.strip, max(ends) + self.strip

    def rows(self):
        """Return time [s] and thickness [m] of every row and how many particles are in it."""
        rows, before, each = [], 0, self.particle_volume
        while before < self.particles:
            count = 1
            for _ in range(8):  # thickness and number of particles in the row follow from each other
                fit = self.hydrograph.width * np.sqrt(self._row(before, count)[1] / each)
                count = min(max(1, round(fit)), self.particles - before)
            rows.append((*self._row(before, count), count))
            before += count
        return rows

    def _row(self, before, count):
        """Return when half of a row has crossed the line [s], and its thickness, in the mean over the row [m].

        The thickness at that one time would not do: between two surges that share a row it may be 0.
        """
        time = self.entered.when((before + 0.5 * count) * self.particle_volume)
        parts = before + count * (np.arange(PARTS_OF_A_ROW) + 0.5) / PARTS_OF_A_ROW
        times = [self.entered.when(part * self.particle_volume) for part in parts]
        discharge, velocity = self.at(times, self.discharge), self.at(times, self.velocity)
        thickness = np.divide(discharge, velocity, out=np.zeros(len(times)), where=velocity > 0.0)
        return time, thickness.mean() / self.hydrograph.width

    def at(self, time, values):
        """Return the value at `time` [s] of a quantity whose `values`, in any unit, are given at the hydrograph's."""
        return np.interp(time, self.times, values)

    def direction(self, surface):
        """Return the unit vector of the flow, shape (2,): as the hydrograph says, or as the ground falls.

        Raises
        ------
        InputError
            If the ground falls to neither side of the line.
        """
        if (given := self.hydrograph.direction) is not None:
            return np.array([np.cos(np.radians(given)), np.sin(np.radians(given))])
        along = self.end - self.start
        left = np.array([-along[1], along[0]]) / np.hypot(*along)
        share = (np.arange(64) + 0.5) / 64
        sample = surface.sample(*(self.start[:, None] + share * along[:, None]))
        if abs(fall := left @ [sample.slope_x.mean(), sample.slope_y.mean()]) < LEAST_FALL:
            h, degrees = self.hydrograph, np.degrees(np.arctan2(left[1], left[0]))
            raise InputError(
                f"inflow: the ground falls to neither side of the line from {h.line_start} to {h.line_end} m; "
                f"give its direction: {degrees:.4g} or {(degrees + 180.0) % 360.0:.4g} deg from east"
            )
        return -left * np.sign(fall)
