"""AvaFrame com1DFA 2.1 on two cases of the flow suite, run as a program in an environment of its own.

python -m validation.rivals.com1dfa PYTHON, where PYTHON is an interpreter with ``avaframe==2.1`` (it needs numpy < 2).
A driver and its input files are written to a temporary folder; it leaves one file of arrays, and all errors are taken
here with the norms of the suite. CPU time is process time of com1DFA's time loop, output switched off, one thread.

com1DFA labels its last state one time step later than it is; errors are given at that label and at the true time.
Its thickness lives on a raster, so errors are those of the raster (cells of the kernel radius) and, beside them, of
its particles. The dam break starts from uniformly placed particles: the random ones of its default make the plateau
run ahead. Settings are those of its own tests: sphOption 2, viscOption 1, subgridMixingFactor 10, dt = 0.02 s per metre
of kernel radius, 20 (radius/5 m)^-1.5 particles per kernel radius, explicit friction (with its default, implicit, the
cap hardly leaves rest: 2.1 m/s after 5 s instead of 9.4).
"""

import argparse
import json
import math
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

from landlab_debrisflow.exact import flows
from validation.measure import Result, norms

DRIVER = """
import json, pathlib, sys, time
import numpy as np
from avaframe.com1DFA import com1DFA
from avaframe.in3Utils import cfgUtils, initializeProject
task = json.loads(pathlib.Path(sys.argv[1]).read_text())
folder = task["folder"]
main = cfgUtils.getGeneralConfig()
main["MAIN"]["avalancheDir"], main["MAIN"]["nCPU"] = folder, "1"
for flag in ("savePlot", "createReport", "ReportDir", "reportOneFile", "debugPlot"):
    main["FLAGS"][flag] = "False"
state = {"steps": 0}
one_step, loop = com1DFA.computeEulerTimeStep, com1DFA.DFAIterate
def step(*arguments, **keywords):
    found = one_step(*arguments, **keywords)
    state["particles"], state["fields"] = found[0], found[1]
    state["steps"] += 1
    return found
def timed(*arguments, **keywords):  # runs in a process that com1DFA forks
    begin = time.process_time()
    found = loop(*arguments, **keywords)
    cpu, p, f = time.process_time() - begin, state["particles"], state["fields"]
    np.savez(task["result"], cpu=cpu, steps=state["steps"], FT=f["FT"], Vx=f["Vx"], Vy=f["Vy"], Vz=f["Vz"],
             **{name: p[name] for name in ("x", "y", "h", "m", "ux", "uy", "uz")})
    return found
com1DFA.computeEulerTimeStep, com1DFA.DFAIterate = step, timed
com1DFA.com1DFAMain(main, cfgInfo=pathlib.Path(task["settings"]))
"""

END = 5.0  # [s]
RHO = 200.0


def interpreter(path: str) -> str:
    """Return the path of an interpreter that has com1DFA: looked at before anything runs, for `argparse`."""
    try:
        found = subprocess.run([path, "-c", "import avaframe.com1DFA"], capture_output=True, text=True)
        why = "" if found.returncode == 0 else (found.stderr.strip().splitlines() or ["it failed"])[-1]
    except OSError as error:
        why = str(error)
    if why:
        raise argparse.ArgumentTypeError(f"no interpreter with avaframe==2.1: {path} ({why})")
    return path


def settings(radius, friction_angle, placing) -> str:
    """Return the configuration, as differences from com1DFA's default."""
    general = {
        "simTypeList": "null", "resType": "FT|FV|Vx|Vy|Vz", "tSteps": "", "relThFromFile": "True",
        "secRelArea": "False", "rho": RHO,
        "initPartDistType": placing, "iniStep": "False", "dt": 0.02 * radius, "tEnd": END, "stopCrit": 0.0,
        "sphOption": 2, "viscOption": 1, "subgridMixingFactor": 10.0, "sphKernelRadius": radius, "meshCellSize": radius,
        "massPerParticleDeterminationMethod": "MPPKR", "nPPK0": 20, "sphKR0": 5, "aPPK": -1.5, "splitOption": 0,
        "frictModel": "Coulomb", "mucoulomb": math.tan(math.radians(friction_angle)), "curvAccInFriction": 0,
        "explicitFriction": 1, "dam": "False",
    }  # fmt: skip
    lines = ["[GENERAL]", *(f"{key} = {value}" for key, value in general.items())]
    return "\n".join([*lines, "[VISUALISATION]", "contourResType = FT", "[EXPORTS]", "exportData = False", ""])


def write_raster(path, values, x, y, cell) -> None:
    """Write ESRI ASCII; rows of `values` from south to north."""
    head = f"ncols {x.size}\nnrows {y.size}\nxllcenter {x[0]}\nyllcenter {y[0]}\ncellsize {cell}\nnodata_value -9999\n"
    path.write_text(head + "\n".join(" ".join(f"{v:.6f}" for v in row) for row in values[::-1]) + "\n")


def run(python, radius, angle, friction_angle, extent, thickness, placing):
    """Run com1DFA on a plane of `angle` degrees; return its arrays, and x, y of the raster's cells."""
    tan = math.tan(math.radians(angle))
    x = np.arange(extent[0], extent[1] + 0.5 * radius, radius)
    y = np.arange(extent[2], extent[3] + 0.5 * radius, radius)
    gx, gy = np.meshgrid(x, y)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name) / "case"
        (folder / "Inputs" / "REL").mkdir(parents=True)
        (folder / "Outputs").mkdir()
        write_raster(folder / "Inputs" / "dem.asc", tan * (extent[1] + 100.0 - gx), x, y, radius)
        write_raster(folder / "Inputs" / "REL" / "rel.asc", thickness(gx * math.sqrt(1.0 + tan**2), gy), x, y, radius)
        ini, result, task = Path(name) / "settings.ini", Path(name) / "result.npz", Path(name) / "task.json"
        ini.write_text(settings(radius, friction_angle, placing))
        task.write_text(json.dumps({"folder": str(folder), "settings": str(ini), "result": str(result)}))
        (Path(name) / "driver.py").write_text(DRIVER)
        done = subprocess.run([python, "driver.py", str(task)], cwd=name, capture_output=True, text=True)
        if done.returncode or not result.exists():
            raise RuntimeError(f"com1DFA failed:\n{done.stdout[-2000:]}\n{done.stderr[-4000:]}")
        return dict(np.load(result)), gx, gy


def compare(case, found, gx, gy, angle, radius, solution, inside) -> Result:
    """Compare raster and particles with ``solution(s, y, t) -> h, u, v``."""
    cos = math.cos(math.radians(angle))

    def at(time, x, y):
        h, u, v = solution(x / cos, y, time)
        return h, h * np.stack([u, v])

    here = inside(gx / cos, gy)
    wet = found["FT"][here]
    flux = wet * np.stack([np.hypot(found["Vx"][here], found["Vz"][here]), found["Vy"][here]])
    true, label = found["steps"] * 0.02 * radius, (found["steps"] + 1) * 0.02 * radius
    rows = {}
    for name, time in (("true", true), ("label", label)):
        h, hu = at(time, gx[here], gy[here])
        rows[name] = norms(1.0, wet, h), norms(1.0, flux, hu)
    px, py = found["x"] + gx[0, 0], found["y"] + gy[0, 0]
    used = inside(px / cos, py)
    h, hu = at(true, px[used], py[used])
    speed = np.stack([np.hypot(found["ux"], found["uz"]), found["uy"]])[:, used]
    weight = found["m"][used] / RHO / np.maximum(found["h"][used], 1e-6)
    scalars = {
        "time [s]": float(true), "kernel radius [m]": radius,
        "L2 of h at its label": rows["label"][0].l2, "L2 of hu at its label": rows["label"][1].l2,
        "L1 of h at particles": norms(weight, found["h"][used], h).l1,
        "L2 of h at particles": norms(weight, found["h"][used], h).l2,
        "L2 of hu at particles": norms(weight, found["h"][used] * speed, hu).l2,
    }  # fmt: skip
    n = found["x"].size
    return Result(
        case, "com1DFA", round(math.sqrt(n)), n, int(found["steps"]), float(found["cpu"]), *rows["true"], scalars
    )


def similarity(python, radius) -> Result:
    """Run the similarity solution: 35 degrees, friction 25, a cap of 80 m by 4 m, 5 s."""

    def thickness(s, y):
        return 4.0 * np.maximum(0.0, 1.0 - (s**2 + y**2) / 6400.0)

    def everywhere(s, y):
        return np.ones(np.shape(s), bool)

    found, gx, gy = run(python, radius, 35.0, 25.0, (-200.0, 1800.0, -250.0, 250.0), thickness, "random")
    return compare("similarity", found, gx, gy, 35.0, radius, flows.similarity, everywhere)


def dam_break(python, radius) -> Result:
    """Run the dam break: 22 degrees, friction 21, a reservoir of 60 m by 60 m by 1 m, 5 s; its middle 12 m."""
    slope, friction = math.radians(22.0), math.tan(math.radians(21.0))
    cos = math.cos(slope)
    half = radius * round(30.0 / radius)

    def thickness(s, y):
        return np.where((abs(y) < half) & (s * cos > -2.0 * half) & (s < 0.0), 1.0, 0.0)

    def solution(s, y, t):
        h, u = flows.mangeney(s, t, 1.0, slope, friction)
        return h, u, 0.0 * h

    def inside(s, y):
        return (abs(y) < 6.0) & (s > -18.0)

    extent = (-150.0 - 0.5 * radius, 150.0, -100.0 - 0.5 * radius, 100.0)
    found, gx, gy = run(python, radius, 22.0, 21.0, extent, thickness, "uniform")
    return compare("dam break 22/21", found, gx, gy, 22.0, radius, solution, inside)


def results(python, quick=False):
    """Yield the results of all cases."""
    for radius in (10.0, 5.0) if quick else (10.0, 5.0, 3.0):
        yield similarity(python, radius)
    for radius in (5.0,) if quick else (5.0, 3.0, 2.0):
        yield dam_break(python, radius)


def main():
    for one in results(sys.argv[1]):
        print(f"{one.case}: {one.particles} particles, {one.steps} steps, {one.cpu:.2f} CPU s, {one.rate:.2f} M/s")
        print(f"  h {one.h}\n  hu {one.hu}\n  {one.scalars}", flush=True)


if __name__ == "__main__":
    main()
