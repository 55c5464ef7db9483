"""Where the columns with dilatancy are stable: python -m benchmarks.dilatancy_stability

Maps over the shear rate, the thickness and the step. Every point of a map is the worst of all combinations of the
parameters of dilatancy at their declared bounds and at their defaults, of eight solid fractions from the loosest to the
densest, and of a hydrostatic and a nearly liquefied start: 11 levels, six steps in which the load swings by a third.
Counted are the iterations of a step, whether they ended before `ITERATIONS`, stresses beyond their bounds, and what is
not a number.

Prints the worst and keeps benchmarks/results/dilatancy_stability.nc, from which docs/figures/dilatancy_stability.png is
drawn.
"""

import argparse
import dataclasses
import itertools
import time

import numpy as np
import xarray as xr
from matplotlib import colormaps
from matplotlib.colors import BoundaryNorm

from benchmarks import charts, result_files, style
from landlab_debrisflow.laws import Dilatancy, kernel
from landlab_debrisflow.physics.column.dilatancy import DENSEST, LOOSEST
from landlab_debrisflow.physics.column.schemes.dilatant_block import LANES, NOT_PRESCRIBED, Block, Rates
from landlab_debrisflow.physics.column.schemes.dilatant_solution import ITERATIONS, solve_block

LEVELS, STEPS = 11, 6
SHEAR = np.concatenate([[0.0], np.logspace(-3.0, 5.0, 9)])  # [s-1]
THICKNESS = np.logspace(-4.0, 1.0, 6)  # [m]
DURATION = np.logspace(-6.0, 3.0, 10)  # [s]
FRACTIONS = np.linspace(LOOSEST, DENSEST, LANES // 2)
RATIOS = 0.0, 0.95  # pressure over liquefaction at the start
LOADING, WATER_TO_BUOYANT, SOLID_DENSITY = 990.0 * 9.81, 1000.0 / 990.0, 2650.0
MEASURED = {"iterations": 1, "unfinished": 0, "beyond": 0.0, "missing": 0}
COMMAND = "python -m benchmarks.dilatancy_stability"


def laws():
    """Yield the constants of dilatancy at all corners of its parameters, defaults between them."""
    names, values = [], []
    for field in dataclasses.fields(Dilatancy):
        low, high = field.metadata["bounds"]
        names.append(field.name)
        values.append(sorted({low, field.default, high}))
    for corner in itertools.product(*values):
        yield Dilatancy(**dict(zip(names, corner, strict=True))).constants(SOLID_DENSITY)


@kernel
def run(block, rates, law, dt, fractions, ratios, load, counted):
    """Take steps of one block from its start; add what is `counted`, in the order of `MEASURED`."""
    stress, fraction, _, _, _, _, _ = block
    _, loads, _, mosts, _ = rates
    cells, lanes = stress.shape[0] - 1, stress.shape[1]
    half = lanes // 2
    for b in range(lanes):
        for j in range(cells + 1):
            stress[j, b] = (1.0 - ratios[b // half]) * load * j / cells
            fraction[j, b] = fractions[b % half]
    for k in range(6):
        swing = 1.0 + 0.33 * np.sin(2.0 * k)
        for b in range(lanes):
            loads[b], mosts[b] = load * swing, load * swing * (1.0 + 1000.0 / 990.0)
            for j in range(cells + 1):
                stress[j, b] = min(stress[j, b], mosts[b] * j / cells)
        iterations = solve_block(block, rates, law, dt)
        counted[0] = max(counted[0], iterations)
        counted[1] += iterations == 60
        for b in range(lanes):
            for j in range(cells + 1):
                s, m, most = stress[j, b], fraction[j, b], mosts[b] * j / cells
                if not (np.isfinite(s) and np.isfinite(m)):
                    counted[3] += 1.0
                counted[2] = max(counted[2], max(-s, s - most) / (most + law.reference_stress))


def measure():
    """Return the worst at each shear rate, thickness and step as a Dataset, and where iterations were most."""
    scratch, numbers = np.zeros((7, LEVELS + 1, LANES)), np.empty((5, LANES))
    block = Block(
        stress=scratch[0, :-1], fraction=scratch[1, :-1], logarithm=scratch[2], conductance=scratch[3],
        storage=scratch[4], eliminated=scratch[5], change=scratch[6],
    )  # fmt: skip
    rates = Rates(shear=numbers[0], load=numbers[1], thickness=numbers[2], most=numbers[3], prescribed=numbers[4])
    numbers[4] = NOT_PRESCRIBED
    shape = SHEAR.size, THICKNESS.size, DURATION.size
    found = np.zeros((*shape, 4))
    worst, usual = (0, None), 0
    constants, ratios = list(laws()), np.array(RATIOS)
    for place in np.ndindex(shape):
        i, j, k = place
        numbers[0], numbers[2] = SHEAR[i], THICKNESS[j]
        for law in constants:
            counted = np.zeros(4)
            run(block, rates, law, DURATION[k], FRACTIONS, ratios, LOADING * THICKNESS[j], counted)
            if law == Dilatancy().constants(SOLID_DENSITY):
                usual = max(usual, int(counted[0]))
            if counted[0] > worst[0]:
                worst = counted[0], (law, SHEAR[i], THICKNESS[j], DURATION[k])
            found[place][[0, 2]] = np.maximum(found[place][[0, 2]], counted[[0, 2]])
            found[place][[1, 3]] += counted[[1, 3]]
    coordinates = {"shear_rate": SHEAR, "thickness": THICKNESS, "dt": DURATION}
    data = {name: (tuple(coordinates), found[..., m].astype("f4")) for m, name in enumerate(MEASURED)}
    return xr.Dataset(data, coordinates, {"blocks": len(constants) * int(np.prod(shape)), "usual": usual}), worst


def report() -> str:
    """Return the worst of all maps."""
    found = result_files.read_dataset("dilatancy_stability")
    return "\n".join([
        f"blocks of {LANES} columns, {STEPS} steps each: {found.attrs['blocks']}",
        f"most iterations of a step: {int(found.iterations.max())} of {ITERATIONS} allowed",
        f"with the default parameters: {found.attrs['usual']}",
        f"steps that did not converge: {int(found.unfinished.sum())}",
        f"largest excess of a stress over its bounds, over bound + sigma_0: {float(found.beyond.max()):.1e}",
        f"not a number: {int(found.missing.sum())}",
    ])  # fmt: skip


def chart():
    """Return the figure: most iterations over shear rate and step, and over thickness and step."""
    found = result_files.read_dataset("dilatancy_stability").iterations
    bounds = np.array([1, 3, 5, 7, 10, 15, 20, 30, 60])
    figure, axes = style.panels(1, 2, (10.0, 4.6), sharey=True)
    axes = axes.ravel()
    colours = colormaps["YlGnBu"]
    norm = BoundaryNorm(bounds, colours.N)
    for axis, other, words in (
        (axes[0], "thickness", "shear rate [s$^{-1}$]"), (axes[1], "shear_rate", "thickness [m]")
    ):  # fmt: skip
        values = found.max(other)
        name = next(dim for dim in values.dims if dim != "dt")
        places = np.arange(values.sizes[name])
        mesh = axis.pcolormesh(
            places, found.dt, values.transpose("dt", name), cmap=colours, norm=norm, shading="nearest"
        )  # fmt: skip
        axis.set(yscale="log", xlabel=words)
        axis.set_xticks(places, [f"{value:g}" for value in found[name].values], rotation=45)
        axis.set_title(f"worst of all {'thicknesses' if other == 'thickness' else 'shear rates'}", fontsize=10)
    axes[0].set_ylabel("step [s]")
    bar = figure.colorbar(mesh, ax=axes, location="right", ticks=bounds)
    bar.set_label("most iterations of a step [-]")
    return figure


def main() -> None:
    argparse.ArgumentParser(description=__doc__.splitlines()[0]).parse_args()
    start = time.process_time()
    found, (most, where) = measure()
    print(f"most iterations {most:.0f} at {where}; {time.process_time() - start:.0f} s CPU")
    result_files.keep_dataset("dilatancy_stability", found, COMMAND)
    print(report())
    charts.make("dilatancy_stability")


if __name__ == "__main__":
    main()
