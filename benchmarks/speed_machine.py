"""Limits of the machine: bandwidth of memory and peak of floating-point operations, one thread and more."""

import time
from concurrent.futures import ThreadPoolExecutor

import numba
import numpy as np

REPEATS = 7
FMAS = 16  # per value read, on arrays that stay in the first cache: short enough that the processor overlaps chains


@numba.njit(nogil=True)
def _triad(first, last, a, b, c, scale):
    for i in range(first, last):
        a[i] = b[i] + scale * c[i]


def _fma_kernel(kind):
    """Return a loop of chains of multiply-adds, independent from value to value: vector code."""

    @numba.njit(nogil=True, fastmath={"contract"})
    def run(times, values, factor, summand):
        for _ in range(times):
            for i in range(values.size):
                value = values[i]
                for _k in range(FMAS):
                    value = value * factor + summand
                values[i] = value

    run(1, np.zeros(16, kind), kind(0.5), kind(0.5))
    return run


def fastest(function, threads: int) -> float:
    """Return the least wall time of ``function(thread)`` in all of some threads at once [s]."""
    best = np.inf
    with ThreadPoolExecutor(threads) as pool:
        list(pool.map(function, range(threads)))
        for _ in range(REPEATS):
            begin = time.perf_counter()
            list(pool.map(function, range(threads)))
            best = min(best, time.perf_counter() - begin)
    return best


def bandwidth(threads: int, size=20_000_000) -> float:
    """Return GB/s of a triad on three arrays of 160 MB, 24 bytes a value (what is read before writing not counted)."""
    a, b, c = np.zeros(size), np.ones(size), np.ones(size)
    cut = np.linspace(0, size, threads + 1).astype(int)
    return 24e-9 * size / fastest(lambda k: _triad(cut[k], cut[k + 1], a, b, c, 3.0), threads)


def peak(kind, threads: int, times=10_000) -> float:
    """Return GF/s of multiply-adds, two operations each."""
    run, values = _fma_kernel(kind), [np.ones(1024, kind) for _ in range(threads)]
    taken = fastest(lambda k: run(times, values[k], kind(0.5), kind(0.5)), threads)
    return 2e-9 * FMAS * times * 1024 * threads / taken


def measure() -> dict[str, tuple[float, float]]:
    """Return every figure for one thread and for two."""
    kinds = {
        "bandwidth, triad [GB/s]": bandwidth,
        "peak, 32 bits [GF/s]": lambda threads: peak(np.float32, threads),
        "peak, 64 bits [GF/s]": lambda threads: peak(np.float64, threads),
    }
    return {name: (one(1), one(2)) for name, one in kinds.items()}
