"""Where the schemes of the pore-pressure column are stable: python -m benchmarks.column_stability

A map over the cell Péclet number e_R dx/c_v at the base and the Fourier number of a step, c_v dt/dx^2, both with the
first thickness, of 11 levels. A cold column erodes over a bed of 1 Pa until its thickness has doubled, for 4000 steps
at most and 8 at least; then it stands over an impermeable base for as many steps, and then erodes as long over a bed of
0 Pa. The exact pressure stays between 0 and 1 Pa. Measured after every step: by how much the largest pressure is above
1 Pa, by how much the least is below 0, and whether anything is not a number: Lax-Wendroff gives up a column that would
need more than 1e5 sub-steps in one step.

Prints the worst of each scheme and keeps benchmarks/results/column_stability.nc, from which
docs/figures/column_stability.png is drawn.
"""

import argparse
import time

import numpy as np
import xarray as xr
from matplotlib import colormaps
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from benchmarks import charts, result_files, style
from landlab_debrisflow.physics.column import ALE
from landlab_debrisflow.physics.column.driver import Columns

SCHEMES = {"default": "default", "lax_wendroff": "Lax–Wendroff (the paper's)", "upwind": "hybrid upwind, implicit"}
LEVELS = 11
PECLET = np.logspace(-3.0, 3.0, 37)  # of a cell
FOURIER = np.logspace(-3.0, 4.0, 43)  # of a cell and a step
MOST_STEPS, LEAST_STEPS, DOUBLED = 4000, 8, 2.0
ROUNDING = 1e-12  # of 1 Pa
COMMAND = "python -m benchmarks.column_stability"


def extremes(scheme: str) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the overshoot, the undershoot [Pa] and which columns failed, shape (Fourier, Péclet)."""
    law, cells = ALE(levels=LEVELS, scheme=scheme, loading_source="none"), LEVELS - 1
    fourier, peclet = (array.ravel() for array in np.meshgrid(FOURIER, PECLET, indexing="ij"))
    count = fourier.size
    over, under, failed = np.zeros(count), np.zeros(count), np.full(count, False)
    # lengths over the first thickness, time in steps: c_v = Fo dx^2 and e_R = Pe c_v/dx
    coefficient = fourier / cells**2
    rate = peclet * fourier / cells
    steps = np.clip(np.ceil((DOUBLED - 1.0) / rate), LEAST_STEPS, MOST_STEPS)
    thickness = np.ones(count)
    columns = Columns(law, np.zeros((count, LEVELS)), thickness, liquefaction_pressure=np.ones(count), bounded=False)
    columns.state.memory[:] = 0.0  # a new column may erode in its first step
    for step in range(int(3 * steps.max())):
        going, phase = step < 3 * steps, step // steps  # erodes, stands, erodes
        entrained = np.where(going & (phase != 1), rate, 0.0)
        thickness = thickness + entrained
        base = columns.step(
            1.0, entrained, volume=thickness, thickness=thickness, liquefaction_pressure=1.0,
            bed_pressure=np.where(phase < 2, 1.0, 0.0), coefficient_of_consolidation=np.where(going, coefficient, 0.0),
        )  # fmt: skip
        seen = np.column_stack([columns.profile(), base])
        failed |= going & ~np.isfinite(seen).all(axis=1)
        with np.errstate(invalid="ignore"):
            over = np.where(going, np.fmax(over, seen.max(axis=1) - 1.0), over)
            under = np.where(going, np.fmax(under, -seen.min(axis=1)), under)
    shape = FOURIER.size, PECLET.size
    return over.reshape(shape), under.reshape(shape), failed.reshape(shape)


def table(found) -> str:
    """Return the worst of each scheme, and where."""

    def worst(values):
        i, j = np.unravel_index(np.nanargmax(values), values.shape)
        if not values[i, j] > ROUNDING:
            return "below 1e-12"
        return f"{values[i, j]:.3f} at Pe {PECLET[j]:.0e}, Fo {FOURIER[i]:.0e}"

    lines = [f"{'scheme':13s} | {'overshoot [Pa]':31s} | {'undershoot [Pa]':31s} | not a number     | CPU time [s]"]
    for scheme in SCHEMES:
        one = found.sel(scheme=scheme)
        failed = one.failed.values > 0
        missing = f"{100.0 * failed.mean():.0f} % of the map" if failed.any() else "nowhere"
        over, under = worst(one.overshoot.values), worst(one.undershoot.values)
        lines.append(f"{scheme:13s} | {over:31s} | {under:31s} | {missing:16s} | {float(one.cpu):.0f}")
    return "\n".join(lines)


def chart():
    """Return the figure: overshoot above undershoot, a column for each scheme."""
    found = result_files.read_dataset("column_stability")
    bounds = [0.0, 0.01, 0.03, 0.1, 0.2, 0.3, 1.0]
    colours = ListedColormap(np.vstack([[0.91, 0.94, 0.98, 1.0], colormaps["YlOrRd"](np.linspace(0.25, 1.0, 5))]))
    colours = colours.with_extremes(bad="0.35", over="black")
    norm = BoundaryNorm(bounds, colours.N)
    figure, axes = style.panels(2, len(SCHEMES), (11.0, 7.6), sharex=True, sharey=True)
    for column, (scheme, title) in zip(axes.T, SCHEMES.items(), strict=True):
        failed = found.failed.sel(scheme=scheme).values > 0
        for axis, words in zip(column, ("overshoot", "undershoot"), strict=True):
            values = found[words].sel(scheme=scheme).values
            shown = np.ma.masked_where(failed, np.maximum(values, 0.0))
            mesh = axis.pcolormesh(PECLET, FOURIER, shown, cmap=colours, norm=norm, shading="nearest")
            axis.plot(PECLET, (LEVELS - 1) / PECLET, "k--", linewidth=1.0)
            axis.set(xscale="log", yscale="log", xlim=PECLET[[0, -1]], ylim=FOURIER[[0, -1]])
            most = np.nanmax(values)
            told = "none, to rounding" if most <= ROUNDING else f"{most:.2f} Pa at most"
            axis.set_title(f"{title}\n{words}: {told}" if words == "overshoot" else f"{words}: {told}", fontsize=10)
    axes[1, 1].set_xlabel("cell Péclet number at the start, $e_R\\,\\Delta x/c_v$ [-]", fontsize=10)
    figure.supylabel("Fourier number of a step at the start, $c_v\\,\\Delta t/\\Delta x^2$ [-]", fontsize=10)
    good = found.where(found.failed == 0)
    beyond = max(float(good.overshoot.max()), float(good.undershoot.max())) > bounds[-1]
    end = "max" if beyond else "neither"
    bar = figure.colorbar(mesh, ax=axes, location="right", shrink=0.8, ticks=bounds, extend=end)
    bar.set_label("largest excursion beyond the exact bounds, 0 and 1 Pa [Pa]")
    marks = [
        Line2D([], [], color="k", linestyle="--", label="thickness doubles in one step; to the right of it: more"),
        Patch(facecolor="0.35", label="not a number: needs more than 1e5 sub-steps in one step"),
    ]
    figure.legend(handles=marks, loc="outside lower center", frameon=False, ncols=2)
    return figure


def main() -> None:
    argparse.ArgumentParser(description=__doc__.splitlines()[0]).parse_args()
    coordinates = {"scheme": list(SCHEMES), "fourier": FOURIER, "peclet": PECLET}
    results = []
    for scheme in SCHEMES:
        start = time.process_time()
        results.append((*extremes(scheme), time.process_time() - start))
    over, under, failed, cpu = (np.array(values) for values in zip(*results, strict=True))
    found = xr.Dataset(
        {"overshoot": (tuple(coordinates), over.astype("f4")), "undershoot": (tuple(coordinates), under.astype("f4")),
         "failed": (tuple(coordinates), failed.astype("i1")), "cpu": ("scheme", cpu)}, coordinates,
    )  # fmt: skip
    print(table(found))
    result_files.keep_dataset("column_stability", found, COMMAND)
    charts.make("column_stability")


if __name__ == "__main__":
    main()
