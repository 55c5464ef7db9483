"""Order of the particles in a file, by identity, with the place of each in memory as a variable.

The order in memory depends on which particles sleep, and may differ between versions. A run goes on to the bit only if
the sums over neighbours are computed in the same order as before.
"""

import numpy as np
import xarray as xr


def sort_by_identity(dataset: xr.Dataset, prefix: str) -> xr.Dataset:
    """Return the Dataset of a state with particles in order of identity, and ``place``, the place of each in memory.

    Parameters
    ----------
    dataset : xarray.Dataset
        As `state_dataset.to_dataset` returns it.
    prefix : str
        Beginning of the names of variables of the particles.

    Examples
    --------
    >>> numbers = {"identity": ("particle", [2, 0, 1]), "volume": ("particle", [2.5, 0.5, 1.5])}
    >>> ordered = sort_by_identity(xr.Dataset(numbers), "")
    >>> ordered["volume"].values, ordered["place"].values
    (array([0.5, 1.5, 2.5]), array([1, 2, 0]))
    >>> sort_by_place(ordered, "")["volume"].values
    array([2.5, 0.5, 1.5])
    """
    place = np.argsort(dataset[f"{prefix}identity"].values)
    ordered = dataset.isel(particle=place)
    words = {"units": "1", "long_name": "place of the particle in memory"}
    ordered[f"{prefix}place"] = ("particle", place, words)
    if "partners_of" not in dataset:
        return ordered
    now = place.size, int(dataset["ever"])
    if tuple(dataset["partners_generation"].values.tolist()) != now:  # partners that have left are never read again
        return ordered.isel(grain=slice(0), pair=slice(0))
    number = np.empty_like(place)
    number[place] = np.arange(place.size)
    return _renumber(ordered, number)


def sort_by_place(dataset: xr.Dataset, prefix: str) -> xr.Dataset:
    """Return the Dataset of a state with particles as they were in memory: undo `sort_by_identity`."""
    place = dataset[f"{prefix}place"].values
    number = np.argsort(place)
    ordered = dataset.isel(particle=number).drop_vars(f"{prefix}place")
    return _renumber(ordered, place) if "partners_of" in dataset else ordered


def _renumber(dataset, number):
    """Return a Dataset in which grains and their partners have other numbers; `number` is int, shape (n,)."""
    of, index = (number[dataset[f"partners_{name}"].values] for name in ("of", "index"))
    return dataset.assign(partners_of=("grain", of), partners_index=("pair", index))
