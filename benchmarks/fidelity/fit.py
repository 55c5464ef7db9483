"""Fit the constants of stated errors to scenes: k, least and order of each quantity.

E = k b + f: for every f of a short list, k is the 95 % quantile over the scenes of what
covers the true error with 1000 particles. Taken is the pair whose median of stated over max(true, .5 %) is least. The
order p is that of the 90 % quantile of errors. Of the factors on changes since the pilots the one is taken that covers
95 % of all quantities that can be held with 2000, 4000 and 8000 particles, with the least median of stated over true.
"""

import math
from typing import NamedTuple

import numpy as np

from landlab_debrisflow.fidelity.constants import CHANGE_FACTOR, ERROR_LAWS, PILOTS
from landlab_debrisflow.fidelity.errors import error_base, errors_after

from .campaign import TRUTH
from .replay import QUANTITIES, complete, pilots_of, true_errors
from .score import LEAST

COVERED = 0.95
LEASTS = (0.001, 0.002, 0.003, 0.004, 0.005, 0.008, 0.01)
COUNTS = (1000, 2000, 4000, 8000)
ORDERS = (0.3, 1.2)  # least and most
CHANGE_FACTORS = (0.5, 1.0, 1.5, 2.0, 2.5, 3.0)


class Fitted(NamedTuple):
    """Constants of a quantity.

    Attributes
    ----------
    factor, least, order : float
        As of `constants.ErrorLaw`.
    coverage, ratio : float
        Of the scenes with 1000 particles: part covered, and median of stated over max(true, .5 %) [-].
    """

    factor: float
    least: float
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
    """Return the order p by which the 90 % quantile of errors (counts, scenes) falls, a power of N.

    From runs with at most a quarter of the particles of the truth, whose own error then matters little: with order 1 it
    makes 1.16 of it. Errors with 8000 particles are noise of both runs for a good part.
    """
    here = np.array([count <= TRUTH // 4 for count in COUNTS])
    high = np.log(np.maximum(np.quantile(errors, 0.9, axis=1), 1e-4))[here]
    slope = np.polyfit(np.log(np.array(COUNTS)[here]), high, 1)[0]
    return float(np.clip(round(-slope * 20.0) / 20.0, *ORDERS))


def fit_quantity(bases, errors, least_coverage: float = COVERED) -> Fitted:
    """Return the constants of a quantity from `bases_and_errors`."""
    best = None
    for least in LEASTS:
        asked = (errors[0] - least) / np.maximum(bases, 1e-9)
        factor = max(1.0, float(np.quantile(asked, least_coverage, method="higher")))
        factor = math.ceil(10.0 * factor) / 10.0
        stated = factor * bases + least
        ratio = float(np.median(stated / np.maximum(errors[0], LEAST)))
        if best is None or ratio < best.ratio:
            best = Fitted(factor, least, fit_order(errors), float(np.mean(errors[0] <= stated)), ratio)
    return best


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
    stated, true = after_pairs(scenes, names, name, count, CHANGE_FACTOR).T
    stated = np.maximum(stated, 1e-9)
    ratio = float(np.median(stated / np.maximum(true, LEAST)))
    return float(np.mean(true <= stated)), ratio, float(np.quantile(true / stated, COVERED, method="higher"))


def fit_after(scenes, names) -> tuple[float, float, float]:
    """Return the factor of `errors_after`, the coverage [-] and the median of stated over true [-]."""
    found = []
    for factor in CHANGE_FACTORS:
        pairs = np.concatenate([
            after_pairs(scenes, names, name, count, factor)
            for name in QUANTITIES if not ERROR_LAWS[name].reason for count in COUNTS[1:]
        ])  # fmt: skip
        coverage = float(np.mean(pairs[:, 1] <= pairs[:, 0]))
        ratio = float(np.median(pairs[:, 0] / np.maximum(pairs[:, 1], LEAST)))
        found.append(((min(coverage, COVERED), -ratio), (factor, coverage, ratio)))
    return max(found)[1]


def after_pairs(scenes, names, name: str, count: int, factor: float) -> np.ndarray:
    """Return stated and true errors of a quantity after runs with a number of particles, (scenes, 2) [-]."""
    found = []
    for one in names:
        runs = scenes[one]
        known = pilots_of(runs, "fast") | {count: runs["fast", count]}
        stated = errors_after(known, count, PILOTS[-1], factor=factor)[name]
        found.append((stated, true_errors(runs["fast", count], runs["", TRUTH])[name]))
    pairs = np.array(found)
    return pairs[np.isfinite(pairs).all(axis=1) & pairs.any(axis=1)]


def print_fit(scenes, names) -> None:
    """Print fitted constants beside those of the package, and what those do after runs with more particles."""
    names = complete(scenes, names)
    print(f"fitted to {len(names)} scenes; in the package: k, f, p")
    for name, found in fit(scenes, names).items():
        law = ERROR_LAWS[name]
        print(
            f"{name:9} k {found.factor:4.1f} f {found.least:.3f} p {found.order:.2f}; covers "
            f"{found.coverage:.2f}, stated/true {found.ratio:.2f}; "
            f"now {law.factor:g} {law.least:g} {law.order:g}"
        )
    factor, coverage, ratio = fit_after(scenes, names)
    print(f"after a run: factor {factor:g}; covers {coverage:.2f}, stated/true {ratio:.2f}; now {CHANGE_FACTOR:g}")
    print("with the constants of the package, after a run: coverage, stated/true, factor with which 95 % are covered")
    for name in QUANTITIES:
        cells = [after_a_run(scenes, names, name, count) for count in COUNTS]
        print(
            f"{name:9} "
            + "; ".join(f"{n}: {c:.2f} {r:.2f} {e:.2f}" for n, (c, r, e) in zip(COUNTS, cells, strict=True))
        )
