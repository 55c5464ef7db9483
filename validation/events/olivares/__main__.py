"""Choose a set on five flows for the sixth; shift releases by half a cell: ``python -m validation.events.olivares``.

The first is kept in family.json, the second with the scores. An hour or two; members that are kept are not run again.
"""

import argparse
from dataclasses import replace

from ..record import add_scores
from . import EVENT, references, score
from .leave_one_out import run_family
from .setup import read_observed, run_flows

MEMBER_PARTICLES = 1000
"""Of the runs by which a set is chosen; the chosen one is scored with the number of the event."""
SHIFTS = {"east": (0.5, 0.0), "north": (0.0, 0.5), "west": (-0.5, 0.0), "south": (0.0, -0.5)}


def main() -> None:
    """Run the family and the shifted releases."""
    parser = argparse.ArgumentParser(prog="python -m validation.events.olivares", description=__doc__.splitlines()[0])
    parser.add_argument("--choice", action="store_true", help="only the choice of sets")
    parser.add_argument("--shifts", action="store_true", help="only the shifted releases")
    options = parser.parse_args()
    both, centre = options.choice == options.shifts, EVENT.read_set()
    if options.choice or both:
        run_family(read_observed(), centre, MEMBER_PARTICLES, EVENT.particle_count, print)
    for words, shift in SHIFTS.items() if options.shifts or both else ():
        result = run_flows(centre, EVENT.particle_count, shift)
        shifted = replace(centre, change=f"release half a cell to the {words}")
        add_scores(EVENT, shifted, EVENT.particle_count, score(result), references(result))
        print(f"{shifted.change}: median IoU {score(result)['median iou']:.3f}")


if __name__ == "__main__":
    main()
