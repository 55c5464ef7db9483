"""Benchmarks of the rules of time steps, and of accuracy beside an earlier version."""

import importlib
from dataclasses import asdict

import numpy as np
import pytest

from benchmarks import erosion_order, flow, rules_off, step_rules, step_scenes, step_stability
from benchmarks.checkout_calls import CALLS
from landlab_debrisflow.model.numerics import Numerics
from landlab_debrisflow.model.step_rule import step_rule
from validation.measure import Norms, Result


@pytest.mark.parametrize("rule", rules_off.RULES)
def test_a_rule_is_what_it_replaces(rule):
    place, name, off = rules_off.RULES[rule]
    assert isinstance(getattr(importlib.import_module(f"landlab_debrisflow.{place}"), name), type(off))
    assert getattr(importlib.import_module(f"landlab_debrisflow.{place}"), name) != off


def test_a_rule_is_switched_off_inside_a_scene_only():
    bounds = []

    def scene():
        bounds.append(step_rule(Numerics(), 5.0))

    for rules in ([], list(rules_off.RULES), []):
        rules_off.without(scene)(rules)
    assert bounds[0] == bounds[2]
    assert bounds[1].longest_way == bounds[1].way < bounds[0].longest_way


def test_every_rule_is_left_out_once():
    asked = step_rules.requests("to_rest", {"count": 10})
    assert len(asked) == len(rules_off.RULES) + 2
    assert [line.count("[") for line in asked.values()] == [2] * len(asked)


def test_errors_of_the_valley_are_against_its_exact_values():
    answer = {"steps": 10, "cpu": 1.0, "run_out": 5.0, "centre": 3.0, "eroded": 7.0}
    found = {"all rules": [answer] * 3, "old": [answer | {"steps": 20, "cpu": 4.0}] * 3}
    row, _ = step_rules.of_the_valley(found, dict.fromkeys(step_rules.MEASURES, 3.0), "old")
    assert (row["steps"], row["cpu"], row["run_out"], row["centre"]) == (0.5, 0.25, 2.0, 0.0)


def test_means_of_s1000_are_against_those_of_the_other_version():
    def of(shift):
        return [{"steps": [1, 3], "cpu": [2.0, 2.0]} | {key: [shift, shift + 2.0] for key in step_rules.MEASURES}]

    row, other = step_rules.of_s1000({"all rules": of(1.0), "old": of(0.0)}, "old")
    assert row["run_out"] == 1.0 and other["run_out"] == 0.0 and row["run_out, spread"] == pytest.approx(2**0.5)


@pytest.mark.slow
def test_a_longer_step_over_a_bend_has_the_larger_error():
    exact, *found = (step_scenes.bend(0.3, way) for way in (0.2, 0.5, 2.0))
    short, long = (step_stability.of_a_slide(run, exact) for run in found)
    assert found[0]["way"] == pytest.approx(0.5, rel=1e-9)
    assert 4.0 * abs(short["energy"]) < abs(long["energy"]) < 0.01
    # without friction the whole fall is kinetic energy, but for what the bend takes
    assert max(exact["energy"]) - exact["energy"][-1] < 2e-3 * exact["kinetic"][-1]


@pytest.mark.slow
def test_a_slab_takes_soil_beyond_the_edge_only():
    run = step_scenes.edge(1.0)
    grown = np.array(run["volume"]) > run["volume"][0]
    assert grown[-1] and not grown[np.array(run["front"]) < 30.0 + step_scenes.FALL - 20.0].any()


def test_a_run_that_blew_up_has_no_numbers():
    assert all(np.isnan(value) for value in step_stability.of_a_surge(None, {}).values())


def test_orders_stand_beside_the_shorter_steps():
    rows = [
        {"revision": "here", "time": 20.0, "shorter": shorter, "steps": 10 * shorter, "front": 0.0}
        | {"x": 1.0 / shorter**2 - 1.0 / 256.0, "volume": 1.0 / shorter - 1.0 / 16.0}
        for shorter in (1, 2, 4)
    ]
    assert [erosion_order.cells(row, rows)[-2:] for row in rows] == [["", ""], ["2.0", "1.0"], ["2.0", "1.0"]]


def test_both_engines_have_the_median_of_their_times():
    def engine(times):
        left = iter(times)
        return lambda name, case, number: asdict(
            Result(case, "ours", number, number, 5, next(left), Norms(0.1, 0.1, 0.1), Norms(0.1, 0.1, 0.1))
        )

    ours, before = flow.in_turns([engine([1.0, 9.0, 2.0]), engine([3.0, 4.0, 5.0])], "Ritter", (48,))
    assert (ours.method, ours.cpu, before.method, before.cpu) == ("ours", 2.0, "before", 4.0)
    assert list(flow.methods([before])) == ["before"] and ours.h == Norms(0.1, 0.1, 0.1)
    assert {"flow", "column_cost", "column_errors"} == set(CALLS)
