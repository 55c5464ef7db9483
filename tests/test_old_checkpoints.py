"""A checkpoint of every version of the format stays readable, and its flow goes on.

``python -m tests.test_old_checkpoints`` writes the file of the present version; one that was released never changes.
"""

import gzip
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest

from landlab_debrisflow import DebrisFlow
from landlab_debrisflow.record.checkpoint_file import VERSION
from validation.grids import inclined, release_slab

FOLDER = Path(__file__).parent / "checkpoints"
SAVED = 2.0
"""Elapsed time after which the flow was saved, within a call until 8 s [s]."""


class Saves:
    """An observer that saves once, and remembers that."""

    interval = SAVED

    def __init__(self, path=None):
        self.path, self.seen = path, 0

    def observe(self, flow):
        self.seen += 1
        if self.seen == 1 and self.path is not None:
            flow.save(self.path)

    def state(self):
        return {"seen": self.seen}

    def restore(self, mapping):
        self.seen = mapping["seen"]


def flow(observers=()):
    """Return a flow that uses most there is: a bed that erodes and is loaded, walls, inflow."""
    grid = inclined((9, 24), 5.0, 0.5, soil=1.0, foot=70.0)
    release_slab(grid, (20.0, 20.0), 6.0, 0.8)
    grid.add_full("bed__excess_pore_pressure", 500.0, at="node")
    grid.status_at_node[(grid.x_of_node == 60.0) & (grid.y_of_node == 10.0)] = grid.BC_NODE_IS_CLOSED
    surge = {
        "line_start": (30.0, 14.0), "line_end": (30.0, 26.0), "times": [1.0, 3.0], "discharge": [8.0, 8.0],
        "velocity": 4.0,
    }  # fmt: skip
    material = {"bed_loading_coefficient": 0.6, "bed_drainage_time": 20.0}
    return DebrisFlow(
        grid, inflow=surge, material=material, column={"law": "ale", "levels": 6}, numerics={"particle_count": 12},
        observers=observers,
    )  # fmt: skip


def committed(version):
    return FOLDER / f"version_{version}.nc.gz"  # two thirds of so small a file are zeros between its parts


@pytest.mark.parametrize("version", range(1, VERSION + 1))
def test_it_is_read_and_goes_on(version, tmp_path):
    path, observer = tmp_path / "flow.nc", Saves()
    path.write_bytes(gzip.decompress(committed(version).read_bytes()))
    again = DebrisFlow.load(path, observers=observer)
    assert observer.seen == 1 and SAVED <= again.elapsed_time < SAVED + 0.5 and again.unfinished_until == 8.0
    budget = again.budget
    assert budget["released"] == pytest.approx(180.0, rel=1e-12) and abs(budget["residual"]) < 1e-11
    assert budget["eroded"] > 0.0 and 0.0 < budget["inflow"] < 16.0
    assert again.grid.at_node["bed__excess_pore_pressure"].max() > 500.0
    again.run_one_step(8.0 - again.elapsed_time)
    assert observer.seen == 4 and abs(again.budget["residual"]) < 1e-11
    assert again.budget["eroded"] > budget["eroded"] and again.unfinished_until is None


def test_it_is_small():
    assert committed(VERSION).stat().st_size < 100_000


if __name__ == "__main__":
    with TemporaryDirectory() as folder:
        path = Path(folder) / "flow.nc"
        flow(Saves(path)).run_one_step(8.0)
        committed(VERSION).write_bytes(gzip.compress(path.read_bytes(), mtime=0))
    print(f"{committed(VERSION)}: {committed(VERSION).stat().st_size} bytes")
