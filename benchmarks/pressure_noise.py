"""Do films, noise of the thickness and the number of particles make pore pressure? python -m benchmarks.pressure_noise

First columns alone: they start at the pressure ratio 0.5, thin to a seventh, stay so over 200 steps in which the
thickness is noisy, and pile up to where they were. Without drainage the ratio they end with is that of the start.

Then flows: the saturated slip of benchmarks/fidelity, as it is and without drainage, and S-1000 (folder of its rasters
in $DEBRISFLOW_DATA) from few to many particles, in the mean of three numbers within 2 %. Printed are run-out and area,
the 99 % quantile of the peak pressure ratio over the nodes of that area, the eroded volume and the time to rest.

--columns leaves the flows out. Another version that is installed elsewhere is measured by its own interpreter, as a
file: PYTHON -P benchmarks/pressure_noise.py
"""

import argparse
import logging
import sys
from functools import partial
from pathlib import Path

import numpy as np

if not __package__:  # run as a file: the package that is installed goes before that of the checkout
    sys.path.append(str(Path(__file__).parents[1]))

from benchmarks.fidelity.measure import measure
from benchmarks.fidelity.scenes import MissingDataError, s1000, saturated_slip
from landlab_debrisflow.physics.column import ALE
from landlab_debrisflow.physics.column.driver import Columns

LOAD_PER_METRE = 990.0 * 9.81  # buoyant density times gravity [Pa m-1]
START, FILM, STEPS, COUNT = 0.5, 1.0 / 7.0, 200, 100  # ratio [-], thickness [m], steps of the film, columns
NOISE = (0.0, 0.1, 0.3)  # largest, over the thickness [-]
PARTICLES = (500, 1000, 2000, 4000)
MORE = ("", "more=1.5", "more=-1.5")  # variations of benchmarks/fidelity
SHOWN = {
    "run_out": "run-out [m]", "area": "area [m2]", "pressure": "ratio [-]", "eroded": "eroded [m3]",
    "duration": "at rest [s]",
}  # fmt: skip


def ratio_after_film(noise: float) -> float:
    """Return the mean pressure ratio [-] of columns that went through a film with a `noise` of its thickness [-]."""
    rng, one = np.random.default_rng(1), np.ones(COUNT)
    start = np.outer(START * LOAD_PER_METRE * one, np.linspace(1.0, 0.0, 11))
    columns = Columns(ALE(), start, one, liquefaction_pressure=LOAD_PER_METRE * one)
    for step in range(STEPS + 1):
        thickness = FILM * (1.0 + noise * rng.uniform(-1.0, 1.0, COUNT)) if step < STEPS else one
        base = columns.step(0.1, thickness=thickness, liquefaction_pressure=LOAD_PER_METRE * thickness)
    return float(base.mean() / LOAD_PER_METRE)


def undrained_slip():
    """Return the saturated slip with c_v = 0."""
    scene = saturated_slip()
    material = scene.keywords["material"] | {"coefficient_of_consolidation": 0.0}
    return scene._replace(keywords=scene.keywords | {"material": material})


SCENES = {"saturated slip": saturated_slip, "without drainage": undrained_slip, "S-1000": s1000}


def mean_of_runs(make, particles: int) -> dict[str, float]:
    """Return the quantities of `SHOWN`, in the mean over runs of nearly the same number of particles."""
    runs = [measure(make, particles, variation) for variation in MORE]
    return {name: float(np.mean([run[name] for run in runs])) for name in SHOWN}


def main(arguments=None) -> int:
    """Print both tables."""
    logging.getLogger("landlab_debrisflow").setLevel(logging.ERROR)
    parser = argparse.ArgumentParser(prog="python -m benchmarks.pressure_noise", description=__doc__.splitlines()[0])
    parser.add_argument("--columns", action="store_true", help="columns only")
    parser.add_argument("--scenes", default=",".join(SCENES), help="names with commas between them")
    parser.add_argument("--particles", default=",".join(map(str, PARTICLES)), help="numbers with commas between them")
    options = parser.parse_args(arguments)
    show = partial(print, flush=True)
    for noise in NOISE:
        show(f"film with noise of {noise:4.0%}: ratio {START:.2f} becomes {ratio_after_film(noise):.2f}")
    if options.columns:
        return 0
    show(f"{'':17}{'particles':>10}" + "".join(f"{words:>14}" for words in SHOWN.values()))
    for name in options.scenes.split(","):
        for particles in map(int, options.particles.split(",")):
            try:
                found = mean_of_runs(SCENES[name], particles)
            except MissingDataError as error:
                show(f"{name}: left out, {error}")
                break
            show(f"{name:17}{particles:10}" + "".join(f"{found[quantity]:14.5g}" for quantity in SHOWN))
    return 0


if __name__ == "__main__":
    sys.exit(main())
