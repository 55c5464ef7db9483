"""One column of the default scheme through erosion, rest and erosion again: python -m benchmarks.lazy_figure

Keeps the basal pressure, the profiles, and the account that says when an update of the column is due, in
benchmarks/results/lazy_scheme.nc, from which docs/figures/lazy_scheme.png is drawn for the page beside the scheme.
"""

import argparse

import numpy as np
import xarray as xr

from benchmarks import charts, result_files, style
from landlab_debrisflow.physics.column import ALE
from landlab_debrisflow.physics.column.driver import Columns
from landlab_debrisflow.physics.column.schemes.lazy.bookkeeping import GRADING, LOSS, MODES_FRACTION, STRIDE
from landlab_debrisflow.physics.column.schemes.lazy.state import records
from landlab_debrisflow.physics.column_contracts import BaseContact

DT, STEPS, LOAD, RATIO = 0.1, 900, 9712.0, 0.65  # [s], [-], [Pa m-1], of the bed [-]
EROSION = ((0.0, 30.0), (60.0, 75.0))  # [s]
RATE, COEFFICIENT = 0.02, 4e-3  # [m s-1], [m2 s-1]
SHOWN = (29.9, 59.9)
"""Times of the profiles [s]."""


def account(column, volume, load, tolerance) -> float:
    """Return the account of a column over what is allowed until the next update [-]; see `lazy.bookkeeping`."""
    if tolerance == 0.0:  # due at every step
        return np.inf
    if column["contact"] == BaseContact.IMPERMEABLE:
        error = column["remainder"] * column["diffusion"] ** 3
        error += LOSS * np.sqrt(column["diffusion"]) * column["load_variation"]
        return error / (MODES_FRACTION * tolerance * load)
    start = column["volume_at_update"]
    allowed = min(STRIDE * np.sqrt(tolerance) * start, GRADING * (start - column["volume_at_contact"]))
    return (volume - start) / allowed if allowed > 0.0 else np.nan


def history(law):
    """Return time [s], basal pressure over the load [-], account [-], contact and profiles over the load by step."""
    columns = Columns(law, 0.2 * LOAD * np.linspace(1.0, 0.0, law.levels)[None], [1.0], liquefaction_pressure=[LOAD],
                      coefficient_of_consolidation=COEFFICIENT)  # fmt: skip
    found = []
    for step in range(1, STEPS + 1):
        time = step * DT
        erodes = any(begin < time <= end for begin, end in EROSION)
        thickness = columns.forcing.thickness + RATE * DT * erodes
        load = LOAD * thickness
        base = columns.step(DT, RATE * DT * erodes, bed_pressure=RATIO * load)
        column = records(columns.state.memory)[0]
        owed = account(column, columns.forcing.volume[0], load[0], law.choices.tolerance)
        found.append((time, base[0] / load[0], owed, column["contact"].copy(), (columns.profile() / load)[0]))
    return tuple(np.array(values) for values in zip(*found, strict=True))


def measure() -> xr.Dataset:
    """Return the history of the column by the default scheme, and by 161 levels that are updated at every step."""
    time, base, owed, contact, profiles = history(ALE())
    _, exact, *_, fine = history(ALE(levels=161, tolerance=0.0))
    at = [int(np.argmin(abs(time - when))) for when in SHOWN]
    return xr.Dataset(
        {
            "base": ("time", base), "base_of_161_levels": ("time", exact), "account": ("time", owed),
            "in_modes": ("time", (contact == BaseContact.IMPERMEABLE).astype("i1")),
            "profile": (("shown", "level"), profiles[at]), "profile_of_161_levels": (("shown", "fine_level"), fine[at]),
        },
        {"time": time, "shown": list(SHOWN)},
    )  # fmt: skip


def chart():
    """Return the figure: basal pressure, account and profiles."""
    found = result_files.read_dataset("lazy_scheme")
    time, in_modes = found.time.values, found.in_modes.values > 0
    figure, axes = style.panels(1, 3, (14.0, 4.8), width_ratios=(1.2, 1.2, 0.8))
    left, middle, right = axes[0]
    for axis in (left, middle):
        words = ("in modes (base sealed)", style.ORANGE), ("at levels (base eroding)", style.BLUE)
        for (label, colour), mask in zip(words, (in_modes, ~in_modes), strict=True):
            axis.fill_between(time, 0.0, 1.0, where=mask, step="pre", color=colour, alpha=0.18, linewidth=0.0,
                              transform=axis.get_xaxis_transform(), label=label)  # fmt: skip
    left.plot(time, found.base_of_161_levels, color="0.6", linewidth=3.0, label="161 levels, updated at every step")
    left.plot(time, found.base, "k", linewidth=1.0, label="11 levels, default scheme")
    style.finish(left, xlabel="time [s]", xlim=(0.0, time[-1]), ylim=(0.40, None), title="Basal pressure",
                 ylabel="basal pressure over liquefaction pressure [-]")  # fmt: skip
    owed = found.account.values
    updates = np.append(False, np.diff(owed) < 0.0)
    middle.plot(time, owed, "k", linewidth=0.9)
    middle.plot(time[updates], np.full(updates.sum(), -0.06), "k|", markersize=7.0)
    middle.axhline(1.0, color=style.RED, linestyle="--", linewidth=1.0)
    middle.text(0.5 * time[-1], 1.03, "update due", color=style.RED, ha="center")
    style.finish(middle, xlabel="time [s]", xlim=(0.0, time[-1]), ylim=(-0.12, 1.22),
                 title=f"Error account; ticks: the {updates.sum()} updates in {time.size} steps",
                 ylabel="account over the error allowed [-]")  # fmt: skip
    for k, (when, colour) in enumerate(zip(found.shown.values, (style.BLUE, style.ORANGE), strict=True)):
        fine, coarse = found.profile_of_161_levels[k], found.profile[k]
        right.plot(fine, np.linspace(0.0, 1.0, fine.size), color="0.6", linewidth=3.0)
        right.plot(coarse, np.linspace(0.0, 1.0, coarse.size), "o-", color=colour, label=f"11 levels, {when:g} s")
    style.finish(right, xlabel="pressure over liquefaction pressure [-]", ylabel="height over thickness [-]",
                 title="Profiles; grey: 161 levels")  # fmt: skip
    right.legend(frameon=False)
    style.legend_below(figure, left, ncol=4)
    return figure


def main() -> None:
    argparse.ArgumentParser(description=__doc__.splitlines()[0]).parse_args()
    found = measure()
    result_files.keep_dataset("lazy_scheme", found.astype("f4"), "python -m benchmarks.lazy_figure")
    updates = int((found.account.diff("time") < 0.0).sum())
    error = float(abs(found.base - found.base_of_161_levels).max())
    print(f"{updates} updates in {STEPS} steps; base within {error:.1e} of the load of 161 levels")
    charts.make("lazy_scheme")


if __name__ == "__main__":
    main()
