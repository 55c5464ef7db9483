"""Kernels run as plain Python, which checks every index, as well: `nox -s test-nojit`, and measures what is reached."""

import functools
import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from landlab_debrisflow.model import kinematics

from .scenes import SCENES, result

PLAIN = not hasattr(kinematics.drift, "py_func")


@functools.cache
def compiled():
    """Return the results of all scenes in a process whose kernels are compiled."""
    command = [sys.executable, "-m", "tests.without_jit.scenes"]
    environment = os.environ | {"NUMBA_DISABLE_JIT": "0", "COVERAGE_PROCESS_START": ""}
    root = Path(__file__).parents[2]
    return json.loads(subprocess.run(command, cwd=root, env=environment, capture_output=True, check=True).stdout)


@pytest.mark.parametrize("name", SCENES)
def test_a_scene_ends_with_the_same(name):
    found = result(name)
    assert found["released"] + found["inflow"] > 0.0
    if PLAIN:
        # sums over neighbours are of single precision, reordered, with estimated roots: measured 4.5e-5
        assert found == pytest.approx(compiled()[name], rel=1e-3, abs=1e-3)
