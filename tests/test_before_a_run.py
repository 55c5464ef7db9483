"""A component that was refused leaves nothing on the grid; one that has not run yet can be looked at like any other."""

import logging
from html.parser import HTMLParser

import numpy as np
import pytest
from landlab import FieldError, RasterModelGrid

from landlab_debrisflow import DebrisFlow
from landlab_debrisflow.physics.friction import Coulomb
from landlab_debrisflow.physics.registry import LAWS
from validation.grids import COARSE, changed_fields, copy_fields, inclined, place

SURGE = {
    "line_start": (20.0, 38.0), "line_end": (20.0, 58.0), "times": [5.0, 10.0], "discharge": 20.0, "velocity": 4.0,
}  # fmt: skip


# ---- refused constructors ----


@pytest.mark.slow
@pytest.mark.parametrize(
    "keywords",
    [
        {"friction": {"law": "coulomb", "basal_friction_angle": "no_such_field"}},
        {"friction": {"law": "coulomb", "basal_friction_angle": np.full(7, 30.0)}},
        {"friction": {"law": "coulomb", "basal_friction_angle": np.full(1200, 95.0)}},
        {"erosion": {"law": "growth", "growth_rate": "too__low"}},
        {"material": {"bed_loading_coefficient": 0.5}, "erosion": {"law": "growth", "growth_rate": "no_such_field"}},
        {"observers": [3.0]},
        {"inflow": "surge.csv"},
        {"material": {"water_density": 0.0}},
    ],
)
def test_a_refused_constructor_leaves_no_field(keywords):
    grid = inclined((20, 60), 5.0, 0.5)
    grid.add_full("too__low", -1.0, at="node")
    before = copy_fields(grid)
    with pytest.raises(ValueError, match=r"\w"):
        DebrisFlow(grid, flow="two_phase", **keywords)
    assert not changed_fields(grid, before)
    DebrisFlow(grid, flow="two_phase")


def test_neither_do_landlabs_own_refusals_and_failures_of_any_kind(monkeypatch):
    grid = RasterModelGrid((5, 5))
    with pytest.raises(FieldError, match="topographic__elevation"):
        DebrisFlow(grid)
    assert list(grid.at_node) == []
    grid.add_zeros("topographic__elevation", at="node")
    grid.status_at_node[3] = 3
    with pytest.raises(ValueError, match="looped"):
        DebrisFlow(grid)
    assert list(grid.at_node) == ["topographic__elevation"]
    grid.status_at_node[3] = 1
    monkeypatch.setattr("landlab_debrisflow.component.Simulation", lambda *_: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        DebrisFlow(grid)
    assert list(grid.at_node) == ["topographic__elevation"]


def test_fields_that_were_there_stay():
    grid = inclined((20, 60), 5.0, 0.5)
    DebrisFlow(grid).run_one_step(1.0)
    grid.add_ones("mine", at="node")
    before = copy_fields(grid)
    with pytest.raises(ValueError, match="no_such_field"):
        DebrisFlow(grid, flow="two_phase", friction=Coulomb(basal_friction_angle="no_such_field"))
    assert not changed_fields(grid, before)


# ---- before a run ----


@pytest.mark.slow
@pytest.mark.parametrize("column", LAWS["column"])
@pytest.mark.parametrize("law", LAWS["flow"])
@pytest.mark.parametrize("state", ["before a run", "after settling", "nothing to do"])
def test_nothing_there_is_an_empty_dataset(valley, law, column, state):
    flow = DebrisFlow(valley, flow=law, column=column, numerics=COARSE)
    full = DebrisFlow(inclined((20, 60), 5.0, 0.5), flow=law, column=column, inflow=SURGE, numerics=COARSE)
    full.run_one_step(6.0)
    if state == "nothing to do":
        valley.at_node["debris_flow__release_depth"][:] = 0.0
        flow.run_one_step(1.0)
    elif state == "after settling":
        place(flow)._simulation.settle()
    for name in ("columns", "particles"):
        empty, one = getattr(flow, name), getattr(full, name)
        assert empty.sizes["particle"] == 0 and one.sizes["particle"] > 0
        assert set(empty.variables) == set(one.variables)
        for variable in one.variables:
            assert empty[variable].dims == one[variable].dims and empty[variable].attrs == one[variable].attrs
            assert empty[variable].dtype == one[variable].dtype
        assert dict(empty.sizes) | {"particle": 0} == dict(one.sizes) | {"particle": 0}


@pytest.mark.parametrize("law", LAWS["flow"])
def test_before_a_run_all_accounts_are_there_and_0(valley, law):
    flow = DebrisFlow(valley, flow=law, numerics=COARSE)
    before = copy_fields(valley)
    assert set(flow.budget.values()) == {0.0} == set(flow.outflow_by_edge.values())
    assert all(set(phase.values()) == {0.0} for phase in flow.budget_by_phase.values())
    assert flow.at_rest and flow.elapsed_time == 0.0
    maps = flow.maps
    assert maps.attrs["budget_released"] == 0.0 and not maps.debris_flow__max_depth.any()
    assert "nothing released yet at 0 s" in repr(flow)
    flow.settle()
    assert not changed_fields(valley, before)


def test_settling_before_the_inflow_says_why_not():
    flow = DebrisFlow(inclined((20, 60), 5.0, 0.5), inflow=SURGE, numerics=COARSE)
    with pytest.raises(ValueError, match="something has yet to flow in"):
        flow.settle()


# ---- in a few lines ----


class Cells(HTMLParser):
    """Collects the text of the cells of a table, and the tags."""

    def __init__(self, text):
        super().__init__()
        self.tags, self.words = [], []
        self.feed(text)

    def handle_starttag(self, tag, _):
        self.tags.append(tag)

    def handle_data(self, data):
        self.words.append(data)


def test_a_component_tells_its_state_laws_and_budget(valley):
    flow = DebrisFlow(valley, friction="voellmy", numerics=COARSE | {"settle": False})
    seen = [repr(flow)]
    flow.run_one_step(2.0)
    seen.append(repr(flow))
    flow.run_until_rest()
    seen.append(repr(flow))
    flow.settle()
    seen.append(repr(flow))
    states = ["nothing released yet at 0 s", "moving at 2 s", "at rest, not settled at", "at rest at"]
    for text, state, count in zip(seen, states, (0, 100, 100, 0), strict=True):
        assert text.startswith(f"DebrisFlow: {state}") and f"particles: {count} on 20 x 80 nodes" in text
        assert "flow one_phase, friction voellmy, erosion growth, column ale" in text
        assert max(len(line) for line in text.splitlines()) <= 160
    budget = flow.budget
    assert all(f"{name} {volume:.6g}" in seen[-1] for name, volume in budget.items())
    cells = Cells(flow._repr_html_())
    assert set(cells.tags) == {"table", "caption", "tr", "th", "td"}
    assert all(line.split(": ", 1)[1].strip() in cells.words for line in seen[-1].splitlines())


@pytest.mark.slow
def test_what_a_user_called_his_law_is_escaped(slope):
    law = type("<b>Mine</b> & co", (Coulomb,), {})()
    html = DebrisFlow(slope, friction=law)._repr_html_()
    assert "friction &lt;b&gt;Mine&lt;/b&gt; &amp; co" in html and "<b>" not in html


@pytest.mark.slow
def test_observers_may_print_the_flow(valley):
    class Printing:
        interval, seen = 5.0, ()

        def observe(self, flow):
            self.seen = (*self.seen, repr(flow), flow._repr_html_())

    observer = Printing()
    DebrisFlow(valley, numerics=COARSE, observers=observer).run_one_step(10.0)
    # at the end of the step that crosses 5 s, and of the last one
    assert "moving at 5." in observer.seen[0] and "moving at 10 s" in observer.seen[2]


def test_waiting_for_inflow_is_a_state_and_an_unfinished_component_has_none():
    flow = DebrisFlow(inclined((20, 60), 5.0, 0.5), inflow=SURGE, numerics=COARSE)
    assert repr(flow).startswith("DebrisFlow: waiting for inflow at 0 s")
    unfinished = DebrisFlow.__new__(DebrisFlow)
    assert "DebrisFlow object" in repr(unfinished) and "under construction" in unfinished._repr_html_()


@pytest.mark.slow
def test_looking_does_not_log(valley, caplog):
    caplog.set_level(logging.INFO, "landlab_debrisflow")
    flow = DebrisFlow(valley)
    assert flow.columns is not flow.particles and repr(flow) and caplog.messages == []
