"""Stated errors: from the quantities of pilot runs to errors, and to the number of particles that a tolerance asks for.

No function here runs a flow: runs are mappings of the number of particles to quantities, as `quantities` returns them.
"""

import itertools
import math
from collections.abc import Collection, Mapping

from .constants import CHANGE_FACTOR, ERROR_LAWS, ErrorLaw

Runs = Mapping[int, Mapping[str, float]]


def error_base(runs: Runs, related: Collection[str]) -> float:
    """Return the base of an error: the change by the last doubling of particles, or half of that before [-].

    Parameters
    ----------
    runs : mapping of int to mapping of str to float
        Quantities by number of particles, at least two numbers; the three largest count.
    related : collection of str
        Quantities, of which the largest base is returned.

    Returns
    -------
    float
        max(abs(d2), abs(d1) / 2) / abs(Q), of the largest number of particles; 0 of a quantity that is 0 in all runs;
        NaN if one is not known.

    Examples
    --------
    >>> runs = {250: {"area": 80.0}, 500: {"area": 110.0}, 1000: {"area": 100.0}}
    >>> error_base(runs, ["area"])
    0.15
    """
    finest = sorted(runs)[-3:]
    bases = []
    for name in related:
        values = [runs[count][name] for count in finest]
        if not all(math.isfinite(value) for value in values):
            return math.nan
        changes = [abs(after - before) for before, after in itertools.pairwise(values)]
        change = max(changes[-1], *(0.5 * one for one in changes[:-1]))
        bases.append(_relative(change, values[-1]))
    return max(bases)


def stated_errors(runs: Runs) -> dict[str, float]:
    """Return the error of every quantity, meant for 95 % of scenes, of the largest number of particles [-].

    Parameters
    ----------
    runs : mapping of int to mapping of str to float
        Quantities by number of particles, of pilot runs with `constants.PILOTS`.

    Returns
    -------
    dict of str to float
        k b + f by quantity of `constants.ERROR_LAWS`; NaN where there is nothing to measure.
    """
    return {name: _stated(law, error_base(runs, law.related)) for name, law in ERROR_LAWS.items()}


def errors_with(errors: Mapping[str, float], count: int, with_count: int) -> dict[str, float]:
    """Return the errors that another number of particles leaves [-].

    Parameters
    ----------
    errors : mapping of str to float
        Errors with `with_count` particles [-].
    count, with_count : int
        Number of particles, and that of the errors.

    Returns
    -------
    dict of str to float
        Each times (with_count / count)^p.
    """
    return {name: error * (with_count / count) ** ERROR_LAWS[name].order for name, error in errors.items()}


def count_asked(errors: Mapping[str, float], with_count: int, tolerance: float, hold: Collection[str]) -> float:
    """Return the number of particles with which all quantities that are to be held are within a tolerance.

    Parameters
    ----------
    errors : mapping of str to float
        Errors with `with_count` particles [-].
    with_count : int
        Number of particles of these errors.
    tolerance : float
        [-].
    hold : collection of str
        Quantities to be held; those without a known error do not count.

    Returns
    -------
    float
        with_count max (E / tolerance)^(1/p), at least `with_count`.

    Examples
    --------
    >>> round(count_asked({"speed": 0.1, "run_out": 0.01}, 1000, 0.05, ["speed", "run_out"]))  # 1000 * 2^(1/0.7)
    2692
    """
    asked = [float(with_count)]
    for name in hold:
        law, error = ERROR_LAWS[name], errors[name]
        if error > tolerance:
            asked.append(with_count * (error / tolerance) ** (1.0 / law.order))
    return max(asked)


def next_count(asked: float, finest: int, most: int) -> int:
    """Return the number of particles of the run to come: doublings of that of the last pilot run, up to a limit.

    Parameters
    ----------
    asked : float
        Number of particles that the tolerance asks for.
    finest : int
        Number of particles of the last pilot run.
    most : int
        Limit.

    Returns
    -------
    int

    Examples
    --------
    >>> next_count(2692.0, 1000, 8000), next_count(2692.0, 1000, 3000), next_count(990.0, 1000, 8000)
    (4000, 3000, 1000)
    """
    if not math.isfinite(asked):
        return max(most, finest)
    doublings = max(0, math.ceil(math.log2(asked / finest) - 1e-9))
    return min(finest * 2**doublings, max(most, finest))


def errors_after(runs: Runs, count: int, finest: int, *, factor: float = CHANGE_FACTOR) -> dict[str, float]:
    """Return the stated errors after a run with more particles than the pilot runs [-].

    Parameters
    ----------
    runs : mapping of int to mapping of str to float
        Quantities by number of particles: of the pilot runs, and of the run.
    count, finest : int
        Number of particles of the run and of the last pilot run.
    factor : float, optional
        Multiplies the error that Richardson's extrapolation gives [-].

    Returns
    -------
    dict of str to float
        The larger of two errors: the one expected from the pilot runs, and a multiple of the one that Richardson's
        extrapolation gives from the change since the last pilot run, with f added. If the run has no more particles
        than the pilot runs, the errors of the pilot runs.

    References
    ----------
    Richardson (1911).
    """
    pilots = {number: values for number, values in runs.items() if number <= finest}
    before = stated_errors(pilots)
    if count <= finest:
        return before
    found = {}
    for name, law in ERROR_LAWS.items():
        expected = before[name] * (finest / count) ** law.order
        change = abs(runs[count][name] - runs[finest][name])
        left = factor * change / ((count / finest) ** law.order - 1.0)
        now = _relative(left, runs[count][name]) + (law.least if left else 0.0)
        found[name] = math.nan if math.isnan(expected + now) else max(expected, now)
    return found


def _stated(law: ErrorLaw, base: float) -> float:
    return 0.0 if base == 0.0 else law.factor * base + law.least


def _relative(change: float, value: float) -> float:
    if change == 0.0 and value == 0.0:
        return 0.0
    return math.inf if value == 0.0 else abs(change / value)
