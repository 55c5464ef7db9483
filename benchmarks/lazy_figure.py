"""One column of the default scheme through erosion, rest and erosion again: python -m benchmarks.lazy_figure

Draws the basal pressure, the profiles, and the account that says when an update of the column is due, and writes
docs/lazy_scheme.png for the page beside the scheme.
"""

from pathlib import Path

import matplotlib

matplotlib.use("Agg")  # draws to a file only

import matplotlib.pyplot as plt
import numpy as np

from landlab_debrisflow.physics.column import ALE
from landlab_debrisflow.physics.column.driver import Columns
from landlab_debrisflow.physics.column.schemes.lazy.bookkeeping import GRADING, LOSS, MODES_FRACTION, STRIDE
from landlab_debrisflow.physics.column.schemes.lazy.state import records
from landlab_debrisflow.physics.contracts import BaseContact

FILE = Path(__file__).parents[1] / "docs" / "lazy_scheme.png"
DT, STEPS, LOAD, RATIO = 0.1, 900, 9712.0, 0.65  # [s], [-], [Pa m-1], of the bed [-]
EROSION = ((0.0, 30.0), (60.0, 75.0))  # [s]
RATE, COEFFICIENT = 0.02, 4e-3  # [m s-1], [m2 s-1]
MODES, LEVELS = "tab:orange", "tab:blue"


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


def main() -> None:
    time, base, owed, contact, profiles = history(ALE())
    _, exact, *_, fine = history(ALE(levels=161, tolerance=0.0))
    figure, axes = plt.subplots(1, 3, figsize=(14.0, 4.4), layout="constrained", width_ratios=(1.2, 1.2, 0.8))
    in_modes = contact == BaseContact.IMPERMEABLE
    for axis in axes[:2]:
        for mask, colour in ((in_modes, MODES), (~in_modes, LEVELS)):
            axis.fill_between(time, 0.0, 1.0, where=mask, step="pre", color=colour, alpha=0.15, linewidth=0.0,
                              transform=axis.get_xaxis_transform())  # fmt: skip
        axis.set(xlabel="time [s]", xlim=(0.0, time[-1]))
    axes[0].plot(time, exact, color="0.6", linewidth=3.0, label="161 levels, updated at every step")
    axes[0].plot(time, base, "k", linewidth=1.0, label="11 levels, default")
    axes[0].set(ylabel="basal pressure over load [-]", title="Friction reads the base at every step ...")
    axes[0].legend(loc="lower left")
    axes[0].set_ylim(bottom=0.40)  # below the curve: room for the legend
    updates = np.append(False, np.diff(owed) < 0.0)
    axes[1].plot(time, owed, "k", linewidth=0.9)
    axes[1].plot(time[updates], np.full(updates.sum(), -0.06), "k|", markersize=7.0)
    axes[1].axhline(1.0, color="tab:red", linestyle="--", linewidth=1.0)
    axes[1].text(0.5 * time[-1], 1.03, "due", color="tab:red", ha="center")
    axes[1].text(0.18 * time[-1], 1.13, "at levels", color=LEVELS, ha="center")
    axes[1].text(0.5 * time[-1], 1.13, "in modes", color=MODES, ha="center")
    axes[1].set(ylabel="account over what is allowed [-]", ylim=(-0.12, 1.22),
                title=f"... the column is updated in {updates.sum()} of {STEPS} steps")  # fmt: skip
    for when, colour in ((29.9, LEVELS), (59.9, MODES)):
        k = int(np.argmin(abs(time - when)))
        axes[2].plot(fine[k], np.linspace(0.0, 1.0, fine.shape[1]), color="0.6", linewidth=3.0)
        axes[2].plot(profiles[k], np.linspace(0.0, 1.0, profiles.shape[1]), "o-", color=colour, label=f"{when:g} s")
    axes[2].set(xlabel="pressure over load [-]", ylabel="height over thickness [-]", title="Profiles, when asked for")
    axes[2].legend()
    figure.savefig(FILE, dpi=110)
    error = abs(base - exact).max()
    print(f"{updates.sum()} updates in {STEPS} steps; base within {error:.1e} of the load of 161 levels")


if __name__ == "__main__":
    main()
