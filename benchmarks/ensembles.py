"""Ensembles of the gully: cost beside the runs, members a minute, memory, and the plan beside 8000 particles.

python -m benchmarks.ensembles overhead            CPU time and bytes of a member beside its run; 1 minute
python -m benchmarks.ensembles workers             members a minute of one worker and of two; 3 minutes
python -m benchmarks.ensembles client --members N  CPU time of client and scheduler by the length of batches; 1 minute
python -m benchmarks.ensembles memory --members N  largest memory of all processes; N members with 30 particles
python -m benchmarks.ensembles plan --members N    cost and probabilities of fidelity auto beside 8000 particles
python -m benchmarks.ensembles plan-s1000          the same on the landslide S-1000, with erosion; 20 minutes
"""

import argparse
import tempfile
import threading
import time
from pathlib import Path

import numpy as np
import psutil

from landlab_debrisflow import Scene
from landlab_debrisflow.ensemble import Ensemble
from landlab_debrisflow.ensemble.cluster import connected
from landlab_debrisflow.ensemble.member import prepare_member
from landlab_debrisflow.fidelity.pilots import collected_warnings
from landlab_debrisflow.run.advance import start
from landlab_debrisflow.run.grids import build_grid
from landlab_debrisflow.scene.releases import advance

from .calibration_s1000 import event

HEAD = [[400020, 5200140], [400045, 5200140], [400045, 5200160], [400020, 5200160]]
VARY = {
    "friction.basal_friction_angle": {"truncated_normal": {"mean": 28.0, "sd": 2.0, "low": 20.0, "high": 36.0}},
    "release.volume": {"lognormal": {"median": 700.0, "sigma": 0.3}},
}
VARY_LANDSLIDE = {
    "friction.basal_friction_angle": {"truncated_normal": {"mean": 31.0, "sd": 2.0, "low": 24.0, "high": 38.0}},
    "erosion.growth_rate": {"lognormal": {"median": 1.22e-3, "sigma": 0.5}},
    "material.initial_pressure_ratio": {"uniform": {"low": 0.0, "high": 0.6}},
}
THRESHOLDS = {"max_depth": 0.5, "max_speed": 5.0, "max_impact_pressure": 30e3, "deposit_depth": 0.3}
"""Thresholds of the probabilities that are compared, in the units of the maps."""


def ensemble(members: int, particles: int, duration: float = 3600.0, **others) -> Ensemble:
    """Return an ensemble of the gully."""
    scene = {
        "terrain": {"example": "gully"}, "release": {"polygons": HEAD, "depth": 1.5},
        "friction": {"law": "voellmy", "basal_friction_angle": 28.0}, "numerics": {"particle_count": particles},
        "output": {"max_duration": duration},
    }  # fmt: skip
    return Ensemble(Scene.from_mapping(scene), VARY, members, seed=1, **others)


def quiet(text: str) -> None:
    """Take no notice of progress."""


def overhead(members: int) -> None:
    """Print CPU time and bytes of a member beside its run."""
    runs = ensemble(members, 60, 20.0)
    basis = runs.basis()
    runs.run(workers=1, notify=quiet)  # kernels are compiled
    alone = []
    for member in range(members):
        prepared = prepare_member(basis, runs.values(member))
        grid = build_grid(basis.terrain)
        began = time.process_time()
        with collected_warnings():
            advance(start(grid, prepared.setup, prepared.releases), prepared.releases, prepared.max_duration)
        alone.append(time.process_time() - began)
    with tempfile.TemporaryDirectory() as folder:
        store = Path(folder) / "members.zarr"
        began = time.process_time()
        results = runs.run(store=store, workers=1, notify=quiet)
        here = time.process_time() - began
        stored = sum(path.stat().st_size for path in store.rglob("*") if path.is_file())
        sent = [sum(values.nbytes for values in one.maps.values()) for one in results.members()]
    print(f"run of a member {1e3 * np.mean(alone):.1f} ms; beside it {1e3 * (here - sum(alone)) / members:.1f} ms")
    print(f"maps of a member {np.mean(sent) / 1e6:.3f} MB, in the store {stored / members / 1e6:.3f} MB")


def workers(members: int) -> None:
    """Print members a minute of one worker process and of two."""
    paces = []
    for count in (1, 2):
        with connected(None, count) as client:
            ensemble(8 * count, 200).run(client, notify=quiet)  # every worker has imported and compiled
            own, began, cpu = ensemble(members, 200), time.perf_counter(), time.process_time()
            own.run(client, notify=quiet)
            wall, cpu = time.perf_counter() - began, time.process_time() - cpu
        paces.append(60.0 * members / wall)
        print(f"{count} workers: {paces[-1]:.1f} members a minute; {1e3 * cpu / members:.1f} ms of the client each")
    print(f"ratio {paces[1] / paces[0]:.2f}")


def client(members: int) -> None:
    """Print CPU time of the client, which runs the scheduler of a local cluster, by the length of batches."""
    lengths, times = (1, 8, 64), []
    with connected(None, 2) as own, tempfile.TemporaryDirectory() as folder:
        ensemble(16, 30, 5.0).run(own, notify=quiet)  # every worker has imported and compiled
        for length in lengths:
            began = time.process_time()
            ensemble(members, 30, 5.0, batch=length).run(own, Path(folder) / f"{length}.zarr", notify=quiet)
            times.append(1e3 * (time.process_time() - began) / members)
            print(f"batches of {length}: {times[-1]:.1f} ms of the client for a member", flush=True)
    each, batch = np.polynomial.Polynomial.fit(1.0 / np.array(lengths), times, 1).convert().coef
    print(f"{batch:.1f} ms for a batch and {each:.1f} ms for each member in it")


def memory(members: int) -> None:
    """Print the largest memory of all processes while an ensemble runs on two workers."""
    largest, ended, own = [0], threading.Event(), psutil.Process()

    def watch():
        while not ended.wait(0.2):
            found = 0
            for process in (own, *own.children(recursive=True)):
                try:
                    found += process.memory_info().rss
                except psutil.NoSuchProcess:
                    continue
            largest[0] = max(largest[0], found)

    watcher = threading.Thread(target=watch)
    with tempfile.TemporaryDirectory() as folder:
        runs = ensemble(members, 30, 5.0, batch=8 if members > 16 else 1)
        watcher.start()
        began = time.perf_counter()
        runs.run(store=Path(folder) / "members.zarr", workers=2, notify=quiet)
        ended.set()
        watcher.join()
    print(
        f"{members} members in {time.perf_counter() - began:.0f} s: at most {largest[0] / 1e9:.3f} GB in all processes"
    )


def probabilities(results) -> dict[str, np.ndarray]:
    """Return the probability of exceeding the thresholds at every node."""
    counts = {name: np.zeros(results.lattice.shape, int) for name in THRESHOLDS}
    for one in results.members():
        for name, threshold in THRESHOLDS.items():
            counts[name][one.rows, one.columns] += one.maps[name] > threshold
    return {name: count / results.done.sum() for name, count in counts.items()}


def landslide(members: int, particles: int, **others) -> Ensemble:
    """Return an ensemble of the landslide S-1000 on its DEM of 10 m, with erosion."""
    given, _ = event("s1000", particles)
    return Ensemble(given.scene, VARY_LANDSLIDE, members, seed=1, **others)


def plan(members: int, build=ensemble, vary=VARY) -> None:
    """Print cost and probabilities of an ensemble with its plan beside those with 8000 particles."""
    found, costs = [], []
    for options in ({"particles": 2000, "fidelity": "auto"}, {"particles": 8000}):
        runs = build(members, **options)
        began = time.process_time()
        basis_plan = runs.plan(quiet) if runs.automatic else None
        pilots = time.process_time() - began
        if basis_plan is not None:
            print(basis_plan)
            setup = basis_plan.applied(runs.scene.setup)
            runs = Ensemble(_with_setup(runs.scene, setup), vary, members, seed=1)
        results = runs.run(workers=1, notify=quiet)
        costs.append(pilots + float(np.nansum(results.seconds)))
        print(f"{options}: {costs[-1]:.0f} s of CPU time, of which pilots {pilots:.0f} s", flush=True)
        found.append(probabilities(results))
    print(f"ratio of costs {costs[0] / costs[1]:.3f}")
    for name, threshold in THRESHOLDS.items():
        one, other = (part[name] for part in found)
        nodes = (one > 0.0) | (other > 0.0)
        error = np.sqrt(np.maximum(other * (1.0 - other), 1.0 / members) / members)
        within = abs(one - other)[nodes] <= 1.96 * error[nodes]
        differences, errors = (np.sqrt(np.mean(part[nodes] ** 2)) for part in (one - other, error))
        print(
            f"P({name} > {threshold:g}): rms difference {differences:.4f}, rms sampling error {errors:.4f}; "
            f"{100.0 * within.mean():.1f} % of {nodes.sum()} nodes within 1.96 sampling errors, largest difference "
            f"{abs(one - other).max():.3f}"
        )


def plan_landslide(members: int) -> None:
    """Print cost and probabilities of the landslide's ensemble with its plan beside those with 8000 particles."""
    plan(members, landslide, VARY_LANDSLIDE)


def _with_setup(scene: Scene, setup) -> Scene:
    mapping = scene.to_mapping() | {key: value for key, value in setup.to_mapping().items() if key != "inflow"}
    return Scene.from_mapping({key: value for key, value in mapping.items() if value != []})


TABLES = {
    "overhead": overhead, "workers": workers, "client": client, "memory": memory, "plan": plan,
    "plan-s1000": plan_landslide,
}  # fmt: skip


def main() -> None:
    """Print one of the tables."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("table", choices=TABLES)
    parser.add_argument("--members", type=int, default=32)
    arguments = parser.parse_args()
    TABLES[arguments.table](arguments.members)


if __name__ == "__main__":
    main()
