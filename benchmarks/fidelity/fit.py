"""Fit the constants of stated errors to scenes: k, least, floor and order of each quantity.

E = k b + f, at least the floor: for every f and floor of a short list, k is the 95 % quantile over the scenes of what
covers the true error with 1000 particles. Taken is the triple whose median of stated over max(true, .5 %) is least
while 92 % are covered with 2000, 4000 and 8000, too, where E falls with the order p of the 90 % quantile of errors; if
no triple covers as many, the one that covers most.
"""

import itertools
import math
from typing import NamedTuple

import numpy as np

from landlab_debrisflow.fidelity.constants import ERROR_LAWS, FLOOR_COUNT, PILOTS
from landlab_debrisflow.fidelity.errors import error_base, errors_after

from .campaign import TRUTH
from .replay import QUANTITIES, complete, pilots_of, true_errors
from .score import LEAST

COVERED = 0.95
LEASTS = (0.001, 0.002, 0.003, 0.004, 0.005, 0.008, 0.01)
FLOORS = (0.0, 0.01, 0.015, 0.02, 0.03, 0.04, 0.06)
COUNTS = (1000, 2000, 4000, 8000)
ORDERS = np.arange(6, 25) / 20.0


class Fitted(NamedTuple):
    """Constants of a quantity.

    Attributes
    ----------
    factor, least, floor, order : float
        As of `constants.ErrorLaw`.
    coverage, ratio : float
        Of the scenes with 1000 particles: part covered, and median of stated over max(true, .5 %) [-].
    """

    factor: float
    least: float
    floor: float
    order: float
    coverage: float
    ratio: float


def bases_and_errors(scenes, names, name: str):
    """Return bases of pilots (scenes,) and true errors (counts, scenes) of a quantity, where all are known."""
    bases = np.array([error_base(pilots_of(scenes[one], "fast"), ERROR_LAWS[name].related) for one in names])
    errors = np.array([
        [true_errors(scenes[one]["fast", count], scenes[one]["", TRUTH])[name] for one in names] for count in COUNTS
    ])  # fmt: skip
    known = np.isfinite(bases) & np.isfinite(errors).all(axis=0) & ((bases > 0.0) | (errors > 0.0).any(axis=0))
    return bases[known], errors[:, known]


def fit_order(errors) -> float:
    """Return the order p by which the 90 % quantile of errors (counts, scenes) falls.

    The truth has an error of its own, so it falls as N^-p - T^-p, with T the particles of the truth.
    """
    high = np.log(np.maximum(np.quantile(errors, 0.9, axis=1), 1e-4))
    return float(min(ORDERS, key=lambda p: np.var(high - np.log(np.power(COUNTS, -p, dtype=float) - TRUTH**-p))))


def fit_quantity(bases, errors, least_coverage: float = COVERED) -> Fitted:
    """Return the constants of a quantity from `bases_and_errors`."""
    order, best = fit_order(errors), None
    for least, floor in itertools.product(LEASTS, FLOORS):
        at_pilots = floor * math.sqrt(FLOOR_COUNT / PILOTS[-1])
        asked = np.where(errors[0] <= at_pilots, 0.0, (errors[0] - least) / np.maximum(bases, 1e-9))
        factor = max(1.0, float(np.quantile(asked, least_coverage, method="higher")))
        factor = math.ceil(2.0 * factor) / 2.0
        stated = np.maximum(factor * bases + least, at_pilots)
        ratio = float(np.median(stated / np.maximum(errors[0], LEAST)))
        covered = [
            np.mean(error <= np.maximum(stated * (PILOTS[-1] / count) ** order, floor * math.sqrt(FLOOR_COUNT / count)))
            for count, error in zip(COUNTS, errors, strict=True)
        ]
        rank = min(float(min(covered)), least_coverage - 0.03), -ratio
        if best is None or rank > best[0]:
            best = rank, Fitted(factor, least, floor, order, float(covered[0]), ratio)
    return best[1]


def fit(scenes, names) -> dict[str, Fitted]:
    """Return the constants of every quantity, fitted to the scenes that are complete."""
    names = complete(scenes, names)
    return {name: fit_quantity(*bases_and_errors(scenes, names, name)) for name in QUANTITIES}


def after_a_run(scenes, names, name: str, count: int) -> tuple[float, float, float]:
    """Return what the constants of the package do after a run with more particles than the pilots.

    Returns
    -------
    coverage : float
        Part of the scenes whose error of a quantity is within the stated one [-].
    ratio : float
        Median of stated over max(true, .5 %) [-].
    enough : float
        Factor on stated errors with which 95 % would be covered [-].
    """
    found = []
    for one in names:
        runs = scenes[one]
        known = pilots_of(runs, "fast") | {count: runs["fast", count]}
        true = true_errors(runs["fast", count], runs["", TRUTH])
        found.append((errors_after(known, count, PILOTS[-1])[name], true[name]))
    stated, true = np.array(found).T
    known = np.isfinite(stated) & np.isfinite(true) & ((stated > 0.0) | (true > 0.0))
    stated, true = np.maximum(stated[known], 1e-9), true[known]
    ratio = float(np.median(stated / np.maximum(true, LEAST)))
    return float(np.mean(true <= stated)), ratio, float(np.quantile(true / stated, COVERED, method="higher"))


def print_fit(scenes, names) -> None:
    """Print fitted constants beside those of the package, and what those do after runs with more particles."""
    names = complete(scenes, names)
    print(f"fitted to {len(names)} scenes; in the package: k, f, p, floor")
    for name, found in fit(scenes, names).items():
        law = ERROR_LAWS[name]
        print(
            f"{name:9} k {found.factor:4.1f} f {found.least:.3f} p {found.order:.2f} floor {found.floor:.3f}; covers "
            f"{found.coverage:.2f}, stated/true {found.ratio:.2f}; "
            f"now {law.factor:g} {law.least:g} {law.order:g} {law.floor:g}"
        )
    print("with the constants of the package, after a run: coverage, stated/true, factor with which 95 % are covered")
    for name in QUANTITIES:
        cells = [after_a_run(scenes, names, name, count) for count in COUNTS]
        print(
            f"{name:9} "
            + "; ".join(f"{n}: {c:.2f} {r:.2f} {e:.2f}" for n, (c, r, e) in zip(COUNTS, cells, strict=True))
        )
