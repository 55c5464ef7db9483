"""Variations of a run, in words joined by "+": the differences to the scene.

fast          the cheap steps: Courant number 1, one node per step
fastest       the same, and rest at 1e-3 of the peak energy
coarse        every second node of the grid
more=PERCENT  so many particles more, or fewer
column=LAW    another law of the column, its levels after a slash: column=ale/21
flow=LAW      one phase or two
levels=N      another number of levels of the same column
courant=N     another Courant number, of waves and of the way of a particle
"""


def vary(scene, particles: int, variation: str):
    """Return grid, keywords without numerics, and numerics of a variation of a `Scene`.

    Raises
    ------
    ValueError
        If a word is unknown.
    """
    grid, keywords, numerics = scene.grid, dict(scene.keywords), {"particle_count": particles}
    for word in filter(None, variation.split("+")):
        key, _, value = word.partition("=")
        if word in ("fast", "fastest"):
            numerics["preset"] = word
        elif word == "coarse":
            from landlab_debrisflow.fidelity.grids import coarse_grid  # older versions do without

            grid = coarse_grid(grid)
        elif key == "more":
            numerics["particle_count"] = round(particles * (1.0 + float(value) / 100.0))
        elif key == "column":
            law, _, levels = value.partition("/")
            keywords["column"] = {"law": law} | ({"levels": int(levels)} if levels else {})
        elif key == "flow":
            keywords["flow"] = value
        elif key == "levels":
            keywords["column"] = {**keywords["column"], "levels": int(value)}
        elif key == "courant":
            numerics |= {"courant_number": float(value), "advective_courant_number": float(value)}
        else:
            raise ValueError(f"unknown variation {word!r}; see benchmarks/fidelity/variations.py")
    return grid, keywords, numerics
