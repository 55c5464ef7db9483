"""The paper's class of SPH as a law of flow: smoothing lengths stay as released."""

from contextlib import contextmanager

from landlab_debrisflow.physics.flow import OnePhase


class FixedLength:
    """The paper's class of SPH: smoothing lengths stay as released, without the terms of their gradient."""

    def interact(self, state, cells, shock_viscosity, threads, sums):
        """Write the sums; a length at its cap is not adapted, and its gradient term is 1."""
        length = state.smoothing.length
        state = state._replace(smoothing=state.smoothing._replace(longest=length))
        OnePhase().interact(state, cells, shock_viscosity, threads, sums)
        sums.next_length[:] = length[: sums.next_length.size]


_law = [None]


def law_of_flow():
    """Return the law of the flow a case is to run with; None is the default."""
    return _law[0]


@contextmanager
def fixed_smoothing_length():
    """Let the cases inside the block run with the rival."""
    _law[0] = FixedLength()
    try:
        yield
    finally:
        _law[0] = None
