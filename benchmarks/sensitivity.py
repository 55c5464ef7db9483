"""Intervals of sensitivities: how often they hold the truth, for functions of random values.

python -m benchmarks.sensitivity    rank correlations and Sobol indices of 400 designs each; 2 minutes
"""

from collections.abc import Callable

import numpy as np

from landlab_debrisflow.ensemble.sampling import draw_points
from landlab_debrisflow.sensitivity.indices import indices
from landlab_debrisflow.sensitivity.rank import correlation_interval, correlations

DESIGNS, VALUES, LEVEL = 400, 4, 0.95
MANY = 2**15
"""Members or base points of which the estimate counts as the truth."""

FUNCTIONS: dict[str, Callable[[np.ndarray], np.ndarray]] = {
    "sum": lambda x: x @ [1.0, 0.7, 0.3, 0.0],
    "product": lambda x: (1.0 + x[:, 0]) * (1.0 + 0.7 * x[:, 1]) * (1.0 + 0.3 * x[:, 2]),
    "threshold": lambda x: np.maximum(0.0, x[:, 0] - 0.5 + 0.3 * x[:, 1]) + 0.3 * x[:, 2],
    "scatter": lambda x: x @ [1.0, 0.7, 0.3, 0.8],
}
"""Measures of four values in [0, 1]; the fourth makes scatter, and is no value of the rank correlations."""


def rank_table(members: int) -> None:
    """Print how often intervals hold the rank correlation, and by how much the partial one is off in the mean."""
    for name, function in FUNCTIONS.items():
        points = draw_points("sobol", MANY, VALUES, 0).uniform
        truth = correlations(points[:, :3], function(points))
        for method in ("random", "latin_hypercube", "sobol"):
            found = []
            for seed in range(1, DESIGNS + 1):
                points = draw_points(method, members, VALUES, seed).uniform
                found.append(correlations(points[:, :3], function(points)))
            whole, partial = np.swapaxes(found, 0, 1)
            lower, upper = correlation_interval(whole, members, LEVEL)
            held = ((lower <= truth[0]) & (truth[0] <= upper)).mean(axis=0)
            lower, upper = correlation_interval(partial, members - 2, LEVEL)
            held_partial = ((lower <= truth[1]) & (truth[1] <= upper)).mean(axis=0)
            print(
                f"{name:10s} {method:16s} {members} members: intervals hold rank correlations {truth[0].round(2)} in "
                f"{(100.0 * held).round()} %, would hold partial ones {truth[1].round(2)} in "
                f"{(100.0 * held_partial).round()} %; mean of these {partial.mean(axis=0).round(2)}", flush=True,
            )  # fmt: skip


def index_table(base: int) -> None:
    """Print how often intervals hold the Sobol indices."""
    for name, function in FUNCTIONS.items():
        truth = _indices(function, MANY, 0, 2)[..., 0]
        found = np.array([_indices(function, base, seed, 200) for seed in range(1, DESIGNS + 1)])
        held = ((found[..., 1] <= truth) & (truth <= found[..., 2])).mean(axis=0)
        for kind, words in enumerate(("first order", "total order")):
            print(
                f"{name:10s} {base} base points: intervals hold {words} {truth[kind].round(2)} in "
                f"{(100.0 * held[kind]).round()} %", flush=True,
            )  # fmt: skip


def _indices(function: Callable[[np.ndarray], np.ndarray], base: int, seed: int, resamples: int) -> np.ndarray:
    points = draw_points("saltelli", base * (VALUES + 2), VALUES, seed).uniform
    return indices(function(points).reshape(base, -1), seed, resamples, LEVEL)


def main() -> None:
    """Print both tables."""
    for members in (32, 128):
        rank_table(members)
    for base in (16, 32, 64):
        index_table(base)


if __name__ == "__main__":
    main()
