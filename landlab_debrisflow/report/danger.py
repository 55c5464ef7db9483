"""Danger levels in the report of an ensemble."""

from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from ..core.errors import InputError
from ..geo.exposure import ELEVATION
from ..hazard.files import LEVELS
from ..hazard.matrix import level_names
from ..plots import draw_danger_levels
from ..plots.map_frame import reference_name
from .blocks import Block, Sentences, Table
from .numbers import rounded
from .pictures import picture


def danger_blocks(folder: Path, digest: str, shapes: Any = None) -> list[Block]:
    """Return picture, areas and source of the danger levels, if a directory has a file of danger levels.

    Parameters
    ----------
    folder : Path
        Directory that `write_danger_levels` may have written to.
    digest : str
        Digest of the ensemble in the directory; danger levels of others alone are named and not shown.
    shapes : object, optional
        As in `draw_map`.

    Returns
    -------
    list of Block

    Raises
    ------
    InputError
        If the file is damaged.
    """
    path = folder / f"{LEVELS}.nc"
    if not path.is_file():
        return []
    try:
        with xr.open_dataset(path, engine="netcdf4", decode_coords="all") as file:
            found = file.load()
        levels, periods = found[LEVELS], found.period.values
        names, colours = level_names(levels)
        classes, _ = level_names(found.class_number)
    except (OSError, ValueError, RuntimeError, KeyError, AttributeError) as error:
        raise InputError(f"cannot read {path}: {error}; write the danger levels again, or remove the file") from error
    if digest not in str(found.attrs.get("ensemble_digest", "")).split(", "):
        return [Sentences([f"{path.name} was made of other members, and is not shown; write the danger levels again."])]
    figure = draw_danger_levels(
        levels, names, colours, relief=found.get(ELEVATION), reference=reference_name(found), shapes=shapes
    )
    area = abs(float(found.x[1] - found.x[0]) * float(found.y[1] - found.y[0]))
    share = 100.0 * float(found.attrs["probability_of_class"])
    told = f"Classes that at least {share:.0f} % of the members reach, with their return periods."
    areas = [(name, rounded(area * int((levels.values == k).sum()), "m²")) for k, name in enumerate(names, 1)]
    head = ("hazard class", *(f"{period:g} years" for period in periods))
    rows = [
        (name, *(rounded(area * int(np.sum(one == k)), "m²") for one in found.class_number.values))
        for k, name in enumerate(classes, 1)
    ]
    sources = [f"{found.attrs[name]}: {found.attrs[f'{name}_source']}" for name in ("hazard_scale", "hazard_matrix")]
    return [
        picture(figure, "Map: danger levels.", told),
        Table(caption="Area by danger level", head=("danger level", "area"), rows=areas[::-1], numbers=(1,)),
        Table(caption="Area by hazard class and return period", head=head, rows=rows[::-1],
              numbers=range(1, len(head))),
        Sentences(sources, listed=True),
    ]  # fmt: skip
