"""Column and steps by their rules, and the warning about phases."""

import functools

import pytest

from landlab_debrisflow import Hydrograph, Numerics, Setup
from landlab_debrisflow.fidelity.choices import (
    choose_column,
    choose_steps,
    column_words,
    consolidation_ratio,
    has_pressure,
    phase_warning,
    start_coefficient,
)
from landlab_debrisflow.fidelity.event import Event
from landlab_debrisflow.laws import ALE, NoExcessPressure

from .valleys import flow_on, valley

DILATANT = {"law": "ale", "dilatancy": {"permeability": 1e-8}}
OWN = Setup(column=DILATANT).column
NO_PRESSURE = {"initial_pressure_ratio": 0.0, "bed_pressure_ratio": 0.0}


@functools.cache
def shared(**keywords):
    """Return a grid that no test changes: to build one takes longer than a test."""
    return valley(**keywords)


def event(grid=None, **keywords):
    return Event(grid or shared(), Setup(**keywords), 10.0, flow_on)


@pytest.mark.parametrize(
    ("keywords", "ratio", "hold", "column", "words"),
    [
        ({}, 5.0, ("run_out",), ALE(), "T_c/T = 5"),
        ({}, 31.0, ("run_out",), ALE(), "T_c/T = 31"),
        ({}, 31.0, ("run_out", "deposit"), ALE(levels=21), "T_c/T = 31 > 30 and deposit asked for"),
        ({}, 30.0, ("pressure",), ALE(), "T_c/T = 30"),
        ({}, 1e-4, ("run_out",), ALE(), "T_c/T = 0.0001"),
        ({"material": NO_PRESSURE}, 0.0015, ("run_out",), NoExcessPressure(), "T_c/T = 0.0015 <= 0.0015"),
        ({"material": NO_PRESSURE}, 0.0016, ("run_out",), ALE(), "T_c/T = 0.0016"),
        ({"material": NO_PRESSURE, "flow": "two_phase"}, 1e-4, ("run_out",), ALE(), "T_c/T = 0.0001"),
        ({"material": {"water_density": 0.0}}, 100.0, ("deposit",), NoExcessPressure(), "there is no pore water"),
        ({"material": {"water_table_ratio": 0.0}}, 100.0, (), NoExcessPressure(), "there is no pore water"),
        ({"column": {"law": "ale", "levels": 7}}, 100.0, ("deposit",), ALE(levels=7), "your own choice"),
        ({"column": "none"}, 100.0, ("deposit",), NoExcessPressure(), "your own choice"),
        ({"column": DILATANT}, 100.0, ("deposit",), OWN, "your own choice"),
        ({"column": DILATANT, "material": NO_PRESSURE}, 1e-4, (), OWN, "your own choice"),
    ],
)
def test_columns(keywords, ratio, hold, column, words):
    choice = choose_column(event(**keywords), ratio, hold)
    assert choice.value == column and words in choice.rule


@pytest.mark.slow
def test_where_pressure_comes_from():
    dry_body = {"initial_pressure_ratio": 0.0}
    assert has_pressure(event())
    assert has_pressure(event(material=dry_body))  # of the bed
    assert not has_pressure(event(material=dry_body, erosion="none"))
    assert not has_pressure(event(shared(soil=0.0, release=0.0), material=dry_body))
    assert has_pressure(event(material=NO_PRESSURE | {"bed_loading_coefficient": 0.5}))
    grid = valley()
    grid.add_zeros("bed__excess_pore_pressure_ratio", at="node")
    assert not has_pressure(event(grid, material=dry_body))
    grid.at_node["bed__excess_pore_pressure_ratio"][7] = 0.1
    assert has_pressure(event(grid, material=NO_PRESSURE))
    assert not has_pressure(event(material=NO_PRESSURE))
    assert has_pressure(event(material=NO_PRESSURE | {"bed_degree_of_saturation": 0.9}))  # suction of pores with air
    surge = {
        "line_start": (1010.0, 2020.0),
        "line_end": (1010.0, 2050.0),
        "times": [0.0, 9.0],
        "discharge": 9.0,
        "velocity": 2.0,
    }
    for ratio, found in ((None, True), (0.0, False), (0.3, True)):
        line = Hydrograph(**surge, pressure_ratio=ratio) if ratio is not None else Hydrograph(**surge)
        still = event(shared(release=0.0), erosion="none", inflow=line)
        assert has_pressure(still) == found


@pytest.mark.parametrize(
    ("numerics", "tolerance", "chosen", "rule"),
    [
        (Numerics(), 0.02, Numerics(preset="fast"), "tolerance 2 % >= 2 %"),
        (Numerics(), 0.019, Numerics(), "tolerance 1.9 % < 2 %"),
        (Numerics(courant_number=0.3), 0.05, Numerics(courant_number=0.3), "your own courant_number in numerics"),
        (Numerics(preset="fast"), 0.01, Numerics(preset="fast"), "your own"),
        (Numerics(threads=2, settle=False), 0.05, Numerics(preset="fast", threads=2, settle=False), ">="),
    ],
)
def test_steps(numerics, tolerance, chosen, rule):
    choice = choose_steps(numerics, tolerance)
    assert choice.value == chosen and rule in choice.rule


def test_consolidation_over_duration():
    assert consolidation_ratio(2.0, 0.01, 100.0) == 4.0
    assert consolidation_ratio(2.0, 0.0, 100.0) == float("inf")


def test_phases_differ_where_grains_and_water_move_apart():
    """tau = c_v/125 m2 s-2: 1 m2/s are 8 ms, times (9.81/2)^(1/2) s-1 are 0.0177."""
    ratio, warning = phase_warning(event(), 2.0, 1.0)
    assert ratio == pytest.approx(0.0177, rel=1e-2) and warning == ""
    ratio, warning = phase_warning(event(), 2.0, 4.0)
    assert ratio == pytest.approx(0.0709, rel=1e-2)
    assert "one phase, as you chose" in warning and "eroding bed" in warning
    assert "two phases" in phase_warning(event(flow="two_phase", erosion="none"), 2.0, 4.0)[1]
    assert phase_warning(event(material={"water_density": 0.0}), 2.0, 4.0) == (0.0, "")


def test_words_tell_dilatancy():
    assert column_words(ALE()) == "ale with 11 levels"
    assert column_words(OWN) == "ale with dilatancy and 11 levels"


def test_debris_with_dilatancy_begins_with_its_own_coefficient():
    """Half the load of 2 m with the default material: 990 * 9.81 Pa; k_w = 1e-8/5e-3 m2 Pa-1 s-1 at m = 0.6."""
    assert start_coefficient(Setup(), 2.0) == 4e-4
    found = start_coefficient(Setup(column=DILATANT), 2.0)
    assert found == pytest.approx(2e-6 * 0.6 * (990.0 * 9.81 + 1000.0) / 0.017, rel=1e-12)


def test_with_dilatancy_permeability_tells_how_far_grains_and_water_move_apart():
    """The default stiffness 2.5e5 Pa is a coefficient of 0.5 m2/s with k_w = 2e-6: the number does not count."""
    usual, _ = phase_warning(event(), 2.0, 0.5)
    for coefficient in (0.5, 5.0):
        ratio, warning = phase_warning(event(column=DILATANT), 2.0, coefficient)
        assert ratio == pytest.approx(usual, rel=2e-2) and warning == ""
    coarse = {"law": "ale", "dilatancy": {"permeability": 1e-7}}
    assert "one phase, as you chose" in phase_warning(event(column=coarse), 2.0, 0.5)[1]
