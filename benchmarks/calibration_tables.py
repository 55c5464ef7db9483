"""Tables of docs/events.md on the calibration of two landslides, from its result files."""

from collections.abc import Mapping

from . import result_files

NAMES = {"s1000": "S-1000", "cascade2009": "Cascade Mountains 2009"}
LAWS = {
    "growth": "calibration_s1000", "shear_excess": "calibration_s1000_shear_excess",
    "excess_traction": "calibration_s1000_excess_traction",
}  # fmt: skip
"""Result files of the calibrations of S-1000 by their law of erosion."""
FORMATS = {
    "csi outside": ("CSI", "{:.3f}"), "correlation outside": ("correlation", "{:+.2f}"),
    "lowered outside": ("lowered [m³]", "{:.0f}"), "in scar": ("in the scar [m³]", "{:.0f}"),
    "toe": ("toe [m]", "{:+.0f}"),
}  # fmt: skip
"""Columns by the names of scores, as in `validation.events.s1000.measures`."""

Rows = tuple[list[str], list[list[str]]]


def scores(name: str) -> Rows:
    """Return heads and rows of the scores of a calibrated event, in sample."""
    found = result_files.read(f"calibration_{name}")
    return ["in sample", *_heads()], [_row(words, values) for words, values in found["scores"].items()]


def laws() -> Rows:
    """Return heads and rows of the scores of S-1000 with each law of erosion, in sample."""
    rows = []
    for law, file in LAWS.items():
        found = result_files.read(file)["scores"]
        rows += [
            _row(f"`{law}`, {words}", found[words]) for words in ("best member", "posterior mean", "2000 particles")
        ]
    return ["in sample, S-1000", *_heads()], rows


def reached() -> Rows:
    """Return heads and rows of what any run of S-1000 reached, by law of erosion."""
    rows = []
    for law, file in LAWS.items():
        found = result_files.read(file)
        best = found["reached"]
        values = [f"{best['csi outside']:.3f}", f"{best['correlation outside']:+.2f}", f"{best['bounds kept']} of 5"]
        rows.append([f"`{law}`", str(best["members"]), *values, f"{found['effective_size']:.1f}"])
    heads = [
        "law of erosion",
        "runs",
        "highest CSI",
        "highest correlation",
        "most aims of one run",
        "effective sample size",
    ]
    return heads, rows


def predictions() -> Rows:
    """Return heads and rows of the scores of each event with the posterior and the prior of the other one."""
    rows = []
    for name, words in NAMES.items():
        found = result_files.read(f"calibration_{name}")["prediction"]
        event = NAMES[found["event"]]
        for key, values in found.items():
            if isinstance(values, Mapping):
                told = f"{event}, posterior of {words}" if key == "posterior" else f"{event}, {key}"
                rows.append(_row(told, values))
    return ["out of sample", *_heads()], rows


def intervals() -> Rows:
    """Return heads and rows of the 90 % intervals of both posteriors."""
    found = {name: result_files.read(f"calibration_{name}") for name in NAMES}
    rows = []
    for key in found["s1000"]["intervals"]:
        ends = [found[name]["intervals"][key] for name in NAMES]
        rows.append([f"`{key}`", *(f"{low:.3g} to {high:.3g}" for low, high in ends)])
    shares = [found[name]["loading_source"].get("proportional", 0.0) for name in NAMES]
    rows.append(["probability of `column.loading_source: proportional`", *(f"{share:.2f}" for share in shares)])
    rows.append(["effective sample size", *(f"{found[name]['effective_size']:.1f}" for name in NAMES)])
    return ["90 % interval", *NAMES.values()], rows


def coverage() -> Rows:
    """Return heads and rows of how often 90 % intervals hold the truth, by effective sample size."""
    found = result_files.read("calibration_coverage")
    groups = {
        "all": found["rows"],
        "effective size of 60 or more": [row for row in found["rows"] if row["effective_size"] >= 60.0],
        "below 30": [row for row in found["rows"] if row["effective_size"] < 30.0],
    }
    heads = ["intervals that hold the truth", *(f"{words}: {len(rows)} cases" for words, rows in groups.items())]
    heads.append("width over that of the prior")
    rows = []
    for key, one in found["summary"].items():
        held = [f"{100.0 * sum(row['held'][key] for row in part) / len(part):.0f} %" for part in groups.values()]
        rows.append([f"`{key}`", *held, f"{one['width over prior']:.2f}"])
    return heads, rows


def _heads() -> list[str]:
    return [words for words, _ in FORMATS.values()]


def _row(words: str, values: Mapping[str, float]) -> list[str]:
    return [words, *(form.format(values[key]) for key, (_, form) in FORMATS.items())]
