"""The page of laws says what the declarations say."""

import importlib
from pathlib import Path

import pytest

from landlab_debrisflow import Hydrograph, Material, Numerics
from landlab_debrisflow.cli import laws as laws_page
from landlab_debrisflow.cli import main
from landlab_debrisflow.core.parameters import declared, parameter
from landlab_debrisflow.core.values import flat_keys_of
from landlab_debrisflow.physics.column.dilatancy import Dilatancy
from landlab_debrisflow.physics.consolidation import Consolidation
from landlab_debrisflow.physics.registry import LAWS

PAGE = (Path(__file__).parents[2] / "docs" / "laws.md").read_text(encoding="utf-8")


def test_the_page_is_up_to_date(capsys):
    assert main.main(["info", "--markdown"]) == 0
    # no diff of pytest's: two hundred lines say less than the remedy
    assert (capsys.readouterr().out == PAGE) is True, f"docs/laws.md is out of date; run: {laws_page.COMMAND}"


def test_every_law_and_parameter_is_there_once():
    sections = {text.split("\n")[0]: text for text in PAGE.split("\n### ")[1:]}
    laws = {f"{kind}: {name}": law for kind, known in LAWS.items() for name, law in known.items()}
    others = {"material": Material, "numerics": Numerics, "inflow": Hydrograph}
    with_formula = {"dilatancy": Dilatancy, "coefficient_of_consolidation": Consolidation}
    others |= with_formula
    assert list(sections) == list(laws | others)
    for title, cls in (laws | others).items():
        rows = [line.split("`")[1] for line in sections[title].splitlines() if line.startswith("| `")]
        assert rows == list(flat_keys_of(cls))
        assert ("\nSource: " in sections[title]) == (title in laws | with_formula)


def test_every_class_is_imported_from_a_public_module():
    for path in (line.split("`")[1] for line in PAGE.splitlines() if line.startswith("Class `")):
        module, _, name = path.rpartition(".")
        assert name in importlib.import_module(module).__all__ and module.count(".") <= 1


@declared
class Sample:
    """a = b^2: what
    it is.

    More of it.

    References
    ----------
    Someone (1999),
    eq. 3.

    Examples
    --------
    >>> Sample().number
    1.5

    Not a paragraph of the page.
    """

    number: float = parameter("m|s", "of something", 1.5, (0.0, 2.0), varies=True)
    count: int = parameter("-", "how many", 3, (1, None), kind=int)
    switch: bool = parameter("-", "whether", True, kind=bool)
    word: str = parameter("-", "which", "this", choices=("this", "that"))
    several: tuple = parameter("s", "times", None, (None, None), kind=tuple)


@pytest.fixture
def entry(monkeypatch):
    monkeypatch.setitem(LAWS, "flow", {"sample": Sample})
    return laws_page.law_entries("flow")[0]


def test_the_parts_of_a_docstring(entry):
    assert entry.title == "flow: sample" and entry.cls is Sample
    assert (entry.formula, entry.summary, entry.details) == ("a = b^2", "what it is.", "More of it.")
    assert entry.source == "Someone (1999), eq. 3."


def test_the_rows_of_parameters(entry):
    assert entry.rows == [
        ("number", "m|s", "1.5", "0 to 2", "yes", "of something"),
        ("count", "-", "3", "integer, 1 or more", "", "how many"),
        ("switch", "-", "true", "true, false", "", "whether"),
        ("word", "-", "this", "this, that", "", "which"),
        ("several", "s", "not set", "list, any", "", "times"),
    ]
    assert "| `number` | m\\|s | 1.5 | 0 to 2 | yes | of something |\n" in laws_page.markdown()


@pytest.mark.parametrize("doc", ["a = b", "a = b."])
def test_a_formula_may_stand_alone(doc, entry, monkeypatch):
    monkeypatch.setattr(Sample, "__doc__", doc)
    bare = laws_page.law_entries("flow")[0]
    assert (bare.formula, bare.summary, bare.details, bare.source) == ("a = b", "", "", "")
