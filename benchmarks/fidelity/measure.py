"""Measure a run: its quantities at the end, and its cost."""

import importlib.util
import logging
import math
import time
from pathlib import Path

from landlab_debrisflow import DebrisFlow

from .variations import vary

QUANTITIES = Path(__file__).parents[2] / "landlab_debrisflow" / "fidelity" / "quantities.py"
DIGITS = 5  # significant ones that are kept


def load_quantities():
    """Return the module of the checkout, which measures an older package that is installed, too."""
    name = "landlab_debrisflow.fidelity.quantities"
    spec = importlib.util.spec_from_file_location(name, QUANTITIES)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


quantities = load_quantities()


def rounded(value):
    """Return a number with the digits that are kept, None instead of NaN."""
    return None if not math.isfinite(value) else float(f"{value:.{DIGITS}g}")


def build(scene, particles: int, variation: str, observers=()):
    """Return the flow of a `Scene`, and its longest time [s].

    Parameters
    ----------
    scene : Scene
    particles : int
        Their number, before the variation.
    variation : str
        Words of `variations`.
    """
    grid, keywords, numerics = vary(scene, particles, variation)
    return DebrisFlow(grid, **keywords, numerics=numerics | {"settle": False}, observers=observers), scene.max_duration


def warm_up(make, variation: str) -> None:
    """Load the kernels that a run needs, so that its cost is that of the run; `make` returns a new `Scene`."""
    flow, _ = build(make(), 50, variation)
    flow.run_one_step(3.0)


def measure(make, particles: int, variation: str = "") -> dict:
    """Run a scene and return its quantities and its cost.

    Parameters
    ----------
    make : callable
        Returns a new `Scene`.
    particles : int
    variation : str

    Returns
    -------
    dict
        Quantities by name; "at_rest", "steps", "seconds" (CPU of the run), "made": particles that were made,
        "outflow": volume that left over what there was [-].
    """
    log = logging.getLogger("landlab_debrisflow")
    level = log.level
    log.setLevel(logging.ERROR)  # what does not come to rest is no news here
    try:
        return _measure(make, particles, variation)
    finally:
        log.setLevel(level)


def _measure(make, particles, variation) -> dict:
    warm_up(make, variation)
    scene = make()
    flow, duration = build(scene, particles, variation)
    origin = quantities.origin_of(flow.grid, flow.setup)
    began = time.process_time()
    rest = flow.run_until_rest(duration)
    seconds = time.process_time() - began
    budget = flow.budget
    whole = budget["released"] + budget["inflow"] + budget["eroded"]
    return {name: rounded(value) for name, value in quantities.quantities(flow, origin).items()} | {
        "at_rest": bool(rest), "steps": flow.diagnostics.steps, "seconds": round(seconds, 3),
        "made": flow.particles.sizes["particle"], "outflow": rounded(budget["outflow"] / whole),
    }  # fmt: skip
