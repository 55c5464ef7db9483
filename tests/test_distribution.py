"""The wheel and the source distribution hold what they should, and their metadata agree with the documents."""

import importlib.util
import re
import shutil
import subprocess
import sys
import tarfile
import tomllib
import zipfile
from importlib.metadata import metadata
from pathlib import Path

import pytest

import landlab_debrisflow

ROOT = Path(__file__).parents[1]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
PACKAGE = "landlab_debrisflow"
NOT_SOURCE = {
    ".git", ".hypothesis", ".mypy_cache", ".nox", ".pytest_cache", ".ruff_cache", ".venv", "__pycache__", "_build",
    "build", "dist", "jupyter_execute", f"{PACKAGE}.egg-info",
}  # fmt: skip
MADE_BY_SETUPTOOLS = {"PKG-INFO", "setup.cfg"}


def sources():
    """Return the files that belong to the project: those that git tracks, in an unpacked distribution all files."""
    if (ROOT / ".git").exists():
        listed = subprocess.run(["git", "ls-files"], cwd=ROOT, check=True, capture_output=True, text=True)
        return {name for name in listed.stdout.splitlines() if (ROOT / name).exists()}
    paths = (path.relative_to(ROOT) for path in ROOT.rglob("*") if path.is_file())
    return {path.as_posix() for path in paths if not NOT_SOURCE & set(path.parts)} - MADE_BY_SETUPTOOLS


def load_setup():
    spec = importlib.util.spec_from_file_location("setup_of_the_package", ROOT / "setup.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def distributions(tmp_path_factory):
    """Build both from a copy of the sources, as `python -m build` does, with the setuptools that is installed."""
    folder = tmp_path_factory.mktemp("distributions")
    for name in sources():
        (folder / "sources" / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(ROOT / name, folder / "sources" / name)
    command = [sys.executable, "-m", "build", "--no-isolation", "--outdir", folder / "dist", folder / "sources"]
    built = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    assert built.returncode == 0, built.stdout + built.stderr
    (archive,), (wheel,) = (folder / "dist").glob("*.tar.gz"), (folder / "dist").glob("*.whl")
    return archive, wheel


def test_the_version_is_the_same_everywhere():
    assert landlab_debrisflow.__version__ == PROJECT["version"] == metadata(PACKAGE)["Version"]
    (cited,) = re.findall(r"^version: (.+)$", (ROOT / "CITATION.cff").read_text(encoding="utf-8"), re.MULTILINE)
    assert cited == PROJECT["version"]
    assert re.search(rf"^## {re.escape(cited)}\b", (ROOT / "CHANGES.md").read_text(encoding="utf-8"), re.MULTILINE)


def test_classifiers_name_pythons_that_are_allowed():
    lowest, beyond = (int(minor) for minor in re.findall(r"3\.(\d+)", PROJECT["requires-python"]))
    named = [int(minor) for minor in re.findall(r"Python :: 3\.(\d+)", "\n".join(PROJECT["classifiers"]))]
    assert named == list(range(lowest, named[-1] + 1)) and named[-1] < beyond
    assert "Typing :: Typed" in PROJECT["classifiers"]


def test_urls_are_public_addresses():
    assert PROJECT["urls"] and all(url.startswith("https://") for url in PROJECT["urls"].values())


@pytest.mark.parametrize(
    "text, there, alone",
    [
        ("see [laws](docs/laws.md#x).", "see [laws](https://a.org/b/blob/HEAD/docs/laws.md#x).", "see laws."),
        ("![a map](docs/a.png)", "![a map](https://a.org/b/raw/HEAD/docs/a.png)", "*Picture `docs/a.png` of the "),
        ("[![m](a.png)](b.md)", "[![m](https://a.org/b/raw/HEAD/a.png)](https://a.org/b/blob/HEAD/b.md)", "*Picture"),
        ("[paper](https://doi.org/1), [below](#x)", "[paper](https://doi.org/1), [below](#x)", "[paper](https://"),
        ("```python\nf[0](1)\n```", "```python\nf[0](1)\n```", "```python\nf[0](1)\n```"),
    ],
)
def test_links_of_the_long_description_hold_without_the_files(text, there, alone):
    published = load_setup().published
    assert published(text, "https://a.org/b/") == there
    assert published(text, None).startswith(alone)


@pytest.mark.slow
def test_the_source_distribution_holds_all_sources(distributions):
    with tarfile.open(distributions[0]) as archive:
        names = {name.split("/", 1)[1] for name in archive.getnames() if "/" in name}
        files = {member.name.split("/", 1)[1] for member in archive.getmembers() if member.isfile()}
    assert sources() - names == set()
    unasked = files - sources() - MADE_BY_SETUPTOOLS
    assert {name for name in unasked if not name.startswith(f"{PACKAGE}.egg-info/")} == set()


@pytest.mark.slow
def test_the_wheel_holds_the_package_and_nothing_else(distributions):
    names = set(zipfile.ZipFile(distributions[1]).namelist())
    assert f"{PACKAGE}/py.typed" in names
    package = {name for name in sources() if name.startswith(f"{PACKAGE}/")}
    assert {name for name in names if ".dist-info/" not in name} == package
    assert any(name.endswith(".dist-info/licenses/LICENSE") for name in names)


@pytest.mark.slow
def test_the_long_description_is_the_readme(distributions):
    with zipfile.ZipFile(distributions[1]) as wheel:
        (name,) = (name for name in wheel.namelist() if name.endswith("METADATA"))
        text = wheel.read(name).decode("utf-8")
    assert "Description-Content-Type: text/markdown\n" in text
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    assert text.endswith(load_setup().published(readme, PROJECT["urls"].get("Repository")))
    assert re.findall(r"\]\((?!https?:|#)[^)]*\)", re.sub(r"(?ms)^```.*?^```$", "", text)) == []


@pytest.mark.slow
def test_the_wheel_works_alone(distributions, tmp_path):
    target = tmp_path / "installed"
    with zipfile.ZipFile(distributions[1]) as wheel:
        wheel.extractall(target)
    script = [
        f"import sys; sys.path.insert(0, {str(target)!r})", f"import {PACKAGE}; print({PACKAGE}.__file__)",
        f"from {PACKAGE}.cli.main import main; main(['info'])",
    ]  # fmt: skip
    command = [sys.executable, "-P", "-c", "\n".join(script)]
    told = subprocess.run(command, check=True, cwd=tmp_path, capture_output=True, text=True).stdout
    assert told.startswith(str(target)) and "turbulent_coefficient" in told
