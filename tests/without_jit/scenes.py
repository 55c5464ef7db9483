"""Short flows of few particles that together reach every law and every stage of a step.

``python -m tests.without_jit.scenes`` prints what each ends with, as JSON.
"""

import json

import numpy as np

from landlab_debrisflow import DebrisFlow
from landlab_debrisflow.physics.registry import LAWS
from landlab_debrisflow.record.observers import Snapshots
from landlab_debrisflow.record.series import Series
from validation.grids import inclined, release_slab

SHAPE, SPACING = (9, 24), 5.0
LINE = {"line_start": (25.0, 14.0), "line_end": (25.0, 26.0)}
SURGE = LINE | {"times": [0.0, 1.0], "discharge": [30.0, 30.0], "velocity": [6.0, 5.0]}
LOADED = {"bed_loading_coefficient": 0.3, "bed_drainage_time": 5.0}


def run(duration=0.6, *, inclination=0.5, foot=None, shape=SHAPE, change=None, soil=1.0, depth=1.0, **keywords):
    """Return a flow that slid down a small slope for `duration` [s]; `change` is called with the grid before."""
    grid = inclined(shape, SPACING, inclination, soil=soil, foot=foot)
    if "inflow" not in keywords:
        release_slab(grid, (30.0, 20.0), 6.0, depth, on_top=True)
    if change:
        change(grid)
    numerics = {"particle_count": 12, "settle": False} | keywords.pop("numerics", {})
    flow = DebrisFlow(grid, numerics=numerics, **keywords)
    flow.run_one_step(duration)
    return flow


def wall(grid):
    """Close nodes right below the release."""
    grid.status_at_node[(grid.x_of_node > 36.0) & (grid.x_of_node < 46.0)] = grid.BC_NODE_IS_CLOSED


def drain(grid):
    """Let the bed drain to the right of the release."""
    grid.add_field("bed__drained", 1.0 * (grid.x_of_node > 30.0), at="node")


def settled(**keywords):
    """Return a flow that came to rest and was laid into the terrain."""
    numerics = {"rest_energy": 0.5}
    flow = run(0.3, inclination=0.02, depth=0.2, erosion="none", column="none", numerics=numerics, **keywords)
    flow.run_until_rest(20.0)
    flow.settle()
    return flow


def watched():
    """Return a flow with observers, before it is begun a second time."""
    flow = run(0.2, observers=[Series([0.1], lambda flow: {"moving": flow.budget["moving"]}), Snapshots(0.1)])
    flow.run_one_step(0.2)
    return flow


def left_at_once():
    """Return a flow of one particle of grains and one of water that left the grid in one step."""

    def beside_the_edge(grid):
        release = (grid.x_of_node == 105.0) & (grid.y_of_node == 20.0)
        grid.at_node["debris_flow__release_depth"][:] = 0.5 * release
        grid.add_field("debris_flow__release_velocity_x", 8.0 * release, at="node")

    return run(4.0, flow="two_phase", soil=None, change=beside_the_edge, numerics={"particle_count": 1})


SCENES = {f"{kind} {law}": lambda kind=kind, law=law: run(**{kind: law}) for kind in LAWS for law in LAWS[kind]}
SCENES |= {
    f"two phases {kind} {law}": lambda kind=kind, law=law: run(0.3, flow="two_phase", **{kind: law})
    for kind, law in (
        ("friction", "voellmy"),
        ("erosion", "liquefied_bed"),
        ("column", "classical"),
        ("column", "none"),
    )
}
SCENES |= {
    "two phases that leave at once": left_at_once,
    "at a wall": lambda: run(2.0, change=wall),
    "two phases at a wall": lambda: run(1.5, change=wall, flow="two_phase"),
    "loaded bed": lambda: run(material=LOADED),
    "dilatancy": lambda: run(0.2, column={"law": "ale", "dilatancy": {}}, change=drain),
    "dilatancy, soil in the half cell": lambda: run(0.2, column={"law": "ale", "dilatancy": {}, "bed_contact": "flux"}),
    "inflow": lambda: run(1.0, inflow=SURGE),
    "two phases in": lambda: run(0.8, inflow=SURGE, flow="two_phase"),
    "out of the grid": lambda: run(2.0, shape=(9, 11), inclination=1.5, erosion="none", column="none"),
    "thin soil": lambda: run(soil=0.01),
    "threads": lambda: run(0.3, numerics={"threads": 2}),
    "at rest": settled,
    "two phases at rest": lambda: settled(flow="two_phase"),
    "watched": watched,
}


def result(name):
    """Run a scene; return sums that every particle, column and node has a part in."""
    flow = SCENES[name]()
    numbers = dict(flow.budget)
    particles, maps = flow.particles, flow.maps
    for each in ("x", "y", "depth", "velocity_x", "basal_pressure"):
        if each in particles:
            numbers[each] = float(np.abs(particles[each].values).sum())
    for each in maps.data_vars:
        if maps[each].dtype == float:
            numbers[each] = float(np.nansum(np.abs(maps[each].values)))
    return numbers


if __name__ == "__main__":
    print(json.dumps({name: result(name) for name in SCENES}))
