"""The accounts of volume: every term is measured on its own, none is the rest of the others."""

from .row_backup import Journal


class Ledger:
    """Volumes taken from and given to the ground, measured as differences of its fields.

    Parameters
    ----------
    area : float
        Map area of a node [m2].
    """

    def __init__(self, area: float):
        self._area = float(area)
        self.released = self.deposited = 0.0
        self._eroded = 0.0  # in earlier calls
        self._core = self._soil = None
        self._earlier = dict.fromkeys(("released", "inflow", "eroded"), (0.0, 0.0))

    def continue_from(self, earlier: "Ledger", simulation) -> None:
        """Begin with the accounts of an earlier ledger; `simulation`, of which they are, holds no particles any more.

        Of which phase volumes were is what they were then, of another material perhaps.
        """
        whole, solid = earlier.budget(simulation), earlier.budget_by_phase(simulation)["solid"]
        self._earlier = {name: (whole[name], solid[name]) for name in self._earlier}
        self.released, self._eroded, self.deposited = (whole[name] for name in ("released", "eroded", "deposited"))

    def watch_soil(self, core, soil: Journal | None) -> None:
        """Measure erosion as the fall of the soil depth in a journal, on core nodes, from now on; None: no more."""
        self._eroded = self.eroded
        self._core, self._soil = core, soil

    def cover(self, first: int, last: int) -> None:
        """Keep some rows of the soil that is measured, if any; see `Journal.cover`."""
        if self._soil is not None:
            self._soil.cover(first, last)

    @property
    def eroded(self) -> float:
        """Volume eroded so far [m3], also in the middle of a call."""
        return self._eroded + (0.0 if self._soil is None else self._soil.fall(0, self._core) * self._area)

    def count_deposit(self, core, elevation: Journal) -> None:
        """Count by how much volume the elevation kept in a journal has risen on core nodes."""
        self.deposited -= elevation.fall(0, core) * self._area

    def budget(self, simulation) -> dict[str, float]:
        """Return all terms and the residual [m3]: released + inflow + eroded - moving - deposited - outflow."""
        moving = float(simulation.particles.volume.sum())
        inflow, outflow = self._earlier["inflow"][0] + simulation.inflow.volume, simulation.state.outflow.total
        return {
            "released": self.released, "inflow": inflow, "eroded": self.eroded, "moving": moving,
            "deposited": self.deposited, "outflow": outflow,
            "residual": self.released + inflow + self.eroded - moving - self.deposited - outflow,
        }  # fmt: skip

    def budget_by_phase(self, simulation) -> dict[str, dict[str, float]]:
        """Return the budgets of grains and of what is between them [m3]; settled grains are those of the particles."""
        whole, material = self.budget(simulation), simulation.physics.material
        porosity = dict.fromkeys(("released", "inflow"), material.porosity) | {"eroded": material.soil_porosity}
        parts = {
            name: solid + (1.0 - porosity[name]) * (whole[name] - volume)
            for name, (volume, solid) in self._earlier.items()
        }
        parts["moving"] = float(simulation.phases.solid_volume(simulation.particles).sum())
        parts["deposited"], parts["outflow"] = simulation.state.settled_solid, simulation.state.outflow.solid
        phases = {"solid": parts, "water": {name: whole[name] - part for name, part in parts.items()}}
        for terms in phases.values():
            came = terms["released"] + terms["inflow"] + terms["eroded"]
            terms["residual"] = came - terms["moving"] - terms["deposited"] - terms["outflow"]
        return phases
