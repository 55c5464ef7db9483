"""How a result came about: command, date, version, commit, machine and its load."""

import os
import platform
import subprocess
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from landlab_debrisflow import __version__

ROOT = Path(__file__).parents[1]
CODE = ("landlab_debrisflow", "validation", ":(exclude)validation/events/*/scores.json",
        ":(exclude)validation/events/*/sets", ":(exclude)validation/events/*/result.nc")  # fmt: skip
"""Paths whose changes make a commit dirty: not records, and not sets, which have commits of their own."""


def provenance(command: str) -> dict[str, Any]:
    """Return how a result came about: command, date, version, commit, machine and its load."""
    return {
        "command": command, "date": datetime.now(UTC).date().isoformat(), "version": __version__, "commit": commit(),
        "cores": os.cpu_count(), "processor": processor(), "python": platform.python_version(),
        "load": round(os.getloadavg()[0], 1),
    }  # fmt: skip


def commit() -> str:
    """Return the short name of the commit, with ``-dirty`` if files of the package differ; empty without Git."""
    git = ["git", "-C", str(ROOT)]
    try:
        name = subprocess.run([*git, "rev-parse", "--short", "HEAD"], check=True, capture_output=True, text=True)
        differs = subprocess.run([*git, "diff", "--quiet", "HEAD", "--", *CODE])
    except (OSError, subprocess.CalledProcessError):
        return ""
    return name.stdout.strip() + ("-dirty" if differs.returncode else "")


def processor() -> str:
    """Return the name of the processor."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        lines = []
    names = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.processor() or platform.machine()
