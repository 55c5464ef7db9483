"""Tables of pages of docs/, written from result files between markers: they cannot drift from the charts.

In the page stands ``<!-- table NAME -->``, then the table, then ``<!-- end -->``. `fill` writes all of them;
tests/benchmarks/test_charts.py compares.
"""

import math
import re
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

import numpy as np

from benchmarks import calibration_tables, result_files, step_tables
from benchmarks import column as columns
from benchmarks import flow as flows
from benchmarks import paper_speed as speeds
from benchmarks.example_scripts import load

PAGES = tuple(
    result_files.ROOT / "docs" / name for name in ("accuracy.md", "calibration.md", "time_steps.md", "events.md")
)
MARKED = re.compile(r"(<!-- table (\w+) -->\n).*?(<!-- end -->)", re.DOTALL)


def fill() -> Iterator[Path]:
    """Write the tables of all pages; yield the pages that changed."""
    for page in PAGES:
        before = page.read_text(encoding="utf-8")
        if (after := filled(before)) != before:
            page.write_text(after, encoding="utf-8")
            yield page


def filled(text: str) -> str:
    """Return the text of a page with its tables written anew."""
    return MARKED.sub(lambda found: f"{found[1]}{TABLES[found[2]]()}{found[3]}", text)


def table(heads: Sequence[str], rows: Iterable[Sequence[str]], other: str = "---:") -> str:
    """Return a table of Markdown; `other` tells how columns but the first are aligned, by default as numbers."""
    lines = ["| " + " | ".join(heads) + " |", "|---|" + f"{other}|" * (len(heads) - 1)]
    return "\n".join([*lines, *("| " + " | ".join(row) + " |" for row in rows)]) + "\n"


def percent(value: float) -> str:
    """Return an error in per cent with two digits; below a hundredth of a per cent as a power of ten."""
    size = abs(100.0 * value)
    if math.isnan(size):
        return ""
    if size == 0.0 or size >= 0.01:
        return f"{100.0 * value:.2g} %"
    return f"{value:.0e}".replace("e-0", "e-")


def seconds(value: float) -> str:
    """Return a time with two digits."""
    return f"{value:.2g}"


# ---- flow ----


def rivals() -> str:
    """Return the finest run of every method on every case of the chart: errors and CPU time."""
    found = flows.kept()
    rows, methods = [], flows.methods(found)
    for case, title in flows.TITLES.items():
        row = [title]
        for method in methods:
            these = [r for r in found if (r.case, r.method) == (case, method)]
            row.append(f"{100.0 * these[-1].h.l1:.2g} ({seconds(these[-1].cpu)}\N{NO-BREAK SPACE}s)" if these else "–")
        rows.append(row)
    return table(["case", *(words for *_, words in methods.values())], rows)


def single() -> str:
    """Return errors of this package where no other method is compared."""
    found = flows.kept()

    def one(case, particles=None):
        return next(r for r in found if (r.case, r.method) == (case, "ours") and particles in (None, r.particles))

    caps = [one(f"cap {slope} deg", 2000) for slope in (0, 30, 45)]
    walls = one("Ritter walls")
    rows = [
        ("block on 20°, 45°: travel", [one(f"block {slope} deg").scalars["travel error"] for slope in (20, 45)]),
        ("cap of 2000 particles on 0°, 30°, 45°: radius along", [r.scalars["radius along, error"] for r in caps]),
        ("the same: L1 of the thickness", [r.h.l1 for r in caps]),
        (f"Ritter's dam break between closed walls, {walls.along} particles along: L1 of thickness, momentum",
         [walls.h.l1, walls.hu.l1]),
        ("stopping slab: time, travel", [one("stopping slab").scalars[f"{name} error"] for name in ("time", "travel")]),
        ("eroding block: travel, volume",
         [one("eroding block").scalars[f"{name} error"] for name in ("travel", "volume")]),
        ("consolidating block: travel, pressure ratio",
         [one("consolidating block").scalars[f"{name} error"] for name in ("travel", "pressure ratio")]),
    ]  # fmt: skip
    written = [(words, ", ".join(percent(abs(value)) for value in values)) for words, values in rows]
    lakes = [r for r in found if r.case == "lake, damped"]
    counts = ", ".join(f"{r.particles:,}".replace(",", " ") for r in lakes)
    heights = ", ".join(f"{1e3 * r.scalars['surface rms [m]']:.1f}" for r in lakes)
    written.append((f"damped lake of 1 m, {counts} particles: rms of the surface", f"{heights} mm"))
    return table(["case", "relative error"], written)


def two_phases() -> str:
    """Return the errors of two phases."""
    names = {"h_s": "thickness of grains", "h_w": "of water", "h_s v_s": "momentum of grains", "h_w v_w": "of water"}
    rows = [
        (f"{row['case'].replace('_', ' ')}, {row['particles']}", *(f"{100.0 * row[name]:.2g}" for name in names))
        for row in result_files.read("two_phase_errors")["rows"]
    ]
    return table(["case, particles of each phase", *(f"{words} [%]" for words in names.values())], rows)


def demo() -> str:
    """Return how far the demo's front runs with other numbers of particles and of levels."""
    found = result_files.read("key_figures")["front of the demo"]
    rows = []
    for law in ("ale", "classical"):
        for words, key, scheme in (
            ("particles", "particles", "default"), ("levels", "levels", "default"), ("levels", "levels", "upwind"),
        ):  # fmt: skip
            fixed = ("levels", 41) if key == "particles" else ("particles", 750)
            these = {
                row[key]: row["front [m]"]
                for row in found
                if (row["law"], row["scheme"], row[fixed[0]]) == (law, scheme, fixed[1])
            }
            counts = ", ".join(str(count) for count in sorted(these))
            fronts = ", ".join(f"{these[count]:.0f}" for count in sorted(these))
            rows.append((f"{law}, {scheme} scheme, {fixed[1]} {fixed[0]}", f"{counts} {words}", f"{fronts} m"))
    return table(["column", "with", "front beyond the 100 m contour"], rows)


# ---- columns ----


def column_errors() -> str:
    """Return the largest errors of the basal pressure, and the cost, by scheme and number of levels."""
    worst, dear, _ = columns.kept()
    once = ("A_cold", "A_warm")
    varying = [name for name in columns.CASES if name[0] not in "AEH"]
    rows = []
    for scheme, levels in dear_keys(dear):
        errors = [np.nanmax(worst[name, scheme, levels][0]) for name in once]
        several = [np.nanmax(worst[name, scheme, levels][0]) for name in varying if (name, scheme, levels) in worst]
        cost = np.nanmedian(dear["A_cold", scheme, levels])
        cells = percent(max(errors)), percent(max(several)) if several else "", f"{cost:.0f}"
        rows.append((f"{columns.NAMES[scheme]}, {levels}", *cells))
    heads = ("scheme, levels", "one stop of erosion", "varying rates, bed and thickness", "ns per column and step")
    return table(heads, rows)


def dear_keys(dear):
    """Return schemes and levels whose cost is known for the first case, schemes first."""
    keys = [(scheme, levels) for case, scheme, levels in dear if case == "A_cold"]
    return sorted(keys, key=lambda key: (columns.SCHEMES.index(key[0]), key[1]))


# ---- speed ----


def speed() -> str:
    """Return what steps, scenes and starts cost."""
    found = result_files.read("speed")
    points = {(row["curve"], row["particles"]): row for row in found["curves"]}
    tables = {one["title"]: one["rows"] for one in found["tables"]}

    def rates(curve, key="one"):
        return " / ".join(f"{points[curve, count][key]:.1f}" for count in (10_000, 100_000, 1_000_000))

    def rows_of(start):
        return next(rows for title, rows in tables.items() if title.startswith(start))

    scenes, ways, starts = rows_of("The demo's valley"), rows_of("8 scenes"), rows_of("Import")
    peer, rasters = rows_of("com1DFA"), {row[0]: row for row in rows_of("One event")}
    equal = rows_of("At the error")
    demos = result_files.read("key_figures")["CPU time of the demo [s]"]
    ways = {row[0]: row[1] for row in ways}
    rows = [
        ("sums over neighbours, million particle steps per second, 1e4 / 1e5 / 1e6 particles, one thread",
         rates("density + force")),
        ("the same, two threads", rates("density + force", "two")),
        ("whole step, one thread", rates("whole step")),
        ("demo's valley to rest, " + " / ".join(row[0] for row in scenes) + " particles",
         " / ".join(row[1] for row in scenes) + " s"),
        ("the two runs of the demo (41 levels), kernels compiled / read (in brackets the whole process)",
         " / ".join(f"{one['runs']:.2g} ({one['process']:.2g})" for one in demos) + " s"),
        ("such valleys a minute on two cores: two processes / two threads",
         f"{ways['two processes']} / {ways['two threads']}"),
        ("import and first step beyond the import of Landlab, kernels read / compiled",
         " / ".join(row[1] for row in starts) + " s"),
        ("steps of one event on 2000 × 2000 nodes over the same on 200 × 200", rasters["CPU s of the steps"][3]),
        (f"particle steps per second over those of com1DFA, {peer[1][0]} / {peer[-1][0]} particles",
         f"{peer[1][7]} / {peer[-1][7]}"),
        ("CPU time of com1DFA over that of this package at the error of com1DFA's finest run, on the raster",
         equal[-1][6]),
    ]  # fmt: skip
    return table(["cost", "measured"], rows)


# ---- S-1000 and provenance ----

SCORES = {
    "csi": "CSI", "csi outside": "CSI outside the source", "correlation": "correlation outside the source",
    "lowered outside": "lowered outside the source [m³]", "run-out error": "error of run-out [m]",
    "in scar": "left in the scar [m³]",
}  # fmt: skip
RUNS = {
    "observed": "observed", "Coulomb": "Coulomb", "Coulomb, prop. loading": "Coulomb, proportional loading",
    "Voellmy": "Voellmy", "Voellmy, prop. loading": "Voellmy, proportional loading",
    '"Mass- Wasting- Runout"': "MassWastingRunout, calibrated; quoted",
    "spread evenly": "source spread evenly along the path",
}  # fmt: skip


def s1000() -> str:
    """Return the scores of S-1000, one run in a row."""
    script = load("s1000_scores")
    found = {row["column"]: row for row in result_files.read("s1000_scores")["columns"]}
    rows = []
    for name, words in RUNS.items():
        cells = []
        for key in SCORES:
            form = "{:.2f}" if key.startswith("csi") else script.MEASURES[key][1]
            value = found[name].get(key, math.nan)
            if name == "observed" and key.startswith(("csi", "correlation", "run-out")):
                value = math.nan  # observed against observed
            cells.append("" if isinstance(value, float) and math.isnan(value) else form.format(value))
        rows.append((words, *cells))
    rows.append(("noise", *(script.NOISE.get(key, "") for key in SCORES)))
    return table(["run", *SCORES.values()], rows)


SOURCES = (
    "flow", "flow_com1dfa", "two_phase_errors", "column", "column_stability", "dilatancy_stability", "flow_stability",
    "speed", "ratios", "valley_accuracy", "step_rules", "erosion_order", "step_stability", "key_figures", "s1000",
    "tsing_shan", "when_ale_matters", "calibration_coverage", "calibration_s1000", "calibration_cascade2009",
    "calibration_s1000_shear_excess", "calibration_s1000_excess_traction",
)  # fmt: skip


def provenance() -> str:
    """Return by which command, when, from which commit and on what machine results were measured."""
    rows = []
    for name in SOURCES:
        told = result_files.measured(name)
        load = told.get("load")
        known = "" if load is None or math.isnan(load) else f"{load:g}"
        machine = f"{told['processor']}, {told['cores']} cores"
        link = f"[{name}](../benchmarks/results/{result_files.path_of(name).name})"
        rows.append((link, f"`{told['command']}`", told["date"], told["commit"], machine, known, told.get("note", "")))
    return table(["result", "command", "date", "commit", "machine", "load before", "note"], rows, "---")


def paper_speed() -> str:
    """Return speeds by resistance, and by how much ALE runs farther than the classical model."""
    kept = result_files.read("paper_speed")["rows"]
    found = {tuple(row[name] for name in speeds.NAMES): row for row in kept}
    rows = []
    for resistance in speeds.RESISTANCES:
        pairs = {name: found[(*case, resistance)] for name, case in speeds.SHOWN.items()}
        one = pairs["farther"]
        rows.append([
            resistance, f"{one['speed']:.1f}", f"{one['Pe_b']:.0f}, {pairs['fast']['Pe_b']:.2g}",
            *(f"{round(pair['farther'])}" for pair in pairs.values()),
            f"{one['ALE']:.0f}", f"{one['deposit ALE']:.2f}, {one['deposit classical']:.2f}", f"{one['angle']:.1f}",
        ])  # fmt: skip
    for name in speeds.DILATANCY:
        row = found["plain of 2°", "overburden", speeds.FOLLOWS, name]
        rows.append([
            name, f"{row['speed']:.1f}", f"{row['Pe_b']:.0f}", *("" for _ in speeds.SHOWN),
            f"{row['ALE']:.0f}", f"{row['deposit ALE']:.2f}", f"{row['angle']:.1f}",
        ])  # fmt: skip
    heads = (
        "resistance", "speed [m/s]", "Pe_b, with c_v = 0.4", "ALE farther [m]", "valley moved", "plain of 10°",
        "proportional", "no loading", "c_v = 0.4", "both: 0.4, 10°", "ALE beyond [m]", "deposit: ALE, classical [m]",
        "travel angle [°]",
    )  # fmt: skip
    return table(heads, rows)


TABLES = {
    "rivals": rivals, "single": single, "two_phases": two_phases, "demo": demo, "columns": column_errors,
    "speed": speed, "s1000": s1000, "provenance": provenance, "paper_speed": paper_speed,
    "ratios": lambda: table(*step_tables.ratios()), "step_rules": lambda: table(*step_tables.rules()),
    "erosion_order": lambda: table(*step_tables.orders()),
    "coverage": lambda: table(*calibration_tables.coverage()),
    "calibrated_s1000": lambda: table(*calibration_tables.scores("s1000")),
    "calibrated_laws": lambda: table(*calibration_tables.laws()),
    "calibrated_reached": lambda: table(*calibration_tables.reached()),
    "calibrated_2009": lambda: table(*calibration_tables.scores("cascade2009")),
    "calibrated_predictions": lambda: table(*calibration_tables.predictions()),
    "calibrated_intervals": lambda: table(*calibration_tables.intervals()),
}  # fmt: skip
