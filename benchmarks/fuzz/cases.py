"""Cases by number: the same seed and number make the same file."""

import gc
import logging
from pathlib import Path
from typing import NamedTuple

import numpy as np

from . import binary_vectors, checkpoints, hydrographs, rasters, records, scenes, vectors

WRITERS = {
    "scene": scenes.write, "raster": rasters.write, "vector": vectors.write, "hydrograph": hydrographs.write,
    "checkpoint": checkpoints.write, "record": records.write,
}  # fmt: skip
KINDS, FORMS = tuple(WRITERS), ("valid", "one change", "bytes")
KIND_WEIGHTS, FORM_WEIGHTS = (0.27, 0.25, 0.21, 0.05, 0.18, 0.04), (0.06, 0.62, 0.32)


class Case(NamedTuple):
    """Number of a case, what kind of file it is about, in which form, and from which seed it is drawn."""

    number: int
    kind: str
    form: str
    seed: int

    def write(self, folder: Path) -> str:
        """Write the files into an empty directory; return the change as text."""
        rng = np.random.default_rng([self.seed, self.number, 1])
        return WRITERS[self.kind](rng, folder, self.form)

    @property
    def sampled(self) -> bool:
        """Whether a flow is made of it, if it is accepted."""
        return self.kind == "checkpoint" or self.number % 4 == 0


def case(seed: int, number: int) -> Case:
    """Return the case of a number."""
    rng = np.random.default_rng([seed, number, 0])
    return Case(number, str(rng.choice(KINDS, p=KIND_WEIGHTS)), str(rng.choice(FORMS, p=FORM_WEIGHTS)), seed)


def prepare() -> None:
    """Make what cases have in common, once, before the process is copied."""
    logging.getLogger("landlab_debrisflow").setLevel(logging.ERROR)
    binary_vectors.prepare()
    checkpoints.good()
    records.good()
    for number in range(len(checkpoints.good())):
        checkpoints._read(number)
    logging.getLogger("landlab_debrisflow").setLevel(logging.NOTSET)
    gc.freeze()  # else the first collection in a copy would touch, and so copy, all pages
