"""Set-up shared by all tests."""

import os
import signal
from weakref import WeakKeyDictionary

from .numba_cache import NUMBA_CACHE

os.environ["NUMBA_CACHE_DIR"] = NUMBA_CACHE

import numpy as np
import pytest

from landlab_debrisflow.grid.call import GridCall
from landlab_debrisflow.model.simulation import Simulation
from validation.grids import inclined, release_slab

from .suspicions import BuiltError, suspicions
from .twins import build, outcome, state


def pytest_collection_modifyitems(items):
    """Build the site last: its pages run side by side, and read the kernels that tests have compiled by then."""
    items.sort(key=lambda item: "site" in getattr(item, "fixturenames", ()))


@pytest.fixture(autouse=True, scope="session")
def ctrl_c_is_heard():
    """Let Ctrl-C raise KeyboardInterrupt, also where the tests are a job in the background, which ignores it."""
    found = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, found)


@pytest.fixture
def slope():
    """A wet slope of 27 degrees with one metre of soil and 225 m3 about to fail: erodes, leaves nothing."""
    grid = inclined((20, 60), 5.0, 0.5, soil=1.0)
    release_slab(grid, (30.0, 48.0), 8.0, 1.0)
    return grid


@pytest.fixture
def valley():
    """The same slope running out on a flat: everything comes to rest inside."""
    grid = inclined((20, 80), 5.0, 0.5, soil=1.0, foot=150.0)
    release_slab(grid, (30.0, 48.0), 8.0, 1.0)
    return grid


@pytest.fixture(autouse=True)
def every_call_balances(monkeypatch):
    """In every test and example: volume, and the elevation the call left, against the budget, to round-off."""
    run, known = GridCall.run, WeakKeyDictionary()

    def checked(calls, duration, stop_at_rest):
        flow = calls.flow
        z, core = flow.grid.at_node["topographic__elevation"], flow.grid.core_nodes
        failing = flow.grid.at_node["debris_flow__release_depth"][core] > 0.0  # it may come back to where it was
        before, ground = flow.budget, z[core].copy()
        run(calls, duration, stop_at_rest)
        after, area = flow.budget, flow.grid.dx * flow.grid.dy
        tolerance = 1e-12 * (after["released"] + after["inflow"] + after["eroded"])
        gain = {name: after[name] - before[name] for name in after}
        rise = np.sum(z[core] - ground) * area
        # an elevation is rounded to eps |z| where it changes: in the release, by erosion and in the deposit
        rounding = 3.0 * np.finfo(float).eps * np.linalg.norm(ground[failing | (z[core] != ground)]) * area
        # what has been laid down, in this call or before, is measured in the elevation, too
        known[flow] = known.get(flow, 0.0) + rounding
        assert abs(after["residual"]) <= tolerance + known[flow]
        assert abs(rise - (gain["deposited"] - gain["released"] - gain["eroded"])) <= tolerance + rounding

    monkeypatch.setattr(GridCall, "run", checked)


@pytest.fixture
def only_built(monkeypatch):
    """Stop every flow with a `BuiltError` when particles would be made."""

    def stop(*_):
        raise BuiltError

    monkeypatch.setattr(Simulation, "release", stop)


@pytest.fixture
def no_doubts():
    """Yield what is doubted, of which nothing must be left."""
    with suspicions() as said:
        yield said
    assert said == []


@pytest.fixture(scope="session")
def twin():
    """The outcome and the state of flows that nobody interrupted, and the number of their steps."""
    known = {}

    def find(name):
        if name not in known:
            flow = build(name)
            flow.run_until_rest()
            known[name] = outcome(flow), state(flow), flow.diagnostics.steps
        return known[name]

    return find
