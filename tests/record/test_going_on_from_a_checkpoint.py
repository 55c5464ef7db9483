"""A run that was killed and loaded ends with the outputs of one that was not."""

import numpy as np
import pytest
import xarray as xr

from landlab_debrisflow import DebrisFlow
from landlab_debrisflow.record import Front, Gauges, MapSeries, MarkedColumns, Sections, Tracks
from validation.grids import inclined, release_slab


class Stop(Exception):
    """Stands for the kill."""


class Saves:
    """Saves in the middle of a call, goes on a while and is killed."""

    interval = 1e9

    def __init__(self, path, save_after, kill_after):
        self.path, self.save_after, self.kill_after, self.steps = path, save_after, kill_after, 0

    def observe(self, flow):
        """Do nothing."""

    def keep(self, flow, broken_off):
        self.steps += 1
        if self.steps == self.save_after:
            flow.save(self.path)
        if self.steps == self.kill_after:
            raise Stop


def grid():
    made = inclined((24, 50), 5.0, 0.5, soil=1.0, xy_of_lower_left=(4000.0, 9000.0))
    release_slab(made, (4030.0, 9060.0), 8.0, 1.0)
    return made


def observers(folder):
    folder.mkdir(exist_ok=True)
    lines = {name: [(x, 9000.0), (x, 9120.0)] for name, x in (("a", 4040.0), ("b", 4100.0), ("edge", 4242.0))}
    return (
        MapSeries(1.0, folder, crs="EPSG:32633", replace=True), Sections(lines, 1.0),
        Gauges({"g": (4060.0, 9060.0)}, 1.0), Front([(4000.0, 9060.0), (4250.0, 9060.0)], 1.0), Tracks(1.0, 7),
        MarkedColumns(2.0, [0, 5]),
    )  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("save_after, kill_after", [(3, 11), (14, 15), (25, 40)])
def test_outputs_are_those_of_an_unbroken_run(tmp_path, save_after, kill_after):
    whole, first, second = observers(tmp_path / "whole"), observers(tmp_path / "again"), observers(tmp_path / "again")
    numerics = {"particle_count": 80}
    flow = DebrisFlow(grid(), numerics=numerics, observers=whole)
    flow.run_one_step(22.0)
    assert flow.budget["outflow"] > 0.0
    killed = DebrisFlow(
        grid(), numerics=numerics, observers=(*first, Saves(tmp_path / "now.nc", save_after, kill_after))
    )
    with pytest.raises(Stop):
        killed.run_one_step(22.0)
    loaded = DebrisFlow.load(tmp_path / "now.nc", observers=(*second, Saves(tmp_path / "now.nc", 0, 0)))
    loaded.run_one_step(loaded.unfinished_until - loaded.elapsed_time)
    assert loaded.elapsed_time == flow.elapsed_time
    for one, other in zip(whole[1:], second[1:], strict=True):
        xr.testing.assert_identical(one.dataset, other.dataset)
    names = [[path.name for path in series[0].files] for series in (whole, second)]
    assert names[0] == names[1] == sorted(path.name for path in (tmp_path / "again").iterdir()) and len(names[0]) > 10
    for name in names[0]:
        with xr.open_dataset(tmp_path / "whole" / name) as one, xr.open_dataset(tmp_path / "again" / name) as other:
            assert np.array_equal(one.x, other.x) and one.equals(other)
