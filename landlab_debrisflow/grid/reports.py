"""Messages at the end of a call, to the logger: volumes stopped by walls, outflow, and mass that still moves."""

import logging

import numpy as np

from .owned import OwnedByFlow

log = logging.getLogger("landlab_debrisflow")

NOTABLE = 0.01
"""Least outflow to be reported, over the volume that an event released, took in and eroded [-]."""


class Reports(OwnedByFlow):
    """Messages about an event, each given once.

    Parameters
    ----------
    flow : DebrisFlow
        The component whose event is reported.
    """

    def __init__(self, flow):
        super().__init__(flow)
        self._simulation = flow._simulation
        self._supply, self._outflow_before, self._reported = 0.0, dict.fromkeys(flow.outflow_by_edge, 0.0), 0.0

    def continue_from(self, earlier: "Reports") -> None:
        """Take over the volumes [m3] that have been told of the flow that this one continues."""
        self._supply, self._reported = earlier._supply, earlier._reported
        self._outflow_before = dict(earlier._outflow_before)

    def log_messages(self, until_rest: bool) -> None:
        """Log the messages of a call that ends; `until_rest`: whether it was to end at rest."""
        self._walls()
        self._outflow()
        if until_rest and not self._simulation.at_rest:
            self._unrest()

    def variables(self) -> dict:
        """Return by name, as dimensions and values, the volumes that have been told of [m3]."""
        return {
            "supply": ((), self._supply), "reported": ((), self._reported),
            "outflow_before": ("edge", np.array(list(self._outflow_before.values()))),
        }  # fmt: skip

    def set_variables(self, variables) -> None:
        """Restore the volumes that `variables` returned, values by name."""
        self._supply, self._reported = float(variables["supply"]), float(variables["reported"])
        self._outflow_before = dict(zip(self._outflow_before, variables["outflow_before"].tolist(), strict=True))

    def _walls(self):
        stopped = self._simulation.state.stopped
        if stopped.volume > 0.0:
            x, y = np.add(stopped.where, self.flow.grid.xy_of_lower_left)
            later = " and later" if stopped.last > stopped.first else ""
            log.warning(
                "%.4g m3 ran against closed or NODATA nodes at %.4g s%s, first near (%.6g, %.6g) m: obstacles, or the "
                "DEM is too small", stopped.volume, stopped.first, later, x, y,
            )  # fmt: skip
        stopped.forget()

    def _outflow(self):
        budget, by_edge = self.flow.budget, self.flow.outflow_by_edge
        supply = budget["released"] + budget["inflow"] + budget["eroded"]
        outflow = {edge: volume - self._outflow_before[edge] for edge, volume in by_edge.items()}
        total, came, at_rest = sum(outflow.values()), supply - self._supply, self._simulation.at_rest
        # when it becomes notable, and once more with its final volume
        if total - self._reported >= NOTABLE * came > 0.0 and (at_rest or self._reported == 0.0):
            sides = {"inside": "open nodes inside"} | {edge: f"the {edge} edge" for edge in outflow if edge != "inside"}
            where = ", ".join(f"{v:.4g} m3 over {sides[edge]}" for edge, v in outflow.items() if v >= 0.01 * total)
            log.log(
                logging.INFO if self._reported else logging.WARNING,
                "%s left the grid, %.3g %% of the volume that was released, flowed in and was eroded: the DEM ends "
                "within the reach of the flow, and depths and deposits near its edge are too small; use a larger DEM",
                where, 100.0 * total / came,
            )  # fmt: skip
            self._reported = total
        if at_rest:
            self._supply, self._outflow_before, self._reported = supply, by_edge, 0.0

    def _unrest(self):
        sim = self._simulation
        p, speed = sim.particles, np.sqrt(np.sum(sim.particles.velocity**2, axis=0))
        words = []
        if np.any(moving := speed > 0.0):
            k = int(speed.argmax())
            x, y = np.add((p.x[k], p.y[k]), self.flow.grid.xy_of_lower_left)
            words.append(
                f"{p.volume[moving].sum():.4g} m3 in {np.count_nonzero(moving)} of {p.count} particles still move, the "
                f"fastest with {speed[k]:.3g} m/s near ({x:.8g}, {y:.8g}) m"
            )
        if not sim.inflow.over:
            words.append(f"the inflow lasts until {max(source.times[-1] for source in sim.inflow.sources):.4g} s")
        log.warning(
            "not at rest after %.6g s: %s. No mass was settled, so elevation and soil still lack the moving mass. Call "
            "run_until_rest() again, or with a larger max_duration; a flow that only creeps, as under a viscous law, "
            "comes to rest earlier with a larger rest_energy in numerics",
            sim.time, "; ".join(words) or "nothing moves any more",
        )  # fmt: skip
