"""State of a run as an xarray Dataset: every particle variable with unit and dimensions, then counters and accounts."""

import numpy as np
import xarray as xr

from ..core.errors import InputError
from ..spatial.partners import Partners
from .rest import PER_BODY
from .time_step import StepLimits

BESIDE = {
    "control": ("step", "speed"),
    "bodies": ("at_rest", "steps", "known"),
    "exchange": ("age", "steps"),
    "counters": ("steps", "smallest_step", "particle_steps", "sleeping_steps"),
    "stopped": ("volume", "first", "last"),
    "outflow": ("solid",),
    "inflow": ("rows_entered",),
}
"""Numbers that parts of the state consist of, by part; they are scalars named ``part_number``."""

ORIGINS = {
    "_x": "released", "_y": "released", "_volume": "released",
    "_owner": "released_part", "_node": "released_part", "_part": "released_part",
}  # fmt: skip
"""Dimension of the arrays of `Origins`."""


def to_dataset(state, prefix: str = "") -> xr.Dataset:
    """Return all of a `State` but the CPU time it took; `prefix` begins the names of variables of the particles."""
    p, data = state.particles, {}
    for variable in p.variables:
        words = {"units": variable.unit, "long_name": variable.long_name}
        data[prefix + variable.name] = (_dimensions(variable), getattr(p, variable.name).copy(), words)
    data |= {"awake": p.awake, "ever": p.ever, "time": state.time, "outdated": state.outdated}
    data["settled_solid"] = state.settled_solid
    data |= {f"{part}_{name}": getattr(getattr(state, part), name) for part, names in BESIDE.items() for name in names}
    if state.limits is not None:
        data |= {f"limits_{name}": value for name, value in state.limits._asdict().items()}
    data["stopped_where"] = ("map_axis", np.array(state.stopped.where))
    data["inflow_directions"] = (("source", "map_axis"), state.inflow.directions.copy())
    data |= {f"bodies_{name}": ("body_number", getattr(state.bodies, name).copy()) for name in PER_BODY}
    data |= {f"origins{name}": (dim, getattr(state.origins, name)) for name, dim in ORIGINS.items()}
    nodes, volumes = list(state.outflow._at), list(state.outflow._at.values())
    data["outflow_node"] = ("exit_node", np.array(nodes, np.int64))
    data["outflow_volume"] = ("exit_node", np.array(volumes, float))
    if state.exchange.partners is not None:
        of, first, index, weight = state.exchange.partners
        data["partners_of"], data["partners_count"] = ("grain", of), ("grain", np.diff(first))
        data["partners_index"], data["partners_weight"] = ("pair", index), ("pair", weight)
        data["partners_generation"] = ("generation", np.array(state.exchange.generation, np.int64))
    return xr.Dataset(data)


def from_dataset(dataset: xr.Dataset, state, prefix: str = ""):
    """Return the state that was written by `to_dataset`.

    Parameters
    ----------
    dataset : xarray.Dataset
    state : State
        State of a simulation with the same setup; it is not changed. Values that no run changes are taken from it.
    prefix : str
        Beginning of the names of variables of the particles.

    Returns
    -------
    State

    Raises
    ------
    InputError
        If the dataset lacks a variable that particles of this setup have.
    """
    new, read = state.copy(), {name: data.values for name, data in dataset.variables.items()}
    p = new.particles
    needed = (*(prefix + variable.name for variable in p.variables), "awake", "ever", "time")
    if missing := [name for name in needed if name not in read]:
        raise InputError(
            f"state: the Dataset lacks {', '.join(missing[:5])}{' and more' * (len(missing) > 5)}; give a Dataset "
            "that to_dataset() of a run with the same setup wrote"
        )
    p.restore({variable.name: read[prefix + variable.name] for variable in p.variables})
    p.awake, p.ever = int(read["awake"]), int(read["ever"])
    new.time, new.outdated = float(read["time"]), bool(read["outdated"])
    new.settled_solid = float(read["settled_solid"])
    for part, names in BESIDE.items():
        for name in names:
            value, here = read[f"{part}_{name}"], getattr(new, part)
            setattr(here, name, type(getattr(here, name))(value))
    new.limits = None
    if "limits_energy" in read:
        kinds = StepLimits.__annotations__
        new.limits = StepLimits(*(kinds[name](read[f"limits_{name}"]) for name in StepLimits._fields))
    new.stopped.where = tuple(map(float, read["stopped_where"]))
    new.inflow.directions = np.array(read["inflow_directions"])
    for name in PER_BODY:
        setattr(new.bodies, name, np.array(read[f"bodies_{name}"]))
    for name in ORIGINS:
        setattr(new.origins, name, np.array(read[f"origins{name}"]))
    nodes = new.origins._node
    new.origins.span = (int(nodes.min()), int(nodes.max())) if nodes.size else ()
    volumes = zip(read["outflow_node"].tolist(), read["outflow_volume"].tolist(), strict=True)
    new.outflow._at = dict(volumes)
    new.exchange.partners = new.exchange.grains = new.exchange.generation = None
    if "partners_of" in read:
        of, count, index, weight = (read[f"partners_{name}"] for name in ("of", "count", "index", "weight"))
        first = np.concatenate([[0], np.cumsum(count)])
        partners = Partners(of=np.array(of), first=first, index=np.array(index, np.int32), weight=np.array(weight))
        age, generation = new.exchange.age, tuple(read["partners_generation"].tolist())
        new.exchange.keep(partners, p.phase, generation)
        new.exchange.age = age
    return new


def _dimensions(variable) -> tuple[str, ...]:
    """Return the names of the dimensions of a variable's array."""
    if variable.components:
        return {3: "axis", 6: "surface_term"}.get(variable.components, f"{variable.name}_component"), "particle"
    if variable.per_level:
        return "particle", "level"
    return ("particle",) if variable.width is None else ("particle", f"{variable.name}_place")
