"""Landslide components of Landlab beside this one, on the same valley: ``python -m benchmarks.which_component``.

Each runs once for warming up and then three times on a fresh grid; printed is the least CPU time, without what is done
once before. The valley is the stand-in of Tsing Shan, the landslide the same for both components that let one run out.
Writes benchmarks/which_component.txt, which docs/which_component.md quotes.
"""

import io
import time
import warnings
from pathlib import Path

import numpy as np
from landlab.components import (
    BedrockLandslider,
    FlowAccumulator,
    FlowDirectorMFD,
    LandslideProbability,
    MassWastingRunout,
    PriorityFloodFlowRouter,
)
from rich.console import Console
from rich.table import Table

from landlab_debrisflow import DebrisFlow
from landlab_debrisflow.record import write_atomically
from landlab_debrisflow.scene import tsing_shan_valley

Z, RELEASE = "topographic__elevation", "debris_flow__release_depth"
STRENGTH = {
    "soil__density": 2000.0,
    "soil__internal_friction_angle": 35.0,
    "soil__minimum_total_cohesion": 3000.0,
    "soil__mode_total_cohesion": 6000.0,
    "soil__maximum_total_cohesion": 9000.0,
    "soil__saturated_hydraulic_conductivity": 0.0,
    "soil__transmissivity": 10.0,
}


def valley():
    """Return the valley with the landslide that is about to fail."""
    return tsing_shan_valley(runout_length=900.0, width=400.0)


def bedrock_landslider(grid):
    """Return a step of ten years, with its routing, and what to call the result."""
    router = PriorityFloodFlowRouter(grid, separate_hill_flow=True, suppress_out=True)
    landslider = BedrockLandslider(
        grid, angle_int_frict=0.6, landslides_return_time=1e3, landslides_on_boundary_nodes=False
    )

    def step():
        router.run_one_step()
        _, left = landslider.run_one_step(dt=10.0)
        return {"failed": sum(landslider.landslides_volume), "left": left}

    return step


def landslide_probability(grid):
    """Return a map with 250 draws at every node."""
    FlowAccumulator(grid, flow_director="FlowDirectorD8").run_one_step()
    grid.add_field("topographic__slope", grid.calc_slope_at_node(), at="node")
    area = grid.at_node["drainage_area"] / grid.dx
    grid.add_field("topographic__specific_contributing_area", np.maximum(area, grid.dx), at="node")
    grid.add_full("soil__thickness", 1.0, at="node")
    for name, value in STRENGTH.items():
        grid.add_full(name, value, at="node")
    slopes = LandslideProbability(grid, number_of_iterations=250)

    def step():
        slopes.calculate_landslide_probability()
        return {"failed": 0.0}

    return step


def mass_wasting_runout(grid):
    """Return the run-out of the landslide."""
    failing = grid.at_node[RELEASE]
    grid.set_closed_boundaries_at_grid_edges(True, True, True, True)
    FlowDirectorMFD(grid, diagonals=True, partition_method="slope").run_one_step()
    grid.add_field("soil__thickness", np.where(failing > 0.0, failing, grid.at_node["soil__depth"]), at="node")
    grid.add_field("mass__wasting_id", (failing > 0.0).astype(int), at="node")
    runout = MassWastingRunout(
        grid, critical_slope=[0.1], threshold_flux=0.1, erosion_coefficient=0.006, grain_shear=False
    )

    def step():
        failed = failing.sum() * grid.dx * grid.dy
        runout.run_one_step()
        return {"failed": failed}

    return step


def debris_flow(grid):
    """Return the event of the landslide until rest, 1500 particles."""
    flow = DebrisFlow(grid, numerics={"particle_count": 1500})

    def step():
        flow.run_until_rest()
        return {"failed": flow.budget["released"], "left": flow.budget["outflow"]}

    return step


COMPONENTS = {
    "BedrockLandslider": (bedrock_landslider, "step of 10 years with its router"),
    "LandslideProbability": (landslide_probability, "map, 250 draws at a node"),
    "MassWastingRunout": (mass_wasting_runout, "event"),
    "DebrisFlow": (debris_flow, "event to rest, 1500 particles"),
}


def measure(build) -> dict:
    """Return CPU time [s] and volumes [m3] of a component on a fresh valley; the residual is of rise and outflow."""
    grid = valley()
    ground = grid.at_node[Z].copy()
    step, cpu = build(grid), time.process_time()
    found = step()
    found["cpu"] = time.process_time() - cpu
    core, area = grid.core_nodes, grid.dx * grid.dy
    change = (grid.at_node[Z] - ground)[core]
    found["raised"], found["lowered"] = area * np.maximum(change, 0.0).sum(), area * np.maximum(-change, 0.0).sum()
    found["residual"] = area * change.sum() + found.get("left", 0.0)
    return found


def main() -> dict[str, dict[str, float]]:
    """Print and return what every component took and did."""
    grid, found = valley(), {}
    for name, (build, _) in COMPONENTS.items():
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of libraries below Landlab
            runs = [measure(build) for _ in range(4)]
        found[name] = min(runs[1:], key=lambda run: run["cpu"])
    shown = Table(title=f"{grid.shape[0]} x {grid.shape[1]} nodes of {grid.dx:g} m", title_justify="left")
    for heading in (
        "component",
        "run",
        r"CPU \[s]",
        r"failed \[m3]",
        r"raised \[m3]",
        r"lowered \[m3]",
        r"residual \[m3]",
    ):
        shown.add_column(heading, justify="left" if heading in ("component", "run") else "right")
    for name, run in found.items():
        volumes = (f"{run[key]:.0f}" for key in ("failed", "raised", "lowered"))
        shown.add_row(name, COMPONENTS[name][1], f"{run['cpu']:.2g}", *volumes, f"{run['residual']:.1g}")
    text = io.StringIO()
    Console(file=text, width=130).print(shown)
    print(text.getvalue())
    write_atomically(
        Path(__file__).with_suffix(".txt"), lambda path: path.write_text(text.getvalue(), encoding="utf-8")
    )
    return found


if __name__ == "__main__":
    main()
