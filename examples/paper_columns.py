"""The column tests of Pastor et al. (2022), figures 6 to 9, by `solve_column` and by exact solutions.

    python examples/paper_columns.py --output paper_columns.png

A column without pressure, h0 thick, erodes at a constant rate e_R ground whose pressure is p_b. Lines are exact
solutions; markers are solutions by the scheme of the paper (`lax_wendroff`, with the steps of eq. 50) and by the
default scheme. All columns are ALE columns: captions and text of the paper mention no classical model for these
figures.

Eq. 48 can be read in two ways, for eq. 49 puts the top at x = h0 and eq. 48 at x = h = h0 + e_R t:

- growing: the column grows and its top is at x = h; x is shown over the present h;
- fixed: h stays h0, as in a column that spreads as fast as it erodes.

The text of the paper fits the growing column only. It says that in figure 7 the profile steepens on, towards p_b
everywhere except at the surface. The growing column does; the fixed column stops at erf(a (1 - x/h)) / erf(a), a^2 =
Pe/2, and its profiles of the last three times are the same. Figure 8 cannot decide: at t/T_c = 0.5 both are within 0.5
% of the line 1 - x/h. The growing h in eq. 48 together with the top at h0 is no third reading: grains would leave
through the surface, where the speed, and so the Péclet number, is 0 by eq. 51.

Readings of the paper where it leaves further choices:

- Depth: eqs. 56 to 58 hold for y/h in [0, 1]; the front is at the depth y/h = 1/(1 + t/T_e), not y/h0.
- Time: over T_c = h0^2/c_v in figures 7 to 9; over T_e = h0/e_R in figure 6, t e_R/h0 (eq. 53 has it inverted).
- Pressure: over p_b, which is 1 in the paper's unit rho_w g h0.
- Péclet number: e_R h0/c_v, with the initial thickness; that of figure 8 is 0.01, which is printed as 001.
- Times: those of figure 7 are used in figures 8 and 9 too, for which the text names none but 0.5.
- Figure 6 is a sketch with one time, as far as its caption tells; the times here are chosen for this example.
"""

import argparse
import sys

import numpy as np
from numpy.polynomial import legendre
from paper_columns_figure import draw
from rich.console import Console
from rich.table import Table
from scipy.linalg import eigh

from landlab_debrisflow import InputError, ParameterError, solve_column
from landlab_debrisflow.exact import columns
from landlab_debrisflow.plots import save_figure
from landlab_debrisflow.record import check_writable

THICKNESS = 1.0  # h0 [m]
BED_PRESSURE = 1000.0 * 9.81 * THICKNESS  # p_b [Pa]
COEFFICIENT = 1e-3  # c_v [m2 s-1]; figures 7 to 9
EROSION_RATE = 0.01  # e_R [m s-1]; figure 6

TIMES = (0.01, 0.05, 0.1, 0.5, 1.0, 5.0)
"""Times of figures 7 to 9, over the consolidation time [-]."""

PECLET = {"Fig. 7": 10.0, "Fig. 8": 0.01, "Fig. 9": 1.0}

SCHEMES = ("default", "lax_wendroff")

FRONT_TIMES = (0.25, 1.0, 3.0)
"""Times of the profiles of figure 6 (A), over the erosion time [-]."""

FRONT_PATH = np.array([0.25, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0])
"""Times of the fronts of figure 6 (B), over the erosion time [-]; they include the times of the profiles."""

TELLING = 0.8
"""Height over thickness at which the two readings are compared [-]."""


def main(output=None, levels=11):
    """Solve the column tests, print how far they are from exact solutions, and draw them.

    Parameters
    ----------
    output : path, optional
        File for the figure; without it none is drawn.
    levels : int
        Number of levels of the columns.

    Returns
    -------
    dict
        For each scheme and each row of the table, its largest error over all times [-].
    """
    if output is not None:
        check_writable(output)
    fronts = {scheme: pressure(solve_front(scheme, levels)) for scheme in SCHEMES}
    profiles = {
        (scheme, reading, name): pressure(solve_profiles(scheme, reading, number, levels))
        for scheme in SCHEMES
        for reading in EXACT
        for name, number in PECLET.items()
    }
    level = np.linspace(0.0, 1.0, levels)
    errors = {scheme: compare(scheme, level, fronts, profiles) for scheme in SCHEMES}
    console = Console(width=120)
    console.print(error_table(errors, levels), highlight=False, markup=False)
    console.print(reading_table(), highlight=False, markup=False)
    if output is not None:
        save_figure(draw(sys.modules[__name__], level, fronts, profiles, errors), output, dpi=80)
        console.print(f"Wrote {output}", highlight=False, soft_wrap=True)
    return errors


# ---- solving ----


def solve_front(scheme, levels):
    """Return the column of figure 6, which does not consolidate."""
    return solve_column(
        thickness=THICKNESS, entrainment_rate=EROSION_RATE, coefficient_of_consolidation=0.0,
        basal_pressure=BED_PRESSURE, times=FRONT_PATH * THICKNESS / EROSION_RATE, levels=levels, scheme=scheme,
        step=longest_step(EROSION_RATE, 0.0, levels) if scheme == "lax_wendroff" else None,
    )  # fmt: skip


def solve_profiles(scheme, reading, number, levels):
    """Return the column of figures 7 to 9 with this Péclet number; a fixed one spreads as fast as it erodes."""
    rate = number * COEFFICIENT / THICKNESS
    return solve_column(
        thickness=THICKNESS, entrainment_rate=rate, divergence_rate=rate / THICKNESS if reading == "fixed" else 0.0,
        coefficient_of_consolidation=COEFFICIENT, basal_pressure=BED_PRESSURE,
        times=np.array(TIMES) * THICKNESS**2 / COEFFICIENT, levels=levels, scheme=scheme,
        step=longest_step(rate, COEFFICIENT, levels) if scheme == "lax_wendroff" else None,
    )  # fmt: skip


def longest_step(rate, coefficient, levels):
    """Return the step that the paper's scheme allows at the start (eq. 50) [s]."""
    spacing = THICKNESS / (levels - 1)
    return min(spacing / rate, spacing**2 / (2.0 * coefficient) if coefficient else np.inf)


def pressure(column):
    """Return p/p_b over time and level."""
    return column.excess_pore_pressure.values[:, 0] / BED_PRESSURE


# ---- exact solutions ----


def fixed_column(xi, time, peclet):
    """Return the exact profile of a column of fixed thickness, to 1e-10 for Péclet numbers up to 20.

    With eta = 1 - xi, eq. 48 reads ``w p_t = (w p_eta)_eta``, w = exp(Pe eta^2/2): its waves are orthogonal under w.
    They are found by the method of Galerkin in 48 Legendre polynomials, and what the start lacks of the limit decays
    in them.
    """
    terms = 48
    nodes, weights = legendre.leggauss(2 * terms)
    eta = 0.5 * (1.0 + nodes)
    weights = weights * np.exp(0.5 * peclet * (eta**2 - 1.0))

    def shapes(at, order=0):
        """Return polynomials that vanish at base and surface, or their slopes."""
        every = legendre.legder(np.eye(terms + 2), order)
        values = legendre.legval(2.0 * at - 1.0, every).T * 2.0**order
        return values[..., :-2] - values[..., 2:]

    shape, slope = shapes(eta), shapes(eta, 1)
    rates, waves = eigh((slope.T * weights) @ slope, (shape.T * weights) @ shape)
    share = waves.T @ (shape.T @ (weights * columns.constant_local_peclet(1.0 - eta, peclet)))
    decaying = shapes(1.0 - np.asarray(xi, float)) @ (waves @ (share * np.exp(-rates * time)))
    return columns.constant_local_peclet(xi, peclet) - decaying


EXACT = {"growing": columns.growing_column, "fixed": fixed_column}
"""Exact profile of each reading of eq. 48, from x/h, t/T_c and the Péclet number."""


# ---- comparing ----

MEASURES = {
    "Fig. 6 (A)": "p/p_b, mean over the height (levels cannot be sharper)",
    "Fig. 6 (A), overshoot": "p/p_b above 1 or below 0",
    "Fig. 6 (B)": "depth of the front (p = p_b/2) over h",
    "Fig. 7, growing": "p/p_b at a level, Pe = 10",
    "Fig. 8, growing": "p/p_b at a level, Pe = 0.01",
    "Fig. 9, growing": "p/p_b at a level, Pe = 1",
    "Fig. 7, fixed": "p/p_b at a level, Pe = 10",
    "Fig. 8, fixed": "p/p_b at a level, Pe = 0.01",
    "Fig. 9, fixed": "p/p_b at a level, Pe = 1",
}


def compare(scheme, level, fronts, profiles):
    """Return the largest error of each row of the table."""
    found = fronts[scheme]
    values = [smearing(level, found), overshoot(found), front_error(level, found)]
    for reading, exact in EXACT.items():
        for name, number in PECLET.items():
            true = [exact(level, time, number) for time in TIMES]
            values.append(float(abs(profiles[scheme, reading, name] - true).max()))
    return dict(zip(MEASURES, values, strict=True))


def height_where(profile, level, value):
    """Return the greatest height over thickness where the pressure, linear between levels, has this value."""
    k = np.flatnonzero(profile >= value)[-1]
    return float(level[k] + (profile[k] - value) / (profile[k] - profile[k + 1]) * (level[k + 1] - level[k]))


def smearing(level, profiles):
    """Return the largest error of the pressure over all times: its mean difference over the height to a step."""
    fine = (np.arange(10_000) + 0.5) / 10_000
    steps = fine < columns.front(FRONT_PATH)[:, None]
    pairs = zip(profiles, steps, strict=True)
    return max(float(abs(np.interp(fine, level, profile) - step).mean()) for profile, step in pairs)


def overshoot(profiles):
    """Return the largest excess of pressures over the range between 0 and that of the bed."""
    return float(max(profiles.max() - 1.0, -profiles.min()))


def front_error(level, profiles):
    """Return the largest error of the position of the front over all times, over the thickness."""
    found = [height_where(profile, level, 0.5) for profile in profiles]
    return float(abs(found - columns.front(FRONT_PATH)).max())


# ---- showing ----


def error_table(errors, levels):
    """Return the largest error of each row and scheme."""
    table = Table(title=f"Largest error against exact solutions, {levels} levels", title_justify="left")
    table.add_column("Pastor et al. (2022)", no_wrap=True)
    for scheme in SCHEMES:
        table.add_column(scheme, justify="right")
    table.add_column("of")
    for name, measure in MEASURES.items():
        table.add_row(name, *(f"{errors[scheme][name]:.1e}" for scheme in SCHEMES), measure)
    return table


def reading_table():
    """Return the difference of the two readings of eq. 48, from exact solutions."""
    table = Table(title="Readings of eq. 48, exact", title_justify="left")
    table.add_column("")
    for reading in EXACT:
        table.add_column(reading, justify="right")
    for time in TIMES[3:]:
        values = (float(exact(TELLING, time, PECLET["Fig. 7"])) for exact in EXACT.values())
        table.add_row(f"Fig. 7: p/p_b at x/h = {TELLING:g}, t/T_c = {time:g}", *(f"{v:.3f}" for v in values))
    xi = np.linspace(0.0, 1.0, 201)
    apart = (abs(exact(xi, 0.5, PECLET["Fig. 8"]) - (1.0 - xi)).max() for exact in EXACT.values())
    table.add_row("Fig. 8: largest |p/p_b - (1 - x/h)|, t/T_c = 0.5", *(f"{v:.3f}" for v in apart))
    table.add_row("the text: Fig. 7 goes on steepening towards 1; Fig. 8 is 1 - x", "agrees", "Fig. 7 does not")
    return table


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--output", default="paper_columns.png", help="file for the figure")
    parser.add_argument("--levels", type=int, default=11)
    words = parser.parse_args()
    try:
        main(words.output, words.levels)
    except (InputError, ParameterError) as error:
        sys.exit(f"paper_columns: {error}")
