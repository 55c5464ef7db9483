"""The scenes of recorder.py, a program of its own that either version runs: ``python -P recorder_scenes.py FOLDER``.

Uses the public interface only, because everything else has other names in another version. Writes what it finds into
FOLDER: the arrays of every scene as ``<scene>.npz`` and the numbers of steps as steps.json, or, with ``--whole
OFFSET ...``, the scalars of whole events with that many particles more as whole.json.
"""

import argparse
import hashlib
import importlib.util
import json
import logging
import os
import tempfile
from functools import partial
from pathlib import Path


def cache_of_its_own() -> None:
    """Let numba keep kernels by all sources of the package: its own index knows one file of those a kernel is made of.

    Must run before anything imports numba.
    """
    package = Path(importlib.util.find_spec("landlab_debrisflow").origin).parent
    digest = hashlib.sha256()
    for path in sorted(package.rglob("*.py")):
        digest.update(path.relative_to(package).as_posix().encode() + path.read_bytes())
    folder = Path(tempfile.gettempdir()) / "landlab_debrisflow_recorder" / digest.hexdigest()[:16]
    os.environ["NUMBA_CACHE_DIR"] = str(folder)


cache_of_its_own()

import numpy as np  # noqa: E402
from landlab import RasterModelGrid  # noqa: E402

from landlab_debrisflow import DebrisFlow, solve_column  # noqa: E402

RELEASE = "debris_flow__release_depth"
LONGEST = 600.0  # of a whole event [s]


def valley(rows=24, columns=110, slope=0.5, foot=200.0, soil=1.5, release=1.2, radius=17.0):
    """Return a gully that falls by half to a plain, on nodes of 5 m, with a release near its top."""
    grid = RasterModelGrid((rows, columns), xy_spacing=5.0)
    x, y = grid.x_of_node, grid.y_of_node - 2.5 * (rows - 1)
    grid.add_field("topographic__elevation", slope * np.maximum(0.0, foot - x) + 0.1 * abs(y), at="node")
    grid.add_full("soil__depth", soil, at="node")
    grid.add_field(RELEASE, release * (np.hypot(x - 45.0, y) < radius), at="node")
    return grid


def flow(grid, particles, settle=True, **keywords):
    return DebrisFlow(grid, numerics={"particle_count": particles, "settle": settle}, **keywords)


def plain(n, **keywords):
    """Nothing but the valley."""
    return flow(valley(), n, **keywords)


def inflow(n, **keywords):
    """Two surges across lines, one beside a release, with pressures of their own."""
    upper = {
        "line_start": (70.0, 45.0), "line_end": (70.0, 70.0), "times": [0.0, 4.0, 12.0], "discharge": [0.0, 60.0, 20.0],
        "velocity": 4.0, "pressure_ratio": [0.8, 0.8, 0.4],
    }  # fmt: skip
    lower = upper | {"line_start": (140.0, 50.0), "line_end": (140.0, 65.0), "discharge": [20.0, 0.0, 10.0]}
    return flow(valley(), n, inflow=[upper, lower], friction="voellmy", erosion="shear_excess", **keywords)


def walls(n, **keywords):
    """Two buildings of closed nodes in the way, and a dam that reaches to the edge."""
    grid = valley()
    x, y = grid.x_of_node, grid.y_of_node
    for west, east, south, north in ((85, 105, 50, 62), (120, 135, 70, 90), (150, 165, 0, 50)):
        inside = (x >= west) & (x <= east) & (y >= south) & (y <= north)
        grid.status_at_node[inside] = grid.BC_NODE_IS_CLOSED
    return flow(grid, n, friction={"law": "voellmy", "basal_friction_angle": 25.0}, **keywords)


def loaded_bed(n, drained=False, **keywords):
    """A bed whose pore pressure rises with the weight of the flow, and drains."""
    grid = valley()
    material = {
        "bed_porosity": 0.45, "basal_slip_ratio": 1 / 3, "bed_loading_coefficient": 0.6, "bed_drainage_time": 120.0
    }  # fmt: skip
    if drained:
        grid.add_field("bed__drained", 1.0 * ((grid.x_of_node > 80.0) & (grid.x_of_node < 130.0)), at="node")
    return flow(grid, n, material=material, friction="voellmy", **keywords)


def in_space(n, law, names, **keywords):
    """A friction law some of whose parameters are arrays over nodes, the first of them a field by name."""
    grid = valley()
    waves = 1.0 + 0.2 * np.sin(grid.x_of_node / 20.0) * np.cos(grid.y_of_node / 15.0)
    values = {name: law[name] * waves for name in names}
    grid.add_field("friction__first", values[names[0]], at="node")
    erosion = {"law": "growth", "growth_rate": 0.01 * waves}
    given = law | values | {names[0]: "friction__first"}
    return flow(grid, n, friction=given, erosion=erosion, **keywords)


def sleeping(n, **keywords):
    """One body slides down towards another, which lies still at the foot."""
    grid = valley(foot=150.0)
    near = np.hypot(grid.x_of_node - 200.0, grid.y_of_node - 57.5) < 17.0
    grid.at_node[RELEASE][near] = 0.6
    material = {"coefficient_of_consolidation": 2e-3, "initial_pressure_ratio": 0.3}
    return flow(grid, n, material=material, **keywords)


VISCOUS = {"law": "coulomb", "cohesion": 50.0, "viscosity": 0.5}
VOELLMY = {"law": "voellmy", "basal_friction_angle": 28.0, "turbulent_coefficient": 400.0}
MUD = {"law": "herschel_bulkley", "yield_stress": 900.0, "flow_index": 0.4}
DRAG = {"law": "two_phase", "drag": "anderson_jackson", "terminal_velocity": 1.0, "manning_coefficient": 0.03}
LEVELS = {"law": "ale", "levels": 21, "bed_contact": "flux", "loading_source": "proportional"}
FLOWS = {
    "one phase": {
        "defaults": plain,
        "voellmy": partial(plain, friction="voellmy", erosion="liquefied_bed", column="classical"),
        "bingham": partial(plain, friction="bingham", column={"law": "ale", "scheme": "upwind"}),
        "herschel_bulkley": partial(plain, friction="herschel_bulkley", column="constant_ratio"),
        "mu_i": partial(plain, friction="mu_i", erosion="none", column="none"),
        "coulomb": partial(plain, friction=VISCOUS, column=LEVELS),
    },
    "two phases": {
        "darcy": partial(plain, flow="two_phase"),
        "anderson_jackson": partial(plain, flow=DRAG, friction=VISCOUS, material={"bed_porosity": 0.45}),
    },
    "inflow": {"one phase": inflow, "two phases": partial(inflow, flow="two_phase")},
    "walls": {"one phase": walls, "two phases": partial(walls, flow=DRAG)},
    "loaded bed": {"one phase": loaded_bed, "drained": partial(loaded_bed, drained=True)},
    "parameters in space": {
        "voellmy": partial(in_space, law=VOELLMY, names=("basal_friction_angle", "turbulent_coefficient")),
        "herschel_bulkley": partial(in_space, law=MUD, names=("yield_stress", "flow_index")),
        "two phases": partial(in_space, law=VISCOUS, names=("cohesion", "viscosity"), flow="two_phase"),
    },
    "sleeping": {"two bodies": sleeping},
}
"""Scene, flow, and what makes it with some number of particles."""

PARTICLES = 300
SECONDS = dict.fromkeys(FLOWS, 8.0) | {"loaded bed": 11.0}
"""How long the scenes run: 50 steps and some more."""

GROWING = {"times": [20.0, 60.0], "step": 0.25, "entrainment_rate": lambda t: 0.05 if t < 43.2 else 0.0}
MANY = {
    "thickness": np.linspace(0.5, 2.0, 12), "coefficient_of_consolidation": np.logspace(-6, -1, 12), "loading": 9810.0,
    "initial": "basal_layer", "basal_pressure": lambda t: 3e3 + 1e3 * np.sin(t / 7.0),
}  # fmt: skip
COLUMNS = {
    "default": {},
    "every step": {"advance": "every_step"},
    "classical": {"law": "classical", "levels": 41},
    "constant ratio": {"law": "constant_ratio", "basal_pressure": 1.0, "basal_pressure_ratio": 0.6},
    "lax_wendroff": {"scheme": "lax_wendroff", "coefficient_of_consolidation": np.logspace(-6, -3, 12)},
    "upwind": {"scheme": "upwind"},
    "flux": {"bed_contact": "flux"},
    "closed": {"base": "impermeable", "divergence_rate": lambda t: 0.01 * np.sin(t / 5.0)},
    "drained": {"base": ["drained", "by_erosion", "prescribed", "impermeable"] * 3, "porosity_source": 20.0},
    "proportional": {"loading_source": "proportional", "divergence_rate": 0.01, "bounded": True},
    "of the paper": {"source_includes_erosion": True, "initial": "uniform"},
}  # fmt: skip
"""Arguments of solve_column, beside those of `MANY` and `GROWING`: 240 steps of 12 columns."""


class Counter:
    """Counts the steps: an observer whose interval is shorter than any of them."""

    interval = 1e-9

    def __init__(self):
        self.times = set()

    def observe(self, flow):
        self.times.add(flow.elapsed_time)


def arrays(flow) -> dict[str, np.ndarray]:
    """Return copies of all that a flow shows."""
    found = {f"node {name}": flow.grid.at_node[name] for name in flow.grid.at_node}
    for kind in ("particles", "columns", "maps"):
        found |= {f"{kind}.{name}": data.values for name, data in getattr(flow, kind).variables.items()}
    # volumes side by side, so that the residual is seen beside them
    found["budget"] = list(flow.budget.values())
    found |= {f"budget of {phase}": list(volumes.values()) for phase, volumes in flow.budget_by_phase.items()}
    found["outflow"] = list(flow.outflow_by_edge.values())
    found["elapsed_time"] = flow.elapsed_time
    return {name: np.array(values) for name, values in found.items()}


def record_flows(scene: str) -> tuple[dict[str, np.ndarray], int]:
    """Return the arrays of a scene's flows at half the time and at the end, and the steps of the one with fewest.

    Steps are counted in runs of their own, so that nothing has looked at what is compared.
    """
    found, steps, half = {}, [], SECONDS[scene] / 2.0
    for name, make in FLOWS[scene].items():
        one, counter = make(PARTICLES), Counter()
        for moment in ("half", "end"):
            one.run_one_step(half)
            found |= {f"{name}, {moment}: {key}": values for key, values in arrays(one).items()}
        make(PARTICLES, observers=[counter]).run_one_step(2.0 * half)
        steps.append(len(counter.times))
    return found, min(steps)


def record_columns() -> tuple[dict[str, np.ndarray], int]:
    """Return the arrays of columns by themselves, and the steps they took."""
    found = {}
    for name, arguments in COLUMNS.items():
        solved = solve_column(**GROWING | MANY | arguments)
        found |= {f"{name}: {key}": data.values for key, data in solved.variables.items()}
    return found, round(GROWING["times"][-1] / GROWING["step"])


def scalars(flow) -> dict[str, float | str]:
    """Run an event to its end, and return what would be asked of it, and a digest of all that it left on the grid."""
    flow.run_until_rest(LONGEST)
    maps, budget, x = flow.maps, flow.budget, flow.maps.x.values
    lies = np.nansum(maps.debris_flow__deposit_depth.values + maps.debris_flow__depth.values, axis=0)
    reached = np.nanmax(maps.debris_flow__max_depth.values, axis=0, initial=0.0) > 0.0
    return {
        "eroded [m3]": budget["eroded"],
        "deposited [m3]": budget["deposited"],
        "outflow [m3]": budget["outflow"],
        "front [m]": float(np.interp(0.99, np.cumsum(lies) / lies.sum(), x)),
        "run-out [m]": float(x[reached].max()),
        "largest speed [m/s]": float(np.nanmax(maps.debris_flow__max_speed.values)),
        "duration [s]": flow.elapsed_time,
        "digest": hashlib.sha256(b"".join(values.tobytes() for values in arrays(flow).values())).hexdigest(),
    }


def main() -> None:
    logging.getLogger("landlab_debrisflow").setLevel(logging.ERROR)
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--whole", type=int, nargs="+", metavar="OFFSET")
    options = parser.parse_args()
    if options.whole:
        found = {
            f"{scene}, {name}": [scalars(make(PARTICLES + more)) for more in options.whole]
            for scene, flows in FLOWS.items()
            for name, make in flows.items()
        }
        (options.folder / "whole.json").write_text(json.dumps(found))
        return
    steps = {}
    for scene in (*FLOWS, "solve_column"):
        found, steps[scene] = record_columns() if scene == "solve_column" else record_flows(scene)
        np.savez(options.folder / f"{scene}.npz", **found)
    (options.folder / "steps.json").write_text(json.dumps(steps))


if __name__ == "__main__":
    main()
