"""Public functions of public modules say the type of every argument and of what they return (mypy checks the rest)."""

import ast
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PUBLIC = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["mypy"]["files"]
FILES = sorted(
    {file for name in PUBLIC for file in ((ROOT / name).rglob("*.py") if (ROOT / name).is_dir() else [ROOT / name])}
)


def public_functions(body, prefix=""):
    """Yield name and node of every function that a user may call."""
    for node in body:
        if isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
            yield from public_functions(node.body, f"{node.name}.")
        elif isinstance(node, ast.FunctionDef) and (
            not node.name.startswith("_") or node.name in ("__init__", "__call__")
        ):
            yield prefix + node.name, node


def lacking(function):
    """Return the names of arguments without a type, and "return"."""
    a = function.args
    arguments = [*a.posonlyargs, *a.args, *a.kwonlyargs, *filter(None, (a.vararg, a.kwarg))]
    names = [each.arg for each in arguments if each.annotation is None and each.arg not in ("self", "cls")]
    return names + ["return"] * (function.returns is None and function.name != "__init__")


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.relative_to(ROOT).as_posix())
def test_public_functions_are_annotated_wholly(path):
    functions = dict(public_functions(ast.parse(path.read_text(encoding="utf-8")).body))
    assert {name: lacking(node) for name, node in functions.items() if lacking(node)} == {}


def test_the_package_ships_its_types():
    assert (ROOT / "landlab_debrisflow" / "py.typed").exists()
