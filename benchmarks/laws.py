"""What a step costs with every law, over Coulomb friction and growth: ``python -m benchmarks.laws``.

All run the same stand-in valley from the same moment on, in turns: the ratio of CPU time per step
in one turn is disturbed by other work of the machine only as noise; medians over turns are printed. Two
phases have as many particles of each phase as one phase has in all.

Flows differ by the end: where a law keeps particles closer together, their sums have more pairs, and where it erodes
another way, columns have more to do. What is spent in the methods of the friction and the erosion law is therefore
printed, too, less what the first case spends there.
"""

import argparse
import time
from contextlib import ExitStack, contextmanager
from unittest import mock

import numpy as np
from rich.console import Console
from rich.table import Table

from landlab_debrisflow import DebrisFlow
from landlab_debrisflow.cli.demo import MATERIAL
from landlab_debrisflow.laws import LAWS
from landlab_debrisflow.scene import tsing_shan_valley

START, TURN = 2.0, 0.2
"""Until when all run before the first turn, and how long a turn is [s of the event]: before laws bring them apart."""


def cases():
    """Return keywords of `DebrisFlow` by name; the first is what the others are compared with."""
    found = {"coulomb + growth": {}}
    for kind in ("friction", "erosion"):
        for name in list(LAWS[kind])[1:]:
            found[f"{kind}: {name}"] = {kind: name}
    loaded = {"bed_loading_coefficient": 0.3, "bed_drainage_time": 30.0}
    found["a bed under load"] = {"material": MATERIAL | loaded}
    found["two_phase, tight"] = {"flow": "two_phase"}
    found["two_phase, permeable"] = {"flow": {"law": "two_phase", "hydraulic_conductivity": 1e-3}}
    return found


@contextmanager
def timed(physics):
    """Sum up what is spent in the laws of friction and erosion: yields a list of CPU times [s]."""
    spent = []
    with ExitStack() as stack:
        for law, name in ((physics.friction, "basal_resistance"), (physics.erosion, "entrainment_rate")):
            stack.enter_context(mock.patch.object(type(law), name, watched(getattr(type(law), name), spent)))
        yield spent


def watched(method, spent):
    def run(*arguments):
        begin = time.process_time()
        method(*arguments)
        spent.append(time.process_time() - begin)

    return run


def main(particles=10_000, turns=9):
    """Return and print the cost of a step over that of the first case, and its CPU time [us per particle]."""
    flows = {}
    for name, keywords in cases().items():
        flows[name] = DebrisFlow(
            tsing_shan_valley(),
            numerics={"particle_count": particles, "settle": False},
            **({"material": MATERIAL} | keywords),
        )
        flows[name].run_one_step(START)
    costs, inside = {name: [] for name in flows}, {name: [] for name in flows}
    for _ in range(turns):
        for name, flow in flows.items():
            steps, cpu = flow.diagnostics.steps, time.process_time()
            with timed(flow._simulation.setup) as spent:
                flow.run_one_step(TURN)
            per = 1e6 / (flow.diagnostics.steps - steps) / particles
            costs[name].append((time.process_time() - cpu) * per)
            inside[name].append(sum(spent) * per)
    base, base_inside = (np.array(next(iter(values.values()))) for values in (costs, inside))
    table = Table(
        "law", "over the first", "from .. to", "of it in the law", "us per particle and step",
        title=f"{particles} particles",
    )  # fmt: skip
    ratios = {}
    for name, values in costs.items():
        ratio = np.array(values) / base
        ratios[name] = float(np.median(ratio))
        low, high = np.quantile(ratio, [0.25, 0.75])
        more = float(np.median((np.array(inside[name]) - base_inside) / base))
        table.add_row(
            name, f"{ratios[name]:.2f}", f"{low:.2f} .. {high:.2f}", f"{more:+.3f}", f"{np.median(values):.2f}"
        )
    Console(width=110).print(table)
    return ratios


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.split(":")[0])
    parser.add_argument("--particles", type=int, default=10_000)
    main(parser.parse_args().particles)
