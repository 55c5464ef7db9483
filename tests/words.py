"""Pronouns without a noun in docstrings, comments, messages and pages: the pattern, and the places where it is found.

    python -m tests.words [CHECKOUT]

prints how many there are in each kind of text, of this checkout or of another one.
"""

import ast
import io
import json
import re
import sys
import tokenize
from collections.abc import Iterable, Iterator
from pathlib import Path

ANYWHERE = r"\b(?:what|who|whom|those|such(?! as)|likewise|others|nobody|somebody|everybody|the latter|the former)\b"
"""Words that refer to a sentence the reader does not see, wherever they stand."""
CLAUSE = r"(?:^|[:;,.(] )(?:and |or |but )?"
SUBJECT = CLAUSE + r"(?!(?-i:None))(?:it|they|this|these|that|all|none|nothing|something)\b(?! \w+s\b| \[)"
"""A pronoun that begins a clause: in "these columns" the subject is a noun."""
OBJECT = r"^\w+ (?:it|them|all of it|this|that of|the same)\b(?=$|[.,;:]| at | one )"
"""A verb at the beginning whose only object is a pronoun."""
SAME = r"\bthe same(?=$|[.,;:]| (?:of|as|for|in|one)\b)"
PRONOUN = re.compile("|".join((ANYWHERE, SUBJECT, OBJECT, SAME)), re.IGNORECASE)
PICTURED = re.compile(r"\b(?:but for|leans? on|owed|whoever|anyhow|feels?|felt)\b", re.IGNORECASE)
"""Turns of speech that nobody should have to decipher."""


WRITTEN_BY_COMMANDS = {"laws.md", "contributing.md", "changes.md"}
"""Pages of docs/ that are made of declarations, or copied there for the site."""


def docstrings(package: Path) -> Iterator[tuple[str, str]]:
    """Yield place and text of every docstring of a package, and of every text below a constant."""
    for path in sorted(package.rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if (
                isinstance(node, ast.Expr)
                and isinstance(node.value, ast.Constant)
                and isinstance(node.value.value, str)
            ):
                yield f"{path.relative_to(package).as_posix()}:{node.lineno}", node.value.value


def comments(package: Path) -> Iterator[tuple[str, str]]:
    """Yield place and text of every comment of a package."""
    for path in sorted(package.rglob("*.py")):
        for token in tokenize.generate_tokens(io.StringIO(path.read_text(encoding="utf-8")).readline):
            if token.type == tokenize.COMMENT:
                yield f"{path.relative_to(package).as_posix()}:{token.start[0]}", token.string[2:]


def messages(package: Path) -> Iterator[tuple[str, str]]:
    """Yield place and text of every other string of a package with three words or more; values in it as {}."""
    for path in sorted(package.rglob("*.py")):
        tree = ast.parse(path.read_text(encoding="utf-8"))
        left_out = {id(node.value) for node in ast.walk(tree) if isinstance(node, ast.Expr)}
        for node in ast.walk(tree):
            if isinstance(node, ast.JoinedStr):
                left_out |= {id(part) for part in ast.walk(node) if part is not node}
                text = "".join(part.value if isinstance(part, ast.Constant) else "{}" for part in node.values)
            elif isinstance(node, ast.Constant) and isinstance(node.value, str):
                text = node.value
            else:
                continue
            if id(node) not in left_out and len(text.split()) > 2:
                yield f"{path.relative_to(package).as_posix()}:{node.lineno}", text


def page(path: Path) -> Iterator[tuple[str, str]]:
    """Yield place and text of a page in Markdown or of a notebook, code left out."""
    text = path.read_text(encoding="utf-8")
    if path.suffix == ".ipynb":
        cells = json.loads(text)["cells"]
        text = "\n\n".join("".join(cell["source"]) for cell in cells if cell["cell_type"] == "markdown")
    yield path.name, re.sub(r"```.*?```|`[^`]*`", "", text, flags=re.DOTALL)


def found(texts: Iterable[tuple[str, str]], pattern: re.Pattern = PRONOUN) -> list[tuple[str, str]]:
    """Return place and words around for everything in texts that a pattern matches."""
    joined = ((place, " ".join(text.split())) for place, text in texts)
    return [
        (place, text[max(0, match.start() - 50) : match.end() + 30])
        for place, text in joined for match in pattern.finditer(text)
    ]  # fmt: skip


def pages(root: Path) -> Iterator[tuple[str, str]]:
    """Yield place and text of the pages of a checkout, without tables written from declarations."""
    notebooks = sorted((root / "notebooks").glob("*.ipynb"))
    for path in (root / "CONTRIBUTING.md", *sorted((root / "docs").rglob("*.md")), *notebooks):
        if path.name not in WRITTEN_BY_COMMANDS and not {"_build", "api"} & set(path.parts):
            yield from page(path)


def rates(root: Path) -> dict[str, float]:
    """Return how many pronouns without a noun there are in 1000 words, by kind of text of a checkout."""
    package = root / "landlab_debrisflow"
    kinds = {
        "docstrings": docstrings(package), "comments": comments(package), "messages": messages(package),
        "pages": pages(root),
    }  # fmt: skip
    texts = {kind: list(texts) for kind, texts in kinds.items()}
    words = {kind: sum(len(text.split()) for _, text in some) for kind, some in texts.items()}
    return {kind: 1000.0 * len(found(some)) / words[kind] for kind, some in texts.items()}


if __name__ == "__main__":
    for kind, rate in rates(Path(*sys.argv[1:2] or [Path(__file__).parents[1]])).items():
        print(f"{kind:>10}: {rate:.2f} pronouns without a noun in 1000 words")
