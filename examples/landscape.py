"""A hundred years of a valley: rivers, creep, weathering and uplift, and debris flows that landslides trigger.

    python examples/landscape.py

Every year the ground is lifted, weathers and creeps (ExponentialWeatherer, DepthDependentDiffuser), and rivers work on
it (FlowAccumulator, SpaceLargeScaleEroder). From time to time slopes fail, soil in a storm (LandslideProbability) or
soil with the rock below (BedrockLandslider); the failed mass runs down as a debris flow until it rests. The table lists
the changes of soil and rock by every component, and the residual of its own account. Rivers and failing rock turn rock
into soil with pores, so that their grains balance; weathering makes soil of the same volume as the rock, so that its
volume balances.
"""

import argparse
import sys
import time
from contextlib import contextmanager
from typing import NamedTuple

import numpy as np
from landlab import RasterModelGrid
from landlab.components import (
    BedrockLandslider,
    DepthDependentDiffuser,
    ExponentialWeatherer,
    FlowAccumulator,
    LandslideProbability,
    PriorityFloodFlowRouter,
    SpaceLargeScaleEroder,
)
from rich.console import Console
from rich.table import Table

from landlab_debrisflow import DebrisFlow, InputError, ParameterError
from landlab_debrisflow.triggers import release_bedrock_landslides, release_probable_sites

Z, SOIL, ROCK = "topographic__elevation", "soil__depth", "bedrock__elevation"
PEAKS = ["debris_flow__max_depth", "debris_flow__max_speed"]

SPACING = 10.0  # m
UPLIFT = 1e-3  # m/yr
POROSITY = 0.4  # porosity of soil, debris and river sediment
# years of the first storm and of the first search for failing rock; both are repeated every ten years
STORM, COLLAPSE = 5, 10
SLOPE_STRENGTH = {  # for LandslideProbability; a transmissivity of 10 m2/day is used where the conductivity is 0
    "soil__transmissivity": 10.0,
    "soil__saturated_hydraulic_conductivity": 0.0,
    "soil__minimum_total_cohesion": 3100.0,
    "soil__mode_total_cohesion": 5200.0,
    "soil__maximum_total_cohesion": 8300.0,
    "soil__internal_friction_angle": 36.0,
    "soil__density": 1900.0,
}
ROCK_STRENGTH = {"angle_int_frict": 0.75, "cohesion_eff": 2e4, "landslides_return_time": 2000.0}  # -, Pa, yr


def build_valley(rows: int, columns: int) -> RasterModelGrid:
    """Return a winding valley, open at its lower end in the south, with spurs and hollows on slopes of 35 degrees."""
    grid = RasterModelGrid((rows, columns), xy_spacing=SPACING)
    x, y = grid.x_of_node, grid.y_of_node
    aside = x - 0.5 * x.max() - 0.06 * x.max() * np.sin(y / 180.0)
    beyond = np.maximum(0.0, abs(aside) - 25.0)
    spurs = np.cos(2.0 * np.pi * y / 140.0 + 1.5 * (aside > 0.0))
    elevation = 200.0 + 0.05 * y + 0.65 * (np.hypot(beyond, 30.0) - 30.0)
    elevation += 12.0 * spurs * np.minimum(1.0, beyond / 200.0)
    soil = np.where(beyond > 0.0, 0.9 - 0.5 * spurs, 2.0)
    elevation += np.random.default_rng(1).uniform(0.0, 0.05, x.size)
    for name, values in ((Z, elevation), (SOIL, soil), (ROCK, elevation - soil)):
        grid.add_field(name, values, at="node", units="m")
    grid.set_closed_boundaries_at_grid_edges(True, True, True, False)
    return grid


# ---- accounts ----


class Entry(NamedTuple):
    """What one component did in all its calls; volumes in m3.

    `edge` is what came in over the edges as the component itself reports it, `moved` the sum of all changes of soil and
    rock without sign. `residual` is by how much elevation changed beyond `edge`; `grains` is the same of the volume
    without pores, from soil and rock. `gap` is the largest difference of elevation and soil on rock afterwards [m],
    `cpu` its CPU time [s].
    """

    soil: float = 0.0
    rock: float = 0.0
    edge: float = 0.0
    residual: float = 0.0
    grains: float = 0.0
    moved: float = 0.0
    gap: float = 0.0
    cpu: float = 0.0


class Ledger:
    """Measures soil and rock at core nodes before and after each change."""

    def __init__(self, grid):
        self.grid, self.entries = grid, {}

    @contextmanager
    def account(self, name, solid=1.0):
        """Enter the changes in the block under a name.

        Yields a list for the volumes [m3] that came in over the edges, as the component reports them; `solid` is the
        fraction of grains in these volumes [-].
        """
        at, core, area = self.grid.at_node, self.grid.core_nodes, self.grid.dx * self.grid.dy
        before, reported, cpu = [at[key][core].copy() for key in (SOIL, ROCK, Z)], [], time.process_time()
        yield reported
        cpu = time.process_time() - cpu
        soil, rock, rise = (area * (at[key][core] - old) for key, old in zip((SOIL, ROCK, Z), before, strict=True))
        soil_change, rock_change, edge = soil.sum(), rock.sum(), sum(reported)
        gap = abs(at[Z] - at[ROCK] - at[SOIL])[core].max()
        old = self.entries.get(name, Entry())
        self.entries[name] = Entry(
            old.soil + soil_change, old.rock + rock_change, old.edge + edge,
            old.residual + rise.sum() - edge,
            old.grains + (1.0 - POROSITY) * soil_change + rock_change - solid * edge,
            old.moved + abs(soil).sum() + abs(rock).sum(), max(old.gap, gap), old.cpu + cpu,
        )  # fmt: skip

    def table(self, years) -> Table:
        """Return the accounts of all components."""
        shown = Table(title=rf"Changes in {years} years \[m3]", title_justify="left")
        headings = "soil", "rock", "over edges", "moved", "residual", "of grains", r"z-rock-soil \[m]", r"CPU \[s]"
        for heading in ("", *headings):
            shown.add_column(heading, justify="right" if heading else "left")
        for name, entry in self.entries.items():
            volumes = (f"{value:.0f}" for value in (entry.soil, entry.rock, entry.edge, entry.moved))
            rest = (f"{value:.1e}" for value in (entry.residual, entry.grains, entry.gap))  # rounding, or pores
            shown.add_row(name, *volumes, *rest, f"{entry.cpu:.1f}")
        return shown


def soil_over_edges(grid) -> float:
    """Return the rate at which creeping soil comes in over open edges, negative if it leaves [m3/yr]."""
    core = (grid.status_at_node == grid.BC_NODE_IS_CORE).astype(float)
    inward = core[grid.node_at_link_head] - core[grid.node_at_link_tail]
    return float(np.sum(grid.at_link["soil__flux"] * inward)) * SPACING


# ---- the loop ----


class Landscape:
    """A grid with all components that work on it, and their accounts."""

    def __init__(self, rows: int, columns: int, particles: int, seed: int):
        self.grid = grid = build_valley(rows, columns)
        self.ledger, self.draws = Ledger(grid), np.random.default_rng(seed)
        # inputs of BedrockLandslider; both routers write the same fields of water, so each runs just before its reader
        self.hill_router = PriorityFloodFlowRouter(grid, flow_metric="D8", separate_hill_flow=True, suppress_out=True)
        self.router = FlowAccumulator(grid, "topographic__elevation", "FlowDirectorD8",
                                      depression_finder="DepressionFinderAndRouter")  # fmt: skip
        self.router.run_one_step()
        self.rivers = SpaceLargeScaleEroder(grid, K_sed=3e-6, K_br=6e-7, m_sp=0.8, phi=POROSITY)
        self.weathering = ExponentialWeatherer(grid, soil_production_maximum_rate=5e-4, soil_production_decay_depth=0.5)
        self.creep = DepthDependentDiffuser(grid, soil_transport_velocity=0.01, soil_transport_decay_depth=0.5)
        self.rock_slopes = BedrockLandslider(
            grid, **ROCK_STRENGTH, phi=POROSITY, seed=seed, landslides_on_boundary_nodes=False
        )
        for name, value in SLOPE_STRENGTH.items():
            grid.add_full(name, value, at="node")
        for name in ("topographic__slope", "topographic__specific_contributing_area", "soil__thickness"):
            grid.add_zeros(name, at="node")
        self.soil_slopes = LandslideProbability(grid, number_of_iterations=100, seed=seed)
        self.flow = DebrisFlow(
            grid, friction={"law": "voellmy", "turbulent_coefficient": 500.0},
            material={"porosity": POROSITY, "bed_porosity": POROSITY}, numerics={"particle_count": particles},
        )  # fmt: skip
        self.events = []

    def run(self, years: int) -> None:
        """Go through some years."""
        for year in range(1, years + 1):
            self.grow_old()
            if year % 10 == STORM % 10:
                self.run_event(year, "storm", self.release_soil())
            if year % 10 == COLLAPSE % 10:
                self.run_event(year, "collapse", self.release_rock())

    def grow_old(self) -> None:
        """Let a year pass without events."""
        grid, account = self.grid, self.ledger.account
        with account("uplift") as edge:
            for name in (Z, ROCK):
                grid.at_node[name][grid.core_nodes] += UPLIFT
            edge.append(UPLIFT * grid.number_of_core_nodes * SPACING**2)
        with account("weathering, creep", 1.0 - POROSITY) as edge:
            self.weathering.run_one_step()
            self.creep.run_one_step(1.0)
            edge.append(soil_over_edges(grid))
        with account("rivers (SPACE)") as edge:
            self.router.run_one_step()
            edge.append(-sum(self.rivers.run_one_step(1.0)))

    def release_soil(self) -> float:
        """Let sites fail with the probability of LandslideProbability; return their volume [m3]."""
        grid = self.grid
        with self.ledger.account("trigger: soil"):
            grid.at_node["topographic__slope"][:] = grid.calc_slope_at_node(Z)
            grid.at_node["topographic__specific_contributing_area"][:] = grid.at_node["drainage_area"] / SPACING
            grid.at_node["soil__thickness"][:] = np.maximum(grid.at_node[SOIL], 0.01)
            self.soil_slopes.calculate_landslide_probability()
            return release_probable_sites(grid, threshold=0.2, least_area=5.0 * SPACING**2, seed=self.draws)

    def release_rock(self) -> float:
        """Let slopes fail as BedrockLandslider finds them in ten years; return their volume [m3]."""
        with self.ledger.account("trigger: rock"):
            self.hill_router.run_one_step()
            return release_bedrock_landslides(self.rock_slopes, 10.0, porosity=POROSITY)

    def run_event(self, year: int, trigger: str, volume: float) -> None:
        """Run the failed mass to rest and keep the peaks of the event."""
        if volume == 0.0:
            return
        flow, before = self.flow, self.flow.budget
        with self.ledger.account("debris flows", 1.0 - POROSITY) as edge:
            flow.new_event()
            flow.run_until_rest()
            edge.append(before["outflow"] - flow.budget["outflow"])
        # without attributes, which are those of the flow
        peaks = flow.maps[PEAKS].drop_attrs().expand_dims(year=[year])
        self.events.append(peaks.assign(trigger=("year", [trigger]), released=("year", [volume])))


def main(years: int = 100, rows: int = 100, columns: int = 100, particles: int = 1500, seed: int = 2) -> Landscape:
    """Run the landscape and print its accounts.

    Parameters
    ----------
    years : int
        Duration.
    rows, columns : int
        Nodes of the grid.
    particles : int
        Number of particles of each event.
    seed : int
        Seed of the random numbers.

    Returns
    -------
    Landscape
        As it is at the end.

    Raises
    ------
    InputError, ParameterError
        If an argument is out of bounds.
    """
    landscape = Landscape(rows, columns, particles, seed)
    landscape.run(years)
    console = Console(width=120)
    console.print(landscape.ledger.table(years))
    if landscape.events:
        flows = landscape.ledger.entries["debris flows"]
        console.print(
            f"debris flows close to {abs(flows.residual) / flows.moved:.0e} of the volume they moved", highlight=False
        )
    for event in landscape.events:
        told = f"year {event.year.item():3}, {event.trigger.item():8}: {event.released.item():8.0f} m3, peak depth"
        console.print(f"{told} {event.debris_flow__max_depth.max().item():4.1f} m", highlight=False)
    return landscape


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--years", type=int, default=100)
    parser.add_argument("--particles", type=int, default=1500)
    parser.add_argument("--seed", type=int, default=2)
    words = parser.parse_args()
    try:
        main(words.years, particles=words.particles, seed=words.seed)
    except (InputError, ParameterError) as error:
        sys.exit(f"landscape: {error}")
