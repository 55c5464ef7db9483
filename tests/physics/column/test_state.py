"""The state of the default scheme is what its table says, and laws ask for as much memory as they use."""

import re

import numpy as np
import pytest

from landlab_debrisflow.physics.column import ALE, Classical, ConstantRatio, NoExcessPressure
from landlab_debrisflow.physics.column.driver import Columns
from landlab_debrisflow.physics.column.schemes.lazy import state
from landlab_debrisflow.physics.column_contracts import BaseContact


def test_every_member_stands_in_the_table_once_with_its_unit():
    rows = re.findall(r"^(\w+) +(-|Pa|m3)(?: |$)", state.__doc__, re.MULTILINE)
    assert [name for name, _ in rows] == list(state.LAYOUT.names)


def test_records_are_a_view_of_the_memory():
    memory = np.zeros((2, state.SIZE))
    state.records(memory)["load"][1] = 3.0
    assert memory[1, state.LAYOUT.names.index("load")] == 3.0 and not memory[0].any()


@pytest.mark.parametrize("law", [ALE(), Classical(), ALE(scheme="upwind"), ConstantRatio(), NoExcessPressure()])
def test_a_law_takes_no_more_memory_than_it_asks_for(law):
    columns = Columns(law, np.zeros((1, law.levels)), [1.0], liquefaction_pressure=[1e4])
    assert columns.state.memory.shape == (1, law.memory_size)
    assert np.isfinite(columns.step(1.0, entrained=0.1, bed_pressure=5e3)).all()


@pytest.mark.parametrize("contact", [BaseContact.BY_EROSION, BaseContact.PRESCRIBED, BaseContact.IMPERMEABLE])
@pytest.mark.parametrize("entrained", [0.0, 0.1])
def test_one_enumeration_of_the_base(contact, entrained):
    expected = {
        (BaseContact.BY_EROSION, 0.0): BaseContact.IMPERMEABLE,
        (BaseContact.BY_EROSION, 0.1): BaseContact.ERODING,
        (BaseContact.PRESCRIBED, 0.0): BaseContact.PRESCRIBED,
        (BaseContact.PRESCRIBED, 0.1): BaseContact.PRESCRIBED,
        (BaseContact.IMPERMEABLE, 0.0): BaseContact.IMPERMEABLE,
        (BaseContact.IMPERMEABLE, 0.1): BaseContact.SEALED,
    }
    columns = Columns(ALE(), np.zeros((1, 11)), [1.0], liquefaction_pressure=[1e4])
    columns.step(1.0, entrained, base=contact)
    assert state.records(columns.state.memory)["contact"][0] == expected[contact, entrained]


def test_without_changes_the_load_grows_as_the_column_does():
    columns = Columns(ALE(), np.zeros((1, 11)), [2.0], volume=[8.0], liquefaction_pressure=[1e4])
    columns.step(1.0, entrained=4.0)
    assert columns.forcing.volume[0] == 12.0 and columns.forcing.thickness[0] == 3.0
    assert columns.forcing.liquefaction_pressure[0] == 1.5e4
