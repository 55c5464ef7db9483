"""Cost of a step with dilatancy over one without: ``python -m benchmarks.dilatancy_cost`` from the root of a checkout.

10 000 particles and 11 levels on a slope of 31 degrees, with and without erosion; the two columns run in turns. Printed
are medians of the CPU time of a step. Kept is nothing.
"""

import logging
import statistics
import time

from landlab import RasterModelGrid

from landlab_debrisflow import DebrisFlow

COLUMNS = {"without": "ale", "with dilatancy": {"law": "ale", "dilatancy": {}}}
PARTICLES, TURNS = 10_000, 5
BEFORE, MEASURED = 0.5, 1.0
"""Times that pass before the measurement, and in it [s]."""


def time_of_a_step(column, erosion: str) -> float:
    """Return the CPU time of a step [ms] of a release that has begun to move."""
    grid = RasterModelGrid((41, 400), xy_spacing=0.5)
    x, y = grid.x_of_node, grid.y_of_node
    grid.add_field("topographic__elevation", 60.0 - 0.6 * x, at="node")
    grid.add_full("soil__depth", 0.5, at="node")
    grid.add_field("debris_flow__release_depth", 0.5 * ((x - 8.0) ** 2 + (y - 10.0) ** 2 < 16.0), at="node")
    flow = DebrisFlow(
        grid, column=column, erosion=erosion, friction={"law": "coulomb", "basal_friction_angle": 40.0},
        material={"porosity": 0.38, "initial_pressure_ratio": 0.0 if isinstance(column, dict) else 0.9},
        numerics={"particle_count": PARTICLES},
    )  # fmt: skip
    flow.run_one_step(BEFORE)
    steps, began = flow.diagnostics.steps, time.process_time()
    flow.run_one_step(MEASURED)
    return 1000.0 * (time.process_time() - began) / (flow.diagnostics.steps - steps)


def main() -> None:
    """Print the medians and their ratio."""
    logging.disable(logging.WARNING)  # the release is a slab, whose pit is doubted
    for erosion in ("none", "growth"):
        time_of_a_step("ale", erosion), time_of_a_step(COLUMNS["with dilatancy"], erosion)  # compiles
        turns = [[time_of_a_step(column, erosion) for column in COLUMNS.values()] for _ in range(TURNS)]
        plain, dilatant = (statistics.median(times) for times in zip(*turns, strict=True))
        print(
            f"erosion {erosion}: {plain:.2f} ms a step, with dilatancy {dilatant:.2f} ms: {dilatant / plain:.2f} times"
        )


if __name__ == "__main__":
    main()
