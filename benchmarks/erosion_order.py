"""Errors of the time step where a flow erodes, by rule: ``python -m benchmarks.erosion_order [--particles 1500]``.

A particle that slides onto soil (validation/cases/soil_edge.py), and the demo's valley, with steps as by default and 2
and 4 times as short, against steps 16 times as short (32 times for the particle). Each rule is switched off once: soil
taken where a step begins, and half a node as the longest way over any ground. Takes three minutes.
"""

import argparse
from contextlib import ExitStack
from unittest import mock

import numpy as np

from benchmarks import result_files
from landlab_debrisflow import DebrisFlow
from landlab_debrisflow.cli.demo import MATERIAL
from landlab_debrisflow.model import entrainment, step_rule
from landlab_debrisflow.scene import tsing_shan_valley
from validation.cases.soil_edge import cross_edge

MIDDLE, HALF = (entrainment, "EROSION_TIME", 0.0), (step_rule, "EVEN", 1.0)
RULES = {"as it is": (), "half a node at most": (HALF,), "soil at the beginning": (MIDDLE,), "both": (HALF, MIDDLE)}
"""Constants to be replaced, by rule: module, name and value."""
TIMES = 20.0, 30.0, 36.0
SHORTER, REFERENCE = (1, 2, 4), 16
NAMES = "steps", "centre 20 s", "centre 30 s", "centre 36 s", "volume 36 s", "speed 36 s", "centre at rest", "eroded"
UNITS = "", "m", "m", "m", "%", "%", "m", "%"


def valley(particles, shorter):
    """Return what `NAMES` says of the demo's valley with steps `shorter` times as short, in SI units."""
    numerics = {"particle_count": particles, "courant_number": 0.6 / shorter, "advective_courant_number": 0.5 / shorter}
    flow, centres = DebrisFlow(tsing_shan_valley(), material=MATERIAL, numerics=numerics), []
    for time in TIMES:
        flow.run_one_step(time - flow.elapsed_time)
        p = flow.particles
        weight, volume = p.volume / p.volume.sum(), float(p.volume.sum())
        centres.append(float((p.x * weight).sum()))
    speed = float((np.sqrt(p.velocity_x**2 + p.velocity_y**2 + p.velocity_z**2) * weight).sum())
    flow.run_until_rest()
    deposit = flow.grid.at_node["debris_flow__deposit_depth"]
    rest = float(flow.grid.x_of_node @ deposit / deposit.sum())
    return np.array([flow.diagnostics.steps, *centres, volume, speed, rest, flow.budget["eroded"]])


def with_rule(changes, measure, *arguments):
    """Return what a function returns while some constants are replaced."""
    with ExitStack() as stack:
        for module, name, value in changes:
            stack.enter_context(mock.patch.object(module, name, value))
        return measure(*arguments)


def main(particles):
    exact, _, _ = cross_edge(32.0)
    edge = {
        rule: [with_rule(changes, cross_edge, float(shorter))[0] - exact for shorter in SHORTER]
        for rule, changes in RULES.items()
    }
    reference = valley(particles, REFERENCE)
    relative, errors = np.array([unit == "%" for unit in UNITS]), {}
    for rule, changes in RULES.items():
        errors[rule] = []
        for shorter in SHORTER:
            found = with_rule(changes, valley, particles, shorter)
            error = np.where(relative, 100.0 * (found / reference - 1.0), found - reference)
            errors[rule].append([found[0], *error[1:]])
    result_files.keep(
        "erosion_order",
        {"particles": particles, "names": NAMES, "units": UNITS, "shorter": SHORTER, "edge": edge, "valley": errors},
        "python -m benchmarks.erosion_order",
    )
    print(report())


def report() -> str:
    """Return the table."""
    kept = result_files.read("erosion_order")
    heads = [f"{name} [{unit}]" if unit else name for name, unit in zip(kept["names"], kept["units"], strict=True)]
    lines = [f"errors, {kept['particles']:.0f} particles".ljust(30) + "  steps/  edge [m3]  " + "  ".join(heads)]
    for rule, rows in kept["valley"].items():
        for shorter, row, edge in zip(kept["shorter"], rows, kept["edge"][rule], strict=True):
            cells = [f"{row[0]:.0f}".rjust(5), *(f"{x:+.3f}" for x in row[1:])]
            cells = [cell.rjust(len(head)) for cell, head in zip(cells, heads, strict=True)]
            lines.append(f"{rule:30s}  {shorter:6.0f}  {edge:+9.5f}  " + "  ".join(cells))
    return "\n".join(lines)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--particles", type=int, default=1500)
    main(parser.parse_args().particles)
