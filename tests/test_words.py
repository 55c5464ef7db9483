"""First lines of docstrings name their subject with a noun, public names are imported from where they are public."""

import ast
import importlib
import re
from pathlib import Path

import pytest

import landlab_debrisflow

PACKAGE = Path(landlab_debrisflow.__file__).parent
ROOT = Path(__file__).parents[1]
PAGES = "README.md", "CONTRIBUTING.md", "docs/which_component.md"
SHOWN = [
    *(ROOT / name for name in PAGES), *(ROOT / "notebooks").glob("*.ipynb"),
    *(ROOT / "examples").glob("*.py"),
]  # fmt: skip
PUBLIC = {"exact", "laws", "plots", "record", "report", "scene", "triggers"}
"""Modules of the package that are public, beside the package itself."""
ANYWHERE = r"\b(?:what|who|whom|those|such(?! as)|likewise|others|nobody|somebody|everybody|the latter|the former)\b"
"""Words that lean on a sentence the reader does not see, wherever they stand."""
CLAUSE = r"(?:^|[:;,.(] )(?:and |or |but )?"
SUBJECT = CLAUSE + r"(?!(?-i:None))(?:it|they|this|these|that|all|none|nothing|something)\b(?! \w+s\b| \[)"
"""A pronoun that begins a clause: in "these columns" the subject is a noun."""
OBJECT = r"^\w+ (?:it|them|all of it|this|that of|the same)\b(?=$|[.,;:]| at | one )"
"""A verb at the beginning whose only object is a pronoun."""
SAME = r"\bthe same(?=$|[.,;:]| (?:of|as|for|in|one)\b)"
PRONOUN = re.compile("|".join((ANYWHERE, SUBJECT, OBJECT, SAME)), re.IGNORECASE)


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
    assert len(lines) > 800 and len(found) < 20, found


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


@pytest.mark.parametrize("module", PUBLIC)
def test_public_modules_list_their_names(module):
    public = importlib.import_module(f"landlab_debrisflow.{module}")
    assert len(set(public.__all__)) == len(public.__all__)
    assert [name for name in public.__all__ if not hasattr(public, name)] == []
    assert f"`{module}`" in landlab_debrisflow.__doc__
