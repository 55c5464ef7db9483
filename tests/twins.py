"""Scenes that use every kind of state a flow has, and all of that state, to compare twins to the bit."""

from contextlib import contextmanager
from unittest import mock

import numpy as np

from landlab_debrisflow import DebrisFlow
from landlab_debrisflow.model import step
from landlab_debrisflow.record.observers import EVERY_STEP
from landlab_debrisflow.terrain.bed import Bed
from validation.grids import inclined, release_slab

SURGES = {
    "line_start": (20.0, 38.0), "line_end": (20.0, 58.0), "times": [1.0, 3.0, 5.0, 40.0, 41.0, 44.0],
    "discharge": [0.0, 20.0, 0.0, 0.0, 20.0, 0.0], "velocity": 4.0,
}  # fmt: skip


def valley(soil=1.0, shape=(20, 60)):
    grid = inclined(shape, 5.0, 0.5, soil=soil, foot=120.0)
    release_slab(grid, (30.0, 48.0), 8.0, 1.0)
    return grid


def with_sleepers():
    """One body lies at the foot, until another runs into it."""
    grid = inclined((20, 60), 5.0, 0.5, soil=1.0, foot=120.0)
    y = abs(grid.y_of_node - 48.0) < 11.0
    release = grid.add_zeros("debris_flow__release_depth", at="node")
    release[y & (abs(grid.x_of_node - 30.0) < 13.0)] = 1.0
    release[y & (abs(grid.x_of_node - 150.0) < 13.0)] = 0.5
    return grid


def with_walls():
    grid = valley()
    grid.status_at_node[(abs(grid.x_of_node - 100.0) < 8.0) & (abs(grid.y_of_node - 40.0) < 8.0)] = 4
    return grid


def with_loaded_bed():
    """Wet far from the flow, too."""
    grid = valley(shape=(60, 60))
    grid.add_full("bed__excess_pore_pressure", 500.0, at="node")
    return grid


def half_wet():
    """Wetter to one side."""
    grid = valley()
    wetness = (grid.y_of_node - grid.y_of_node.min()) / np.ptp(grid.y_of_node)
    grid.add_field("bed__degree_of_saturation", wetness, at="node")
    return grid


def with_friction():
    grid = valley()
    grid.add_full("friction__angle", 30.0, at="node")
    return grid


WET = {"coefficient_of_consolidation": 2e-3, "initial_pressure_ratio": 0.3}
SCENES = {
    "bare": (lambda: valley(soil=None), {}),
    "eroding": (valley, {}),
    "not settling": (valley, {"numerics": {"settle": False}}),
    "two phases": (valley, {"flow": "two_phase"}),
    "inflow": (valley, {"inflow": SURGES}),
    "sleeping": (with_sleepers, {"material": WET, "numerics": {"particle_count": 200}}),
    "walls": (with_walls, {}),
    "loaded bed": (with_loaded_bed, {"material": {"bed_loading_coefficient": 0.6, "bed_drainage_time": 20.0}}),
    "half-wet bed": (half_wet, {"erosion": "excess_traction", "material": WET | {"bed_pressure_ratio": 1.0}}),
    "dilatancy": (
        with_sleepers,
        {"column": {"law": "ale", "dilatancy": {"permeability": 1e-10}}, "inflow": SURGES | {"pressure_ratio": 0.3},
         "numerics": {"particle_count": 200}},
    ),
    "friction from a field": (
        with_friction, {"friction": {"law": "coulomb", "basal_friction_angle": "friction__angle"}},
    ),
    "mu(I), shear excess": (valley, {"friction": "mu_i", "erosion": "shear_excess", "column": "classical"}),
}  # fmt: skip
"""Grid and keywords of a flow each."""


def build(name, observers=(), threads=1, **grid):
    """Return the flow of a scene; `grid` is for the function that makes its grid."""
    make, keywords = SCENES[name]
    numerics = {"particle_count": 60, "threads": threads} | keywords.get("numerics", {})
    return DebrisFlow(make(**grid), **(keywords | {"numerics": numerics}), observers=observers)


SCRATCH = {"_touched", "_granted", "_scratch", "_demand", "_sums", "_taken", "_before", "_cover", "_last", "cpu"}
"""Arrays that are written before they are read, or 0 between two uses; what was found last and is found anew if it does
not fit; accounts of a bed by slot, which are compared by node; and what it took on this machine."""

HISTORY = {"interrupted", "interruption", "_interruption"}
"""What a flow may go back to, and what was the matter in its last call."""


def state(flow):
    """Return everything that decides how a flow goes on, by its place, as bytes and plain values.

    Whatever attribute is added to any object of the model is found.
    """
    found = {f"field {name}": values.tobytes() for name, values in flow.grid.at_node.items()}
    found["status"] = flow.grid.status_at_node.tobytes()
    _collect("flow", flow._call, found, {id(flow), id(flow.grid), id(flow.setup), id(flow.setup.numerics)})
    return found


def _collect(place, value, found, seen):
    if isinstance(value, np.ndarray):
        found[place] = (value.dtype.str, value.shape, value.tobytes())
    elif value is None or isinstance(value, str | int | float | np.generic | slice):
        found[place] = repr(value)
    elif id(value) in seen or callable(value):
        return
    elif isinstance(value, dict | list | tuple):
        items = dict(value) if isinstance(value, dict) else dict(enumerate(value))
        found[place] = repr(list(items))
        for key, each in items.items():
            _collect(f"{place}[{key!r}]", each, found, seen)
    else:
        seen.add(id(value))
        if isinstance(value, Bed):
            _collect(f"{place}.variables", value.variables(), found, seen)
        attributes = {name: each for name, each in vars(value).items() if name not in SCRATCH | HISTORY}
        found[place] = repr(sorted(attributes))
        for name, each in attributes.items():
            _collect(f"{place}.{name}", each, found, seen)


def outcome(flow):
    """Return all that a user can see of a flow, and the number of its steps, likewise."""
    found = {f"field {name}": values.tobytes() for name, values in flow.grid.at_node.items()}
    for kind, dataset in (("particles", flow.particles), ("columns", flow.columns)):
        found |= {f"{kind} {name}": values.values.tobytes() for name, values in dataset.variables.items()}
    found |= {f"budget {name}": volume for name, volume in flow.budget.items()}
    found |= {f"outflow {edge}": volume for edge, volume in flow.outflow_by_edge.items()}
    return found | {"time": flow.elapsed_time, "steps": flow.diagnostics.steps, "at rest": flow.at_rest}


def different(one, other):
    """Return the places at which two states or outcomes differ."""
    return sorted(place for place in one.keys() | other.keys() if one.get(place) != other.get(place))


class Failed(Exception):
    """Raised in the middle of a step, or by an observer."""


@contextmanager
def failing(calls, stage="consolidate", error=Failed):
    """Let a stage of the step raise after it has done its work for so many times."""
    original, count = getattr(step, stage), [0]

    def fail(*arguments):
        result = original(*arguments)
        count[0] += 1
        if count[0] == calls:
            raise error
        return result

    with mock.patch.object(step, stage, fail):
        yield


class Fails:
    """An observer that fails when it has looked before the first step and after so many steps."""

    interval = EVERY_STEP

    def __init__(self, *steps, error=Failed):
        self.steps, self.error, self.looks = steps, error, []

    def observe(self, flow):
        self.looks.append(flow.elapsed_time)
        if len(self.looks) - 1 in self.steps:
            raise self.error


def run_through(flow, duration=None):
    """Run a flow to rest, or for so many seconds, as often as it takes; return how often it was interrupted."""
    interruptions, began = 0, flow.elapsed_time
    while True:
        try:
            if duration is None:
                flow.run_until_rest()
            else:
                flow.run_one_step(duration - (flow.elapsed_time - began))
            return interruptions
        except (Failed, KeyboardInterrupt) as interruption:
            interruptions += 1
            if "had come to its end" in interruption.__notes__[0]:
                return interruptions
