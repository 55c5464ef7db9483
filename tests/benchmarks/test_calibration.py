"""Coverage of calibrated intervals: the committed figures are those of their rows, and those that a decision states."""

import json
from pathlib import Path

ROOT = Path(__file__).parents[2]
FOUND = json.loads((ROOT / "benchmarks/results/calibration_coverage.json").read_text(encoding="utf-8"))


def test_nine_of_ten_intervals_hold_the_truth_and_a_decision_says_so():
    held = [
        sum(row["intervals"][key][0] <= row["truth"][key] <= row["intervals"][key][1] for row in FOUND["rows"])
        for key in FOUND["summary"]
    ]
    assert FOUND["cases"] == len(FOUND["rows"]) == 100
    assert held == [one["held"] for one in FOUND["summary"].values()]
    assert all(80 <= count <= 97 for count in held)
    words = "{}, {} and {}".format(*held)
    assert words in " ".join((ROOT / "docs/decisions/ensembles.md").read_text(encoding="utf-8").split())
