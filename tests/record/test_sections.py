"""What crosses a line closes with what is beyond it, by accounts that look at places and not at paths."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from landlab_debrisflow import DebrisFlow, InputError
from landlab_debrisflow.record import Sections
from landlab_debrisflow.record.crossings import crossings
from validation.grids import inclined, release_slab

WEST, SOUTH = 4000.0, 9000.0


class Beyond:
    """Account of what is beyond x = const, of what was eroded and flowed in there and what left from there."""

    interval = np.inf

    def __init__(self, x, north=np.inf):
        self.x, self.north = x - WEST, north - SOUTH
        self.volumes, self.eroded, self.entered, self.left = {}, 0.0, 0.0, 0.0
        self.present = 0.0

    def observe(self, flow):
        pass

    def is_beyond(self, p):
        return (p.x > self.x) & (p.y < self.north)

    def follow(self, p, began, time):
        """Particles beyond the line before and after the step gained by erosion; new particles came in."""
        beyond = self.is_beyond(p)
        if p.departed is not None and began < time:
            gone = p.departed
            for number, volume, out in zip(gone.identity, gone.volume, self.is_beyond(gone), strict=True):
                before = self.volumes[number]
                self.left += volume * out
                self.eroded += (volume - before[0]) * before[1]
        for number, volume, here in zip(p.identity.tolist(), p.volume.tolist(), beyond.tolist(), strict=True):
            before = self.volumes.get(number)
            if before is None:
                self.entered += volume * here
            else:
                self.eroded += (volume - before[0]) * before[1]
        self.volumes = dict(zip(p.identity.tolist(), zip(p.volume.tolist(), beyond.tolist(), strict=True), strict=True))
        self.present = float(p.volume[beyond].sum())

    @property
    def crossed(self):
        return self.present + self.left - self.eroded - self.entered


def line_at(x):
    return [(x, SOUTH - 100.0), (x, SOUTH + 500.0)]


def slope(*observers, **keywords):
    grid = inclined((24, 60), 5.0, 0.5, soil=1.0, xy_of_lower_left=(WEST, SOUTH))
    release_slab(grid, (WEST + 30.0, SOUTH + 60.0), 8.0, 1.0)
    return DebrisFlow(grid, observers=observers, **{"numerics": {"particle_count": 80}} | keywords)


def test_crossed_closes_on_an_eroding_flow_that_leaves_the_grid():
    places = [WEST + d for d in (29.0, 62.5, 150.0, 292.4)]  # one in the release, one just before the edge
    accounts = [Beyond(x) for x in places]
    sections = Sections({f"{x:g}": line_at(x) for x in places}, interval=2.0)
    flow = slope(sections, *accounts)
    flow.run_one_step(8.0)
    flow.run_one_step(60.0)
    assert flow.budget["outflow"] > 200.0 and flow.budget["eroded"] > 50.0
    data = sections.dataset
    assert data.crossed_volume.values == pytest.approx([account.crossed for account in accounts], rel=1e-12)
    assert accounts[1].eroded > 10.0 and accounts[1].left > 100.0
    # what leaves does so over the east edge: where the node at 295 m is nearest, 0.1 m beyond the last line
    assert accounts[-1].left == pytest.approx(flow.budget["outflow"], rel=1e-12)
    assert 0.0 < accounts[-1].left - float(data.crossed_volume[-1]) < 1.0  # eroded in the last step
    assert data.volume.sum("time").values == pytest.approx(data.crossed_volume.values, rel=1e-12)
    assert (data.discharge * np.diff(data.time_bounds)[:, 0]).sum("time").values == pytest.approx(
        data.crossed_volume.values, rel=1e-12
    )
    assert data.positive_direction.values == pytest.approx(0.0)  # downhill is to the east
    solid = data.crossed_solid_volume / data.crossed_volume
    assert solid.values == pytest.approx(1.0 - flow.setup.material.porosity, rel=1e-12)
    crossed = data.isel(section=2)
    assert np.array_equal(np.isfinite(crossed.speed), crossed.volume > 0.0)
    assert 2.0 < float(crossed.speed.max()) < 30.0 and 0.01 < float(crossed.depth.max()) < 2.0
    assert float(crossed.basal_excess_pore_pressure.max()) > 0.0


@pytest.mark.slow
@pytest.mark.parametrize("flow_law", ["one_phase", "two_phase"])
def test_inflow_before_and_beyond_a_line_closes(flow_law):
    inflow = {
        "line_start": (WEST + 50.0, SOUTH + 40.0), "line_end": (WEST + 50.0, SOUTH + 80.0), "times": (0.0, 10.0, 20.0),
        "discharge": (0.0, 20.0, 0.0), "velocity": (3.0, 3.0, 3.0),
    }  # fmt: skip
    accounts = [Beyond(WEST + d) for d in (30.0, 45.0, 120.0)]
    sections = Sections({str(k): line_at(WEST + d) for k, d in enumerate((30.0, 45.0, 120.0))})
    flow = slope(sections, *accounts, inflow=inflow, flow=flow_law)
    flow.run_one_step(40.0)
    crossed = sections.dataset.crossed_volume.values
    assert crossed == pytest.approx([account.crossed for account in accounts], rel=1e-12, abs=1e-9)
    assert accounts[1].entered > 1.0 and crossed[2] > 100.0
    if flow_law == "two_phase":
        assert 0.3 < float(sections.dataset.crossed_solid_volume[2]) / crossed[2] < 0.9


@pytest.mark.slow
def test_round_the_end_of_a_line_nothing_crosses():
    whole, half = (
        Sections({"whole": line_at(WEST + 100.0)}),
        Sections({"half": [(WEST + 100.0, SOUTH), (WEST + 100.0, SOUTH + 60.0)]}),
    )
    other = Sections({"other": [(WEST + 100.0, SOUTH + 60.0), (WEST + 100.0, SOUTH + 120.0)]})
    slope(whole, half, other).run_one_step(20.0)
    parts = [float(sections.dataset.crossed_volume[0]) for sections in (whole, half, other)]
    assert parts[0] == pytest.approx(parts[1] + parts[2], rel=1e-12) and min(parts) > 10.0


@pytest.mark.slow
def test_a_line_drawn_the_other_way_round_counts_alike():
    one, other = Sections({"a": line_at(WEST + 100.0)}), Sections({"a": line_at(WEST + 100.0)[::-1]})
    slope(one, other).run_one_step(20.0)
    assert one.dataset.crossed_volume.values == pytest.approx(other.dataset.crossed_volume.values, rel=1e-14)
    assert float(one.dataset.crossed_volume[0]) > 100.0


def test_a_run_that_goes_on_ends_with_the_same_hydrograph():
    once, first, second = (Sections({"a": line_at(WEST + 60.0)}, 1.0) for _ in range(3))
    flow = slope(once, first)
    flow.run_one_step(6.0)
    state = first.state()
    second.prepare(flow.grid, flow.setup)
    second.restore(state)
    flow._observers = once, second
    flow.run_one_step(6.0)
    assert second.dataset.identical(once.dataset) and float(once.dataset.crossed_volume[0]) > 10.0
    with pytest.raises(InputError, match="the checkpoint has a, here are b; give those of the checkpoint"):
        Sections({"b": line_at(WEST)}).restore(state)
    for changed in ({"position": state["position"][:, :-1]}, {"identity": 0 * state["identity"]}):
        with pytest.raises(InputError, match="has arrays that do not fit each other"):
            Sections({"a": line_at(WEST)}).restore(state | changed)


@pytest.mark.slow
def test_an_undone_call_is_forgotten():
    class Fails:
        interval = 1e9
        now = False

        def follow(self, particles, began, time):
            if self.now and time > 5.0:
                particles.velocity[:] = np.nan

        def observe(self, flow):
            pass

    sections, fails, once = (
        Sections({"a": line_at(WEST + 60.0)}, 0.5),
        Fails(),
        Sections({"a": line_at(WEST + 60.0)}, 0.5),
    )
    flow, other = slope(sections, fails), slope(once)
    for each in (flow, other):
        each.run_one_step(4.0)
    fails.now = True
    with pytest.raises(Exception, match="became nan"):
        flow.run_one_step(4.0)
    fails.now = False
    for each in (flow, other):
        each.run_one_step(4.0)
    assert sections.dataset.crossed_volume.values == pytest.approx(once.dataset.crossed_volume.values, rel=1e-14)
    assert float(once.dataset.volume.sel(time=slice(4.0, 5.0)).sum()) > 1.0


coordinates = st.tuples(st.integers(-3, 3), st.integers(-3, 3))  # whole numbers: vertices are met exactly


@given(st.lists(coordinates, min_size=2, max_size=12), st.integers(-2, 2), st.booleans(), st.booleans())
def test_walks_cross_a_bent_line_as_often_as_they_change_sides(walk, offset, backward, mirrored):
    """The line goes from far south to far north with a bend, or back; or from west to east, with x and y exchanged."""
    x = 0.5 * offset
    line = np.array([(x, -9.0), (x, -1.0), (x + 1.0, 0.0), (x, 1.0), (x, 9.0)])

    def right(px, py):
        px, py = (px + 1e-12, py + 1e-6) if mirrored else (px + 1e-6, py + 1e-12)
        return px > x + max(0.0, 1.0 - abs(py))

    walk = np.array(walk, float)
    start, end = walk[:-1].T, walk[1:].T
    line = line[::-1] if backward else line
    if mirrored:
        start, end, line = start[::-1], end[::-1], line[:, ::-1]
    _, fraction, sign = crossings(start, end, line)
    assert np.all((fraction >= 0.0) & (fraction <= 1.0))
    to_the_right = sign.sum() if backward != mirrored else -sign.sum()
    assert to_the_right == int(right(*walk[-1])) - int(right(*walk[0]))


@pytest.mark.parametrize(
    "lines, words",
    [
        ({"a": [(0.0, 0.0)]}, "a line needs at least two different vertices, got 1"),
        ({"a": [(1.0, 2.0), (1.0, 2.0)]}, "a line needs at least two different vertices, got 1"),
        ({"a": [1.0, 2.0]}, r"vertices of shape \(n, 2\)"),
        ({"a": [(0.0, np.nan), (1.0, 1.0)]}, "coordinates must be finite numbers"),
        ({"a": "across"}, "coordinates must be numbers"),
        ([("a", [(0, 0), (1, 1)]), ("a", [(0, 0), (1, 2)])], "the name 'a' is there twice"),
        ({}, "a mapping of names to coordinates, at least one"),
        ({1: [(0, 0), (1, 1)]}, "a name must be a text, got 1"),
        (None, "must be a mapping of names to coordinates, got None"),
    ],
)
def test_refusals(lines, words):
    with pytest.raises(InputError, match=words):
        Sections(lines)


def test_a_section_outside_the_grid_is_refused_when_the_flow_is_built():
    with pytest.raises(InputError, match=r"Sections: 'a': \(10, 20\) m is outside the grid, which goes from \(4000"):
        slope(Sections({"a": [(10.0, 20.0), (30.0, 20.0)]}))
