"""What noxfile.py and pyproject.toml say of the project is so."""

import re
import tomllib
from pathlib import Path

ROOT = Path(__file__).parents[1]
NOXFILE = (ROOT / "noxfile.py").read_text(encoding="utf-8")
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]


def test_every_dependency_has_a_lowest_version():
    extras = PROJECT["optional-dependencies"]
    wanted = PROJECT["dependencies"] + extras["geo"] + extras["docs"] + extras["test"]
    needed = [each for each in wanted if "landlab_debrisflow[" not in each]
    assert [each for each in needed if ">=" not in each and "python_version" not in each] == []


def test_tools_that_judge_are_pinned():
    pinned = {each.split("==")[0] for each in PROJECT["optional-dependencies"]["dev"] if "==" in each}
    assert {"ruff", "mypy", "typos", "coverage"} <= pinned


def test_contributing_names_every_session():
    sessions = re.findall(r'@nox\.session(?:\(name="(.*?)"\)|\(.*\))?\ndef (\w+)', NOXFILE)
    text = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    assert [name or function for name, function in sessions if f"nox -s {name or function}" not in text] == []
