"""Cost of the presets of numerics, and changes by them: the same scenes with other steps and an earlier rest."""

import numpy as np
from rich.console import Console
from rich.table import Table

from landlab_debrisflow.fidelity.table import WORDS

from .replay import QUANTITIES, true_errors
from .score import geometric_mean

PARTICLES = 1000
PRESETS = ("fast", "fastest")


def print_presets(scenes, names) -> None:
    """Print cost over that of the preset standard, and changes of quantities against it [%]."""
    needed = [(word, PARTICLES) for word in ("", *PRESETS)]
    names = [name for name in names if all(key in scenes.get(name, {}) for key in needed)]
    table = Table("preset", "cost", *(WORDS[name] for name in QUANTITIES))
    table.title = (
        f"{len(names)} scenes with {PARTICLES} particles: cost (geometric mean) over that of standard steps; "
        "change against them, median / 90 % / largest [%]"
    )
    for preset in PRESETS:
        pairs = [(scenes[name][preset, PARTICLES], scenes[name]["", PARTICLES]) for name in names]
        cost = geometric_mean([one["seconds"] / other["seconds"] for one, other in pairs])
        changes = [true_errors(one, other) for one, other in pairs]
        cells = []
        for name in QUANTITIES:
            found = 100.0 * np.array([change[name] for change in changes])
            found = found[np.isfinite(found)]
            cells.append(" / ".join(f"{v:.1f}" for v in (np.median(found), np.quantile(found, 0.9), found.max())))
        table.add_row(preset, f"{cost:.2f}", *cells)
    Console(width=170).print(table)
