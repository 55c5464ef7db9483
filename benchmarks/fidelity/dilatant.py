"""Random scenes with dilatancy by seed: ground, release and laws of `generator`, values of dilatancy as published.

Debris is saturated and has one phase. Its values are drawn from what was measured or used for the flume of the USGS:
solid fraction 0.61 +- 0.04 beside a critical one of 0.64, viscosity of the pore fluid 0.001 to 0.05 Pa s, permeability
from the least measured, 4e-12 m2, to that of the simulation, 5e-9 m2 (George & Iverson, 2014); compressibility a of
0.01 to 0.05 and reference stress of 10 to 1000 Pa (Iverson & George, 2014).
"""

import numpy as np

from .families import draw_ground, log_uniform
from .generator import draw_erosion, draw_friction, draw_mass, draw_soil, longest
from .scenes import Scene

STREAM = 18
"""First number of every seed of numpy's: another one than that of `generator`."""


def dilatant_scene(seed: int, draw: int = 0) -> Scene:
    """Return the scene with dilatancy of a seed, in its first or a later draw."""
    rng = np.random.default_rng([STREAM, seed, draw])
    ground = draw_ground(rng)
    material, dilatancy = draw_debris(rng)
    erosion, soil = draw_erosion(rng, dry=False)
    if soil:
        draw_soil(rng, ground, soil)
    thickness, volume, inflow = draw_mass(rng, ground, material)
    keywords = {
        "material": material,
        "friction": draw_friction(rng, ground, material, thickness),
        "erosion": erosion,
        "flow": "one_phase",
        "column": {"law": "ale", "dilatancy": dilatancy},
    }
    if inflow:
        keywords["inflow"] = inflow
    return Scene(ground.grid, keywords, longest(volume, thickness, "one_phase"))


def draw_debris(rng):
    """Return material and dilatancy; six bodies in ten begin without excess pore pressure."""
    solid = rng.uniform(0.57, 0.65)
    ratio, bed = rng.choice([0.0, rng.uniform(0.1, 0.8)], p=[0.6, 0.4]), rng.uniform(0.0, 0.7)
    material = {
        "water_density": 1100.0, "solid_density": 2700.0, "porosity": float(1.0 - solid),
        "initial_pressure_ratio": float(ratio), "bed_pressure_ratio": float(bed),
    }  # fmt: skip
    dilatancy = {
        "critical_solid_fraction": 0.64, "permeability": log_uniform(rng, 4e-12, 5e-9),
        "pore_fluid_viscosity": log_uniform(rng, 1e-3, 0.05), "compressibility": log_uniform(rng, 0.01, 0.05),
        "reference_stress": log_uniform(rng, 10.0, 1000.0),
    }  # fmt: skip
    return material, dilatancy
