"""Generations of a calibration: points of the unit cube, simulated and weighted, and proposals around them."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from scipy import special

from ..ensemble.sampling import draw_points
from .criteria import Criterion, Level
from .proposal import Proposal, log_prior, normal_scores

TARGET = 0.25
"""Effective sample size that a level leaves, over the members of a generation."""

Simulate = Callable[[int, np.ndarray], tuple[np.ndarray, np.ndarray]]
"""Function of the number of a generation and of its points, shape (members, dimensions), that returns the points that
were run, which an earlier start may have stored, and their misfits, shape (members, observations)."""


class Sample(NamedTuple):
    """Members of all generations with their weights.

    Attributes
    ----------
    uniform : ndarray, shape (members, dimensions)
        Points of the unit cube.
    generation : ndarray of int, shape (members,)
    misfits : ndarray, shape (members, observations)
    log_ratio : ndarray, shape (members,)
        Logarithm of the prior over the mixture of all proposals.
    level : Level
        Weights of the posterior.
    steps : tuple of float
        Exponent or tolerance from which each generation after the first was proposed.
    """

    uniform: np.ndarray
    generation: np.ndarray
    misfits: np.ndarray
    log_ratio: np.ndarray
    level: Level
    steps: tuple[float, ...]


def draw_posterior(
    dimensions: int, simulate: Simulate, criterion: Criterion, members: int, generations: int, seed: int
) -> Sample:
    """Draw members of a posterior by population Monte Carlo with tempering, all generations weighted together.

    The first generation is a Latin hypercube from the prior. Each further one is drawn around all members so far
    (Cappé et al. 2004), weighted by the strictest criterion that leaves an effective sample size of a quarter of a
    generation (Del Moral, Doucet & Jasra 2006). Weights are prior times criterion over the mixture of all proposals,
    each with the part of its generation (Veach & Guibas 1995, Owen & Zhou 2000, Cornuet et al. 2012), so no run is
    lost; because the first proposal is the prior, the prior over the mixture is at most the number of generations.

    Parameters
    ----------
    dimensions : int
    simulate : callable
        As `Simulate`.
    criterion : Criterion
    members : int
        Members of each generation.
    generations : int
    seed : int
        Equal seeds give equal members.

    Returns
    -------
    Sample
    """
    proposals: list[Proposal] = []
    steps: list[float] = []
    size = TARGET * members
    points, misfits = simulate(0, draw_points("latin_hypercube", members, dimensions, seed).uniform)
    log_ratio = _log_ratio(normal_scores(points), proposals, members)
    for generation in range(1, generations):
        level, scores = criterion.relaxed(misfits, log_ratio, size), normal_scores(points)
        proposals.append(Proposal.around(scores, level.weights))
        steps.append(level.value)
        random = np.random.default_rng([seed, generation])
        more = simulate(generation, proposals[-1].draw(members, random))
        points, misfits = (np.concatenate(pair) for pair in zip((points, misfits), more, strict=True))
        log_ratio = _log_ratio(normal_scores(points), proposals, members)
    level = criterion.final(misfits, log_ratio, size)
    number = np.repeat(np.arange(generations), members)
    return Sample(points, number, misfits, log_ratio, level, tuple(steps))


def _log_ratio(scores: np.ndarray, proposals: list[Proposal], members: int) -> np.ndarray:
    """Return the logarithm of the prior over the mixture of the prior and all proposals, shape (members,)."""
    prior = log_prior(scores)
    densities = [prior, *(one.log_density(scores, members) for one in proposals)]
    found: np.ndarray = prior - special.logsumexp(densities, axis=0) + np.log(len(densities))
    return found
