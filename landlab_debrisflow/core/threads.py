"""Ranges of work in threads."""

import os
from concurrent.futures import ThreadPoolExecutor
from functools import lru_cache


@lru_cache(maxsize=4)
def _pool(process: int, threads: int) -> ThreadPoolExecutor:
    """Return the thread pool of a process; the number of the process is a key because a fork inherits no threads."""
    return ThreadPoolExecutor(threads, thread_name_prefix="debrisflow")


def in_ranges(function, count: int, threads: int, *arguments) -> None:
    """Call ``function(first, last, *arguments)`` on ranges of about equal size that together cover `count` items.

    One thread computes the whole of an item and writes only what belongs to this item. So the result does not depend on
    the number of threads, to the last bit.
    """
    if threads == 1:
        function(0, count, *arguments)
        return
    pool, ends = _pool(os.getpid(), threads), [count * k // threads for k in range(threads + 1)]
    for future in [pool.submit(function, ends[k], ends[k + 1], *arguments) for k in range(threads)]:
        future.result()
