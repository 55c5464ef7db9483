"""Single particles against time: their tracks, and the columns of pore pressure that they carry."""

from collections.abc import Mapping, Sequence
from numbers import Integral
from typing import Any

import numpy as np
import xarray as xr

from ..core.errors import InputError
from .attributes import file_attributes, variable_attributes
from .follower import Follower, TimeRows
from .identities import places_of
from .observers import check_interval

TRACKED = {
    "x": ("m", "map coordinate of the grid"),
    "y": ("m", "map coordinate of the grid"),
    "z": ("m", "elevation of the bed below"),
    "depth": ("m", "vertical flow depth"),
    "speed": ("m s-1", "speed along the bed"),
    "basal_excess_pore_pressure": ("Pa", "excess pore pressure at the base"),
    "volume": ("m3", "volume of debris carried"),
}
"""Unit and meaning of the quantities of a track."""


class Tracks(Follower):
    """Tracks of some particles: position, depth and speed of the flow there, and basal pore pressure.

    Parameters
    ----------
    interval : float
        Event time between two places [s].
    particles : int or sequence of int
        A number of particles, taken evenly from the first particles of the flow; or the numbers of particles, in order
        of release and inflow from 0.

    Raises
    ------
    InputError
        If the interval is not > 0, or the particles are no whole numbers, negative or twice among them.
    """

    def __init__(self, interval: float, particles: int | Sequence[int] = 100) -> None:
        super().__init__(interval)
        self._count: int | None = None
        self._chosen: np.ndarray | None = None
        if isinstance(particles, Integral) and not isinstance(particles, bool):
            if particles < 1:
                raise InputError(f"Tracks: the number of particles must be at least 1, got {particles}")
            self._count = int(particles)
        else:
            self._chosen = chosen_particles("Tracks", particles)

    def sample(self, particles: Any, time: float) -> None:
        """Add the present positions to the tracks.

        Parameters
        ----------
        particles : Particles
            The particles now, at least one.
        time : float
            Elapsed time [s].
        """
        p, identity = particles, particles.identity
        if self._chosen is None:
            present = np.sort(identity)
            count = min(self._count or 1, present.size)
            self._chosen = present[((np.arange(count) + 0.5) * present.size / count).astype(int)]
        at = places_of(self._chosen, identity)
        x0, y0 = self._lower_left
        now = {"x": p.x + x0, "y": p.y + y0, "speed": np.sqrt(np.sum(p.velocity**2, axis=0))}
        now |= {name: getattr(p, name) for name in TRACKED if name not in now}
        self._rows.add(time, **{name: np.where(at >= 0, values[at], np.nan) for name, values in now.items()})

    @property
    def dataset(self) -> xr.Dataset:
        """Tracks over ``time`` [s] and ``particle``, NaN while a particle is not there."""
        rows, chosen = self._rows.arrays(), np.empty(0, int) if self._chosen is None else self._chosen
        nothing = np.empty((0, chosen.size))
        data = {
            name: (("time", "particle"), rows.get(name, nothing), variable_attributes(unit, words))
            for name, (unit, words) in TRACKED.items()
        }
        return xr.Dataset(data, _coordinates(rows["time"], chosen), file_attributes())

    def state(self) -> dict[str, Any]:
        """Return the tracks so far by name, for a checkpoint."""
        return super().state() | ({} if self._chosen is None else {"particles": self._chosen})

    def restore(self, state: Mapping[str, Any]) -> None:
        """Go on after the tracks of a checkpoint.

        Parameters
        ----------
        state : mapping
            As `state` returned it.
        """
        self._chosen = np.array(state["particles"], np.int64) if "particles" in state else self._chosen
        super().restore({name: values for name, values in state.items() if name != "particles"})


class MarkedColumns:
    """Columns of marked particles: excess pore pressure over level against time.

    Parameters
    ----------
    interval : float
        Event time between two profiles [s].
    particles : sequence of int
        Numbers of the particles, in order of release and inflow from 0.

    Raises
    ------
    InputError
        If the interval is not > 0, or the particles are no whole numbers, negative or twice among them.
    """

    def __init__(self, interval: float, particles: Sequence[int]) -> None:
        self.interval = check_interval(interval, type(self).__name__)
        self._chosen = chosen_particles("MarkedColumns", particles)
        self._rows = TimeRows()

    def observe(self, flow: Any) -> None:
        """Note the profiles of now.

        Parameters
        ----------
        flow : DebrisFlow
            The component after a step.
        """
        now = flow.columns[["excess_pore_pressure", "thickness"]].reindex(particle=self._chosen)
        self._rows.add(
            flow.elapsed_time, level=now.level.values, pressure=now.excess_pore_pressure.values,
            thickness=now.thickness.values,
        )  # fmt: skip

    @property
    def dataset(self) -> xr.Dataset:
        """Profiles over ``time`` [s], ``particle`` and ``level``, NaN while a particle is not there."""
        rows = self._rows.arrays()
        level = rows["level"][0] if len(self._rows) else np.empty(0)
        pressure = rows.get("pressure", np.empty((0, self._chosen.size, 0)))
        data = {
            "excess_pore_pressure": (
                ("time", "particle", "level"), pressure, variable_attributes("Pa", "excess pore pressure")
            ),
            "thickness": (
                ("time", "particle"), rows.get("thickness", np.empty((0, self._chosen.size))),
                variable_attributes("m", "slope-normal thickness"),
            ),
        }  # fmt: skip
        words = variable_attributes("-", "height above the base over thickness, 0 at the base, 1 at the surface")
        axes = _coordinates(rows["time"], self._chosen) | {"level": ("level", level, words)}
        return xr.Dataset(data, axes, file_attributes())

    def state(self) -> dict[str, Any]:
        """Return the profiles so far by name, for a checkpoint."""
        return self._rows.arrays()

    def restore(self, state: Mapping[str, Any]) -> None:
        """Go on after the profiles of a checkpoint.

        Parameters
        ----------
        state : mapping
            As `state` returned it.
        """
        self._rows.restore(state)


def chosen_particles(owner: str, particles: Any) -> np.ndarray:
    """Return numbers of particles as an array.

    Parameters
    ----------
    owner : str
        Name of the observer, for messages.
    particles : sequence of int
        At least one.

    Returns
    -------
    ndarray of int

    Raises
    ------
    InputError
        If a number is no whole number >= 0, or is given twice.
    """
    try:
        numbers = np.asarray(particles)
    except ValueError:  # sequences of unequal lengths
        numbers = np.empty(0)
    if numbers.ndim != 1 or numbers.size == 0 or numbers.dtype.kind not in "iu" or numbers.min() < 0:
        raise InputError(f"{owner}: particles must be whole numbers >= 0, at least one, got {particles!r}")
    if np.unique(numbers).size < numbers.size:
        raise InputError(f"{owner}: a particle is twice among the numbers {particles!r}")
    return numbers.astype(np.int64)


def _coordinates(times, particles):
    words = variable_attributes("-", "number of the particle, in order of release")
    return {
        "time": ("time", times, variable_attributes("s", "elapsed time")),
        "particle": ("particle", particles, words),
    }
