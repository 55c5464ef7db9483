"""What the user waits for at the first start: each kernel is compiled once (docs/decisions.md, Start)."""

import os
import subprocess
import sys

PROGRAM = """
import sys
import numpy as np
from landlab import RasterModelGrid
from landlab_debrisflow import DebrisFlow
grid = RasterModelGrid((20, 80), xy_spacing=5.0)
grid.add_field("topographic__elevation", np.maximum(0.0, 75.0 - 0.5 * grid.x_of_node), at="node")
grid.add_full("soil__depth", 1.0, at="node")
release = grid.add_zeros("debris_flow__release_depth", at="node")
release[(abs(grid.x_of_node - 30) < 8) & (abs(grid.y_of_node - 48) < 8)] = 1.0
flow = DebrisFlow(grid, numerics={"particle_count": 60})
flow.run_one_step(0.1)
flow.run_until_rest()
flow.columns
for name, module in list(sys.modules.items()):
    for kernel in vars(module).values() if name.startswith("landlab_debrisflow") else ():
        if hasattr(kernel, "py_func") and kernel.py_func.__module__ == name:
            print(name, kernel.py_func.__name__, len(kernel.signatures))
"""


def test_every_kernel_of_an_event_is_compiled_for_one_signature():
    # a process of its own: other tests call kernels with other types, or are run without compiling
    compiling = os.environ | {"NUMBA_DISABLE_JIT": "0"}
    run = subprocess.run([sys.executable, "-c", PROGRAM], check=True, capture_output=True, text=True, env=compiling)
    found = {tuple(line.split()[:2]): int(line.split()[2]) for line in run.stdout.splitlines()}
    used = {name for (_, name), count in found.items() if count}
    assert {"account", "stand", "close", "look", "open_up", "grow", "settle"} <= used
    assert {name: count for name, count in found.items() if count > 1} == {}
