"""Nine scenes: S-1000, the stand-in for Tsing Shan twice, six of one peculiarity each; and one with dilatancy.

A function of no arguments returns a `Scene`, whose grid is new with every call.
"""

import os
import sys
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from landlab import RasterModelGrid

from landlab_debrisflow.scene import tsing_shan_valley

from .ground import cut_channel, lay_soil, release_cap, roughen, slope_grid

EXAMPLES = Path(__file__).parents[2] / "examples"  # scripts, no package


class Scene(NamedTuple):
    """A flow before it begins: grid, keywords of DebrisFlow without numerics, longest time [s]."""

    grid: RasterModelGrid
    keywords: dict[str, Any]
    max_duration: float


class MissingDataError(Exception):
    """Data of a scene is not on this machine."""


def example(name):
    """Return a module of the examples."""
    if str(EXAMPLES) not in sys.path:
        sys.path.append(str(EXAMPLES))
    return __import__(name)


def s1000() -> Scene:
    """S-1000 at 10 m: the ground of examples/s1000.py, friction and growth as in the study of fidelity.

    tan(phi) = 0.6, xi 200 m s-2, growth 1.6e-3 m-1, pressure ratio 0.2 in body and bed. It creeps for long: ended
    after 900 s.
    """
    module = example("s1000")
    try:
        data = module.find_data(os.environ.get("DEBRISFLOW_DATA"))
    except ValueError as error:
        raise MissingDataError(str(error)) from None
    friction = {
        "law": "voellmy", "basal_friction_angle": module.BASAL_FRICTION_ANGLE, "turbulent_coefficient": 200.0
    }  # fmt: skip
    keywords = {
        "friction": friction, "erosion": {"law": "growth", "growth_rate": 1.6e-3},
        "material": {"bed_pressure_ratio": 0.2, "initial_pressure_ratio": 0.2},
    }  # fmt: skip
    return Scene(module.build_grid(data), keywords, 900.0)


def tsing_shan(c_v: float) -> Scene:
    """Stand-in for Tsing Shan with the parameters of examples/tsing_shan.py and a c_v [m2 s-1]."""
    module = example("tsing_shan")
    keywords = {
        "friction": module.FRICTION, "erosion": module.EROSION,
        "material": module.MATERIAL | {"coefficient_of_consolidation": c_v},
    }  # fmt: skip
    return Scene(tsing_shan_valley(), keywords, module.DURATION)


def tight() -> Scene:
    """Stand-in for Tsing Shan, c_v of the case."""
    return tsing_shan(4e-4)


def permeable() -> Scene:
    """Stand-in for Tsing Shan, c_v a thousand times as large."""
    return tsing_shan(0.4)


def dry_avalanche() -> Scene:
    """3e5 m3 of dry rock, 20 m thick in the middle, from 35 deg to a plain of 2 deg; nodes of 10 m."""
    grid = slope_grid(2400.0, 1000.0, 10.0, (0.0, 500.0, 900.0, 2400.0), (35.0, 35.0, 2.0, 2.0))
    release_cap(grid, 250.0, 0.0, (110.0, 87.0), 3e5)
    material = {"water_density": 0.0, "initial_pressure_ratio": 0.0, "bed_pressure_ratio": 0.0}
    friction = {"law": "coulomb", "basal_friction_angle": 17.0}
    return Scene(grid, {"friction": friction, "erosion": "none", "column": "none", "material": material}, 600.0)


def saturated_slip() -> Scene:
    """300 m3, 1.5 m thick in the middle, on an open slope of 34 deg that eases to 5 deg; nodes of 2 m, no erosion."""
    grid = slope_grid(260.0, 120.0, 2.0, (0.0, 90.0, 150.0, 260.0), (34.0, 34.0, 5.0, 5.0))
    release_cap(grid, 35.0, 0.0, (14.0, 9.0), 300.0)
    material = {"coefficient_of_consolidation": 1e-3, "initial_pressure_ratio": 0.5}
    friction = {"law": "coulomb", "basal_friction_angle": 31.0}
    return Scene(grid, {"friction": friction, "erosion": "none", "material": material}, 600.0)


def wet_and_eroding(turbulent_coefficient, growth_rate, coefficient_of_consolidation, pressure_ratio) -> dict:
    """Return keywords of a flow that erodes [m s-2, m-1, m2 s-1, -]; body and bed have the same pressure ratio."""
    return {
        "friction": {"law": "voellmy", "basal_friction_angle": 31.0, "turbulent_coefficient": turbulent_coefficient},
        "erosion": {"law": "growth", "growth_rate": growth_rate},
        "material": {
            "coefficient_of_consolidation": coefficient_of_consolidation, "initial_pressure_ratio": pressure_ratio,
            "bed_pressure_ratio": pressure_ratio,
        },
    }  # fmt: skip


def leaky() -> Scene:
    """3000 m3 in a rough valley, c_v 0.5 m2 s-1, erodible all along; nodes of 5 m, ended after 600 s."""
    grid = slope_grid(1600.0, 400.0, 5.0, (0.0, 500.0, 1100.0, 1600.0), (32.0, 26.0, 5.0, 5.0))
    cut_channel(grid, 50.0, 10.0, end=1000.0, fade=200.0)
    roughen(grid, 0.4, 15.0, seed=1)
    lay_soil(grid, 2.0)
    release_cap(grid, 80.0, 0.0, (35.0, 16.0), 3000.0)
    return Scene(grid, wet_and_eroding(300.0, 1e-3, 0.5, 0.5), 600.0)


def drained_reach() -> Scene:
    """4000 m3 with c_v 5e-3 m2 s-1 over soil, then over 120 m of ground with a drain; nodes of 5 m."""
    grid = slope_grid(1500.0, 400.0, 5.0, (0.0, 500.0, 900.0, 1500.0), (32.0, 26.0, 3.0, 3.0))
    cut_channel(grid, 45.0, 9.0, end=800.0, fade=200.0)
    x = grid.x_of_node
    lay_soil(grid, 2.0, x < 480.0)
    grid.add_field("bed__drained", 1.0 * ((x >= 520.0) & (x < 640.0)), at="node")
    release_cap(grid, 90.0, 0.0, (40.0, 17.0), 4000.0)
    return Scene(grid, wet_and_eroding(400.0, 2e-3, 5e-3, 0.6), 600.0)


def alternating() -> Scene:
    """6000 m3 in a channel of 3 km, 80 m wide, with soil on every second 150 m; c_v 1e-3 m2 s-1, nodes of 5 m."""
    grid = slope_grid(3000.0, 300.0, 5.0, (0.0, 600.0, 2400.0, 3000.0), (26.0, 16.0, 7.0, 4.0))
    cut_channel(grid, 80.0, 12.0)
    lay_soil(grid, 1.5, np.floor(grid.x_of_node / 150.0) % 2.0 == 0.0)
    release_cap(grid, 90.0, 0.0, (45.0, 26.0), 6000.0)
    return Scene(grid, wet_and_eroding(500.0, 1e-3, 1e-3, 0.5), 600.0)


def large_avalanche() -> Scene:
    """1e6 m3 on 240 000 nodes of 10 m, which grow to about 2.9e6 in a wide valley; c_v 1e-2 m2 s-1."""
    grid = slope_grid(5990.0, 3990.0, 10.0, (0.0, 1200.0, 3000.0, 5990.0), (30.0, 24.0, 8.0, 3.0))
    cut_channel(grid, 500.0, 90.0, end=2600.0, fade=800.0)
    lay_soil(grid, 8.0, grid.x_of_node < 3000.0)
    release_cap(grid, 350.0, 0.0, (190.0, 130.0), 1e6)
    return Scene(grid, wet_and_eroding(500.0, 4e-4, 1e-2, 0.4), 600.0)


def loose_debris() -> Scene:
    """300 m3 of loose debris, 1.5 m thick in the middle, on 31 deg that ease to 2.5 deg; nodes of 2 m, no erosion.

    Slopes, densities and dilatancy are those by which George & Iverson (2014) computed the flume of the USGS, whose
    flows are ten times thinner. The debris starts without excess pore pressure, and makes its own.
    """
    grid = slope_grid(400.0, 120.0, 2.0, (0.0, 150.0, 165.0, 400.0), (31.0, 31.0, 2.5, 2.5))
    release_cap(grid, 35.0, 0.0, (14.0, 9.0), 300.0)
    material = {
        "solid_density": 2700.0, "water_density": 1100.0, "porosity": 0.38, "initial_pressure_ratio": 0.0
    }  # fmt: skip
    dilatancy = {
        "critical_solid_fraction": 0.64, "permeability": 5e-9, "pore_fluid_viscosity": 0.005, "grain_diameter": 0.001,
        "compressibility": 0.017, "reference_stress": 1000.0,
    }  # fmt: skip
    keywords = {
        "friction": {"law": "coulomb", "basal_friction_angle": 40.7}, "erosion": "none", "material": material,
        "column": {"law": "ale", "dilatancy": dilatancy},
    }  # fmt: skip
    return Scene(grid, keywords, 600.0)


NINE = {
    "S-1000": s1000, "Tsing Shan 4e-4": tight, "Tsing Shan 0.4": permeable, "dry avalanche": dry_avalanche,
    "saturated slip": saturated_slip, "leaky": leaky, "drained reach": drained_reach, "alternating": alternating,
    "1e6 m3": large_avalanche,
}  # fmt: skip
"""The nine scenes by name."""

NAMED = NINE | {"loose debris": loose_debris}
"""All scenes with a name."""


def maker(name: str):
    """Return the function that makes a scene: one of `NAMED`, or a random one, "r" and its seed.

    Raises
    ------
    KeyError
        If there is none of that name.
    """
    if name in NAMED:
        return NAMED[name]
    from .seeds import DRAWS, function_of

    seed = int(name.removeprefix("r"))
    return partial(function_of(seed), seed, DRAWS[seed])
