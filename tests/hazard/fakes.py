"""Results of members that are made up, in a store in memory."""

import numpy as np
import xarray as xr

from landlab_debrisflow.ensemble import EnsembleResults, MemberResult
from landlab_debrisflow.ensemble.batch import BatchResult
from landlab_debrisflow.ensemble.result import touched_window
from landlab_debrisflow.ensemble.store import Header, Store
from landlab_debrisflow.geo.lattice import Lattice

CRS = "EPSG:32632"


def fake_results(
    members, sampling="random", replicate=None, maps=("max_depth",), batch=4, path=None, run=None, lattice=None,
    scene=None,
):  # fmt: skip
    """Return results whose members have given maps over the whole lattice, or an error where these are a text."""
    shape = next(np.shape(next(iter(one.values()))) for one in members if not isinstance(one, str))
    lattice = lattice or Lattice(shape, (10.0, 10.0), (400000.0, 5200000.0), CRS)
    count = len(members)
    group = np.zeros(count, int) if replicate is None else np.asarray(replicate)
    design = xr.Dataset(
        {"angle": ("member", np.linspace(20.0, 30.0, count), {"key": "friction.basal_friction_angle"}),
         "replicate": ("member", group)},
        {"member": np.arange(count)},
    )  # fmt: skip
    header = Header("d" * 32, {"name": "valley"} if scene is None else scene, sampling, 0, batch, tuple(maps), lattice)
    store = Store.create(path, header, design)
    for k in range(store.batch_count) if run is None else run:
        found = [member_of(number, members[number], maps) for number in store.members_of(k)]
        store.write(BatchResult(k, found, {"volume": {"units": "m3"}}, [1.0] * len(found)))
    return EnsembleResults(store)


def member_of(number, values, maps):
    if isinstance(values, str):
        return MemberResult(number, {}, {}, slice(0, 0), slice(0, 0), {}, values)
    whole = {name: np.asarray(values[name], np.float32) for name in maps}
    rows, columns = touched_window(whole)
    return MemberResult(
        number, {}, {"volume": 1.0}, rows, columns, {name: one[rows, columns] for name, one in whole.items()}
    )
