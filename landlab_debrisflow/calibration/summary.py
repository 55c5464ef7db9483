"""Table that a posterior prints: intervals, scores beside a baseline and the noise floor, doubts."""

import numpy as np
from scipy import stats

from ..ensemble.names import NOISE
from ..fidelity.table import Table
from .criteria import Likelihood
from .observed_maps import ElevationChange
from .weighted_members import WeightedMembers

FEW = 50.0
"""Effective sample size below which the tails of an interval rest on two or three members."""

CLEAR = 2.0
"""Threshold of scores over the standard deviation of a cell from which on errors alone seldom exceed it: in 5 %."""

FAR = 3.0
"""Misfit over its standard deviation that all members have in vain: chance alone gives it to one in 370."""


def posterior_table(posterior: WeightedMembers) -> Table:
    """Return the table of a posterior.

    Parameters
    ----------
    posterior : WeightedMembers
    """
    sample, count = posterior.sample, posterior.weights.size
    generations = int(sample.generation[-1]) + 1
    method = "sequential Monte Carlo with the stated errors"
    if posterior.is_abc:
        method = f"approximate Bayesian computation (ABC), tolerance {sample.level.value:.3g}"
    failed = int(np.isnan(sample.misfits).any(axis=1).sum())
    rows = [
        ("method", method),
        ("members", f"{count} in {generations} generations" + (f", {failed} failed" if failed else "")),
        ("effective size", f"{posterior.effective_size:.0f} of {count}"),
    ]  # fmt: skip
    intervals, medians = posterior.interval(0.9), posterior.quantile(0.5)
    names = {values.attrs["key"]: values.attrs["units"] for values in posterior.members.data_vars.values()
             if "key" in values.attrs}  # fmt: skip
    for key, unit in names.items():
        if key.endswith(f".{NOISE}"):
            rows.append((key, "realisations of noise, which the observations weight with the other values"))
        elif key in intervals:
            low, high = intervals[key]
            words = f"{float(medians[key]):.4g} ({low:.4g} to {high:.4g}) {'' if unit == '1' else unit}".rstrip()
            rows.append((key, f"{words}, median and 90 % interval"))
        else:
            parts = posterior.probabilities(key).items()
            rows.append((key, ", ".join(f"{name:.60} {part:.2f}" for name, part in parts)))
    rows += _model_errors(posterior)
    for runs in posterior.runs:
        if runs.name:
            rows.append((runs.name, "event"))
        rows += [(one.name, one.words()) for one in posterior.scores(runs.name)]
    rows += _chi_square(posterior)
    rows.append(("scores", "in-sample: the same observations chose the weights; the prior is the baseline"))
    return Table(title="Calibration", rows=rows, notes=_doubts(posterior))


def _model_errors(posterior: WeightedMembers) -> list[tuple[str, str]]:
    if not isinstance(posterior.criterion, Likelihood):
        return []
    labels = posterior.members.observation.values
    found = posterior.criterion.errors.model_errors(posterior.sample.misfits, posterior.weights)
    return [
        (f"model error of {labels[k]}", f"{mean:.3g} ({low:.3g} to {high:.3g}), mean and 90 % interval")
        for k, (mean, low, high) in found.items()
    ]


def _chi_square(posterior: WeightedMembers) -> list[tuple[str, str]]:
    if not isinstance(posterior.criterion, Likelihood):
        return []
    errors = posterior.criterion.errors
    squares = errors.chi_square(posterior.sample.misfits).sum(axis=1)
    values = [
        float(np.average(squares[weights > 0.0], weights=weights[weights > 0.0]))
        for weights in (posterior.weights, np.where(np.isnan(squares), 0.0, posterior.prior_weights))
    ]
    best = squares[posterior.best]
    words = f"posterior {values[0]:.3g}, best member {best:.3g}, prior {values[1]:.3g}; expected of a perfect model "
    return [("chi-square", f"{words}{errors.count:.3g}, the number of independent values")]


def _doubts(posterior: WeightedMembers) -> list[str]:
    found = []
    if posterior.is_abc:
        found.append(
            "no errors are stated: intervals depend on the tolerance, and grow narrower with more generations; state "
            "the errors sd of the observations to get a posterior"
        )
    elif posterior.effective_size < FEW:
        found.append(
            f"the effective sample size is {posterior.effective_size:.0f}: ends of intervals rest on few members; take "
            "more generations or members"
        )
    found += _out_of_reach(posterior)
    changes = [one for runs in posterior.runs for one in runs.observations if isinstance(one, ElevationChange)]
    found += [_noise_words(one) for one in changes if one.sd is not None and one.threshold < CLEAR * one.sd]
    return found


def _noise_words(one: ElevationChange) -> str:
    share = 200.0 * stats.norm.sf(one.threshold / one.sd)
    return (
        f"errors of {one.sd:g} m alone carry {share:.0f} % of the cells without change over the threshold of "
        f"{one.threshold:g} m that scores have, so that the CSI of a perfect model is low; a threshold of "
        f"{CLEAR * one.sd:g} m leaves 5 %"
    )


def _out_of_reach(posterior: WeightedMembers) -> list[str]:
    """Return a sentence for each observation from which all members are far."""
    found, first = [], 0
    for runs in posterior.runs:
        for k, bound in enumerate(runs.bound):
            misfits = abs(posterior.sample.misfits[:, first + k])
            if bound.stated is not None and np.isfinite(misfits).any():
                nearest, error = float(np.nanmin(misfits)), bound.stated.largest
                if nearest > FAR * error:
                    unit = "" if bound.unit == "-" else f" {bound.unit}"
                    named = "its sd" if bound.stated.model_error is None else "its sd with the scale of its model_error"
                    found.append(
                        f"{bound.label} is out of reach: the nearest member is off by {nearest:.3g}{unit}, "
                        f"{nearest / error:.1f} of {named}; widen the distributions, or state a larger model_error"
                    )
        first += len(runs.bound)
    return found
