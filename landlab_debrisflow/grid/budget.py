"""Volume budget: every term is measured by itself, so that the residual shows an error of any term."""

from copy import copy
from typing import NamedTuple

import numpy as np

from .row_backup import RowBackup

CARRIED_OVER = ("released", "inflow", "eroded")
"""Terms whose volume from an earlier component keeps its split into grains and fluid."""


class ModelVolumes(NamedTuple):
    """Volumes measured by the model [m3]: particles, inflow and outflow, and their grains.

    Attributes
    ----------
    moving : float
        Volume of all particles, also of those at rest [m3].
    inflow : float
        Volume that has entered by hydrographs [m3].
    outflow : float
        Volume that has left over open boundaries [m3].
    moving_solid : float
        Volume of the grains in all particles [m3].
    settled_solid : float
        Volume of the grains laid into the terrain [m3].
    outflow_solid : float
        Volume of the grains that have left [m3].
    """

    moving: float
    inflow: float
    outflow: float
    moving_solid: float
    settled_solid: float
    outflow_solid: float


class VolumeBudget:
    """Volumes taken from and given to the ground, measured as differences of its fields.

    Parameters
    ----------
    area : float
        Map area of a node [m2].

    Attributes
    ----------
    released, deposited : float
        Volume taken by releases, and laid down, so far [m3].
    """

    def __init__(self, area: float):
        self._area = float(area)
        self.released = self.deposited = 0.0
        self._eroded = 0.0  # in earlier calls
        self._core = self._soil = None
        self._earlier = dict.fromkeys(CARRIED_OVER, (0.0, 0.0))

    def copy(self) -> "VolumeBudget":
        """Return an independent copy, which goes on measuring the same soil."""
        other = copy(self)
        other._soil = None if self._soil is None else self._soil.copy()
        return other

    def continue_from(self, earlier: "VolumeBudget", volumes: ModelVolumes, material) -> None:
        """Begin with the terms of an earlier budget whose component has no particles left.

        Volumes keep the split into grains and fluid of the earlier component, whose material may have been another one.
        """
        whole, solid = earlier.terms(volumes), earlier.terms_by_phase(volumes, material)["solid"]
        self._earlier = {name: (whole[name], solid[name]) for name in CARRIED_OVER}
        self.released, self._eroded, self.deposited = (whole[name] for name in ("released", "eroded", "deposited"))

    def measure_erosion(self, core, soil: RowBackup | None) -> None:
        """Measure erosion as the decrease of the soil depth [m] at core nodes from now on.

        Parameters
        ----------
        core : ndarray of bool, shape (nodes,)
            Nodes that count.
        soil : RowBackup or None
            Backup with the soil depth as its first array; None: stop measuring.
        """
        self._eroded = self.eroded
        self._core, self._soil = core, soil

    def variables(self) -> dict:
        """Return the terms so far by name, as dimensions and values, and the soil since which erosion is measured."""
        earlier = np.array([self._earlier[name] for name in CARRIED_OVER])
        found = {
            "released": ((), self.released), "deposited": ((), self.deposited), "eroded_before": ((), self._eroded),
            "earlier": (("carried_over", "whole_and_solid"), earlier),
        }  # fmt: skip
        return found if self._soil is None else found | self._soil.variables()

    def set_variables(self, variables, core, soil: RowBackup | None) -> None:
        """Restore the terms that `variables` returned, values by name; `core` and `soil` as of `measure_erosion`."""
        self.released, self.deposited, self._eroded = (
            float(variables[name]) for name in ("released", "deposited", "eroded_before")
        )
        self._earlier = dict(zip(CARRIED_OVER, map(tuple, variables["earlier"].tolist()), strict=True))
        self._core, self._soil = core, soil
        if soil is not None:
            soil.set_variables(variables)

    def keep_rows(self, first: int, last: int) -> None:
        """Copy soil depths of some rows of the raster before erosion changes them, if erosion is measured.

        Parameters
        ----------
        first, last : int
            Rows from `first` up to but not including `last`; rows copied before are left as they are.
        """
        if self._soil is not None:
            self._soil.keep_rows(first, last)

    @property
    def eroded(self) -> float:
        """Volume eroded so far [m3], also in the middle of a call."""
        return self._eroded + (0.0 if self._soil is None else self._soil.decrease(0, self._core) * self._area)

    def count_deposit(self, core, elevation: RowBackup) -> None:
        """Add the volume [m3] by which the first array of a backup, elevation [m], has risen at `core` nodes."""
        self.deposited -= elevation.decrease(0, core) * self._area

    def terms(self, volumes: ModelVolumes) -> dict[str, float]:
        """Return all terms and the residual [m3]: released + inflow + eroded - moving - deposited - outflow."""
        moving, outflow = volumes.moving, volumes.outflow
        inflow = self._earlier["inflow"][0] + volumes.inflow
        return {
            "released": self.released, "inflow": inflow, "eroded": self.eroded, "moving": moving,
            "deposited": self.deposited, "outflow": outflow,
            "residual": self.released + inflow + self.eroded - moving - self.deposited - outflow,
        }  # fmt: skip

    def terms_by_phase(self, volumes: ModelVolumes, material) -> dict[str, dict[str, float]]:
        """Return the terms of grains and of the pore fluid [m3]; settled grains are counted by particles."""
        whole = self.terms(volumes)
        porosity = dict.fromkeys(("released", "inflow"), material.porosity) | {"eroded": material.soil_porosity}
        solids = {
            name: solid + (1.0 - porosity[name]) * (whole[name] - volume)
            for name, (volume, solid) in self._earlier.items()
        }
        solids["moving"] = volumes.moving_solid
        solids["deposited"], solids["outflow"] = volumes.settled_solid, volumes.outflow_solid
        phases = {"solid": solids, "water": {name: whole[name] - solid for name, solid in solids.items()}}
        for terms in phases.values():
            came = terms["released"] + terms["inflow"] + terms["eroded"]
            terms["residual"] = came - terms["moving"] - terms["deposited"] - terms["outflow"]
        return phases
