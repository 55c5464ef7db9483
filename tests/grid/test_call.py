"""The border between a grid and the model: what a call goes through, and what passes."""

import sys
from collections import deque
from pathlib import Path

import numpy as np
import pytest

import landlab_debrisflow
from landlab_debrisflow.grid import call
from landlab_debrisflow.grid.read import GridInput
from validation.grids import changed_fields, copy_fields

from ..twins import SCENES, build

PACKAGE = str(Path(landlab_debrisflow.__file__).parent)
STOPS = {"around_call", "read", "lay", "run", "ended"}


def stops_of(action):
    """Return the functions of the package that `GridCall.run` goes out to while something is done."""
    found = set()

    def watch(frame, event, _):
        caller = frame.f_back
        while caller is not None and caller.f_code.co_filename.endswith("contextlib.py"):
            caller = caller.f_back
        if event == "call" and caller is not None and caller.f_code.co_filename == call.__file__:
            inside = frame.f_code.co_filename == call.__file__
            if caller.f_code.co_name in ("run", "_prepare") and PACKAGE in frame.f_code.co_filename and not inside:
                found.add(frame.f_code)

    before = sys.getprofile()
    sys.setprofile(watch)
    try:
        action()
    finally:
        sys.setprofile(before)
    return found


@pytest.mark.parametrize("name", ["eroding", "inflow", "loaded bed", "two phases"])
def test_a_call_leaves_its_file_five_times(name):
    flow = build(name)
    found = stops_of(lambda: flow.run_one_step(2.0)) | stops_of(flow.run_until_rest)
    assert flow.at_rest
    assert {code.co_name for code in found} == STOPS and len(found) <= 5


def reachable(thing):
    """Yield everything that can be reached from an object by attributes and items."""
    seen, waiting = set(), deque([thing])
    while waiting:
        one = waiting.popleft()
        if id(one) in seen or one is None or isinstance(one, str | bytes | int | float | type):
            continue
        seen.add(id(one))
        yield one
        if isinstance(one, dict):
            waiting.extend([*one.keys(), *one.values()])
        elif isinstance(one, list | tuple | set | frozenset):
            waiting.extend(one)
        elif isinstance(one, np.ndarray):
            waiting.append(one.base)
        else:
            waiting.extend(vars(one).values() if hasattr(one, "__dict__") else ())
            waiting.append(getattr(one, "__self__", None))


@pytest.mark.parametrize("name", SCENES)
def test_nothing_of_landlab_reaches_the_model(name):
    flow = build(name)
    flow.run_one_step(2.0)
    found = list(reachable(flow._simulation))
    arrays = [one for one in found if isinstance(one, np.ndarray)]
    assert len(arrays) > 50 and {type(array) for array in arrays} == {np.ndarray}
    assert [one for one in found if type(one).__module__.partition(".")[0] == "landlab"] == []


@pytest.mark.parametrize("name", SCENES)
def test_reading_changes_nothing_and_gives_plain_arrays(name):
    flow = build(name)
    fields, status = copy_fields(flow.grid), flow.grid.status_at_node.copy()
    writer = flow._call._writer
    given = flow._call._reader.read(writer.state.grid_bed, flow._simulation.inflow, False, ())
    assert isinstance(given, GridInput)
    assert not changed_fields(flow.grid, fields) and np.array_equal(status, flow.grid.status_at_node)
    assert writer.state.grid_bed.elevation is None
    for one in reachable(given):
        assert type(one).__module__.partition(".")[0] != "landlab"
        assert not isinstance(one, np.ndarray) or type(one) is np.ndarray
        assert not hasattr(one, "_fields") or len(one._fields) <= 10
    assert np.shares_memory(given.terrain.elevation, flow.grid.at_node["topographic__elevation"])
    assert given.release.volume == pytest.approx(float(fields["debris_flow__release_depth"].sum()) * 25.0, rel=1e-14)


def test_what_the_model_gets_of_statuses_is_its_own():
    """Closing nodes calls back into Landlab: not from here, and not into a call that runs."""
    flow = build("eroding")
    flow.run_one_step(1.0)
    flow.grid.status_at_node[flow.grid.x_of_node > 250.0] = flow.grid.BC_NODE_IS_CLOSED
    assert not np.any(flow._simulation.bed.raster.status == 4)
    flow.run_one_step(1.0)
    assert np.any(flow._simulation.bed.raster.status == 4)
