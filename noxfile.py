"""Every habit is one command: ``nox -l`` lists them, ``nox -s test-fast`` runs one in an environment of its own."""

import re
import shutil
import time
import tomllib
from pathlib import Path

import nox

nox.options.sessions = ["check", "test-fast"]
nox.options.reuse_existing_virtualenvs = True

PROJECT = tomllib.loads(Path("pyproject.toml").read_text(encoding="utf-8"))["project"]
EXTRAS = PROJECT["optional-dependencies"]
JITTED = r"^\s*@(kernel|approximate_kernel|inner)\b"

PLAIN = [
    "tests/without_jit",
    "tests/cli/test_laws.py",
    "tests/columns",
    "tests/core",
    "tests/exact",
    "tests/grid/test_bad_inflow.py",
    "tests/physics",
    "tests/plots",
    "tests/record/test_measures.py",
    "tests/scene",
    "tests/test_varying_parameters.py",
    "landlab_debrisflow/core",
    "landlab_debrisflow/physics",
    "--ignore=tests/physics/column/test_bounds.py",
    "--deselect=tests/record/test_measures.py::test_of_a_flow_that_moves_and_of_its_deposit",
]
"""Tests that take no more than minutes where kernels are plain Python."""
FAST = ["python", "-m", "pytest", "-q", "-n", "auto", "-m", "not slow", "tests", "landlab_debrisflow"]
"""The fast subset, on all processors."""


@nox.session
def test(session):
    """Run all tests and doctests, and build the site, which runs notebooks and pages."""
    session.install("-e", ".[test]")
    session.run("python", "-m", "pytest", "-n", "auto", *session.posargs)


@nox.session(name="test-fast")
def test_fast(session):
    """Run a subset that reaches every room: less than a minute once kernels are in numba's cache."""
    session.install("-e", ".[test]")
    start = time.perf_counter()
    session.run(*FAST, *session.posargs)
    session.log(f"fast subset: {time.perf_counter() - start:.0f} s")


@nox.session(name="test-nojit")
def test_nojit(session):
    """Run kernels as plain Python, which checks every index, and measure coverage: at least 95 % outside kernels.

    Whole events take hours as plain Python, so these are tests of few particles and few steps.
    """
    session.install("-e", ".[test]", *(each for each in EXTRAS["dev"] if each.startswith("coverage")))
    # numba keeps silent where NaN is meant; Python warns
    quiet = ["-m", "pytest", "-q", "-m", "not slow", "-W", "default::RuntimeWarning"]
    session.run("python", "-m", "coverage", "run", *quiet, *PLAIN, env={"NUMBA_DISABLE_JIT": "1"})
    session.log("all lines, then those outside kernels")
    session.run("coverage", "report")
    session.run("coverage", "report", "--fail-under=95", env={"COVERAGE_LEAVE_OUT": JITTED})


@nox.session(python="3.11")
def oldest(session):
    """Run the fast subset with the lowest versions that pyproject.toml allows."""
    wanted = PROJECT["dependencies"] + EXTRAS["geo"] + EXTRAS["ensemble"] + EXTRAS["docs"] + EXTRAS["test"]
    needed = [each for each in wanted if "landlab_debrisflow[" not in each]
    lowest = [re.sub(r">=([\d.]+)(,[^;]*)?", r"==\1", each) for each in needed]
    session.install(*lowest)
    session.install("--no-deps", "-e", ".")
    session.run(*FAST, *session.posargs)


@nox.session
def check(session):
    """Check style, form and types."""
    session.install("-e", ".[dev]")
    session.run("ruff", "check", ".")
    session.run("ruff", "format", "--check", ".")
    session.run("typos")
    session.run("mypy")


@nox.session
def build(session):
    """Build wheel and source distribution, install the one and run the fast subset in the other; both are in dist/."""
    session.install("build", "twine>=6.1")
    work = Path(session.create_tmp()).resolve()
    shutil.rmtree(work, ignore_errors=True)
    session.run("python", "-m", "build", "--outdir", str(work / "dist"), ".")
    (archive,), (wheel,) = (work / "dist").glob("*.tar.gz"), (work / "dist").glob("*.whl")
    session.run("twine", "check", "--strict", str(archive), str(wheel))
    session.install(f"landlab_debrisflow[test] @ {wheel.as_uri()}")
    shutil.copytree(work / "dist", "dist", dirs_exist_ok=True)
    shutil.unpack_archive(archive, work, filter="data")
    session.chdir(work / archive.name.removesuffix(".tar.gz"))
    session.run(*FAST, *session.posargs)


@nox.session
def docs(session):
    """Build the documentation site, which executes pages and notebooks; check links, README and doctests."""
    session.install("-e", ".[test]")
    site = Path("docs/_build/html")
    session.run("python", "-m", "sphinx", "-W", "--keep-going", "-n", "-j", "4", "-q", "docs", str(site))
    session.run("python", "docs/_site/links.py", str(site))
    pages = [
        "tests/docs",
        "tests/test_readme.py",
        "tests/test_contributing.py",
        "tests/test_which_component.py",
        "tests/cli/test_laws.py",
    ]
    session.run("python", "-m", "pytest", "-q", *pages, "landlab_debrisflow", env={"SITE": str(site)})
    session.log(f"the site: {(site / 'index.html').resolve().as_uri()}")


@nox.session
def figures(session):
    """Draw figures and tables from the result files of benchmarks/, all or by name: ``nox -s figures -- column``."""
    session.install("-e", ".[test]")
    session.run("python", "-m", "benchmarks.charts", *session.posargs)


@nox.session
def measure(session):
    """Measure anew what figures are drawn from, minutes to hours: ``nox -s measure -- column``."""
    session.install("-e", ".[test]")
    session.run("python", "-m", "benchmarks.charts", "--measure", *session.posargs)
