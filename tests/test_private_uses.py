"""Tests, benchmarks, cases and examples look at a flow from outside; where they reach inside is counted.

The counts are printed by ``python -m tests.test_private_uses``. They may fall: then lower the ceiling.
"""

import ast
import re
from collections import Counter
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
FOLDERS = "tests", "benchmarks", "validation", "examples"
CEILING = {"private": 84, "patches": 31}


def private(source: str) -> int:
    """Return how often a component's simulation, calls or physics are reached for."""
    return len(re.findall(r"\._(?:simulation|calls|physics)\b", source))


def patches(source: str) -> int:
    """Return how often something of the package is replaced while it runs."""
    package, found = {"landlab_debrisflow"}, 0
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("landlab_debrisflow"):
            package |= {alias.asname or alias.name for alias in node.names}
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Call) and ast.unparse(node.func) in ("monkeypatch.setattr", "mock.patch.object"):
            target = node.args[0]
            name = target.value if isinstance(target, ast.Constant) else ast.unparse(target)
            found += bool(package & set(re.split(r"\W+", str(name)))) or "._" in str(name)
    return found


def counts(count) -> Counter:
    """Return the count by file, where there is any."""
    files = (path for folder in FOLDERS for path in sorted((ROOT / folder).rglob("*.py")) if path != Path(__file__))
    found = {path.relative_to(ROOT).as_posix(): count(path.read_text(encoding="utf-8")) for path in files}
    return Counter({path: n for path, n in found.items() if n})


@pytest.mark.parametrize("count", [private, patches], ids=lambda count: count.__name__)
def test_no_more_reach_inside(count):
    found = counts(count)
    assert found.total() <= CEILING[count.__name__], found.most_common()


if __name__ == "__main__":
    for one in (private, patches):
        found = counts(one)
        print(f"{one.__name__}: {found.total()} in {len(found)} files")
        print("".join(f"  {n:3d} {path}\n" for path, n in found.most_common()), end="")
