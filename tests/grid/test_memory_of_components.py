"""A component that nobody uses any more gives its memory back at once."""

import gc
import weakref

from landlab_debrisflow import DebrisFlow


def test_no_cycle_keeps_a_component(slope):
    """Arrays over all nodes would stay until Python looks for cycles, of one run after the other."""
    gc.collect()
    gc.disable()
    try:
        flow = DebrisFlow(slope, friction="coulomb", numerics={"particle_count": 50})
        flow.run_one_step(1.0)
        known = weakref.ref(flow)
        del flow
        assert known() is None
    finally:
        gc.enable()
