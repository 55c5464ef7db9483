"""Accuracy and cost of the pore-pressure columns: python -m benchmarks.column

Accuracy: a column doubles its thickness under a constant basal pressure, from cold or from a uniform
start, in 400 flow steps; erosion stops. The basal pressure that friction feels is compared at *every*
one of the next 1600 steps with the closed form: the growing column of theory section 6, decaying in
its Fourier series. Error in units of the basal pressure, over Peclet numbers 1e-3 ... 1e4.

Cost: CPU time of one thread, per column and step, over the same two phases; median of some repeats.
A lump is the advance of one column that is due.
"""

import statistics
import time

import numpy as np

from landlab_debrisflow.physics.column import ALE
from landlab_debrisflow.physics.column.analytic import growing_column
from landlab_debrisflow.core.variables import COLUMN_MEMORY
from landlab_debrisflow.physics.contracts import ColumnForcing, ColumnState

HEAVY, LIGHT = 1.0, 1.0  # load and bed pressure [Pa]
STEPS, AFTER = 400, 4
PECLET = np.logspace(-3, 4, 29)


def columns(count: int, levels: int, start: float) -> ColumnState:
    """Return columns of one cubic metre with a uniform pressure [Pa]."""
    profile = np.full((count, levels), start)
    profile[:, -1] = 0.0
    return ColumnState(profile, np.zeros((count, COLUMN_MEMORY)), np.zeros(count))


def step(volume, thickness, load, entrained, bed):
    """Return what a law is told of a step, c_v = 1 m2/s."""
    return ColumnForcing(
        volume, thickness, load, entrained, bed, np.zeros(1, np.int8), np.zeros(1), np.ones(1), 0.0, False
    )


def exact_base(number: float, start: float) -> np.ndarray:
    """Return the basal pressure at the steps after erosion stopped [Pa]."""
    node, weight = np.polynomial.legendre.leggauss(2500)
    stretched = 0.5 * (node + 1.0)
    eta, weight = 1.0 - stretched**3, 1.5 * stretched**2 * weight  # crowded at the base
    waves = (np.arange(800) + 0.5) * np.pi
    profile = growing_column(1.0 - eta, 1.0 / number, number, start)
    amplitude = 2.0 * np.sin(np.outer(waves, eta)) @ (profile * weight) * np.sin(waves)
    passed = np.arange(1, AFTER * STEPS + 1) / STEPS / number / 4.0  # c_v t / h^2 with h = 2 h_0
    return np.exp(-np.outer(passed, waves**2)) @ amplitude


def friction_base(levels: int, start: float) -> np.ndarray:
    """Return the same as the law gives it, shape (time, column) [Pa]."""
    law, count = ALE(levels=levels, loading_source="none"), PECLET.size
    state, base, history = columns(count, levels, start), np.zeros(count), []
    load, ratio = np.full(count, HEAVY), np.ones(count)
    for number_of_step in range(1, (1 + AFTER) * STEPS + 1):
        volume = np.full(count, 1.0 + min(number_of_step, STEPS) / STEPS)
        entrained = np.full(count, 1.0 / STEPS if number_of_step <= STEPS else 0.0)
        # time in units of the erosion time: c_v = h_0^2 / Pe, here by the thickness
        forcing = step(volume, np.sqrt(PECLET) * volume, load, entrained, ratio)
        law.advance(state, forcing, 1.0 / STEPS, base)
        history.append(base.copy())
    return np.array(history[STEPS:])


def cost(levels: int, number: float, count: int = 5000) -> tuple[float, float]:
    """Return the CPU time while eroding and after it [ns per column and step]."""
    law = ALE(levels=levels, loading_source="none")
    times = []
    for _ in range(5):
        state, base = columns(count, levels, 0.0), np.zeros(count)
        load, ratio = np.full(count, HEAVY), np.ones(count)
        marks = [time.process_time()]
        for entrained in (np.full(count, 1.0 / STEPS), np.zeros(count)):
            for number_of_step in range(STEPS):
                volume = np.full(count, 1.0 + (number_of_step + 1) / STEPS if entrained[0] else 2.0)
                forcing = step(volume, np.sqrt(number) * volume, load, entrained, ratio)
                law.advance(state, forcing, 1.0 / STEPS, base)
            marks.append(time.process_time())
        times.append(np.diff(marks) / count / STEPS * 1e9)
    return tuple(statistics.median(column) for column in zip(*times, strict=True))


def lump(levels: int, erodes: bool, count: int = 2000) -> float:
    """Return the CPU time of advancing one column [ns]."""
    law, state, base = ALE(levels=levels), columns(count, levels, 0.5), np.zeros(count)
    volume, load, ratio, times = np.ones(count), np.full(count, HEAVY), np.full(count, 0.5), []
    for _ in range(60):
        volume = volume * (1.01 if erodes else 1.0)
        entrained = volume * (1.0 - 1.0 / 1.01) if erodes else np.zeros(count)
        forcing = step(volume, np.ones(count), load, entrained, ratio)
        before = time.process_time()
        law.advance(state, forcing, 0.1, base)  # one step of 0.1 h^2/c_v: always due
        times.append((time.process_time() - before) / count * 1e9)
    return statistics.median(times)


def main() -> None:
    exact = {start: np.array([exact_base(number, start) for number in PECLET]).T for start in (0.0, 1.0)}
    print(
        "levels | worst error, cold  warm |"
        " ns eroding / after, Pe =  1        10       100      1000 | lump eroding / not"
    )
    for levels in (11, 21, 41):
        error = [np.abs(friction_base(levels, start) - exact[start]).max() for start in (0.0, 1.0)]
        costs = "  ".join("{:3.0f} / {:3.0f}".format(*cost(levels, number)) for number in (1.0, 10.0, 100.0, 1000.0))
        print(
            f"{levels:6d} |          {error[0]:.1e}  {error[1]:.1e} |                  {costs} |"
            f" {lump(levels, True):.0f} / {lump(levels, False):.0f}"
        )


if __name__ == "__main__":
    main()
