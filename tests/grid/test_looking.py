"""Who looks changes nothing, and sees the flow as it would be if the call ended there."""

from contextlib import contextmanager
from types import SimpleNamespace

import numpy as np
import pytest

from landlab_debrisflow import InputError
from landlab_debrisflow.grid.write import FieldWriter
from landlab_debrisflow.record.observers import EVERY_STEP
from validation.grids import changed_fields, copy_fields

from ..twins import SCENES, Failed, Fails, build, different, outcome, run_through, state

HORIZON = 60.0


def everything(flow):
    maps = {name: values.values.tobytes() for name, values in flow.maps.items()}
    return outcome(flow) | {"maps": maps, "phases": flow.budget_by_phase}


class Looks:
    """Looks at everything there is, and keeps how it was."""

    def __init__(self, interval):
        self.interval, self.seen = interval, []

    def observe(self, flow):
        self.seen.append(everything(flow))


TEN = (EVERY_STEP, 1.37, 2.0, 3.0, 5.0, 7.0, 10.0, 20.0, 30.0, np.inf)


@pytest.mark.slow
@pytest.mark.parametrize("name", SCENES)
def test_a_flow_is_the_same_however_many_look(name):
    alone = build(name)
    alone.run_until_rest(HORIZON)
    for intervals in ((1.0,), TEN):
        watched = build(name, [Looks(interval) for interval in intervals])
        watched.run_until_rest(HORIZON)
        assert not different(outcome(watched), outcome(alone))
        assert not different(state(watched), state(alone))
        assert all(observer.seen for observer in watched._observers)


@pytest.mark.slow
@pytest.mark.parametrize("name", SCENES)
def test_a_flow_in_many_calls_is_the_same_when_watched(name):
    flows = [build(name), build(name, [Looks(0.2)])]
    for flow in flows:
        for duration in (0.03, 1.1, 2.0, 0.7, 4.4):
            flow.run_one_step(duration)
    assert not different(outcome(flows[0]), outcome(flows[1])) and not different(state(flows[0]), state(flows[1]))


@pytest.mark.slow
@pytest.mark.parametrize("name", SCENES)
def test_a_look_shows_what_the_end_of_a_call_would(name):
    looks = Looks(EVERY_STEP)
    build(name, [looks]).run_until_rest(8.0)
    for step in (0, 1, 17, len(looks.seen) - 2):
        flow = build(name, [Fails(step)])
        with pytest.raises(Failed):
            flow.run_until_rest(8.0)
        assert different(looks.seen[step], everything(flow)) == []


@pytest.mark.slow
@pytest.mark.parametrize("name", SCENES)
def test_what_is_seen_fits_together(name):
    class Checks:
        interval, looks = 0.5, 0

        def observe(self, flow):
            at, p, area = flow.grid.at_node, flow.particles, flow.grid.dx * flow.grid.dy
            self.looks += 1
            assert float(at["debris_flow__depth"].sum()) * area == pytest.approx(float(p.volume.sum()), rel=1e-12)
            here = at["debris_flow__depth"] > 0.01  # where it counts as arrived
            for now in ("depth", "speed", "basal_peclet_number"):
                assert np.all((at[f"debris_flow__max_{now}"] >= at[f"debris_flow__{now}"])[here])
            assert np.all(at["debris_flow__arrival_time"] <= flow.elapsed_time)
            still = (p.velocity_x == 0.0) & (p.velocity_y == 0.0)
            lies = float(at["debris_flow__deposit_depth"].sum()) * area - flow.budget["deposited"]
            # sums of some hundred tents
            assert lies == pytest.approx(float(p.volume.where(still, 0.0).sum()), abs=1e-9)
            assert abs(flow.budget["residual"]) < 1e-9
            assert not np.isnan(flow.columns.excess_pore_pressure).any()

    checks = Checks()
    build(name, [checks]).run_until_rest(HORIZON)
    assert checks.looks > 20


@pytest.mark.parametrize("call", ["run_one_step(1.0)", "run_until_rest()", "settle()"])
def test_an_observer_may_not_run_the_flow(call):
    class Runs:
        interval = 3.0

        def observe(self, flow):
            if flow.at_rest or call != "settle()":
                eval(f"flow.{call}", {"flow": flow})

    flow, twin = build("eroding", [Runs()]), build("eroding")
    with pytest.raises(InputError, match=r"while another one runs, .*observe\(flow\) may look") as refusal:
        flow.run_until_rest()
    assert "everything computed until then is kept" in refusal.value.__notes__[0]
    flow._observers = ()
    flow.run_until_rest()
    twin.run_until_rest()
    assert not different(outcome(flow), outcome(twin))


@pytest.mark.slow
@pytest.mark.parametrize("name", SCENES)
def test_nothing_of_a_look_stays_on_the_grid(name, monkeypatch):
    present, shown = FieldWriter.present, set()

    @contextmanager
    def checked(writer):
        before, inside = copy_fields(flow.grid), state(flow)
        with present(writer):
            shown.update(changed_fields(flow.grid, before))
            yield
        assert not changed_fields(flow.grid, before) and not different(state(flow), inside)

    monkeypatch.setattr(FieldWriter, "present", checked)
    flow = build(name, [SimpleNamespace(interval=EVERY_STEP, observe=lambda flow: None)])
    flow.run_until_rest(HORIZON)
    assert {"debris_flow__depth", "debris_flow__deposit_depth", "debris_flow__max_run_up"} <= shown


@pytest.mark.slow
def test_nor_where_it_wrote_over_what_a_former_event_left():
    flow = build("eroding", [Looks(0.3)])
    flow.run_until_rest()
    left = copy_fields(flow.grid)
    assert left["debris_flow__basal_excess_pore_pressure"].any()
    twin = build("eroding")
    twin.run_until_rest()
    for each in (flow, twin):
        release, soil = (each.grid.at_node[name] for name in ("debris_flow__release_depth", "soil__depth"))
        release[:] = np.where(abs(each.grid.x_of_node - 40.0) < 8.0, np.minimum(0.5, soil), 0.0)
        release[each.grid.status_at_node != 0] = 0.0
        assert run_through(each, 6.0) == 0
    assert not different(outcome(flow), outcome(twin)) and not different(state(flow), state(twin))
