"""Hydrographs at sections, from the particles that cross lines between two steps."""

from collections.abc import Iterable, Mapping
from itertools import pairwise
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from ..core.errors import InputError
from ..physics.contracts import WATER
from .attributes import file_attributes, variable_attributes
from .crossings import Paths, crossings, near
from .follower import check_same_names
from .observers import check_interval
from .places import check_on_grid, line, named_places

COLUMNS = "section", "time", "volume", "solid_volume", "bearing_volume", "depth", "speed", "pressure"
"""Columns of a crossing: number of the section, time [s]; volume, volume of grains and volume of particles with a
pore-pressure column, > 0 in the positive direction [m3]; depth [m], speed [m s-1] and excess pore pressure at the base
[Pa]."""

MEANS = {
    "depth": ("m", "vertical depth of the flow, mean over the volume that crossed"),
    "speed": ("m s-1", "speed of the flow, mean over the volume that crossed"),
    "pressure": ("Pa", "excess pore pressure at the base, mean over the volume that crossed"),
}


class Sections:
    """Hydrographs at lines across the flow, from every particle that crosses one between two steps.

    A particle counts each time it crosses, with its volume at that time. So the volume beyond a line, less the volume
    eroded or flowed in beyond it, plus the volume that left the grid there, equals the crossed volume to rounding. The
    positive direction is the one in which the ground falls across the line.

    Parameters
    ----------
    lines : mapping of str to array_like, shape (n, 2), or iterable of pairs
        Map coordinates of the vertices of each line, by name [m].
    interval : float
        Length of the bins of the hydrographs [s].

    Raises
    ------
    InputError
        If a line has no two vertices, a name is there twice, the interval is not > 0; when the component is built, if a
        line is outside its grid.

    Examples
    --------
    >>> sections = Sections({"bridge": [(0.0, 20.0), (50.0, 20.0)]}, interval=10.0)
    >>> sections.dataset.sizes["time"]  # nothing was observed yet
    0
    """

    interval = np.inf
    """The grid need not be shown to the observer."""

    def __init__(self, lines: Mapping[str, ArrayLike] | Iterable[Any], interval: float = 10.0) -> None:
        self.bin = check_interval(interval, "Sections")
        named = named_places("Sections", lines)
        self.lines = {name: line(f"Sections: {name!r}", vertices) for name, vertices in named.items()}
        self._local = list(self.lines.values())
        self._signs = np.ones(len(self.lines))
        self._paths, self._time, self._two_phases = Paths(), 0.0, False
        self._events: list[np.ndarray] = []

    def prepare(self, grid: Any, setup: Any) -> None:
        """Find to which side of each line the ground falls.

        Parameters
        ----------
        grid : RasterModelGrid
            Grid of the component.
        setup : Setup
            Laws, material, numerics and inflow.

        Raises
        ------
        InputError
            If a line is outside the grid.
        """
        for name, vertices in self.lines.items():
            check_on_grid(f"Sections: {name!r}", vertices, grid)
        self._local = [vertices - np.array(grid.xy_of_lower_left) for vertices in self.lines.values()]
        self._signs = np.array([_falls_to_the_left(grid, vertices) for vertices in self._local])
        self._paths, self._two_phases = Paths(), setup.two_phases

    def follow(self, particles: Any, began: float, time: float) -> None:
        """Count the volume that crossed the lines in a step [m3].

        Parameters
        ----------
        particles : Particles
            The particles now; x and y are from the lower left node [m].
        began, time : float
            Beginning and end of the step [s]; equal before the first step of a call.
        """
        if began == time:  # later crossings belong to a call that was undone
            self._events = [event for event in self._events if event[0, 1] <= time]
        else:
            self._count(particles, began, time)
            if particles.departed is not None:
                self._count(particles.departed, began, time)
        self._paths.begin(particles)
        self._time = time

    def observe(self, flow: Any) -> None:
        """Do nothing: `follow` has counted all crossings.

        Parameters
        ----------
        flow : DebrisFlow
            The component after a step.
        """

    def _count(self, p, began, time):
        places, start = self._paths.since(p)
        end = np.array([p.x[places], p.y[places]])
        low, high = np.minimum(start, end), np.maximum(start, end)
        for number, (vertices, positive) in enumerate(zip(self._local, self._signs, strict=True)):
            if (close := near(low, high, vertices)).size == 0:
                continue
            path, fraction, sign = crossings(start[:, close], end[:, close], vertices)
            if path.size == 0:
                continue
            k = places[close[path]]
            volume, grains = positive * sign * p.volume[k], p.phase[k] != WATER
            solid = volume * grains if self._two_phases else volume * (1.0 - p.porosity[k])
            event = np.empty((k.size, len(COLUMNS)))
            event.T[:] = (
                np.full(k.size, number), began + fraction * (time - began), volume, solid, volume * grains, p.depth[k],
                np.sqrt(np.sum(p.velocity[:, k] ** 2, axis=0)), p.basal_excess_pore_pressure[k],
            )  # fmt: skip
            self._events.append(event)

    @property
    def crossings(self) -> np.ndarray:
        """All crossings so far, in order of steps: shape (n, 8), columns as in `COLUMNS`."""
        return np.concatenate([np.empty((0, len(COLUMNS))), *self._events])

    @property
    def dataset(self) -> xr.Dataset:
        """Hydrographs over ``section`` and ``time``, the middle of the bins [s].

        ``volume`` is the volume that crossed in a bin [m3], ``discharge`` this volume over the length of the bin,
        ``solid_...`` of the grains alone; ``depth``, ``speed`` and ``basal_excess_pore_pressure`` are means weighted
        with the volume, NaN where nothing crossed. ``crossed_volume`` and ``crossed_solid_volume`` are the sums,
        ``line_x`` and ``line_y`` over ``vertex`` the lines [m].
        """
        names, events = list(self.lines), self.crossings
        count = max(int(np.ceil(self._time / self.bin * (1.0 - 1e-12))), 0)
        edges = np.minimum(self.bin * np.arange(count + 1), max(self._time, 0.0))
        bins = np.clip(np.ceil(events[:, 1] / self.bin).astype(int) - 1, 0, max(count - 1, 0))
        values = dict(zip(COLUMNS, events.T, strict=True))
        place = values["section"].astype(int) * count + bins

        def total(amounts):
            return np.bincount(place, amounts, len(names) * count)[: len(names) * count].reshape(len(names), count)

        def variable(array, unit, words):
            return ("section", "time"), array, variable_attributes(unit, words)

        data = {}
        for prefix, words in (("", ""), ("solid_", "of grains ")):
            volume = total(values[f"{prefix}volume"])
            data[f"{prefix}volume"] = variable(volume, "m3", f"volume {words}that crossed in the bin")
            data[f"{prefix}discharge"] = variable(volume / np.diff(edges), "m3 s-1", f"discharge {words}in the bin")
        for name, (unit, words) in MEANS.items():
            weight = abs(values["bearing_volume" if name == "pressure" else "volume"])
            weights = total(weight)
            mean = np.divide(total(weight * values[name]), weights, out=np.full(weights.shape, np.nan),
                             where=weights > 0.0)  # fmt: skip
            data["basal_excess_pore_pressure" if name == "pressure" else name] = variable(mean, unit, words)
        for name in ("volume", "solid_volume"):
            whole = np.bincount(values["section"].astype(int), values[name], len(names))
            words = f"volume {'of grains ' if name != 'volume' else ''}that crossed so far"
            data[f"crossed_{name}"] = "section", whole, variable_attributes("m3", words)
        directions = [_direction(vertices, sign) for vertices, sign in zip(self._local, self._signs, strict=True)]
        meaning = "direction in which crossing counts as positive, anticlockwise from east"
        data["positive_direction"] = "section", np.array(directions), variable_attributes("deg", meaning)
        middle = variable_attributes("s", "elapsed time, middle of the bin") | {"bounds": "time_bounds"}
        most = max(len(vertices) for vertices in self.lines.values())
        for k, axis in enumerate("xy"):
            padded = [np.pad(line[:, k], (0, most - len(line)), constant_values=np.nan) for line in self.lines.values()]
            described = variable_attributes("m", f"{axis} of the line; NaN behind its last vertex")
            data[f"line_{axis}"] = ("section", "vertex"), np.array(padded), described
        coordinates = {
            "section": ("section", np.array(names, object), {"long_name": "name of the section"}),
            "time": ("time", 0.5 * (edges[1:] + edges[:-1]), middle),
            "time_bounds": (("time", "bounds"), np.stack([edges[:-1], edges[1:]], axis=1)),
        }
        return xr.Dataset(data, coordinates, file_attributes())

    def state(self) -> dict[str, Any]:
        """Return crossings, positions and time by name, for a checkpoint."""
        return {
            "names": "\n".join(self.lines), "signs": self._signs.copy(), "time": self._time,
            "crossings": self.crossings, "identity": self._paths.identity, "position": self._paths.position,
        }  # fmt: skip

    def restore(self, state: Mapping[str, Any]) -> None:
        """Go on after the crossings of a checkpoint.

        Parameters
        ----------
        state : mapping
            As `state` returned it.

        Raises
        ------
        InputError
            If it is of other sections, or its arrays do not fit each other.
        """
        check_same_names("Sections", state, self.lines)
        sizes = {name: np.size(state[name]) for name in ("crossings", "signs", "identity", "position")}
        if (
            sizes["crossings"] % len(COLUMNS) or sizes["signs"] != len(self.lines)
            or sizes["position"] != 2 * sizes["identity"] or np.unique(state["identity"]).size != sizes["identity"]
        ):  # fmt: skip
            raise InputError(f"Sections: the memory in the checkpoint has arrays that do not fit each other: {sizes}")
        events = np.reshape(np.asarray(state["crossings"], float), (-1, len(COLUMNS)))
        self._events = [events[k : k + 1] for k in range(len(events))]
        self._signs, self._time = np.array(state["signs"], float), float(state["time"])
        self._paths.identity = np.array(state["identity"], np.int64)
        self._paths.position = np.reshape(np.array(state["position"], float), (2, -1))


def _falls_to_the_left(grid, vertices) -> float:
    """Return 1 if the ground falls to the left of a line, -1 otherwise; `vertices` are from the lower left node [m]."""
    elevation = np.asarray(grid.at_node["topographic__elevation"]).reshape(grid.shape)
    spacing, fall = np.array([grid.dx, grid.dy]), 0.0
    for first, last in pairwise(vertices):
        along = last - first
        length = float(np.hypot(*along))
        left = np.array([-along[1], along[0]]) / length * spacing.max()
        count = max(2, int(np.ceil(length / spacing.min())))
        on = first + (np.arange(count)[:, None] + 0.5) / count * along
        sides = []
        for place in (on - left, on + left):
            column, row = np.rint(place / spacing).astype(int).T
            inside = (column >= 0) & (column < grid.shape[1]) & (row >= 0) & (row < grid.shape[0])
            sides.append(np.where(inside, elevation[row % grid.shape[0], column % grid.shape[1]], np.nan))
        drop = (sides[0] - sides[1])[np.isfinite(sides[0]) & np.isfinite(sides[1])]
        fall += length / count * float(drop.sum())
    return 1.0 if fall >= 0.0 else -1.0


def _direction(vertices, sign) -> float:
    """Return the direction across a line in which crossing counts as positive [deg from east]."""
    along = vertices[-1] - vertices[0]
    return float(np.degrees(np.arctan2(sign * along[0], -sign * along[1])))
