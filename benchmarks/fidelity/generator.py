"""Random scenes by seed: ground, release or inflow, material, laws, walls.

A seed makes the same scene as long as numpy's generators do: nothing here changes once constants are fitted. Cost is
bounded by the duration, which follows from volume and thickness. Which draw of a seed is taken is a matter of a run
with 150 particles (`seeds.py`).
"""

import numpy as np

from .families import draw_ground, log_uniform
from .ground import RELEASE, lay_soil, release_cap
from .scenes import Scene

STREAM = 16
"""First number of every seed of numpy's, so that nobody else's draws are ours."""

MOST_STEPS = {"one_phase": 700, "two_phase": 200}
"""Steps that the duration allows with 8000 particles, by the estimate of `longest`."""

SHORTEST, LONGEST = 30.0, 400.0  # duration [s]


def random_scene(seed: int, draw: int = 0) -> Scene:
    """Return the scene of a seed, in its first or a later draw."""
    rng = np.random.default_rng([STREAM, seed, draw])
    ground = draw_ground(rng)
    material, dry = draw_material(rng)
    two_phases = not dry and "water_table_ratio" not in material and rng.random() < 0.09
    erosion, soil = draw_erosion(rng, dry)
    if soil:
        draw_soil(rng, ground, soil)
    thickness, volume, inflow = draw_mass(rng, ground, material)
    keywords = {
        "material": material,
        "friction": draw_friction(rng, ground, material, thickness),
        "erosion": erosion,
        "column": "none" if dry else "ale",
        "flow": "two_phase" if two_phases else "one_phase",
    }
    if inflow:
        keywords["inflow"] = inflow
    if not dry and rng.random() < 0.1:
        draw_drain(rng, ground)
    if rng.random() < 0.15:
        draw_walls(rng, ground)
    return Scene(ground.grid, keywords, longest(volume, thickness, keywords["flow"]))


def longest(volume, thickness, flow) -> float:
    """Return the duration [s] in which steps by the Courant number 0.6 are no more than `MOST_STEPS`.

    Taken is the smoothing length of 8000 particles, about 1.4 of their spacing, at half the thickness released.
    """
    mean = 0.5 * thickness
    step = 0.6 * 1.4 * np.sqrt(volume / (8000.0 * mean)) / np.sqrt(9.81 * mean)
    return float(np.round(np.clip(MOST_STEPS[flow] * step, SHORTEST, LONGEST), 1))


def draw_material(rng):
    """Return the material, and whether it is dry."""
    if rng.random() < 0.15:
        return {"water_density": 0.0, "initial_pressure_ratio": 0.0, "bed_pressure_ratio": 0.0}, True
    ratio, bed = rng.choice([0.0, rng.uniform(0.1, 0.8)], p=[0.2, 0.8]), rng.uniform(0.0, 0.7)
    material = {
        "coefficient_of_consolidation": log_uniform(rng, 1e-5, 1.0),
        "initial_pressure_ratio": float(ratio), "bed_pressure_ratio": float(ratio if rng.random() < 0.4 else bed),
        "initial_pressure_profile": str(rng.choice(["linear", "uniform", "basal_layer"], p=[0.7, 0.1, 0.2])),
        "basal_slip_ratio": float(rng.choice([0.0, 1.0 / 3.0], p=[0.7, 0.3])),
        "porosity": float(rng.uniform(0.3, 0.5)),
    }  # fmt: skip
    if rng.random() < 0.1:
        material["water_table_ratio"] = float(rng.uniform(0.4, 1.0))
    if rng.random() < 0.1:
        material |= {"bed_loading_coefficient": float(rng.uniform(0.2, 0.8)), "bed_drainage_time": 120.0}
    return material, False


def draw_erosion(rng, dry):
    """Return the law of erosion and the depth of soil [m], 0 where nothing erodes."""
    kind = rng.choice(["none", "growth", "shear_excess", "liquefied_bed"], p=[0.32, 0.4, 0.14, 0.14])
    soil = log_uniform(rng, 0.3, 4.0)
    if kind == "none":
        return "none", 0.0
    if kind == "growth":
        return {"law": "growth", "growth_rate": log_uniform(rng, 3e-4, 5e-3)}, soil
    if kind == "shear_excess":
        return {
            "law": "shear_excess", "critical_shear_stress": log_uniform(rng, 500.0, 3000.0),
            "erosion_rate": log_uniform(rng, 5e-3, 5e-2),
        }, min(soil, 2.0)  # fmt: skip
    return {"law": "liquefied_bed", "highest_rate": log_uniform(rng, 1e-3, 1e-2)}, min(soil, 0.5)


def draw_soil(rng, ground, depth):
    """Lay soil everywhere, on the upper part, or in strips across the fall."""
    x, kind = ground.grid.x_of_node, rng.choice(["everywhere", "above", "strips"], p=[0.35, 0.45, 0.2])
    if kind == "everywhere":
        lay_soil(ground.grid, depth)
    elif kind == "above":
        lay_soil(ground.grid, depth, x < rng.uniform(0.3, 0.6) * ground.length)
    else:
        strip = rng.uniform(0.04, 0.1) * ground.length
        lay_soil(ground.grid, depth, np.floor(x / strip) % 2.0 == 0.0)


def draw_mass(rng, ground, material):
    """Add bodies to the release, or draw a hydrograph; return mean thickness [m], volume [m3] and the inflow."""
    kind = rng.choice(["body", "bodies", "inflow", "both"], p=[0.68, 0.15, 0.12, 0.05])
    spacing, volume, thickness, inflow = ground.grid.dx, 0.0, 0.0, None
    if kind != "inflow":
        for body in range(rng.integers(2, 5) if kind == "bodies" else 1):
            radius = spacing * rng.uniform(4.0, 9.0) * (1.0 if body == 0 else 0.7)
            peak = max(0.3, radius * log_uniform(rng, 0.02, 0.16))
            stretch = rng.uniform(1.0, 1.8)
            x = (0.1 if body == 0 else rng.uniform(0.1, 0.4)) * ground.length
            y = float(ground.middle(np.array([x]))[0]) + (0.0 if body == 0 else rng.uniform(-6.0, 6.0) * spacing)
            each = 0.5 * np.pi * radius**2 * peak
            release_cap(ground.grid, max(x, radius * stretch), y, (radius * stretch, radius / stretch), each)
            volume, thickness = volume + each, max(thickness, 0.5 * peak)
    if kind in ("inflow", "both"):
        inflow = draw_inflow(rng, ground, material)
        entering = float(np.trapezoid(inflow["discharge"], inflow["times"]))
        volume, thickness = volume + entering, max(thickness, inflow["discharge"][1] / (4.0 * 8.0 * spacing))
    return thickness, volume, inflow


def draw_inflow(rng, ground, material):
    """Return a surge with a short rise and a long fall across the middle line, 8 nodes long."""
    spacing = ground.grid.dx
    x = spacing * round(0.08 * ground.length / spacing)
    y = spacing * round(float(ground.middle(np.array([x]))[0]) / spacing)
    speed = rng.uniform(2.0, 6.0)
    peak = speed * 8.0 * spacing * spacing * log_uniform(rng, 0.08, 0.4)
    rise, fall = rng.uniform(3.0, 10.0), rng.uniform(15.0, 60.0)
    return {
        "line_start": (x, y - 4.0 * spacing), "line_end": (x, y + 4.0 * spacing), "direction": 0.0,
        "times": [0.0, rise, rise + fall], "discharge": [0.0, peak, 0.0], "velocity": speed,
        "pressure_ratio": material["initial_pressure_ratio"],
    }  # fmt: skip


def draw_friction(rng, ground, material, thickness):
    """Return a law of friction; three in ten of those with an angle are within 25 % of holding the release."""
    kind = rng.choice(
        ["coulomb", "viscous", "voellmy", "bingham", "herschel_bulkley", "mu_i"], p=[0.28, 0.1, 0.34, 0.08, 0.08, 0.12]
    )
    slope, dry = np.radians(ground.head), material.get("water_density") == 0.0
    solid = 1.0 - material.get("porosity", 0.4)
    bulk = 2650.0 * solid + (0.0 if dry else 1000.0 * (1.0 - solid))
    buoyant = 1.0 if dry else 1650.0 * solid / bulk
    threshold = np.tan(slope) / (buoyant * (1.0 - 0.5 * material["initial_pressure_ratio"]))
    usual = rng.uniform(14.0, 26.0) if dry else rng.uniform(22.0, 36.0)
    angle = float(np.degrees(np.arctan(threshold * rng.uniform(0.75, 1.0)))) if rng.random() < 0.3 else usual
    angle = min(angle, 45.0)
    driving = bulk * 9.81 * thickness * np.sin(slope)  # Pa, at the mean thickness of the release
    if kind == "coulomb":
        return {"law": "coulomb", "basal_friction_angle": angle}
    if kind == "viscous":
        return {
            "law": "coulomb", "basal_friction_angle": 0.9 * angle, "cohesion": driving * rng.uniform(0.0, 0.1),
            "viscosity": log_uniform(rng, 0.5, 100.0),
        }  # fmt: skip
    if kind == "voellmy":
        xi = log_uniform(rng, 100.0, 1500.0)
        return {"law": "voellmy", "basal_friction_angle": angle, "turbulent_coefficient": xi}
    stress = driving * rng.uniform(0.15, 0.5)
    if kind == "bingham":
        return {"law": "bingham", "yield_stress": stress, "viscosity": log_uniform(rng, 20.0, 500.0)}
    if kind == "herschel_bulkley":
        return {"law": "herschel_bulkley", "yield_stress": stress, "consistency": log_uniform(rng, 50.0, 500.0)}
    angles = {"static_friction_angle": 0.8 * angle, "limiting_friction_angle": min(1.25 * angle, 50.0)}
    return {"law": "mu_i", **angles, "grain_diameter": log_uniform(rng, 0.005, 0.1)}


def draw_drain(rng, ground):
    """Drain the base over 5 to 15 % of the length."""
    x, begin = ground.grid.x_of_node, rng.uniform(0.25, 0.5) * ground.length
    drained = (x >= begin) & (x < begin + rng.uniform(0.05, 0.15) * ground.length)
    ground.grid.add_field("bed__drained", 1.0 * drained, at="node")


def draw_walls(rng, ground):
    """Close the nodes of one to five buildings in the way, or of a dam to one side of it."""
    grid, spacing = ground.grid, ground.grid.dx
    x, y = grid.x_of_node, grid.y_of_node - ground.middle(grid.x_of_node)
    if rng.random() < 0.3:
        begin = rng.uniform(0.4, 0.6) * ground.length
        closed = (x >= begin) & (x < begin + 3.0 * spacing) & (y > rng.uniform(-4.0, 4.0) * spacing)
    else:
        closed = np.zeros(x.size, bool)
        for _ in range(rng.integers(1, 6)):
            west, south = rng.uniform(0.35, 0.6) * ground.length, rng.uniform(-10.0, 8.0) * spacing
            wide, deep = rng.uniform(2.5, 6.0, 2) * spacing
            closed |= (x >= west) & (x < west + wide) & (y >= south) & (y < south + deep)
    if RELEASE in grid.at_node:
        closed &= grid.at_node[RELEASE] == 0.0
    grid.status_at_node[closed] = grid.BC_NODE_IS_CLOSED
