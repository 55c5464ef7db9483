"""Two phases of the engine against the converged finite-volume reference: ``python -m benchmarks.two_phase``.

The strips and the errors are those of `validation.cases.two_phase_strips`. Keeps two_phase_errors.json and two_phase.nc
in benchmarks/results, from which benchmarks/two_phase.txt and docs/figures/two_phase.png are made.

``python -m benchmarks.two_phase --partners`` compares flows in which grains keep their partners for 1 to 32 steps,
``--columns`` counts the columns that grow in a step.
"""

import argparse
import time

import numpy as np
import xarray as xr

from benchmarks import charts, result_files, style
from benchmarks.speed_against_scenes import gully
from landlab_debrisflow.physics.column.schemes.lazy import advance
from validation.cases import two_phase_strips as strips
from validation.replacing import replaced

COUNTS = (500, 2000, 8000)
SHOWN = ("cap", "collapse")
"""Cases of the figure."""

EVERY = 4
"""One cell of the reference in so many is kept."""

QUANTITIES = ("h_s", "h_w", "h_s v_s", "h_w v_w")
COMMAND = "python -m benchmarks.two_phase"


def measure(counts):
    """Return the rows of the table, and flows of the cases of the figure with the second of the counts."""
    rows, drawn = [], {}
    for name in strips.PLACES:
        strips.run(name, 100)  # loads or compiles
        for count in counts:
            flow, cpu, steps = strips.run(name, count)
            errors = dict(zip(QUANTITIES, strips.errors(flow, name), strict=True))
            rows.append({"case": name, "particles": count, "steps": steps, "CPU [s]": cpu, **errors})
            print(rows[-1], flush=True)
            if name in SHOWN and count == counts[min(1, len(counts) - 1)]:
                drawn[name] = flow
    return rows, drawn


def profiles(flows) -> xr.Dataset:
    """Return place, thickness and velocity of particles, and of the reference, by case and phase."""
    found = xr.Dataset()
    for name, flow in flows.items():
        reference = strips.reference(name)
        found[f"{name}_x"] = (f"{name}_cell", reference.x[::EVERY])
        found[f"{name}_x"].attrs["time"] = strips.CASES[name].time
        for phase in strips.PHASES:
            for quantity, values in zip("shv", strips.profile(flow, phase)[:3], strict=True):
                found[f"{name}_{phase}_{quantity}"] = (f"{name}_{phase}", values)
            for quantity in "hv":
                values = getattr(reference, f"{quantity}_{phase[0]}")[-1][::EVERY]
                found[f"{name}_{phase}_{quantity}_reference"] = (f"{name}_cell", values)
    return found


def report() -> str:
    """Return the text of benchmarks/two_phase.txt."""
    lines = [
        f"relative L1 errors against finite volumes of {strips.CELLS} cells; N particles of each phase, "
        f"{strips.ACROSS} across",
        f"{'case':16s}{'N':>6s}{'steps':>7s}{'CPU s':>8s}" + "".join(f"{name:>9s}" for name in QUANTITIES),
    ]
    for row in result_files.read("two_phase_errors")["rows"]:
        head = f"{row['case']:16s}{row['particles']:6d}{row['steps']:7d}{row['CPU [s]']:8.2f}"
        lines.append(head + "".join(f"{row[name]:9.4f}" for name in QUANTITIES))
    return "\n".join(lines) + "\n"


def chart():
    """Return the figure: thickness and velocity of both phases, particles over the reference."""
    found = result_files.read_dataset("two_phase")
    names = [name for name in SHOWN if f"{name}_x" in found]
    figure, axes = style.panels(len(names), 2, (11.0, 3.4 * len(names) + 0.4))
    for name, row in zip(names, axes, strict=True):
        x = found[f"{name}_x"]
        for phase, colour, words in zip(strips.PHASES, (style.RED, style.BLUE), ("grains", "water"), strict=True):
            wet = found[f"{name}_{phase}_h_reference"] > 1e-3
            for axis, quantity in zip(row, "hv", strict=True):
                dots = found[f"{name}_{phase}_s"], found[f"{name}_{phase}_{quantity}"]
                axis.plot(*dots, ".", color=colour, markersize=2, alpha=0.35, rasterized=True)
                line = found[f"{name}_{phase}_{quantity}_reference"]
                axis.plot(x[wet], line[wet], color=colour, linewidth=1.4, label=words)
        size = found.sizes[f"{name}_solid"]
        title = f"{name}, {x.attrs['time']:g} s after the release, {size} particles of each phase"
        for axis, label in zip(row, ("own thickness of the phase [m]", "velocity down the plane [m/s]"), strict=True):
            style.finish(axis, xlabel="distance down the plane [m]", ylabel=label, title=title)
    style.legend_below(figure, axes[0, 0], ncol=2, title="lines: finite volumes, converged; dots: particles")
    return figure


def compare_partners(counts=(500, 2000), kept=(1, 4, 8, 16, 32)) -> None:
    """Print errors, and places of both phases against those with new partners in every step, by steps with partners."""
    print(f"{'case':16s}{'N':>6s}{'steps':>7s}{'kept':>6s}" + "".join(f"{name:>9s}" for name in QUANTITIES)
          + "   centre and 99 % of grains, of water, against kept 1 [mm]")  # fmt: skip
    for name in strips.PLACES:
        for count in counts:
            start = None
            for steps_kept in kept:
                with replaced("model.phases.two_phase", "STEPS_WITH_PARTNERS", steps_kept):
                    flow, _, steps = strips.run(name, count)
                found = [strips.profile(flow, phase) for phase in strips.PHASES]
                places = np.array([(np.average(s, weights=v), np.quantile(s, 0.99)) for s, _, _, v in found]).ravel()
                start = places if start is None else start
                print(f"{name:16s}{count:6d}{steps:7d}{steps_kept:6d}"
                      + "".join(f"{error:9.4f}" for error in strips.errors(flow, name))
                      + "".join(f"{1e3 * moved:8.2f}" for moved in places - start), flush=True)  # fmt: skip


def count_columns(particles=10_000) -> None:
    """Print how many columns over eroding bases are updated in a step, and for readings of the mean, and the cost."""
    grow = advance.grow
    for law in ("one_phase", "two_phase"):
        for begin in (2.0, 6.0):
            flow, done = gully(particles, flow=law), {False: [0, 0.0], True: [0, 0.0]}
            flow.run_one_step(begin)
            before = flow.diagnostics.steps

            def counted(columns, selected, present, ending, *others, done=done):
                start = time.process_time()
                grow(columns, selected, present, ending, *others)
                spent = done[ending]
                spent[0], spent[1] = spent[0] + selected.size, spent[1] + time.process_time() - start

            with replaced("physics.column.schemes.lazy.advance", "grow", counted):
                flow.run_one_step(1.5)
            per_step = 1.0 / (particles * (flow.diagnostics.steps - before))
            words = (f"{100.0 * number * per_step:5.1f} % ({1e6 * cpu / max(number, 1):.2f} us each)"
                     for number, cpu in done.values())  # fmt: skip
            print(f"{law:10s} after {begin:g} s, of {particles}: updated {next(words)}, read or switched {next(words)}")


def main(counts=COUNTS) -> None:
    """Measure, keep, and draw."""
    rows, flows = measure(counts)
    if tuple(counts) != COUNTS:
        return
    result_files.keep("two_phase_errors", {"rows": rows}, COMMAND)
    found = profiles(flows)
    steps = {name: 1e-3 if name.endswith(("_x", "_s")) else 2e-4 for name in found.data_vars}
    steps |= {name: 1e-3 for name in steps if "_v" in name}
    result_files.keep_dataset("two_phase", found, COMMAND, steps)
    charts.make("two_phase")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("counts", nargs="*", type=int, default=COUNTS, help="particles of each phase; keeps nothing")
    parser.add_argument("--partners", action="store_true", help="compare numbers of steps with the same partners")
    parser.add_argument("--columns", action="store_true", help="count the columns that grow in a step")
    chosen = parser.parse_args()
    if chosen.partners or chosen.columns:
        compare_partners() if chosen.partners else count_columns()
    else:
        main(tuple(chosen.counts))
