"""Plans and reports as text and as a table."""

from landlab_debrisflow.fidelity.table import WIDTH, WORDS, Table, percent
from landlab_debrisflow.model.numerics import QUANTITIES


def table(**changes):
    rows = [("particles", "1 000 (" + "the number of particles, and how it was found, " * 4 + "tolerance 5 %)")]
    errors = [
        ("run_out", 0.012, 0.034, "held"),
        ("area", float("nan"), None, "stated"),
        ("speed", 2.0, 0.0, "not held"),
    ]
    values = {"title": "Plan", "rows": rows, "errors": errors, "raster": "half <the> change", "notes": ["a note"]}
    return Table(**values | {"not_held": {"speed": "it errs"}} | changes)


def test_lines_are_short_and_numbers_keep_their_units():
    lines = table().text().splitlines()
    assert max(map(len, lines)) <= WIDTH and lines[0] == "Plan"
    assert not [line for line in lines if line.strip().startswith("%") or line.endswith(" 5")]
    assert "\xa0" not in table().text()


def test_errors_are_two_numbers():
    text = " ".join(table().text().split())
    for words in (
        "run-out 1.2 % / 3.4 % held",
        "affected area not known / not examined stated",
        "> 100 % / 0.0 % not held",
    ):
        assert words in text
    assert "not held peak speed: it errs" in text and "note a note" in text and "creeping" not in text
    assert "creeping slowly" in " ".join(table(creep="slowly").text().split())


def test_notebooks_get_a_table():
    page = table().html()
    assert "half &lt;the&gt; change" in page and page.count("<table>") == 2
    assert "<td>1.2 %</td><td>3.4 %</td>" in page
    assert "errors" not in table(errors=[]).html() and "errors" not in table(errors=[]).text()


def test_every_quantity_has_words():
    assert tuple(WORDS) == QUANTITIES and percent(0.05) == "5.0 %"
