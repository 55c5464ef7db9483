"""Two phases of the engine against the converged finite-volume reference: ``python -m benchmarks.two_phase``.

The strips and the errors are those of `validation.cases.two_phase_strips`. Also writes docs/two_phase.png.
"""

import argparse
from pathlib import Path

from validation.cases import two_phase_strips as strips

COUNTS = (500, 2000, 8000)


def draw(flows, path) -> None:
    """Draw depths and velocities of both phases: particles over the reference."""
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(len(flows), 2, figsize=(10.0, 3.2 * len(flows)), layout="constrained", squeeze=False)
    for (name, flow), row in zip(flows.items(), axes, strict=True):
        found = strips.reference(name)
        for phase, colour in zip(strips.PHASES, ("#a0522d", "#1f77b4"), strict=True):
            s, h, v, _ = strips.profile(flow, phase)
            depth, velocity = (getattr(found, f"{quantity}_{phase[0]}")[-1] for quantity in "hv")
            wet = depth > 1e-3
            for axis, at_particles, exact in ((row[0], h, depth), (row[1], v, velocity)):
                axis.plot(s, at_particles, ".", color=colour, markersize=2, alpha=0.4, rasterized=True)
                axis.plot(found.x[wet], exact[wet], color=colour, linewidth=1.2, label=phase)
        for axis, label in zip(row, ("thickness of the phase [m]", "velocity down the plane [m/s]"), strict=True):
            axis.set(xlabel="distance down the plane [m]", ylabel=label)
            axis.set_title(f"{name}, {strips.CASES[name].time:g} s, {s.size} particles of each phase", fontsize=9)
        row[0].legend(title="lines: finite volumes", fontsize=8, title_fontsize=8)
    figure.savefig(path, dpi=120)


def main(counts=COUNTS) -> None:
    """Print the table and draw the figure."""
    print(
        f"relative L1 errors against finite volumes of {strips.CELLS} cells; N particles of each phase, "
        f"{strips.ACROSS} across"
    )
    print(f"{'case':16s}{'N':>6s}{'steps':>7s}{'CPU s':>8s}" +
          "".join(f"{name:>9s}" for name in ("h_s", "h_w", "h_s v_s", "h_w v_w")))  # fmt: skip
    drawn = {}
    for name in strips.PLACES:
        strips.run(name, 100)  # loads or compiles
        for count in counts:
            flow, cpu, steps = strips.run(name, count)
            print(f"{name:16s}{count:6d}{steps:7d}{cpu:8.2f}" + "".join(f"{e:9.4f}" for e in strips.errors(flow, name)),
                  flush=True)  # fmt: skip
            if name != "tight_friction" and count == counts[min(1, len(counts) - 1)]:
                drawn[name] = flow
    draw(drawn, Path(__file__).parents[1] / "docs" / "two_phase.png")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("counts", nargs="*", type=int, default=COUNTS, help="numbers of particles of each phase")
    main(tuple(parser.parse_args().counts))
