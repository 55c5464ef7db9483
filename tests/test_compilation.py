"""What numba's cache is to the user: each kernel is compiled once, and a result does not depend on who compiled it."""

import os
import subprocess
import sys

import pytest

pytestmark = pytest.mark.slow

PROGRAM = """
import hashlib
import sys
import numpy as np
from landlab import RasterModelGrid
from landlab_debrisflow import DebrisFlow
grid = RasterModelGrid((20, 80), xy_spacing=5.0)
grid.add_field("topographic__elevation", np.maximum(0.0, 75.0 - 0.5 * grid.x_of_node), at="node")
grid.add_full("soil__depth", 1.0, at="node")
release = grid.add_zeros("debris_flow__release_depth", at="node")
release[(abs(grid.x_of_node - 30) < 8) & (abs(grid.y_of_node - 48) < 8)] = 1.0
flow = DebrisFlow(grid, numerics={"particle_count": 60, "threads": int(sys.argv[1])})
flow.run_one_step(0.1)
flow.run_until_rest()
flow.columns
for name, module in list(sys.modules.items()):
    for kernel in vars(module).values() if name.startswith("landlab_debrisflow") else ():
        if hasattr(kernel, "py_func") and kernel.py_func.__module__ == name:
            print(name, kernel.py_func.__name__, len(kernel.signatures))
print("fields", hashlib.sha256(b"".join(grid.at_node[name].tobytes() for name in sorted(grid.at_node))).hexdigest())
"""


def run(cache, threads=1):
    """Run the event in a process of its own; return what it printed: kernels and their signatures, the fields."""
    # other tests call kernels with other types, or are run without compiling
    compiling = os.environ | {"NUMBA_DISABLE_JIT": "0", "NUMBA_CACHE_DIR": str(cache)}
    command = [sys.executable, "-c", PROGRAM, str(threads)]
    ended = subprocess.run(command, check=True, capture_output=True, text=True, env=compiling)
    return [line.split() for line in ended.stdout.splitlines()]


@pytest.fixture(scope="module")
def first_start(tmp_path_factory):
    """Return a cache and what the process printed that found it empty."""
    cache = tmp_path_factory.mktemp("cache")
    return cache, run(cache)


def test_every_kernel_of_an_event_is_compiled_for_one_signature(first_start):
    found = {(module, name): int(count) for module, name, count in first_start[1][:-1]}
    used = {name for (_, name), count in found.items() if count}
    assert {"accumulate", "set_contact", "to_modes", "advance_modes", "to_levels", "grow", "commit"} <= used
    assert {name: count for name, count in found.items() if count > 1} == {}


def test_a_result_does_not_depend_on_what_is_cached(first_start):
    cache, compiled = first_start
    assert run(cache)[-1] == compiled[-1]
    for file in cache.rglob("soil_accounts.take_soil-*"):  # which shares an inner function with a kernel that stays
        file.unlink()
    assert run(cache, threads=2)[-1] == compiled[-1]
