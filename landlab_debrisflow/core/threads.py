"""Ranges of work in threads."""

import os
from concurrent.futures import ThreadPoolExecutor
from functools import lru_cache

LEAST_PARTICLES = 4000
"""Number of particles below which one thread does all: to hand over a range takes some 20 us, and a step of a thousand
particles takes a fraction of a millisecond."""

UNIT = 64
"""Ranges of particles begin at multiples of this number: kernels that treat particles in blocks then have the same
blocks, and threads write to different lines of the cache."""


@lru_cache(maxsize=4)
def _pool(process: int, threads: int) -> ThreadPoolExecutor:
    """Return the thread pool of a process; the number of the process is a key because a fork inherits no threads."""
    return ThreadPoolExecutor(threads, thread_name_prefix="debrisflow")


def worth(threads: int, particles: int) -> int:
    """Return how many of `threads` so many particles are worth.

    Examples
    --------
    >>> worth(2, 1500), worth(2, 100_000)
    (1, 2)
    """
    return threads if particles >= LEAST_PARTICLES else 1


def in_ranges(function, count: int, threads: int, *arguments, unit: int = 1) -> list:
    """Call ``function(first, last, *arguments)`` on ranges of about equal size that together cover `count` items.

    One thread computes the whole of an item and writes only what belongs to this item. So the result does not depend on
    the number of threads, to the last bit. All ranges but the last are multiples of `unit`. The thread that calls does
    the first range. Returned are the values of the function, in the order of the ranges.
    """
    if threads == 1:
        return [function(0, count, *arguments)]
    units = -(-count // unit)
    ends = [min(count, unit * (units * k // threads)) for k in range(threads + 1)]
    pool = _pool(os.getpid(), threads)
    others = [pool.submit(function, ends[k], ends[k + 1], *arguments) for k in range(1, threads)]
    try:
        found = [function(ends[0], ends[1], *arguments)]
    finally:  # no range goes on after an error of another
        for other in others:
            other.exception()
    return found + [other.result() for other in others]


def over_particles(function, count: int, threads: int) -> list:
    """Call ``function(which)`` on slices that together cover `count` particles; see `in_ranges`."""
    if worth(threads, count) == 1:
        return [function(slice(0, count))]
    return in_ranges(lambda first, last: function(slice(first, last)), count, threads, unit=UNIT)
