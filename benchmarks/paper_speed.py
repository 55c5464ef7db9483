"""The claims of Pastor et al. (2022), section 4.2, at the speed that its Péclet numbers imply.

``python -m benchmarks.paper_speed``: both models on the stand-in terrain of `examples/tsing_shan.py`, with the friction
as printed, by which the flow is nine times as fast, and with resistances that slow it down: Voellmy's drag of published
size and larger, and a viscosity; then with dilatancy, which only the ALE column has. Keeps
benchmarks/results/paper_speed.json after every pair of runs, and makes benchmarks/paper_speed.txt and a table of
docs/events.md of it. ``--resume`` goes on with the result file.
"""

import argparse
import math

import numpy as np

from benchmarks import charts, result_files
from benchmarks.example_scripts import load
from landlab_debrisflow import DebrisFlow
from landlab_debrisflow.record import quantile
from landlab_debrisflow.scene import tsing_shan_valley

tsing_shan, record = load("tsing_shan"), load("tsing_shan_record")

PARTICLES, DURATION = 500, 1200.0  # [-], [s]
ANGLE = tsing_shan.FRICTION["basal_friction_angle"]

RESISTANCES = {
    "as printed": tsing_shan.FRICTION,
    "drag, ξ = 500": {"law": "voellmy", "basal_friction_angle": ANGLE, "turbulent_coefficient": 500.0},
    "drag, ξ = 200": {"law": "voellmy", "basal_friction_angle": ANGLE, "turbulent_coefficient": 200.0},
    "drag, ξ = 100": {"law": "voellmy", "basal_friction_angle": ANGLE, "turbulent_coefficient": 100.0},
    "drag, ξ = 30": {"law": "voellmy", "basal_friction_angle": ANGLE, "turbulent_coefficient": 30.0},
    "viscosity 2 kPa s": tsing_shan.FRICTION | {"viscosity": 2000.0},
}
"""Friction as printed has a viscosity of 0.5 Pa s. Published values of xi are 100 to 1000 m s-2 (docs/parameters.md);
30 m s-2 and 2 kPa s were chosen for the paper's speed of 5 m/s, after runs with 15 m s-2 and with 5 and 17 kPa s."""

DILATANCY = {f"dilatancy, m = {fraction}": fraction for fraction in (0.6, 0.64, 0.66)}
"""Solid fraction of release and bed [-]: loose, critical and dense debris. The permeability is that of the paper's
deposit, 1.6e-5 m/s in water; the other values are the defaults."""

FOLLOWS = "follows"
"""Coefficient of consolidation of debris with dilatancy."""

WIDE = {"runout_length": 3500.0, "width": 1000.0}
VALLEYS = {
    "plain of 2°": {"runout_length": 1600.0}, "moved by half a node": {"runout_length": 1600.0, "offset": (0.5, 0.5)},
    "plain of 10°": WIDE | {"slopes": (38.0, 28.0, 10.0)},
}  # fmt: skip
"""The first is that of the example, the second differs from it in nothing but noise."""

LOADING = ("overburden", "proportional", "none")
COMMAND = "python -m benchmarks.paper_speed"


def cases():
    """Yield valley, loading source, coefficient of consolidation [m2 s-1] and resistance of every pair of runs."""
    slow, fast = tsing_shan.CONSOLIDATION
    yield from (("plain of 2°", "overburden", FOLLOWS, name) for name in DILATANCY)
    for valley, loading, c_v in (
        ("plain of 2°", "overburden", slow), ("plain of 2°", "overburden", fast), ("plain of 10°", "overburden", slow),
        ("moved by half a node", "overburden", slow), ("plain of 2°", "proportional", slow),
        ("plain of 10°", "overburden", fast), ("plain of 2°", "none", slow),
    ):  # fmt: skip
        yield from ((valley, loading, c_v, resistance) for resistance in RESISTANCES)


def run(valley, loading, c_v, resistance, model, particles):
    """Return the `Record` of one run and speed and thickness of what erodes as the front leaves erodible ground."""
    dilatant = resistance in DILATANCY
    terrain = VALLEYS[valley] | (WIDE if dilatant or loading != "overburden" else {})
    column = {"law": tsing_shan.COLUMNS[model], "levels": tsing_shan.LEVELS, "loading_source": loading}
    if dilatant:
        column["dilatancy"] = {"permeability": 1.6e-12, "pore_fluid_viscosity": 1e-3}
        material = {"porosity": 1.0 - DILATANCY[resistance]}
    else:
        material = {"coefficient_of_consolidation": c_v}
    grid = tsing_shan_valley(**terrain)
    found = record.Record(grid)
    flow = DebrisFlow(
        grid, friction=RESISTANCES.get(resistance, tsing_shan.FRICTION), erosion=tsing_shan.EROSION,
        material=tsing_shan.MATERIAL | material, column=column,
        numerics={"particle_count": particles, "settle": False},
    )  # fmt: skip
    found.follow(flow, DURATION)
    return found, *at_the_line(found.snapshots.get(("since", 0.0)))


def at_the_line(snapshot):
    """Return speed [m s-1] and thickness [m] of the eroding particles in a snapshot, medians by volume."""
    if snapshot is None:
        return math.nan, math.nan
    p = snapshot["particles"]
    eroding, volume = p.entrainment_rate.values > 0.0, p.volume.values
    if not eroding.any():
        return math.nan, math.nan
    speed = np.sqrt(sum(p[f"velocity_{axis}"].values ** 2 for axis in "xyz"))
    return tuple(float(quantile(of[eroding], volume[eroding], 0.5)) for of in (speed, p.thickness.values))


def compare(valley, loading, c_v, resistance, particles):
    """Return the measures of both models on one line; with dilatancy NaN for the classical model."""
    ale, speed, thickness = run(valley, loading, c_v, resistance, "ALE", particles)
    one, apart = ale.measures, math.nan
    other = dict.fromkeys(one, math.nan)
    if resistance not in DILATANCY:
        classical, *_ = run(valley, loading, c_v, resistance, "classical", particles)
        other, apart = classical.measures, record.first_difference(ale, classical)
    return {
        "speed": speed, "thickness": thickness, "passing": one["passing"], "Pe_b": one["peclet"],
        "apart": apart, "ALE": one["beyond"], "classical": other["beyond"],
        "farther": one["run-out"] - other["run-out"], "deposit ALE": one["mean deposit"],
        "deposit classical": other["mean deposit"], "angle": one["angle"], "eroded": one["eroded"],
        "eroded apart": one["eroded"] - other["eroded"], "outflow": float(np.fmax(one["outflow"], other["outflow"])),
    }  # fmt: skip


HEADS = {
    "speed": ("m/s", "{:.1f}"), "thickness": ("m", "{:.2f}"), "passing": ("s", "{:.1f}"), "Pe_b": ("-", "{:.3g}"),
    "apart": ("s", "{:.1f}"), "ALE": ("m", "{:.0f}"), "classical": ("m", "{:.0f}"), "farther": ("m", "{:.1f}"),
    "deposit ALE": ("m", "{:.2f}"), "deposit classical": ("m", "{:.2f}"), "angle": ("deg", "{:.1f}"),
    "eroded": ("m3", "{:.0f}"), "eroded apart": ("m3", "{:.1f}"), "outflow": ("m3", "{:.0f}"),
}  # fmt: skip
NAMES = {"valley": 22, "loading": 14, "c_v": 8, "resistance": 20}


def report() -> str:
    """Return the text of benchmarks/paper_speed.txt."""
    found = result_files.read("paper_speed")
    lines = [
        f"{found['particles']} particles, {tsing_shan.LEVELS} levels. speed, thickness, Pe_b: medians by volume of "
        "what erodes as the front leaves erodible ground,",
        "at the time passing; apart: first difference of the models in any bit; ALE, classical: run-out of the front "
        "beyond erodible ground, farther:",
        f"their difference after {DURATION:.0f} s; deposit: mean depth there; angle: travel angle of ALE",
        "".join(f"{name:<{width}}" for name, width in NAMES.items())
        + "".join(f"{f'{name} [{unit}]':>{len(name) + len(unit) + 5}}" for name, (unit, _) in HEADS.items()),
    ]
    for row in found["rows"]:
        words = "".join(f"{row[name]!s:<{width}}" for name, width in NAMES.items())
        numbers = (f"{form.format(row[name]):>{len(name) + len(unit) + 5}}" for name, (unit, form) in HEADS.items())
        lines.append(words + "".join(numbers))
    return "\n".join(line.rstrip() for line in lines) + "\n"


SHOWN = {
    "farther": ("plain of 2°", "overburden", 4e-4), "moved": ("moved by half a node", "overburden", 4e-4),
    "steep": ("plain of 10°", "overburden", 4e-4), "proportional": ("plain of 2°", "proportional", 4e-4),
    "none": ("plain of 2°", "none", 4e-4), "fast": ("plain of 2°", "overburden", 0.4),
    "fast steep": ("plain of 10°", "overburden", 0.4),
}  # fmt: skip
"""Valley, loading source and c_v of the differences of run-out that docs/events.md shows."""


def main(particles=PARTICLES, resume=False):
    """Run everything, and keep the results after every pair; with `resume` go on with the result file."""
    rows = result_files.read("paper_speed")["rows"] if resume else []
    done = {tuple(row[name] for name in NAMES) for row in rows}
    for case in cases():
        if case in done:
            continue
        found = {name: float(value) for name, value in compare(*case, particles).items()}
        rows.append(dict(zip(NAMES, case, strict=True)) | found)
        print(case, found, flush=True)
        result_files.keep("paper_speed", {"particles": particles, "rows": rows}, COMMAND)
    charts.make("paper_speed")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--particles", type=int, default=PARTICLES)
    parser.add_argument("--resume", action="store_true", help="go on with the result file")
    options = parser.parse_args()
    main(options.particles, options.resume)
