"""Texts name their subject with a noun, public names are imported from where they are public."""

import ast
import importlib
import re
from pathlib import Path

import pytest

import landlab_debrisflow

from .words import PICTURED, PRONOUN, comments, docstrings, found, messages, rates

PACKAGE = Path(landlab_debrisflow.__file__).parent
ROOT = Path(__file__).parents[1]
PAGES = "README.md", "CONTRIBUTING.md", "docs/which_component.md"
SHOWN = [
    *(ROOT / name for name in PAGES), *(ROOT / "notebooks").glob("*.ipynb"),
    *(ROOT / "examples").glob("*.py"),
]  # fmt: skip
PUBLIC = {
    "calibration", "ensemble", "exact", "hazard", "laws", "plots", "record", "report", "scene", "sensitivity",
    "triggers",
}  # fmt: skip
"""Modules of the package that are public, beside the package itself."""
CEILINGS = {"docstrings": 2.8, "comments": 4.4, "messages": 3.6, "pages": 6.0}
"""Most pronouns without a noun in 1000 words: measured (``python -m tests.words``); lowered as they fall."""


def first_lines():
    """Return the first line of every docstring of the package by file, name and line."""
    lines = {}
    for path in sorted(PACKAGE.rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.FunctionDef | ast.ClassDef | ast.Module) and (text := ast.get_docstring(node)):
                key = path.relative_to(PACKAGE).as_posix(), getattr(node, "name", ""), node.body[0].lineno
                lines[key] = text.splitlines()[0]
    return lines


def test_first_lines_have_nouns_as_subjects():
    lines = first_lines()
    found = {key: line for key, line in lines.items() if PRONOUN.search(line)}
    assert len(lines) > 800 and len(found) < 12, found


@pytest.mark.slow
def test_other_texts_have_fewer_and_fewer_pronouns():
    measured = rates(ROOT)
    assert {kind: rate for kind, rate in measured.items() if rate > CEILINGS[kind]} == {}, "name the noun"
    assert {kind: rate for kind, rate in measured.items() if rate < 0.75 * CEILINGS[kind]} == {}, "lower the ceiling"


@pytest.mark.slow
@pytest.mark.parametrize("texts", [docstrings, comments, messages])
def test_no_turn_of_speech_has_to_be_deciphered(texts):
    assert found(texts(PACKAGE), PICTURED) == []


def test_a_turn_of_speech_is_seen_in_every_kind_of_text(tmp_path):
    (tmp_path / "module.py").write_text('"""Equal but for a bit."""\n# who feels it\nX = f"of {1} what is owed"\n')
    for texts in (docstrings, comments, messages):
        assert len(found(texts(tmp_path), PICTURED)) == 1
    assert [len(found(texts(tmp_path))) for texts in (docstrings, comments, messages)] == [0, 1, 1]


@pytest.mark.parametrize(
    "line",
    [
        "What every column is owed, step by step, and which are due.",
        "What they write, where cells are awake.",
        "Return it at a time [s], shape (column,).",
        "Return the same as a table.",
        "Let what was arrested move again.",
        "Give one column the rest: it must not drift.",
    ],
)
def test_a_pronoun_is_seen(line):
    assert PRONOUN.search(line)


@pytest.mark.parametrize(
    "line",
    [
        "Accumulate diffusion, load and source [Pa] of the columns, and list these columns.",
        "Return the value, or None if there is none.",
        "Columns that move with the base they erode.",
        "Whether all has entered.",
    ],
)
def test_a_noun_is_let_through(line):
    assert not PRONOUN.search(line)


def imported(text):
    """Return modules of the package and the names that are imported from them in code shown in a text."""
    one_line = re.findall(r"from (landlab_debrisflow[\w.]*) import ((?:\w+(?: as \w+)?(?:, )?)+)", text)
    assert len(one_line) == len(re.findall(r"(?:from|import) landlab_debrisflow\b", text)), "write: from ... import ..."
    return [(module, re.findall(r"(\w+)(?: as \w+)?", names)) for module, names in one_line]


@pytest.mark.parametrize("path", SHOWN, ids=lambda path: path.name)
def test_what_is_shown_imports_public_names(path):
    for module, names in imported(path.read_text(encoding="utf-8")):
        assert module.removeprefix("landlab_debrisflow").removeprefix(".") in {"", *PUBLIC}
        assert [name for name in names if name not in importlib.import_module(module).__all__] == []


@pytest.mark.parametrize("module", sorted(PUBLIC))
def test_public_modules_list_their_names(module):
    public = importlib.import_module(f"landlab_debrisflow.{module}")
    assert len(set(public.__all__)) == len(public.__all__)
    assert [name for name in public.__all__ if not hasattr(public, name)] == []
    assert f"`{module}`" in landlab_debrisflow.__doc__
