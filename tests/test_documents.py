"""Documents that code and tests cite exist, and say what the package does."""

import re
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from landlab_debrisflow import Material, solve_column
from landlab_debrisflow.exact import columns, flows
from landlab_debrisflow.physics.flow import TwoPhase

ROOT = Path(__file__).parents[1]
PACKAGE = ROOT / "landlab_debrisflow"
FOLDERS = "landlab_debrisflow", "validation", "tests", "benchmarks", "examples", "notebooks", "docs"
CITING = [path for folder in FOLDERS for path in (ROOT / folder).rglob("*") if path.suffix in (".py", ".md", ".ipynb")]
CITING = [*ROOT.glob("*.md"), *(path for path in CITING if path.name != Path(__file__).name)]
TEXTS = {path.relative_to(ROOT).as_posix(): path.read_text(encoding="utf-8") for path in sorted(CITING)}
THEORY, DECISIONS = TEXTS["docs/theory.md"], TEXTS["docs/decisions.md"]
UNBROKEN = " ".join(THEORY.split())
SECTION = r"(?:§|(?:sections?\s+)?\d)"
DANGLING = [
    # the notes that the project was started from are not in the repository
    re.compile(rf"\b(?:theory|numerics)\b,?\s+{SECTION}", re.IGNORECASE),
    re.compile(r"\bdesign,?\s+(?:§|sections?\s+\d)", re.IGNORECASE),
    re.compile(r"\b(?:house|design|numerics|speed|fidelity|dilatancy|peers)\.md\b"),
    re.compile(r"\(Q\d+\)"),
]
CITED = re.compile(r"theory\.md#([\w-]+)")
DECISION = re.compile(r"decisions\.md[`)]?,\s+([A-Z][a-z]+(?: [a-z]+)*)(?: (\d+))?")
DECISION_HEADING = r'^<a id="([\w-]+)"></a>\n## (\d+)\. (.+)$'
LABELS = "Context", "Decision", "Evidence", "Consequence"
FEWEST = {"Flow": 19, "Column": 17, "Two phases": 13, "Laws": 10, "Erosion and the bed": 7, "Inflow and walls": 6}
FEWEST |= {"What S-1000 taught": 3, "The paper, section 4.2": 5, "Interface": 18, "Calls and looks": 6, "The house": 7}
FEWEST |= {"From a DEM to maps": 11, "Plans": 5, "Start": 6}
"""Fewest decisions of each topic: a decision keeps its number, and none is taken away."""
MODULE = re.compile(r"`((?:\w+/)*\w+\.py)`")


def anchors(text):
    return re.findall(r'<a id="([\w-]+)"></a>', text)


def topics():
    """Return the topics of the index: the file of each, and how many decisions it is said to have."""
    rows = re.findall(r"^\| \[(.+?)\]\((decisions/\w+\.md)\) \|.+\| (\d+) \|$", DECISIONS, re.M)
    return {name: (f"docs/{file}", int(count)) for name, file, count in rows}


def decisions():
    """Return the decisions of each topic by number: anchor, title and body."""
    found = {}
    for name, (file, _) in topics().items():
        parts = re.split(DECISION_HEADING, TEXTS[file], flags=re.M)[1:]
        found[name] = {n: rest for n, *rest in zip(parts[1::4], parts[::4], parts[2::4], parts[3::4], strict=True)}
    return found


def test_no_reference_leads_out_of_the_repository():
    """They cite docs/theory.md with the anchor of a section, or a topic of docs/decisions.md."""
    found = [(name, match.group()) for name in TEXTS for pattern in DANGLING for match in pattern.finditer(TEXTS[name])]
    assert found == []


@pytest.mark.parametrize("words", ["theory, section 6", "Theory, 2", "theory §3", "numerics\n    section 1", "(Q3)"])
def test_a_dangling_reference_is_seen(words):
    assert any(pattern.search(words) for pattern in DANGLING)


def test_sections_of_the_theory_that_are_cited_exist():
    known, cited = anchors(THEORY), {}
    for name, text in TEXTS.items():
        for anchor in CITED.findall(text):
            cited.setdefault(anchor, name)
    assert len(known) == len(set(known))
    assert {anchor: name for anchor, name in cited.items() if anchor not in known} == {}
    assert len(cited) > 8


def test_links_within_the_theory_lead_to_its_sections():
    links = re.findall(r"\]\(#([\w-]+)\)", THEORY)
    assert links and set(links) <= set(anchors(THEORY))


def test_decisions_that_are_cited_exist():
    known, cited = decisions(), []
    for name, text in TEXTS.items():
        for topic, number in DECISION.findall(text):
            cited.append(topic)
            assert topic in known, f"{name} cites {topic!r}"
            assert not number or number in known[topic], f"{name} cites {topic} {number}"
    assert len(cited) > 8


def test_topics_of_decisions_are_those_of_the_index():
    files = {name for name in TEXTS if name.startswith("docs/decisions/")}
    assert {file for file, _ in topics().values()} == files
    assert {name: len(found) for name, found in decisions().items()} == {n: count for n, (_, count) in topics().items()}
    assert {name: count for name, count in FEWEST.items() if len(decisions()[name]) < count} == {}
    for name, (file, _) in topics().items():
        assert TEXTS[file].startswith(f"# Decisions: {name}\n")


def test_decisions_are_numbered_and_have_anchors():
    for topic, found in decisions().items():
        file = TEXTS[topics()[topic][0]]
        assert list(found) == [str(n + 1) for n in range(len(found))], topic
        assert len(anchors(file)) == len(re.findall(r"^#{2,} ", file, re.M)) == len(found)
        start = found["1"][0].removesuffix("-1")
        assert re.sub(r"\W+", "-", topic.lower()).startswith(start)
        assert [anchor for anchor, *_ in found.values()] == [f"{start}-{n}" for n in found]


def test_decisions_have_context_decision_evidence_and_consequence():
    wrong, left_out = {}, 0
    for topic, found in decisions().items():
        for number, (_, title, body) in found.items():
            paragraphs = [text for text in body.split("\n\n") if text.strip()]
            labels = [text.strip().split(".**")[0].removeprefix("**") for text in paragraphs if text.startswith("**")]
            left_out += "Consequence" not in labels
            if (
                tuple(labels) not in (LABELS, LABELS[:3])
                or not paragraphs[0].startswith("**Context.** ")
                or title[-1] == "."
            ):
                wrong[topic, number] = labels
    assert wrong == {}
    assert left_out < 25  # of 141: it is there unless nothing follows


def test_commands_of_decisions_name_tests_that_exist():
    named = {
        path: re.findall(r"^def (test_\w+)", text, re.M) for path, text in TEXTS.items() if path.startswith("tests/")
    }
    missing, counted = [], 0
    for file, _ in topics().values():
        text = " ".join(TEXTS[file].split())
        of_page = re.findall(r"tests/[\w/.]+", text.split("<a id")[0])
        for command in re.findall(r"`((?:pytest|-k|tests/)[^`]*)`", text):
            paths = re.findall(r"tests/[\w/.]+", command)
            missing += [(file, path) for path in paths if not (ROOT / path).exists()]
            tests = [test for path in named if path.startswith(tuple(paths or of_page)) for test in named[path]]
            for words in re.findall(r'-k (?:"([^"]+)"|(\w+))', command):
                for word in "".join(words).split(" or "):
                    counted += 1
                    missing += [(file, word)] if not any(word in test for test in tests) else []
    assert missing == [] and counted > 50


@pytest.mark.parametrize("document", [name for name in TEXTS if re.match(r"docs/(theory|glossary|decisions)\b", name)])
def test_files_and_anchors_that_are_linked_exist(document):
    links = re.findall(r"\]\(([^)#:\s]*)(?:#([\w-]+))?\)", TEXTS[document])
    assert links
    for file, anchor in links:
        path = (ROOT / document).parent / file if file else ROOT / document
        assert path.exists(), f"{document} links to {file}"
        assert not anchor or anchor in anchors(path.read_text(encoding="utf-8")), f"{document}: {file}#{anchor}"


def test_modules_of_the_theory_exist():
    names = set(MODULE.findall(THEORY))
    assert len(names) > 30
    assert sorted(name for name in names if not (PACKAGE / name).exists() and not (ROOT / name).exists()) == []


def test_solutions_of_the_theory_are_functions():
    for module, heading in ((columns, "column-solutions"), (flows, "flow-solutions")):
        body = THEORY.split(f'<a id="{heading}"></a>')[1].split("\n## ")[1]
        names = set(re.findall(r"\(`(\w+)`[;)]|; `(\w+)`\)", body))
        names = {name for pair in names for name in pair if name}
        assert len(names) >= 4
        assert [name for name in sorted(names) if not callable(getattr(module, name, None))] == []


def rows(header):
    """Return the numbers in the table of the theory whose first line begins like this."""
    lines = THEORY[THEORY.index(header) :].split("\n\n")[0].splitlines()[2:]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]


def test_growing_columns_of_the_theory():
    table = np.array(rows("| Pe | t |"), dtype=float)
    assert table.shape == (8, 7)
    for number, time, *values in table:
        exact = columns.growing_column([0.1, 0.25, 0.5, 0.75, 0.9], time, number)
        assert_allclose(exact, values, rtol=0.0, atol=0.5e-8 + 1e-12)


def test_columns_without_erosion_of_the_theory():
    times = [float(word) for word in THEORY.split("| T | ")[1].splitlines()[0].strip("|").split("|")]
    (values,) = rows("| T | ")
    exact = [columns.consolidation(0.0, time) for time in times]
    assert_allclose([float(word) for word in values[1:]], exact, rtol=0.0, atol=0.5e-4)
    memory, passed = rows("| profile when it stops |"), 4e-4 * np.array([32.0, 160.0, 400.0]) / 3.16**2
    kept = {words[0]: np.array(words[1:], dtype=float) for words in memory}
    starts = {"uniform": ("basal_layer", 1.0), "linear": ("linear", 1.0), "basal layer h_n/10": ("basal_layer", 0.1)}
    for name, start in starts.items():
        assert_allclose(
            kept[name], [columns.consolidation(0.0, time, *start) for time in passed], rtol=0.0, atol=0.0051
        )


@pytest.mark.parametrize("law, start", [("ale", "grown"), ("classical", "the same")])
def test_memory_of_the_theory(law, start):
    growing = 2.16 / 0.05  # s
    ds = solve_column(
        thickness=1.0, entrainment_rate=lambda t: 0.05 * (t < growing), coefficient_of_consolidation=4e-4, levels=161,
        basal_pressure_ratio=0.65, loading=9711.9, initial="basal_layer", initial_pressure=0.65 * 9711.9, law=law,
        times=growing + np.array([0.0, 32.0, 160.0, 400.0]), advance="every_step", step=0.1,
    )  # fmt: skip
    base = ds.basal_excess_pore_pressure.values[:, 0]
    (kept,) = [words[1:] for words in rows("| profile when it stops |") if words[0].startswith(start)]
    assert_allclose(base[1:] / base[0], np.array(kept, dtype=float), rtol=0.0, atol=0.0051)


def test_flows_of_the_theory():
    steep = np.radians(30.0)
    speed, travel, growth = flows.eroding_block(20.0, steep, 0.21, 3e-3)
    depth, velocity, shock = flows.stoker_states(1.0, 0.1)
    front = flows.mangeney_front(2.0, 1.0, np.radians(22.0), np.tan(np.radians(15.0)))
    ridge, cap = flows.ridge_half_width(5.0, slope=steep)[0], flows.cap_radius(5.0, slope=steep)
    words = [f"v = {speed:.7f} m/s", f"X = {travel:.6f} m", f"h/h₀ = {growth:.8f}", f"h = {depth:.9f} m"]
    words += [f"u = {velocity:.9f} m/s", f"has {shock:.9f} m/s", f"2 s: {front:.6f} m", f"ℓ(5 s) = {ridge:.6f} m"]
    words += [f"R(5 s) = {cap:.6f} m"]
    assert [number for number in words if number not in UNBROKEN] == []


def test_other_numbers_of_the_theory():
    m, n = Material(), Material().porosity
    speed = np.sqrt(TwoPhase().stiffness * n * (1.0 / m.water_density + n / ((1.0 - n) * m.solid_density)))
    ratio, least = 1.0 - (1.0 - 0.65) * 3.16 / 1.5, (1.0 - 0.65) * 3.16
    step = (0.1 / 10.0) ** 2 / (2.0 * 0.4)  # of explicit diffusion
    for words in (
        f"{speed:.1f} m/s for the defaults", f"becomes {ratio:.2f} at 1.5 m", f"suction below {least:.1f} m",
        f"{step:.2e}".replace("e-0", "e-") + " s at 0.1 m", f"{np.degrees(np.arctan(0.6)):.2f}°",
        f"tan 32° = {np.tan(np.radians(32.0)):.3f}",
    ):  # fmt: skip
        assert words in UNBROKEN
