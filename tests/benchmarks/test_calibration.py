"""Coverage of calibrated intervals: the committed figures are those of their rows, and those that pages state."""

import json
import re
from pathlib import Path

import numpy as np

ROOT = Path(__file__).parents[2]
FOUND = json.loads((ROOT / "benchmarks/results/calibration_coverage.json").read_text(encoding="utf-8"))


def test_nine_of_ten_intervals_hold_the_truth_and_pages_say_so():
    held = [
        sum(row["intervals"][key][0] <= row["truth"][key] <= row["intervals"][key][1] for row in FOUND["rows"])
        for key in FOUND["summary"]
    ]
    assert FOUND["cases"] == len(FOUND["rows"]) == 100
    assert held == [one["held"] for one in FOUND["summary"].values()]
    assert all(80 <= count <= 97 for count in held)
    words = "{}, {} and {}".format(*held)
    for name in ("docs/calibration.md", "docs/decisions/ensembles.md"):
        assert words in " ".join((ROOT / name).read_text(encoding="utf-8").split())


def test_intervals_of_members_that_count_are_told_from_those_that_do_not():
    size = np.array([row["effective_size"] for row in FOUND["rows"]])
    held = np.array([np.mean(list(row["held"].values())) for row in FOUND["rows"]])
    parts = [f"{100.0 * held[chosen].mean():.0f} %" for chosen in (size >= 60.0, size < 30.0)]
    text = " ".join((ROOT / "docs/calibration.md").read_text(encoding="utf-8").split())
    counts = re.search(r"In the (\d+) cases with .* (\d+ %) did, in the (\d+) with less than 30 only (\d+ %)", text)
    assert counts.groups() == (str((size >= 60.0).sum()), parts[0], str((size < 30.0).sum()), parts[1])
