"""First lines of docstrings name their subject with a noun, public names are imported from where they are public."""

import ast
import re
from pathlib import Path

import pytest

import landlab_debrisflow

PACKAGE = Path(landlab_debrisflow.__file__).parent
ANYWHERE = r"\b(?:what|who|whom|those|such(?! as)|likewise|others|nobody|somebody|everybody|the latter|the former)\b"
"""Words that lean on a sentence the reader does not see, wherever they stand."""
CLAUSE = r"(?:^|[:;,.(] )(?:and |or |but )?"
SUBJECT = CLAUSE + r"(?!(?-i:None))(?:it|they|this|these|that|all|none|nothing|something)\b(?! \w+s\b)"
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
