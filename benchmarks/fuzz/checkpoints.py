"""Checkpoints: good ones, damaged ones, and ones with one change of their content under a digest that is right."""

import functools
import json
import tempfile
from hashlib import blake2b
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr
from landlab import RasterModelGrid

from landlab_debrisflow import DebrisFlow
from landlab_debrisflow.record import BudgetSeries, Gauges, Sections, Snapshots, Tracks, checkpoint_file
from landlab_debrisflow.record.checkpoint_file import MAGIC, TRAILER, VERSION, read_checkpoint, write_checkpoint

from . import ground
from .odd import HOSTILE, NUMBERS, damaged, odd_value, one
from .scenes import change_value

SURGE = {
    "line_start": (20.0, 20.0),
    "line_end": (20.0, 45.0),
    "times": (0.0, 60.0),
    "discharge": (10.0, 5.0),
    "velocity": 4.0,
}
FLOWS: dict[str, dict[str, Any]] = {
    "eroding": {"erosion": "growth", "column": "ale"},
    "two phases": {"flow": "two_phase"},
    "inflow": {"inflow": SURGE, "friction": "voellmy"},
    "loaded bed": {"erosion": "liquefied_bed", "material": {"bed_loading_coefficient": 0.3, "bed_drainage_time": 30.0}},
}
"""Keywords of the flows that are saved."""


class _Saver:
    """Observer that saves the flow within a call and then breaks it off."""

    interval = 0.5

    def __init__(self, path: Path):
        self.path, self.calls = path, 0

    def observe(self, flow) -> None:
        self.calls += 1
        if self.calls == 4:
            flow.save(self.path)


@functools.cache
def good() -> list[bytes]:
    """Return the bytes of good checkpoints, of every flow within a call and after it."""
    found = []
    with tempfile.TemporaryDirectory() as folder:
        for keywords in FLOWS.values():
            grid = RasterModelGrid((ground.ROWS, ground.COLUMNS), xy_spacing=ground.SPACING)
            grid.add_field("topographic__elevation", ground.elevation().reshape(-1), at="node")
            grid.add_full("soil__depth", 1.5, at="node")
            release = grid.add_zeros("debris_flow__release_depth", at="node")
            release.reshape(grid.shape)[5:9, 4:8] = 1.2
            path = Path(folder) / "within.nc"
            numerics = {"particle_count": 40}
            flow = DebrisFlow(grid, numerics=numerics, observers=(*observers(), _Saver(path)), **keywords)
            flow.run_one_step(3.0)
            found.append(_without_saver(path))
            found.append(_without_saver(flow.save(path)))
    return found


def observers() -> list[Any]:
    """Return observers as those of the flows that were saved; what they remember is part of a checkpoint."""
    line = [[60.0, 15.0], [60.0, 55.0]]
    gauges, sections = Gauges({"bridge": (50.0, 35.0)}, 0.5), Sections({"bridge": line})
    return [Snapshots(1.0, variables=["debris_flow__depth"]), gauges, Tracks(0.5, 3), BudgetSeries(0.5), sections]


def _without_saver(path: Path) -> bytes:
    """Return the bytes of a checkpoint without its last observer, and remove the file."""
    dataset = read_checkpoint(path)
    kept = {name: json.dumps(json.loads(dataset.attrs[name])[:-1]) for name in ("observers", "observers_with_state")}
    path.unlink()
    write_checkpoint(path, dataset.assign_attrs(kept))
    data = path.read_bytes()
    path.unlink()
    return data


def write(rng: np.random.Generator, folder: Path, form: str) -> str:
    """Write a checkpoint of some form; return the change as text."""
    number = int(rng.integers(len(good())))
    data, path = good()[number], folder / "checkpoint.nc"
    which = f"checkpoint {number}: "
    if form == "valid":
        path.write_bytes(data)
        return which + "nothing"
    if form == "bytes":
        if rng.random() < 0.8:
            data, done = damaged(rng, data)
        else:  # past the digest, into the library
            content, done = damaged(rng, data[: -TRAILER.size], 2)
            data, done = _signed(content), done + ", signed"
        path.write_bytes(data)
        return which + done
    if rng.random() < 0.08:
        data, done = _changed_trailer(rng, data)
        path.write_bytes(data)
        return which + done
    dataset = _read(number).copy(deep=True)
    dataset, done = change_dataset(rng, dataset)
    try:
        write_checkpoint(path, dataset)
    except Exception as error:  # not all that is asked for can be written
        return f"{which}{done} (not written: {type(error).__name__} {error})"
    return which + done


@functools.cache
def _read(number: int) -> xr.Dataset:
    return checkpoint_file._from_bytes(good()[number][: -TRAILER.size])


def _signed(content: bytes, magic: bytes = MAGIC, version: int = VERSION, length: int | None = None) -> bytes:
    head = magic, version, len(content) if length is None else length
    digest = blake2b(content, digest_size=32)
    digest.update(TRAILER.pack(*head, b"")[:-32])
    return content + TRAILER.pack(*head, digest.digest())


def _changed_trailer(rng: np.random.Generator, data: bytes) -> tuple[bytes, str]:
    content = data[: -TRAILER.size]
    changes = {
        "newer": lambda: _signed(content, version=VERSION + 1), "version 0": lambda: _signed(content, version=0),
        "other magic": lambda: _signed(content, magic=b"x" * len(MAGIC)),
        "length 0": lambda: _signed(content, length=0),
        "length huge": lambda: _signed(content, length=2**63), "nothing signed": lambda: _signed(b""),
        "text signed": lambda: _signed(b"hello"),
        "signed twice": lambda: _signed(data), "as text": lambda: data.replace(b"\n", b"\r\n"),
    }  # fmt: skip
    name = one(rng, list(changes))
    return changes[name](), name


def change_dataset(rng: np.random.Generator, dataset: xr.Dataset) -> tuple[xr.Dataset, str]:
    """Return the content of a checkpoint with one change, and the change as text."""
    if rng.random() < 0.3:
        return _change_attribute(rng, dataset)
    name = one(rng, sorted(map(str, dataset.variables)))
    data, way = dataset.variables[name], int(rng.integers(10))
    values = data.values.copy()
    if way == 0:
        return dataset.drop_vars(name), f"{name} removed"
    if way == 1:
        new = one(rng, (name[:-1], f"{name}2", "time", "particle_x"))
        return dataset.drop_vars(name).assign({new: data}), f"{name} renamed {new}"
    if way == 2 and data.ndim:
        axis = int(rng.integers(data.ndim))
        count = one(rng, (0, 1, data.shape[axis] - 1, data.shape[axis] + 1, 2 * data.shape[axis]))
        index = np.resize(np.arange(data.shape[axis]), max(count, 0)) if data.shape[axis] else np.zeros(0, int)
        dims = [f"{dim}_other" if k == axis else dim for k, dim in enumerate(data.dims)]
        changed = xr.Variable(dims, np.take(values, index, axis), data.attrs)
        return dataset.drop_vars(name).assign({name: changed}), f"{name} with {count} along {data.dims[axis]}"
    if way == 3:
        dims = data.dims[::-1] if data.ndim > 1 else (*data.dims, "more")
        changed = xr.Variable(dims, values.T if data.ndim > 1 else values[..., None], data.attrs)
        return dataset.drop_vars(name).assign({name: changed}), f"{name} of dimensions {dims}"
    if way == 4:
        kind = one(rng, ("f4", "i4", "i1", "u8", "S3", "U5", "f8", "i8"))
        with np.errstate(all="ignore"):
            changed = xr.Variable(data.dims, values.astype(kind), data.attrs)
        return dataset.drop_vars(name).assign({name: changed}), f"{name} as {kind}"
    if way == 5:
        changed = xr.Variable(data.dims, values, {})
        return dataset.drop_vars(name).assign({name: changed}), f"{name} without attributes"
    number = one(rng, (*NUMBERS[:28], 1, 2, 10, 100, 1000, -2, -3))
    with np.errstate(all="ignore"):
        try:
            new = np.asarray(min(number, 2**62) if values.dtype.kind in "iu" else number, float).astype(values.dtype)
        except (OverflowError, ValueError):
            new = np.zeros((), values.dtype)
    if way == 6 and values.ndim:
        values[...] = new
        done = f"{name} all {new}"
    elif values.ndim and values.size:
        at = tuple(int(rng.integers(size)) for size in values.shape)
        values[at] = new
        done = f"{name}{at} = {new}"
    else:
        values = new if not values.ndim else values
        done = f"{name} = {new}"
    return dataset.drop_vars(name).assign({name: xr.Variable(data.dims, values, data.attrs)}), done


def _change_attribute(rng: np.random.Generator, dataset: xr.Dataset) -> tuple[xr.Dataset, str]:
    name = one(rng, sorted(dataset.attrs))
    value, way = dataset.attrs[name], int(rng.integers(5))
    attributes = dict(dataset.attrs)
    if way == 0:
        del attributes[name]
        done = f"attribute {name} removed"
    elif way < 3 and isinstance(value, str) and value[:1] in "[{":
        content = {"x": json.loads(value)}
        done = f"attribute {name}: {change_value(rng, content) if content['x'] else 'nothing'}"
        attributes[name] = json.dumps(content.get("x", content))
    else:
        new = one(rng, (odd_value(rng), one(rng, HOSTILE), one(rng, NUMBERS)))
        new = new if isinstance(new, str | int | float) and not isinstance(new, bool) else json.dumps(new)
        attributes[name] = min(max(new, -(2**62)), 2**62) if isinstance(new, int) else new
        done = f"attribute {name} = {attributes[name]!r:.60}"
    changed = dataset.copy()
    changed.attrs = attributes
    return changed, done
