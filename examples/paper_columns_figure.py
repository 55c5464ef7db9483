"""The figure of `paper_columns`."""

import numpy as np
from matplotlib import colormaps
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from landlab_debrisflow.exact import columns

TITLES = {
    ("growing", "Fig. 7"): "Fig. 7: Pe = 10, mostly advection",
    ("growing", "Fig. 8"): "Fig. 8: Pe = 0.01, mostly diffusion",
    ("growing", "Fig. 9"): "Fig. 9: Pe = 1, both",
    ("fixed", "Fig. 7"): "Pe = 10, fixed: stops steepening",
    ("fixed", "Fig. 8"): "Pe = 0.01, fixed: nearly the same",
    ("fixed", "Fig. 9"): "Pe = 1, fixed",
}
SIDE = {
    "growing": "Top at $x = h = h_0 + e_R t$:\nas the text describes",
    "fixed": "Top at $x = h = h_0$:\nthe other reading",
}
MARKERS = "os^Dv*"
COLOURS = colormaps["plasma"](np.linspace(0.0, 0.82, len(MARKERS)))
FRONT_COLOURS = "tab:blue", "tab:green", "tab:brown"  # other times, other colours
SCHEME_WORDS = {"default": "default scheme", "lax_wendroff": "paper's scheme (lax_wendroff)"}


def marked(scheme, colour, marker="o"):
    """Return the style of numbers: hollow markers for the default scheme, so that lines show through, else crosses."""
    style = {"ls": "", "mec": colour, "clip_on": False, "zorder": 3}
    if scheme == "default":
        return style | {"marker": marker, "ms": 6, "mfc": "none"}
    return style | {"marker": "x", "ms": 4.5, "mew": 1.0}


def draw(tests, level, fronts, profiles, errors):
    """Return the figure: figure 6 and all errors on top, then figures 7 to 9 in either reading of eq. 48.

    Parameters
    ----------
    tests : module
        `paper_columns`.
    level : ndarray, shape (levels,)
        Height of the levels over the thickness [-].
    fronts, profiles : dict
        Pressures over that of the bed, by scheme, and by scheme, reading and name of the figure [-].
    errors : dict
        By scheme and row of the table [-].
    """
    figure = Figure(figsize=(14.0, 13.0), layout="constrained")
    grid = figure.subplots(3, 3)
    draw_fronts(grid[0, 0], tests, level, fronts)
    draw_characteristics(grid[0, 1], tests, level, fronts)
    draw_errors(grid[0, 2], errors)
    for row, (reading, exact) in zip(grid[1:], tests.EXACT.items(), strict=True):
        for axes, (name, number) in zip(row, tests.PECLET.items(), strict=True):
            draw_profiles(axes, tests, level, profiles, exact, reading, name, number)
        row[0].set_ylabel(f"{SIDE[reading]}\n\npressure $p/p_b$ [-]")
    add_legend(figure, tests, len(level))
    figure.suptitle("Excess pore pressure in a column that erodes: Pastor et al. (2022), figures 6 to 9")
    return figure


def draw_fronts(axes, tests, level, fronts):
    """Figure 6 (A): pressure over depth, a front that travels away from the base."""
    depth = 1.0 - level
    for time, colour, marker in zip(tests.FRONT_TIMES, FRONT_COLOURS, MARKERS, strict=False):
        y = 1.0 - columns.front(time)
        axes.plot([0.0, y, y, 1.0], [0.0, 0.0, 1.0, 1.0], color=colour)
        for scheme, profile in fronts.items():
            axes.plot(depth, profile[time == tests.FRONT_PATH][0], **marked(scheme, colour, marker))
        axes.text(y + 0.005, 0.28, f"$t/T_e$ = {time:g}", color=colour, fontsize="small")
    axes.set(ylabel="pressure $p/p_b$ [-]", xlabel="depth below the surface $y/h$ [-]", xlim=(0.0, 1.0))
    axes.set_title("Fig. 6 (A): advection alone, the front", fontsize="medium")


def draw_characteristics(axes, tests, level, fronts):
    """Figure 6 (B): the ways of grains through depth and time, and where p = p_b/2 of both schemes."""
    times = np.linspace(0.0, 4.0, 200)
    for start in np.arange(0.1, 0.95, 0.1):
        axes.plot(start / (1.0 + times), times, color="0.75", lw=0.8)
    for entered in np.arange(0.5, 4.0, 0.5):
        later = times[times >= entered]
        axes.plot((1.0 + entered) / (1.0 + later), later, color="0.75", lw=0.8)
    axes.plot(1.0 - columns.front(times), times, color="k")
    for scheme, profiles in fronts.items():
        depths = [1.0 - tests.height_where(profile, level, 0.5) for profile in profiles]
        axes.plot(depths, tests.FRONT_PATH, **marked(scheme, "k"))
    box = {"boxstyle": "square,pad=0.2", "fc": "w", "ec": "none"}
    axes.text(0.03, 0.35, "old soil, $p = 0$", bbox=box)
    axes.text(0.97, 2.55, "new soil, $p = p_b$", ha="right", bbox=box)
    axes.set(xlabel="depth below the surface $y/h$ [-]", ylabel="time $t/T_e$ [-]", xlim=(0.0, 1.0), ylim=(0.0, 4.2))
    axes.set_title("Fig. 6 (B): the same, characteristics", fontsize="medium")


def draw_errors(axes, errors):
    """Draw all errors of both schemes."""
    for scheme, found in errors.items():
        drawn = {name: value for name, value in found.items() if value > 0.0}
        axes.plot(drawn.values(), [list(found).index(name) for name in drawn], **marked(scheme, "k"))
    rows = list(next(iter(errors.values())))
    axes.set_yticks(range(len(rows)), rows)
    axes.set_xscale("log")
    axes.invert_yaxis()
    axes.grid(color="0.9")
    axes.set_xlabel("largest error [-] (0 is not shown)")
    axes.set_title("Errors against the exact solutions", fontsize="medium")


def draw_profiles(axes, tests, level, profiles, exact, reading, name, number):
    """Figures 7 to 9: pressure over height, with the base on the left."""
    xi = np.linspace(0.0, 1.0, 501)
    for k, (time, colour) in enumerate(zip(tests.TIMES, COLOURS, strict=True)):
        axes.plot(xi, exact(xi, time, number), color=colour)
        for scheme in tests.SCHEMES:
            axes.plot(level, profiles[scheme, reading, name][k], **marked(scheme, colour, MARKERS[k]))
    title = TITLES[reading, name]
    if reading == "growing":
        title += f"; $h$ grows to {1.0 + number * tests.TIMES[-1]:.3g} $h_0$"
    axes.set_title(title, fontsize="medium")
    axes.set(xlabel="height above the base $x/h$ [-]", xlim=(0.0, 1.0), ylim=(-0.03, 1.12))


def add_legend(figure, tests, levels):
    """Put one legend below all panels, where it hides nothing; its times are those of figures 7 to 9."""
    handles = [Line2D([], [], color="0.3", label="exact")]
    for scheme, words in SCHEME_WORDS.items():
        handles.append(Line2D([], [], label=f"{words}, {levels} levels", **marked(scheme, "0.3")))
    for time, colour, marker in zip(tests.TIMES, COLOURS, MARKERS, strict=True):
        handles.append(Line2D([], [], color=colour, marker=marker, mfc="none", label=f"$t/T_c$ = {time:g}"))
    figure.legend(
        handles=handles, loc="outside lower center", ncols=len(handles), fontsize="small", frameon=False,
        title="$T_c = h_0^2/c_v$,  $T_e = h_0/e_R$,  Pe $= T_c/T_e$;  $h$ is the present thickness, "
        "$p_b$ the excess pore pressure of the bed", title_fontsize="small",
    )  # fmt: skip
