"""The column tests of Pastor et al. (2022), figures 6 to 9, by `solve_column` and in closed form.

    python examples/paper_columns.py --output paper_columns.png

A column without pressure, h0 thick, erodes at a constant rate e_R ground whose pressure is p_b. Lines are closed
forms, markers numbers. All is the ALE model: captions and text know no classical model in these figures.

How the paper was read where it leaves a choice:

- Length: the domain grows, h = h0 + e_R t (eq. 48), and figures end at the surface: x and y are over the present h.
  Only so do the profiles of figure 7 steepen without end, as the text has it.
- Depth: eqs. 56 to 58 hold for y/h in [0, 1]; the front is at the depth y/h = 1/(1 + t/T_e), not y/h0.
- Time: over T_c = h0^2/c_v in figures 7 to 9; over T_e = h0/e_R in figure 6, t e_R/h0 (eq. 53 has it inverted).
- Pressure: over p_b, which is 1 in the paper's unit rho_w g h0.
- Péclet number: e_R h0/c_v, with the initial thickness; that of figure 8 is 0.01, which is printed as 001.
- Times: those of figure 7 are used in figures 8 and 9 too, for which the text names none but 0.5.
- Figure 6 is a sketch with one time, as far as its caption tells; times here are ours.
"""

import argparse
import sys

import numpy as np
from matplotlib import colormaps
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from rich.console import Console
from rich.table import Table

from landlab_debrisflow import InputError, ParameterError, solve_column
from landlab_debrisflow.physics.column.analytic import front, growing_column
from landlab_debrisflow.record.files import check_writable
from landlab_debrisflow.record.plots import save_figure

THICKNESS = 1.0  # h0 [m]
BED_PRESSURE = 1000.0 * 9.81 * THICKNESS  # p_b [Pa]
COEFFICIENT = 1e-3  # c_v [m2 s-1]; figures 7 to 9
EROSION_RATE = 0.01  # e_R [m s-1]; figure 6

TIMES = (0.01, 0.05, 0.1, 0.5, 1.0, 5.0)
"""Of figures 7 to 9, over the consolidation time [-]."""

PECLET = {"Fig. 7": 10.0, "Fig. 8": 0.01, "Fig. 9": 1.0}
REGIME = {"Fig. 7": "mostly advection", "Fig. 8": "mostly diffusion", "Fig. 9": "both"}

FRONT_TIMES = (0.25, 1.0, 3.0)
"""Of the profiles of figure 6 (A), over the erosion time [-]."""

FRONT_PATH = np.array([0.25, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0])
"""Of the fronts of figure 6 (B), over the erosion time [-]; those of the profiles are among them."""

MEASURES = {
    "Fig. 6 (A)": "p/p_b, mean over the height: a front cannot be sharper than levels are",
    "Fig. 6 (B)": "depth of the front (p = p_b/2) over h",
    "Fig. 7": "p/p_b at a level, Pe = 10",
    "Fig. 8": "p/p_b at a level, Pe = 0.01",
    "Fig. 9": "p/p_b at a level, Pe = 1",
}


def main(output=None, levels=11):
    """Solve the four column tests, print how far they are from closed forms, and draw them.

    Parameters
    ----------
    output : path, optional
        File for the figure; without it none is drawn.
    levels : int
        Number of levels of the columns.

    Returns
    -------
    dict
        For each panel, the largest difference over all its times and levels, see `MEASURES` [-].
    """
    if output is not None:
        check_writable(output)
    advection = solve_advection(levels)
    profiles = {name: solve_profiles(number, levels) for name, number in PECLET.items()}
    differences = {"Fig. 6 (A)": smearing(advection), "Fig. 6 (B)": front_error(advection)}
    for name, column in profiles.items():
        exact = [growing_column(column.level, t, PECLET[name]) for t in TIMES]
        differences[name] = float(abs(pressure(column) - exact).max())
    console = Console(width=120)
    print_table(console, differences, levels)
    if output is not None:
        save_figure(draw(advection, profiles, levels), output)
        console.print(f"Wrote {output}", highlight=False, soft_wrap=True)
    return differences


# ---- solving ----


def solve_advection(levels):
    """Return the column of figure 6, which does not consolidate."""
    return solve_column(
        thickness=THICKNESS, entrainment_rate=EROSION_RATE, coefficient_of_consolidation=0.0,
        basal_pressure=BED_PRESSURE, times=FRONT_PATH * THICKNESS / EROSION_RATE, levels=levels,
    )  # fmt: skip


def solve_profiles(number, levels):
    """Return the column of figures 7 to 9 with this Péclet number."""
    return solve_column(
        thickness=THICKNESS, entrainment_rate=number * COEFFICIENT / THICKNESS,
        coefficient_of_consolidation=COEFFICIENT, basal_pressure=BED_PRESSURE,
        times=np.array(TIMES) * THICKNESS**2 / COEFFICIENT, levels=levels,
    )  # fmt: skip


def pressure(column):
    """Return p/p_b over time and level."""
    return column.excess_pore_pressure.values[:, 0] / BED_PRESSURE


# ---- comparing ----


def height_where(profile, level, value):
    """Return the height over thickness where a profile that falls upwards has this value."""
    return float(np.interp(value, profile[::-1], level[::-1]))


def smearing(column):
    """Return the mean over the height of what the pressure differs from a step, at the worst time."""
    fine = (np.arange(10_000) + 0.5) / 10_000
    steps = fine < front(FRONT_PATH)[:, None]
    return max(
        float(abs(np.interp(fine, column.level, profile) - step).mean())
        for profile, step in zip(pressure(column), steps, strict=True)
    )


def front_error(column):
    """Return how far the front is from where it should be, over the thickness, at the worst time."""
    found = [height_where(profile, column.level.values, 0.5) for profile in pressure(column)]
    return float(abs(found - front(FRONT_PATH)).max())


# ---- showing ----


def print_table(console, differences, levels):
    """Print the largest difference of each panel."""
    table = Table(title=f"Largest difference from the closed form, {levels} levels", title_justify="left")
    table.add_column("Pastor et al. (2022)", no_wrap=True)
    table.add_column("difference", justify="right")
    table.add_column("of")
    for name, value in differences.items():
        table.add_row(name, f"{value:.1e}", MEASURES[name])
    console.print(table, highlight=False, markup=False)


def draw(advection, profiles, levels):
    """Return the figure: figure 6 in two parts, then figures 7 to 9."""
    figure = Figure(figsize=(11.0, 9.6), layout="constrained")
    grid = figure.add_gridspec(2, 2)
    parts = grid[0, 0].subgridspec(2, 1, hspace=0.05)
    upper = figure.add_subplot(parts[0])
    lower = figure.add_subplot(parts[1], sharex=upper)
    draw_fronts(upper, advection)
    draw_characteristics(lower, advection)
    cells = dict(zip(profiles, (grid[0, 1], grid[1, 0], grid[1, 1]), strict=True))
    for name, column in profiles.items():
        axes = figure.add_subplot(cells[name])
        draw_profiles(axes, column, PECLET[name])
        grown = float(column.thickness[-1, 0]) / THICKNESS
        axes.set_title(
            f"{name}: Pe = {PECLET[name]:g}, {REGIME[name]}; $h$ grows to {grown:.3g} $h_0$", fontsize="medium"
        )
        if name == "Fig. 8":
            words = "$t/T_c$ = 0.5, 1 and 5 are all\nclose to $p/p_b = 1 - x/h$"
            axes.text(0.97, 0.9, words, ha="right", va="top")
    add_legend(figure, levels)
    figure.suptitle("Excess pore pressure in a column that erodes: Pastor et al. (2022), figures 6 to 9")
    return figure


MARKERS = "os^Dv*"


COLOURS = colormaps["plasma"](np.linspace(0.0, 0.82, len(TIMES)))
FRONT_COLOURS = "tab:blue", "tab:green", "tab:brown"  # other times, other colours


def marked(colour, marker):
    """Return the style of numbers: hollow markers, so that lines show through."""
    return {"ls": "", "marker": marker, "ms": 6, "mfc": "none", "mec": colour, "clip_on": False, "zorder": 3}


def draw_fronts(axes, column):
    """Figure 6 (A): pressure over depth, a front that travels away from the base."""
    depth = 1.0 - column.level.values
    for time, colour, marker in zip(FRONT_TIMES, FRONT_COLOURS, MARKERS, strict=False):
        y = 1.0 - front(time)
        axes.plot([0.0, y, y, 1.0], [0.0, 0.0, 1.0, 1.0], color=colour)
        axes.plot(depth, pressure(column)[time == FRONT_PATH][0], **marked(colour, marker))
        axes.text(y + 0.01, 0.22, f"$t/T_e$ = {time:g}", color=colour)
    axes.text(0.02, 0.85, "(A)")
    axes.set(ylabel="pressure $p/p_b$ [-]", xlim=(0.0, 1.0), ylim=(-0.06, 1.06))
    axes.tick_params(labelbottom=False)
    axes.set_title("Fig. 6: Pe = ∞, advection alone; (A) front, (B) characteristics", fontsize="medium")


def draw_characteristics(axes, column):
    """Figure 6 (B): the ways of grains through depth and time."""
    times = np.linspace(0.0, 4.0, 200)
    for start in np.arange(0.1, 0.95, 0.1):
        axes.plot(start / (1.0 + times), times, color="0.75", lw=0.8)
    for entered in np.arange(0.5, 4.0, 0.5):
        later = times[times >= entered]
        axes.plot((1.0 + entered) / (1.0 + later), later, color="0.75", lw=0.8)
    axes.plot(1.0 - front(times), times, color="k")
    level = column.level.values
    for time, profile in zip(FRONT_PATH, pressure(column), strict=True):
        colour = dict(zip(FRONT_TIMES, FRONT_COLOURS, strict=True)).get(time, "0.45")
        ends = [1.0 - height_where(profile, level, value) for value in (0.1, 0.9)]
        axes.plot(ends, [time, time], color=colour, lw=1.2)
        axes.plot(1.0 - height_where(profile, level, 0.5), time, **marked(colour, "o"))
    box = {"boxstyle": "square,pad=0.2", "fc": "w", "ec": "none"}
    axes.text(0.02, 3.5, "(B)", bbox=box)
    axes.text(0.03, 0.35, "old soil, $p = 0$", bbox=box)
    axes.text(0.97, 2.55, "new soil, $p = p_b$", ha="right", bbox=box)
    axes.text(0.97, 3.4, "bars: $0.1 < p/p_b < 0.9$", ha="right", bbox=box)
    axes.set(xlabel="depth below the surface $y/h$ [-]", ylabel="time $t/T_e$ [-]", ylim=(0.0, 4.2))


def draw_profiles(axes, column, number):
    """Figures 7 to 9: pressure over height, with the base on the left."""
    xi = np.linspace(0.0, 1.0, 1001)
    for k, (time, colour) in enumerate(zip(TIMES, COLOURS, strict=True)):
        axes.plot(xi, growing_column(xi, time, number), color=colour)
        axes.plot(column.level, pressure(column)[k], **marked(colour, MARKERS[k]))
    axes.set(
        xlabel="height above the base $x/h$ [-]", ylabel="pressure $p/p_b$ [-]", xlim=(0.0, 1.0), ylim=(-0.03, 1.03)
    )


def add_legend(figure, levels):
    """Put one legend below all panels, where it hides nothing; its times are those of figures 7 to 9."""
    handles = [
        Line2D([], [], color="0.3", label="closed form"),
        Line2D([], [], label=f"solve_column,\n{levels} levels", **marked("0.3", "o")),
    ]
    for time, colour, marker in zip(TIMES, COLOURS, MARKERS, strict=True):
        handles.append(Line2D([], [], color=colour, marker=marker, mfc="none", label=f"$t/T_c$ = {time:g}"))
    figure.legend(
        handles=handles, loc="outside lower center", ncols=len(handles), fontsize="small", frameon=False,
        title="$T_c = h_0^2/c_v$,  $T_e = h_0/e_R$,  Pe $= T_c/T_e$;  $h = h_0 + e_R t$ is the present thickness, "
        "$p_b$ the excess pore pressure of the bed", title_fontsize="small",
    )  # fmt: skip


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--output", default="paper_columns.png", help="file for the figure")
    parser.add_argument("--levels", type=int, default=11)
    words = parser.parse_args()
    try:
        main(words.output, words.levels)
    except (InputError, ParameterError) as error:
        sys.exit(f"paper_columns: {error}")
