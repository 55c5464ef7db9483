"""Draw docstrings of the package at random, to be read by somebody who has not seen the code.

    python -m benchmarks.docstrings --seed 14

Functions, methods and classes are drawn alike, public or not. A reader rates each: is it clear what goes in, what comes
out, in which unit, and why?
"""

import argparse
import ast
import inspect
import random
from pathlib import Path

PACKAGE = Path(__file__).parents[1] / "landlab_debrisflow"
KINDS = ast.FunctionDef | ast.ClassDef


def docstrings(root: Path = PACKAGE) -> list[tuple[str, str, str]]:
    """Return module, signature and docstring of everything that has one, in the order of modules and lines."""
    return [
        (".".join(path.relative_to(root.parent).with_suffix("").parts), signature, text)
        for path in sorted(root.rglob("*.py"))
        for signature, text in _documented(ast.parse(path.read_text(encoding="utf-8")), "")
    ]


def _documented(parent, prefix):
    for node in parent.body:
        if isinstance(node, KINDS):
            arguments = f"({ast.unparse(node.args)})" if isinstance(node, ast.FunctionDef) else ""
            if text := ast.get_docstring(node):
                yield f"{prefix}{node.name}{arguments}", text
            yield from _documented(node, f"{prefix}{node.name}.")


def draw(seed: int, count: int = 10) -> list[tuple[str, str, str]]:
    """Return some of `docstrings`, the same ones for the same seed and package."""
    return random.Random(seed).sample(docstrings(), count)


def main() -> None:
    """Print the draw."""
    parser = argparse.ArgumentParser(description=inspect.cleandoc(__doc__).splitlines()[0])
    parser.add_argument("--seed", type=int, default=14)
    parser.add_argument("--count", type=int, default=10)
    arguments = parser.parse_args()
    for number, (module, signature, text) in enumerate(draw(arguments.seed, arguments.count), 1):
        print(f"{number}. {module}\n   {signature}\n")
        print("\n".join(f"       {line}".rstrip() for line in text.splitlines()), end="\n\n")


if __name__ == "__main__":
    main()
