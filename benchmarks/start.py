"""How long a start takes: python -m benchmarks.start [--kernels | --calls]

CPU seconds (user + system) of fresh Python processes: the import of what is needed of landlab, that of the
package, both and the first step of a small event (200 particles, ALE column, erosion), and 20 s of that event, where
more kernels are needed. Cold is with an empty folder NUMBA_CACHE_DIR, once or the median of ``--cold N``, warm
with a full one, median of five. The last column is what comes on top of landlab's own import.

With --kernels, CPU time of compilation by kernel instead: by itself, and with all that it calls and that had not
been compiled yet. With --calls, CPU time of a call of a kernel with 15 arrays, with and without references counted.
"""

import argparse
import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time

from rich.console import Console
from rich.table import Column, Table

WARM = 5
WIDTH = 130  # of the tables [characters]
ARRAYS = 15
LANDLAB = "from landlab import Component, RasterModelGrid"
PACKAGE = f"{LANDLAB}\nimport landlab_debrisflow"
EVENT = f"""{PACKAGE}
import numpy as np
grid = RasterModelGrid((20, 80), xy_spacing=5.0)
grid.add_field("topographic__elevation", np.maximum(0.0, 75.0 - 0.5 * grid.x_of_node), at="node")
grid.add_full("soil__depth", 1.0, at="node")
release = grid.add_zeros("debris_flow__release_depth", at="node")
release[(abs(grid.x_of_node - 30) < 8) & (abs(grid.y_of_node - 48) < 8)] = 1.0
flow = landlab_debrisflow.DebrisFlow(grid, numerics={{"particle_count": 200}})
flow.run_one_step(0.1)"""
LONGER = f"{EVENT}\nflow.run_one_step(19.9)"
PROGRAMS = {
    "import of landlab": LANDLAB,
    "import of the package": PACKAGE,
    "import and first step": EVENT,
    "import and 20 s": LONGER,
}


def cpu_seconds(program: str, cache: str) -> float:
    """Return the CPU time of a program in a process of its own [s]."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([sys.executable, "-c", program], check=True, env={**os.environ, "NUMBA_CACHE_DIR": cache})
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def measure(cold_runs: int) -> Table:
    """Return the table of all programs."""
    table = Table("CPU time [s]", title=f"Python {sys.version.split()[0]}, {WARM} warm starts, {cold_runs} cold")
    for words in ("cold", "warm", "cold - landlab", "warm - landlab"):
        table.add_column(words, justify="right")
    base = None
    for name, program in PROGRAMS.items():
        cold = []
        for _ in range(cold_runs):
            with tempfile.TemporaryDirectory() as cache:
                cold.append(cpu_seconds(program, cache))
        with tempfile.TemporaryDirectory() as cache:
            cpu_seconds(program, cache)
            warm = statistics.median(cpu_seconds(program, cache) for _ in range(WARM))
        base = warm if base is None else base
        times = statistics.median(cold), warm
        table.add_row(name, *(f"{value:.2f}" for value in (*times, *(value - base for value in times))))
    return table


def kernels() -> Table:
    """Return the time that each kernel of the event takes to compile."""
    import numba.core.event as event

    class Clock(event.Listener):
        """Sums the CPU time between start and end of compilations, without those inside them."""

        running, spent = [], {}

        def on_start(self, begun):
            self.running.append([time.process_time(), 0.0])

        def on_end(self, ended):
            begin, inside = self.running.pop()
            whole = time.process_time() - begin
            if self.running:
                self.running[-1][1] += whole
            function = ended.data["dispatcher"].py_func
            name = f"{function.__module__}.{function.__qualname__}".removeprefix("landlab_debrisflow.")
            count, own, all_ = self.spent.get(name, (0, 0.0, 0.0))
            self.spent[name] = count + 1, own + whole - inside, all_ + whole

    clock, first = Clock(), {}
    event.register("numba:compile", clock)
    space = {}
    exec(EVENT, space)
    first = dict(clock.spent)
    space["flow"].run_one_step(19.9)
    table = Table(Column("kernel", no_wrap=True), title="CPU time of compilation [s]")
    for words in ("times", "itself", "with all", "1st step"):
        table.add_column(words, justify="right")
    for name, (count, own, all_) in sorted(clock.spent.items(), key=lambda item: -item[1][2]):
        table.add_row(name, str(count), f"{own:.2f}", f"{all_:.2f}", "yes" if name in first else "")
    own = sum(row[1] for row in clock.spent.values())
    table.add_row("all", str(sum(row[0] for row in clock.spent.values())), f"{own:.2f}", "", "")
    table.add_row("of it columns", "", f"{sum(v[1] for k, v in clock.spent.items() if '.column.' in k):.2f}", "", "")
    table.add_row("of it first step", "", f"{sum(row[1] for row in first.values()):.2f}", "", "")
    return table


def calls(repeats: int = 5, times: int = 100_000) -> Table:
    """Return the CPU time of a call of kernels that count references to arrays and of kernels that do not."""
    import numpy as np

    from landlab_debrisflow.core.jit import allocating_kernel, kernel

    def first(arrays):
        arrays[0][0] = 1.0

    def second(arrays):
        arrays[0][0] = 1.0

    arrays = tuple(np.ones(3) for _ in range(ARRAYS))
    compiled = {"allocating_kernel": allocating_kernel(first), "kernel": kernel(second)}
    spent = {name: [] for name in compiled}
    for function in compiled.values():
        function(arrays)
    for _ in range(repeats):
        for name, function in compiled.items():
            begin = time.process_time()
            for _ in range(times):
                function(arrays)
            spent[name].append((time.process_time() - begin) / times)
    table = Table("decorator", title=f"CPU time of a call with {ARRAYS} arrays in us, median of {repeats} in turns")
    table.add_column("call", justify="right")
    for name, found in spent.items():
        table.add_row(name, f"{1e6 * statistics.median(found):.2f}")
    return table


def main() -> None:
    """Measure as the command line says."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--kernels", action="store_true", help="time of compilation by kernel")
    parser.add_argument("--calls", action="store_true", help="time of a call of a kernel")
    parser.add_argument("--cold", type=int, default=1, metavar="N", help="number of cold starts")
    options = parser.parse_args()
    if options.calls:
        Console(width=WIDTH).print(calls())
    elif not options.kernels:
        Console(width=WIDTH).print(measure(options.cold))
    elif "NUMBA_CACHE_DIR" not in os.environ:  # numba reads it when it is imported
        with tempfile.TemporaryDirectory() as cache:
            environment = {**os.environ, "NUMBA_CACHE_DIR": cache}
            subprocess.run([sys.executable, "-m", "benchmarks.start", "--kernels"], check=True, env=environment)
    else:
        Console(width=WIDTH).print(kernels())


if __name__ == "__main__":
    main()
