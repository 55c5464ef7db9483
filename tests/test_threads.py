"""Threads share the stages of a step, and results are equal to the bit for any number of them."""

from itertools import pairwise

import pytest

from landlab_debrisflow.core.threads import LEAST_PARTICLES, UNIT, in_ranges, over_particles
from validation.replacing import replaced

from .twins import SCENES, build, state


@pytest.mark.slow
@pytest.mark.parametrize("name", SCENES)
def test_any_number_of_threads_gives_the_same_bits(name):
    """Every range is done by threads here, also of few particles."""
    found = []
    with replaced("core.threads", "LEAST_PARTICLES", 1), replaced("core.threads", "UNIT", 32):
        for threads in (1, 2, 3):
            flow = build(name, threads=threads)
            flow.run_one_step(6.0)
            found.append(state(flow))
    assert found[0] == found[1] == found[2]


@pytest.mark.parametrize("count", [1, 63, 64, 65, 200, LEAST_PARTICLES])
@pytest.mark.parametrize("threads", [1, 2, 3, 7])
def test_ranges_cover_everything_once_and_begin_at_units(count, threads):
    ranges = in_ranges(lambda first, last: (first, last), count, threads, unit=UNIT)
    assert ranges[0][0] == 0 and ranges[-1][1] == count and len(ranges) == threads
    assert all(one[1] == other[0] for one, other in pairwise(ranges))
    assert all(first % UNIT == 0 for first, last in ranges if last > first)


def test_few_particles_are_one_range():
    assert over_particles(lambda which: which, LEAST_PARTICLES - 1, 2) == [slice(0, LEAST_PARTICLES - 1)]
    assert len(over_particles(lambda which: which, LEAST_PARTICLES, 2)) == 2


def test_an_error_in_a_range_comes_out():
    def fail(first, last):
        raise ValueError(f"{first}")

    with pytest.raises(ValueError, match="0"):
        in_ranges(fail, 10, 2)
