"""Why S-1000 takes long to come to rest: ``python -m benchmarks.s1000_tail [DATA_DIR]`` from the root of a checkout.

Prints what an earlier stop would save and cut off, what moves the flow in the lower channel at 350 s, and when all
is at rest without erosion and consolidation. The figures of docs/decisions.md, "What S-1000 taught".

    python -m benchmarks.s1000_tail --particles 950,1000,1100,2000,4000,8000

prints where and when the scene of the study of fidelity rests instead, by number of particles. With another version of
the package, installed elsewhere: ``PYTHON -P benchmarks/s1000_tail.py --particles ...``.
"""

import argparse
import logging
import os
import sys
import time
from pathlib import Path

import numpy as np

from landlab_debrisflow import DebrisFlow

if not __package__:  # run as a file: the package that is installed goes before that of the checkout
    sys.path.append(str(Path(__file__).parents[1]))
sys.path.insert(0, str(Path(__file__).parents[1] / "examples"))  # examples are scripts, not a package
import s1000

CHANNEL = 280.0, 560.0  # of the map's y, from the lower left node [m]


def flow_of(data, name, **keywords):
    """Return the flow of `examples/s1000.py` with 2000 particles and some keywords of its own."""
    defaults = {"friction": s1000.FRICTION[name], "erosion": s1000.EROSION, "material": s1000.MATERIAL}
    numerics = {"particle_count": 2000} | keywords.pop("numerics", {})
    return DebrisFlow(s1000.build_grid(data), **(defaults | keywords), numerics=numerics)


def print_rest(data, counts):
    """Print when and where the scene S-1000 of benchmarks/fidelity rests, for some numbers of particles."""
    from benchmarks.fidelity import scenes
    from benchmarks.fidelity.measure import measure

    os.environ["DEBRISFLOW_DATA"] = str(data)
    logging.getLogger("landlab_debrisflow").setLevel(logging.ERROR)  # of what left the grid, of nothing else
    print("particles  at rest [s]  run-out 99 % [m]  centre [m]  eroded [m3]  area [m2]  steps  CPU [s]")
    for count in counts:
        found = measure(lambda: scenes.s1000()._replace(max_duration=3600.0), count)
        print(f"{count:9d}  {found['duration']:11.0f}  {found['run_out']:16.1f}  {found['centre']:10.1f}  "
              f"{found['eroded']:11.0f}  {found['area']:9.0f}  {found['steps']:5d}  {found['seconds']:7.1f}",
              flush=True)  # fmt: skip


def main(data):
    s1000.warm_up(data, s1000.FRICTION["Coulomb"])
    for name in s1000.FRICTION:
        for rest_energy in (1e-2, 1e-4):
            flow = flow_of(data, name, numerics={"rest_energy": rest_energy})
            cpu = time.process_time()
            flow.run_until_rest()
            cpu = time.process_time() - cpu
            print(f"{name}, rest at {rest_energy:g} of the peak energy: {flow.elapsed_time:.0f} s of event, "
                  f"{cpu:.1f} s CPU, eroded {flow.budget['eroded']:.0f} m3")  # fmt: skip

    flow = flow_of(data, "Voellmy")
    flow.run_one_step(350.0)
    sim = flow._simulation
    p = sim.particles
    speed = np.sqrt(np.sum(p.velocity**2, axis=0))
    here = (p.y > CHANNEL[0]) & (p.y < CHANNEL[1]) & (speed > 0.1)
    weight = (p.volume * speed)[here]
    direction = p.velocity[:, here] / speed[here]
    ratio = (p.basal_excess_pore_pressure / p.liquefaction_pressure)[here]
    terms = {
        "speed [m/s]": speed[here],
        "gravity along the flow [m/s2]": -9.81 * direction[2],
        "friction [m/s2]": 9.81 * 0.6 * 990.0 / 1990.0 * (1.0 - ratio) * p.cos_slope[here],
        "thrust along the flow [m/s2]": np.sum(p.thrust[:, here] * direction, axis=0),
        "drag [m/s2]": 9.81 * speed[here] ** 2 / (s1000.TURBULENT_COEFFICIENT * p.thickness[here]),
    }
    print(f"Voellmy at 350 s, {here.sum()} particles in the lower channel, means weighted by volume times speed:")
    for words, values in terms.items():
        print(f"  {words}: {np.average(values, weights=weight):.2f}")

    for c_v in (4e-4, 0.0):
        material = s1000.MATERIAL | {"coefficient_of_consolidation": c_v}
        flow = flow_of(data, "Coulomb", erosion="none", material=material)
        rest = flow.run_until_rest(300.0)
        state = "at rest" if rest else "still moving"
        print(f"Coulomb without erosion, c_v = {c_v:g}: {state} at {flow.elapsed_time:.0f} s")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("data_dir", nargs="?", default=os.environ.get("DEBRISFLOW_DATA"))
    parser.add_argument("--particles", help="numbers with commas between them: print where and when these rest")
    options = parser.parse_args()
    place = s1000.find_data(options.data_dir)
    if options.particles:
        print_rest(place, [int(count) for count in options.particles.split(",")])
    else:
        main(place)
