"""Compare what the tests assert with what they did: ``python -m benchmarks.assertions REVISION``.

For a change that moves and renames, but is to keep every assertion and tolerance. Statements of the tests at REVISION
and in the working tree are compared by their text, without regard to layout, by the name of the test, whatever file it
is in: assertions, what is expected to raise or to warn, numpy's assertions, values of parametrizations, and constants
in capitals, because tolerances have names, too. What is not the same is printed by test, old above new.

Functions of the tests whose numbers differ anywhere are named as well: an assertion is worth what prepares it.

Fails if a number or a comparison differs in such a pair (indices apart), or if a statement is gone that stands nowhere
else.
"""

import argparse
import ast
import difflib
import io
import subprocess
import sys
import tarfile
from collections import Counter, defaultdict
from pathlib import Path
from typing import NamedTuple

from rich.console import Console
from rich.markup import escape

EXPECTING = {"raises", "warns", "parametrize", "approx", "deprecated_call", "fail"}
"""Calls that say what is expected, beside those whose name begins with assert_."""
ALIKE = 0.5
"""Least part of the text that two statements share to be taken for old and new."""


class Statement(NamedTuple):
    """Something that a test says must hold."""

    text: str
    numbers: tuple[str, ...]  # literals and comparisons in order, without indices


def files_of(revision: str | None) -> dict[str, str]:
    """Return the Python files of the tests at a revision of git, or in the working tree."""
    root = Path(__file__).parents[1]
    if revision is None:
        return {str(path.relative_to(root)): path.read_text() for path in sorted((root / "tests").rglob("*.py"))}
    archive = subprocess.run(["git", "archive", revision, "tests"], cwd=root, check=True, capture_output=True).stdout
    with tarfile.open(fileobj=io.BytesIO(archive)) as packed:
        names = [name for name in packed.getnames() if name.endswith(".py")]
        return {name: packed.extractfile(name).read().decode() for name in names}


def numbers(node: ast.AST) -> tuple[str, ...]:
    """Return numbers and comparisons in a piece of code; an index is a way of access, and left out.

    Examples
    --------
    >>> numbers(ast.parse("assert x[3] < -1e-3"))
    ('Lt', 'USub', '0.001')
    """
    if isinstance(node, ast.Subscript):
        return numbers(node.value)
    if isinstance(node, ast.Constant) and isinstance(node.value, int | float) and not isinstance(node.value, bool):
        return (repr(node.value),)
    own = [node.op] if isinstance(node, ast.UnaryOp) else node.ops if isinstance(node, ast.Compare) else []
    inside = [one for child in ast.iter_child_nodes(node) if not isinstance(child, ast.cmpop | ast.unaryop)
              for one in numbers(child)]  # fmt: skip
    return (*(type(one).__name__ for one in own), *inside)


def expecting(node: ast.AST) -> bool:
    """Tell whether a node is a call that expects something."""
    name = getattr(node.func, "attr", getattr(node.func, "id", "")) if isinstance(node, ast.Call) else ""
    return name in EXPECTING or name.startswith("assert_")


def statements_in(function: ast.AST) -> list[Statement]:
    """Return the statements of a test in order, outermost only."""
    found = []

    def visit(node):
        if isinstance(node, ast.Assert) or expecting(node):
            found.append(Statement(ast.unparse(node), numbers(node)))
            return
        for child in ast.iter_child_nodes(node):
            visit(child)

    for child in ast.iter_child_nodes(function):
        visit(child)
    return found


def statements_of(files: dict[str, str]) -> dict[str, dict[str, list[Statement]]]:
    """Return the statements by name of the function, and by file; constants by theirs."""
    found = defaultdict(dict)
    for path, source in files.items():
        for node in ast.parse(source).body:
            inside = [node] if isinstance(node, ast.FunctionDef) else getattr(node, "body", [])
            for function in (one for one in inside if isinstance(one, ast.FunctionDef)):
                if said := statements_in(function) or function.name.startswith("test_"):
                    found[function.name].setdefault(path, []).extend(said if isinstance(said, list) else [])
            targets = node.targets if isinstance(node, ast.Assign) else []
            if targets and ast.unparse(targets[0]).isupper() and numbers(node.value):
                found[f"constant {ast.unparse(targets[0])}"][path] = [Statement(ast.unparse(node), numbers(node))]
    return found


def numbers_of(files: dict[str, str]) -> dict[str, Counter]:
    """Return all numbers and comparisons of the functions by name, what prepares the assertions included."""
    found = defaultdict(Counter)
    for source in files.values():
        for node in ast.walk(ast.parse(source)):
            if isinstance(node, ast.FunctionDef):
                found[node.name].update(numbers(node))
    return found


def side_by_side(old: dict[str, list], new: dict[str, list]):
    """Yield pairs of lists of statements of the functions of one name: equal ones, ones of one file, the others."""
    old, new = dict(old), dict(new)
    for alike in (
        lambda a, b: old[a] == new[b],
        lambda a, b: Path(a).name == Path(b).name,
        lambda a, b: True,
    ):
        for one in list(old):
            if (other := next((name for name in new if alike(one, name)), None)) is not None:
                yield one, old.pop(one), new.pop(other)
    yield from ((path, said, []) for path, said in old.items())
    yield from ((path, [], said) for path, said in new.items())


def pairs_of(gone: list, new: list):
    """Pair what is gone with what is new by how much text they share; yield (old, new), None if there is none."""
    gone, new = list(gone), list(new)
    shared = [
        (difflib.SequenceMatcher(None, a[-1].text, b[-1].text).ratio(), i, k)
        for i, a in enumerate(gone)
        for k, b in enumerate(new)
    ]
    left, right = set(range(len(gone))), set(range(len(new)))
    for ratio, i, k in sorted(shared, reverse=True):
        if ratio >= ALIKE and i in left and k in right:
            left.remove(i)
            right.remove(k)
            yield gone[i], new[k]
    yield from ((gone[i], None) for i in sorted(left))
    yield from ((None, new[k]) for k in sorted(right))


def compare(old: dict, new: dict):
    """Return how many statements are the same, and (test, old statement or None, new one or None) of the others."""
    same, changed, gone, added = 0, [], [], []
    for name in sorted(old.keys() | new.keys()):
        for path, before, after in side_by_side(old.get(name, {}), new.get(name, {})):
            lost, come = Counter(before) - Counter(after), Counter(after) - Counter(before)
            same += len(before) - lost.total()
            where = f"{path}::{name}"
            for a, b in pairs_of([(where, one) for one in lost.elements()], [(where, one) for one in come.elements()]):
                if a and b:
                    changed.append((where, a[1], b[1]))
                else:
                    gone += [a] if a else []
                    added += [b] if b else []
    stands = Counter(one for _, one in added)  # the same text in a test of another name
    moved = [(where, one) for where, one in gone if stands[one] > 0 and not stands.subtract([one])]
    for one in moved:
        gone.remove(one)
        added.remove(next(entry for entry in added if entry[1] == one[1]))
    for a, b in pairs_of(gone, added):
        where = f"{a[0]} -> {b[0]}" if a and b else (a or b)[0]
        changed.append((where, a and a[1], b and b[1]))
    return same + len(moved), len(moved), changed


def show(where: str, old: Statement | None, new: Statement | None, console) -> None:
    console.print(f"[bold]{escape(where)}[/bold]")
    for sign, one, colour in (("-", old, "red"), ("+", new, "green")):
        if one is not None:
            console.print(f"  {sign} {escape(one.text)}", style=colour, soft_wrap=True, highlight=False)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("revision", help="of git, before the change")
    console, files = Console(), (files_of(parser.parse_args().revision), files_of(None))
    old, new = map(statements_of, files)
    same, moved, changed = compare(old, new)
    kinds = {
        "Access changed": [one for one in changed if one[1] and one[2] and one[1].numbers == one[2].numbers],
        "New": [one for one in changed if one[1] is None],
        "Gone": [one for one in changed if one[2] is None],
        "Tolerance changed": [one for one in changed if one[1] and one[2] and one[1].numbers != one[2].numbers],
    }
    for kind, entries in kinds.items():
        if entries:
            console.rule(f"{kind}: {len(entries)}")
        for entry in entries:
            show(*entry, console)
    prepared = [numbers_of(side) for side in files]
    other = [name for name in sorted(prepared[0].keys() & prepared[1].keys()) if prepared[0][name] != prepared[1][name]]
    if other:
        console.rule(f"Functions with other numbers: {len(other)} (no failure: read what prepares their assertions)")
    for name in other:
        less, more = prepared[0][name] - prepared[1][name], prepared[1][name] - prepared[0][name]
        console.print(f"{name}: less {dict(less)}, more {dict(more)}", highlight=False, markup=False, soft_wrap=True)
    tests = [{name for name in side if name.startswith("test_")} for side in (old, new)]
    before, after = (sum(len(said) for paths in side.values() for said in paths.values()) for side in (old, new))
    console.print(f"\nNames of tests: {len(tests[0])} before, {len(tests[1])} now, {len(tests[0] & tests[1])} in both")
    console.print(f"Statements: {before} before, {after} now, {same} the same text, {moved} of them in another test")
    console.print(f"Functions with other numbers: {len(other) or 'none'}", highlight=False)
    for kind, entries in kinds.items():
        console.print(f"{kind}: {len(entries) or 'none'}", highlight=False)
    sys.exit(bool(kinds["Gone"] or kinds["Tolerance changed"]))


if __name__ == "__main__":
    main()
