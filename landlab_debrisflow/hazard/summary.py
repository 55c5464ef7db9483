"""Summary of hazard maps in words: members, sampling errors, and how many members are enough."""

import math

import numpy as np
import xarray as xr

from .errors import members_needed

TARGET = 0.05
"""Standard error of a probability that a summary compares with."""


def variance_ratio(maps: xr.Dataset) -> float:
    """Return the variance of probabilities over that of a random sample of as many members, over all nodes.

    Parameters
    ----------
    maps : xarray.Dataset
        As `hazard_maps` returns them.

    Returns
    -------
    float
        Sum of squared standard errors over the sum of p (1 - p) / n, of all nodes and thresholds where p is neither 0
        nor 1; 1 for a random sample, NaN without an error or such nodes.
    """
    if maps.attrs["sampling_error"] != "scatter between replicates":
        return 1.0 if maps.attrs["sampling_error"] != "none" else math.nan
    squares = plain = 0.0
    for name in probabilities_of(maps):
        p, error = (maps[one].values.astype(float) for one in (name, f"{name}_standard_error"))
        inner = (p > 0.0) & (p < 1.0)
        squares += float(np.sum(error[inner] ** 2))
        plain += float(np.sum((p * (1.0 - p))[inner])) / maps.attrs["members_completed"]
    return squares / plain if plain > 0.0 else math.nan


def probabilities_of(maps: xr.Dataset) -> list[str]:
    """Return the names of the probabilities in hazard maps, errors left out."""
    names = [str(name) for name in maps if str(name).startswith("probability_of_")]
    return [name for name in names if not name.endswith(("_low", "_high", "_standard_error"))]


def hazard_summary(maps: xr.Dataset, standard_error: float = TARGET) -> list[str]:
    """Return a summary of hazard maps as sentences: members, failures, sampling errors, number of members needed.

    Parameters
    ----------
    maps : xarray.Dataset
        As `hazard_maps` returns them.
    standard_error : float
        Standard error of a probability that is wanted at worst.

    Returns
    -------
    list of str
    """
    facts = maps.attrs
    completed, failed = facts["members_completed"], facts["members_failed"]
    found = [f"Probabilities are shares of {completed} of {facts['members']} members ({facts['sampling']})."]
    if failed:
        found.append(f"{failed} members failed ({100.0 * facts['failed_share']:.2g} %) and are left out.")
    if "remark" in facts:
        found.append(f"{facts['remark']}.")
    if "no_sampling_error" in facts:
        return [*found, f"Sampling errors are not known: {facts['no_sampling_error']}."]
    ratio = variance_ratio(maps)
    largest = max(float(maps[f"{name}_standard_error"].max()) for name in probabilities_of(maps))
    found.append(f"The largest standard error of a probability is {largest:.2g} ({facts['sampling_error']}).")
    needed = members_needed(standard_error, 1.0 if math.isnan(ratio) else ratio)
    enough = "so many are there" if completed >= needed else f"{needed - completed} more are needed"
    where = "where the probability is a half"
    if ratio == 1.0 or math.isnan(ratio):
        return [*found, f"A standard error of {standard_error:g} {where} takes {needed} members; {enough}."]
    found.append(
        f"The scatter between replicates has {ratio:.2g} times the variance of a random sample, on the average over "
        f"all nodes: a standard error of {standard_error:g} {where} takes {needed} members on the average; {enough}. "
        f"Of a random sample it takes {members_needed(standard_error)}."
    )
    return found
