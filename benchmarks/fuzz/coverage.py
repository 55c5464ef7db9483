"""Lines of the readers that fuzzed files reach."""

import sys
from collections import defaultdict
from pathlib import Path
from types import CodeType

from rich.console import Console
from rich.table import Table

import landlab_debrisflow

from .cases import Case
from .trial import try_cases

ROOT = Path(landlab_debrisflow.__file__).parent
READERS = (
    "geo/*.py", "scene/*.py", "run/scene.py", "run/grids.py", "record/checkpoint_file.py", "record/memories.py",
    "grid/checkpoint*.py", "restart.py", "core/values.py",
)  # fmt: skip
NO_READERS = (
    "geotiff.py", "styles.py", "exposure.py", "tsing_shan.py", "schema.py", "new_scene.py", "template.py", "gully.py",
    "key_tables.py", "release.py", "failure_kinds.py", "failure_surface.py", "fall_lines.py", "outline.py",
    "__init__.py",
)  # fmt: skip
"""Files in these folders that write or compute, and read nothing."""


def reader_files() -> list[Path]:
    """Return the files of the package that read files."""
    found = (path for pattern in READERS for path in sorted(ROOT.glob(pattern)))
    return [path for path in found if path.name not in NO_READERS]


def lines_of_functions(path: Path) -> set[int]:
    """Return the numbers of all lines inside of functions: those of modules and classes run at import."""
    found: set[int] = set()

    def collect(code: CodeType, inside: bool) -> None:
        if inside:
            found.update(line for _, _, line in code.co_lines() if line is not None and line != code.co_firstlineno)
        for constant in code.co_consts:
            if isinstance(constant, CodeType):
                collect(constant, inside or not _is_class(constant))

    collect(compile(path.read_text(), str(path), "exec"), False)
    return found


def _is_class(code: CodeType) -> bool:
    return "__module__" in code.co_names and "__qualname__" in code.co_names


def traced(function):
    """Call a function; return its result and the lines of the package that ran, by file."""
    lines: dict[str, set[int]] = defaultdict(set)
    root = str(ROOT)

    def local(frame, event, _):
        if event == "line":
            lines[frame.f_code.co_filename].add(frame.f_lineno)
        return local

    def trace(frame, event, _):
        return local if frame.f_code.co_filename.startswith(root) else None

    sys.settrace(trace)
    try:
        result = function()
    finally:
        sys.settrace(None)
    return result, {name: sorted(numbers) for name, numbers in lines.items()}


def print_coverage(console: Console, cases: list[Case], workers: int) -> None:
    """Print which share of the lines of every reader the cases reach."""
    reached: dict[str, set[int]] = defaultdict(set)
    for _, _, found in try_cases(cases, workers, tracer=traced):
        for name, numbers in (found or {}).items():
            reached[name] |= set(numbers)
    table = Table(title=f"Lines inside of functions that {len(cases)} files reach")
    for column in ("file", "lines", "reached", "%", "missing"):
        table.add_column(column, justify="right" if column in ("lines", "reached", "%") else "left")
    total = hit = 0
    for path in reader_files():
        lines = lines_of_functions(path)
        got = lines & reached[str(path)]
        total, hit = total + len(lines), hit + len(got)
        if lines:
            missing = ", ".join(map(str, sorted(lines - got)))
            table.add_row(
                str(path.relative_to(ROOT)),
                str(len(lines)),
                str(len(got)),
                f"{100 * len(got) / len(lines):.0f}",
                missing[:60],
            )
    table.add_section()
    table.add_row("all", str(total), str(hit), f"{100 * hit / total:.1f}", "")
    console.print(table)
