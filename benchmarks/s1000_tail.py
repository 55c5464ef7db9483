"""Why S-1000 takes long to come to rest: ``python -m benchmarks.s1000_tail [DATA_DIR]`` from the root of a checkout.

Prints what an earlier stop would save and cut off, what moves the flow in the lower channel at 350 s, and when all
is at rest without erosion and consolidation. The figures of docs/decisions.md, "What S-1000 taught".
"""

import os
import sys
import time
from pathlib import Path

import numpy as np

from landlab_debrisflow import DebrisFlow

sys.path.insert(0, str(Path(__file__).parents[1] / "examples"))  # examples are scripts, not a package
import s1000

CHANNEL = 280.0, 560.0  # of the map's y, from the lower left node [m]


def flow_of(data, name, **keywords):
    """Return the flow of `examples/s1000.py` with 2000 particles and some keywords of its own."""
    defaults = {"friction": s1000.FRICTION[name], "erosion": s1000.EROSION, "material": s1000.MATERIAL}
    numerics = {"particle_count": 2000} | keywords.pop("numerics", {})
    return DebrisFlow(s1000.build_grid(data), **(defaults | keywords), numerics=numerics)


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
    main(s1000.find_data(sys.argv[1] if len(sys.argv) > 1 else os.environ.get("DEBRISFLOW_DATA")))
