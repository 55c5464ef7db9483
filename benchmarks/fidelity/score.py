"""Score plans on scenes: frequency of errors within the tolerance, cost, and frequency of stated errors that cover true
ones."""

import math
from collections.abc import Callable

import numpy as np
from rich.console import Console
from rich.table import Table
from scipy.stats import binomtest

from .campaign import FULL, TRUTH
from .replay import QUANTITIES, Choice, complete, replay, true_errors

HELD = ("run_out", "speed")
ALSO = (*HELD, "depth", "area")
PROMISED = (*HELD, "eroded")
LEAST = 0.005
"""True errors below this count as this: what is below is not known [-]."""

MOST_RATIO = {"run_out": 2.5, "speed": 2.5, "area": 4.0}
GOAL_RATIO = {"run_out": 2.0, "speed": 2.0, "area": 3.0}
CLASSES = {1000: "<= 1000", 2000: "2000", 4000: "4000", 8000: ">= 8000"}
RESAMPLES = 2000


def proportion(good) -> tuple[float, float, float]:
    """Return the part that is true, and the exact binomial interval of 95 % (Clopper & Pearson, 1934)."""
    good = np.asarray(good, bool)
    if not good.size:
        return math.nan, math.nan, math.nan
    interval = binomtest(int(good.sum()), good.size).proportion_ci()
    return float(good.mean()), float(interval.low), float(interval.high)


def resampled(values, statistic: Callable) -> tuple[float, float, float]:
    """Return a statistic, and the bounds of 95 % of those of resampled scenes (Efron, 1979)."""
    values = np.asarray(values, float)
    if not values.size:
        return math.nan, math.nan, math.nan
    rng = np.random.default_rng(0)
    found = [statistic(rng.choice(values, values.size)) for _ in range(RESAMPLES)]
    return float(statistic(values)), *(float(bound) for bound in np.quantile(found, (0.025, 0.975)))


def geometric_mean(values) -> float:
    return float(np.exp(np.mean(np.log(values))))


def within(choice: Choice, names, tolerance: float) -> bool:
    """Return whether all errors of a choice that are known are within a tolerance."""
    return all(not choice.true[name] > tolerance for name in names)


def pairs(choices, name: str) -> np.ndarray:
    """Return stated and true errors of a quantity, (scenes, 2), where both are known."""
    found = np.array([(choice.stated[name], choice.true[name]) for choice in choices]).reshape(-1, 2)
    return found[np.isfinite(found).all(axis=1) & (found.any(axis=1))]


def class_needed(runs, tolerance: float = 0.03, names=ALSO) -> int:
    """Return the least number of particles from which on all finer runs with default steps are within a tolerance."""
    needed = 2 * FULL
    for count in (8000, 4000, 2000, 1000):
        errors = true_errors(runs["", count], runs["", TRUTH])
        if any(errors[name] > tolerance for name in names):
            break
        needed = count
    return needed


def score_table(scenes, names, title: str) -> tuple[Table, bool]:
    """Return the table of some scenes beside what must be and what is the goal, and whether all that must be is."""
    names = complete(scenes, names)
    table = Table(title=f"{title}: {len(names)} scenes", title_justify="left")
    for head in ("", "found", "95 % interval", "must", "goal"):
        table.add_column(head, justify="left" if not head else "right")
    good = []

    def row(words, values, must, goal, form="{:.3f}", below=False):
        value, low, high = values
        met = math.isnan(value) or (value <= must if below else value >= must)
        good.append(met)
        interval = "-" if math.isnan(low) else f"{form.format(low)} to {form.format(high)}"
        cells = form.format(value) + ("" if met else " !"), interval
        table.add_row(words, *cells, form.format(must), form.format(goal))

    holds = HELD, PROMISED, ALSO
    replayed = {(hold, t): [replay(scenes[n], t, hold) for n in names] for hold in holds for t in (0.05, 0.03)}
    for tolerance, must in ((0.05, 0.95), (0.03, 0.93)):
        words = f"run-out, speed, eroded volume within {100.0 * tolerance:g} % of truth"
        row(words, proportion([within(c, PROMISED, tolerance) for c in replayed[PROMISED, tolerance]]), must, 0.97)
        found = proportion([within(c, PROMISED, tolerance) for c in replayed[HELD, tolerance]])
        row("the same, but run-out and speed held only", found, must, 0.97)
    for hold, words, must, goal in (
        (HELD, "run-out and speed", 0.25, 0.15), (PROMISED, "and eroded volume", 0.25, 0.15),
        (ALSO, "run-out, speed, depth, area", 0.5, 0.33),
    ):  # fmt: skip
        choices = replayed[hold, 0.05]
        row(f"cost over full, 5 %: {words}", resampled([c.cost for c in choices], geometric_mean), must, goal,
            below=True)  # fmt: skip
        costs = [c.cost + c.raster_cost for c in choices]
        row("the same, every second node counted", resampled(costs, geometric_mean), must, goal, below=True)
        costs = [c.cost - c.again for c in choices]
        row("the first, were a last pilot taken over as the run", resampled(costs, geometric_mean), must, goal,
            below=True)  # fmt: skip
    dearest = max((c.cost + c.raster_cost for c in replayed[HELD, 0.05]), default=math.nan)
    row("dearest scene over full, 5 %", (dearest, math.nan, math.nan), 1.3, 1.0, below=True)
    choices = replayed[HELD, 0.05]
    for name in QUANTITIES:
        found = pairs(choices, name)
        must = 0.85 if name == "pressure" else 0.92
        row(f"coverage of the stated error, {name}", proportion(found[:, 1] <= found[:, 0]), must, 0.95)
    for name in QUANTITIES:
        stated, true = pairs(choices, name).T
        ratio = resampled(stated / np.maximum(true, LEAST), np.median)
        must, goal = MOST_RATIO.get(name, 6.0), GOAL_RATIO.get(name, 4.0)
        row(f"median stated over max(true, .5 %), {name}", ratio, must, goal, "{:.2f}", below=True)
    return table, all(good)


def more_tables(scenes, names) -> list[Table]:
    """Return tables of what a fixed number of particles reaches beside plans, and of scenes by particles needed."""
    names = complete(scenes, names)
    fixed = Table(title="within tolerance, and cost over full: plans beside fixed numbers", title_justify="left")
    for head in ("", "5 %: run-out, speed", "3 %", "5 %: and depth, area", "3 %"):
        fixed.add_column(head)
    cases = [(hold, tolerance) for hold in (HELD, ALSO) for tolerance in (0.05, 0.03)]
    cells = []
    for hold, tolerance in cases:
        choices = [replay(scenes[name], tolerance, hold) for name in names]
        good = np.mean([within(choice, hold, tolerance) for choice in choices])
        cells.append(f"{good:.3f} at {geometric_mean([choice.cost for choice in choices]):.2f}")
    fixed.add_row("plan", *cells)
    for count in (1000, 2000, 4000, 8000):
        errors = [true_errors(scenes[name]["fast", count], scenes[name]["", TRUTH]) for name in names]
        costs = [scenes[name]["fast", count]["seconds"] / scenes[name]["", FULL]["seconds"] for name in names]
        good = [np.mean([all(not e[q] > tolerance for q in hold) for e in errors]) for hold, tolerance in cases]
        fixed.add_row(f"{count}, fast", *(f"{one:.3f} at {geometric_mean(costs):.2f}" for one in good))
    chosen = Table(title="particles", title_justify="left")
    for head in ("", *CLASSES.values()):
        chosen.add_column(head)
    for hold, tolerance in cases:
        counts = [min(replay(scenes[name], tolerance, hold).particles, 8000) for name in names]
        words = f"chosen, {100.0 * tolerance:g} % of {', '.join(hold)}"
        chosen.add_row(words, *(f"{np.mean([one == count for one in counts]):.2f}" for count in CLASSES))
    known = [name for name in names if all(("", count) in scenes[name] for count in CLASSES)]
    needed = [min(class_needed(scenes[name]), 8000) for name in known]
    words = f"needed, default steps, 3 % of {', '.join(ALSO)} ({len(known)} scenes)"
    if known:
        chosen.add_row(words, *(f"{np.mean([one == count for one in needed]):.2f}" for count in CLASSES))
    return [fixed, chosen]


def print_scores(scenes, names, title: str, console: Console | None = None) -> bool:
    """Print all tables of some scenes, and return whether all that must be reached is."""
    console = console or Console(width=140)
    if not complete(scenes, names):
        console.print(f"{title}: of no scene are there all runs")
        return False
    table, good = score_table(scenes, names, title)
    console.print(table)
    for one in more_tables(scenes, names):
        console.print(one)
    return good
