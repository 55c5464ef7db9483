"""Where flow models fail, at full size: python -m benchmarks.flow_stability [words of the cases to run]

Every scene of validation/cases/stability.py, the failures of docs/theory.md#failures about the flow, without friction
unless the case says so. Printed per case: time steps and CPU time of one thread; the largest speed, and what the fall
alone allows that particle, (2 g (top - z))^(1/2); how far all stay below the bound with waves, (2 g (top - z))^(1/2) +
2 (g h)^(1/2); the highest head of a particle over the top of the body at rest (half a failing cell beyond its nodes
included); the largest rise of the energy of the whole body, per weight, until something leaves the grid; the root mean
square of the speed at the end; the residual of the volume. (Without pressure the energy of the thickness is no part of
the account.)

If all cases are run, they are kept in benchmarks/results/flow_stability.json with the energy gained against the length
of the step; from it benchmarks/flow_stability.txt and docs/figures/flow_stability.png are made.
"""

import argparse
import math
import sys

import numpy as np
from rich.console import Console
from rich.table import Table

from benchmarks import charts, result_files, style
from landlab_debrisflow.core.errors import SimulationError
from validation.cases import stability as scenes
from validation.watch import NoThrust, Scene

LIMIT = 1.22
"""Longest stable step in smoothing lengths over celerity (docs/decisions.md, Flow 2)."""

HEADINGS = (
    "case", "particles", "steps", "CPU [s]", "speed [m/s]", "by fall [m/s]", "below bound [m/s]", "head over top [m]",
    "energy gained [m]", "speed at end [m/s]", "volume residual",
)  # fmt: skip


def cases():
    """Yield the name of each case and what builds its scene."""
    bowl, period = scenes.bowl, scenes.period
    for shift, word in ((0.0, "curved surface"), (30.0, "swinging aside")):
        yield (
            f"Thacker, {word}, two periods",
            lambda s=shift: Scene(bowl(shift=s), 2.0 * period(s), count=32000, looks=40),
        )
    for depth in (5.0, 20.0):
        yield f"gully one cell wide, {depth:g} m", lambda d=depth: Scene(scenes.gully(d), 12.0, count=4000)
    for height in (50.0, 200.0):
        yield f"cliff of {height:g} m", lambda h=height: Scene(scenes.cliff(h), 10.0, count=4000)
    for depth in (5.0, 20.0, 100.0):
        yield f"pit of one node, {depth:g} m", lambda d=depth: Scene(scenes.pit(d), 20.0, count=1000)
        yield (
            f"the same without pressure, {depth:g} m",
            lambda d=depth: Scene(scenes.pit(d), 20.0, count=300, flow=NoThrust()),
        )
    for amplitude in (1.0, 2.0):
        yield f"noise of {amplitude:g} m on 5 m", lambda a=amplitude: Scene(scenes.noisy_slope(a), 14.0, count=4000)
        yield (
            f"the same with 15 deg, {amplitude:g} m",
            lambda a=amplitude: Scene(scenes.noisy_slope(a), 60.0, 15.0, count=4000),
        )
    yield "wall of closed nodes", lambda: Scene(scenes.walls(), 60.0, count=2000)
    yield "wall with a gap", lambda: Scene(scenes.walls(True), 60.0, count=2000)
    yield "steep corner of closed nodes", lambda: Scene(scenes.steep_corner(), 5.0, count=1000)
    for count in (1, 100):
        yield (
            f"release of one cell, {count}",
            lambda n=count: Scene(scenes.plane(0.5, 1.0, half_width=2.0), 10.0, count=n),
        )
    yield "release of 1e6 m3, 12 deg", lambda: Scene(scenes.wide_release(1e6), 60.0, 12.0, count=8000)
    for degrees in (0.0, 80.0):
        for h in (1e-3, 1.0, 100.0):
            yield (
                f"slope of {degrees:g} deg, {h:g} m",
                lambda d=degrees, h=h: Scene(scenes.plane(math.tan(math.radians(d)), h), 2.0, count=1000),
            )
    yield "stretched front, 20 deg", lambda: Scene(scenes.plane(0.5, 1.0, columns=241), 20.0, 20.0, count=2000)
    for amplitude in (0.0, 0.2, 1.0):
        yield f"still water, noise of {amplitude:g} m", lambda a=amplitude: Scene(scenes.basin(a), 4000.0, count=500)
    yield "the same with 1 deg of friction, 1 m", lambda: Scene(scenes.basin(1.0), 4000.0, 1.0, count=500)


def measure(name, scene):
    """Run one case; return its row of the table."""
    print(name, file=sys.stderr)
    scene.run()
    w = scene.watch
    end = float(np.sqrt(np.mean(scene.speeds**2))) if scene.speeds.size else 0.0
    return (
        name, f"{scene.flow.setup.numerics.particle_count}", f"{len(scene.steps.lengths)}", f"{scene.cpu:.1f}",
        f"{w.speed:.3g}", f"{w.allowed:.3g}", f"{-w.excess:.3g}", f"{w.head:+.2f}", f"{w.gain:.1e}",
        f"{end:.1e}", f"{scene.imbalance:.0e}",
    )  # fmt: skip


def lip(height):
    """Return the lip of the surface over the edge of a cliff [m] and the part of the body that stays behind it [-]."""
    scene = Scene(scenes.cliff(height), 30.0, 10.0, count=800).run()
    x = np.linspace(95.0, 100.0, 101)  # from the last node above to the first below
    y = np.full(x.size, 100.0)
    z = scene.flow._simulation.bed.surface.sample(np.concatenate([x - 5.0, x]), np.concatenate([y, y]))[0]
    edge = scene.grid.at_node["topographic__elevation"].reshape(scene.grid.shape)[20, 19]
    p = scene.flow.particles
    return float(z.max() - edge), float(p.volume.values[p.x.values < 97.0].sum()) / scene.flow.budget["released"]


def gains(factors, viscosity, count=2000):
    """Return the energy gained in the bowl over a period, over the kinetic energy of the exact solution, per step.

    The limit by node spacing, which would hold the longer steps back, is lifted.
    """
    found = []
    for factor in factors:
        scene = Scene(scenes.bowl(), scenes.period(), count=count, looks=20, numerics={"shock_viscosity": viscosity})
        numerics = scene.flow.setup.numerics
        for name, number in (("courant_number", factor * LIMIT), ("advective_courant_number", 1e3)):
            object.__setattr__(numerics, name, number)  # past the check
        try:
            scene.run()
        except SimulationError:  # the end of what has blown up
            found.append(math.nan)
            continue
        left = scene.flow.budget["outflow"] > 0.0
        found.append(math.nan if left else max(scene.watch.gain, 1e-9) / 0.0344)
    return found


FACTORS = np.array([0.25, 0.35, 0.49, 0.6, 0.7, 0.82, 0.9, 1.0, 1.15, 1.35, 1.6, 2.0])
"""Lengths of the step over the limit [-]."""

VISCOSITIES = {0.5: "D", 1.0: "o", 3.0: "^"}
CLIFFS = (10.0, 50.0, 100.0, 200.0)


def chart():
    """Return the figure: the energy gained against the length of the step."""
    rows = result_files.read("flow_stability")["energy gained"]
    figure, axes = style.panels(1, 1, (7.6, 4.9))
    axis = axes[0, 0]
    for row, colour in zip(rows, (style.BLUE, style.ORANGE, style.GREEN), strict=True):
        viscosity = row["shock viscosity"]
        words = f"{viscosity:g}" + (" (default)" if viscosity == 1.0 else "")
        words += ", steps shortened" if viscosity > 1.0 else ""
        mark = {"marker": VISCOSITIES[viscosity], "ms": 5, "lw": 1.2, "color": colour}
        axis.plot(row["step over limit"], row["gained"], label=words, **mark)
    place = {"xycoords": ("data", "axes fraction"), "rotation": 90, "va": "top", "ha": "right", "fontsize": 9}
    for number, line, words in ((1.0, ":", "longest allowed"), (0.6, "--", "default")):
        axis.axvline(number / LIMIT, color="0.4", lw=1, ls=line)
        axis.annotate(f"{words} ", (number / LIMIT, 0.98), **place)
    style.finish(
        axis, yscale="log", ylim=(1e-5, 300.0), xlabel="time step over the stability limit [-]",
        ylabel="energy gained in one period\nover the kinetic energy [-]",
        title="Basin of Thacker with a curved surface, 2000 particles; lines end where a run became unstable",
    )  # fmt: skip
    title = f"shock viscosity (limit of the step: {LIMIT:g} smoothing lengths over celerity)"
    style.legend_below(figure, axis, ncol=3, title=title)
    return figure


def table(rows, title="Where flow models fail") -> Table:
    """Return the table of cases."""
    made = Table(title=title, title_justify="left")
    for heading in HEADINGS:
        made.add_column(heading, justify="left" if heading == "case" else "right")
    for row in rows:
        made.add_row(*row)
    return made


def report() -> str:
    """Return the text of benchmarks/flow_stability.txt."""
    found = result_files.read("flow_stability")

    def show(console):
        console.print(table(found["cases"]))
        for row in found["cliffs"]:
            console.print(
                f"cliff of {row['height [m]']:g} m, 10 deg: surface up to {row['above its edge [m]']:.1f} m above its "
                f"edge, {row['stays behind it']:.0%} stays behind it"
            )

    return charts.printed(show, width=180)


def main(words):
    rows = [measure(name, build()) for name, build in cases() if not words or any(word in name for word in words)]
    if words:
        Console(width=180).print(table(rows))
        return
    cliffs = []
    for height in CLIFFS:
        above, behind = lip(height)
        cliffs.append({"height [m]": height, "above its edge [m]": above, "stays behind it": behind})
    gained = [
        {"shock viscosity": viscosity, "step over limit": FACTORS, "gained": gains(FACTORS, viscosity)}
        for viscosity in VISCOSITIES
    ]
    data = {"cases": rows, "cliffs": cliffs, "energy gained": gained}
    result_files.keep("flow_stability", data, "python -m benchmarks.flow_stability")
    charts.make("flow_stability")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("words", nargs="*", help="of the names of cases; by default all are run and kept")
    words, names = parser.parse_args().words, [name for name, _ in cases()]
    if words and not any(word in name for word in words for name in names):
        parser.error(f"no case has {' or '.join(words)} in its name; there are: {'; '.join(names)}")
    main(words)
