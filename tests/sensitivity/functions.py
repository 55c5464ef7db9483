"""Results of ensembles whose measures are known functions of their values, without a run."""

import numpy as np

from landlab_debrisflow.ensemble import EnsembleResults, MemberResult
from landlab_debrisflow.ensemble.batch import BatchResult
from landlab_debrisflow.ensemble.design import Varied, make_design
from landlab_debrisflow.ensemble.distributions import distribution_of
from landlab_debrisflow.ensemble.names import Name
from landlab_debrisflow.ensemble.store import Header, Store
from landlab_debrisflow.geo.lattice import Lattice

ATTRIBUTES = {"units": "m", "long_name": "a measure"}
NUMBERS = {"x1": {"uniform": {"low": 0.0, "high": 1.0}}, "x2": {"uniform": {"low": 0.0, "high": 1.0}}}


def results_of(
    functions, given=NUMBERS, members=64, sampling="random", seed=1, failed=(), batches=None, batch=64, **options
):
    """Return results whose measures are functions of the values, each of shape (members,)."""
    varied = []
    for key, values in given.items():
        name = Name(key, (key,), "-", "a value", number=None if isinstance(values, list) else float)
        varied.append(Varied(name, distribution_of(name, values)))
    design = make_design(varied, sampling, members, seed, **options)
    columns = [design[name].values for name in design if "key" in design[name].attrs]
    values = {name: function(*columns) for name, function in functions.items()}
    lattice = Lattice((2, 2), (1.0, 1.0), (0.0, 0.0), None)
    store = Store.create(None, Header("0" * 32, {}, sampling, seed, batch, ("max_depth",), lattice), design)
    nothing = slice(0, 0), slice(0, 0)
    for k in range(store.batch_count) if batches is None else batches:
        found = [
            MemberResult(member, {}, {}, *nothing, {}, "it failed") if member in failed else MemberResult(
                member, {}, {name: float(values[name][member]) for name in values}, *nothing,
                {"max_depth": np.zeros((0, 0), np.float32)},
            )
            for member in store.members_of(k)
        ]  # fmt: skip
        store.write(BatchResult(k, found, dict.fromkeys(functions, ATTRIBUTES), [0.0] * len(found)))
    return EnsembleResults(store)
