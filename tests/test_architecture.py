"""The shape of the package: layers, file length, names (CONTRIBUTING.md)."""

import ast
import graphlib
import importlib
import pathlib

import landlab
import pytest
from landlab.components import COMPONENTS

import landlab_debrisflow

PACKAGE = pathlib.Path(landlab_debrisflow.__file__).parent
ROOT = pathlib.Path(__file__).parents[1]
FILES = sorted(PACKAGE.rglob("*.py"))
MODULES = {path.relative_to(PACKAGE).with_suffix("").as_posix(): path for path in FILES}

LEVEL = {
    "core": 0, "exact": 1, "spatial": 1, "terrain": 1, "physics": 2, "model": 3, "grid": 4,
    "record": 5, "columns": 6, "plots": 6, "geo": 6, "scene": 7, "fidelity": 9, "run": 10, "ensemble": 11,
    "sensitivity": 12, "hazard": 12, "calibration": 13,
    "report": 14, "cli": 15,
}  # fmt: skip
TOP = 8  # component and what stands beside it
KNOWS_LANDLAB = {
    "component", "restart", "grid/checks", "scene/tsing_shan", "run/grids", "run/scene", "run/simulate",
    "triggers", "fidelity/grids",
}  # fmt: skip


def layer(module):
    return module.split("/")[0] if "/" in module else "top"


def level(module):
    return LEVEL.get(layer(module), TOP)


def imports(path, root=PACKAGE.parent):
    """Yield the absolute name, as a list, of every import in a file below `root`."""
    inside = path.relative_to(root).with_suffix("").parts
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            for alias in node.names:
                yield alias.name.split(".")
        elif isinstance(node, ast.ImportFrom):
            base = list(inside[: len(inside) - node.level]) if node.level else []
            base += node.module.split(".") if node.module else []
            yield from ([*base, alias.name] for alias in node.names)


def inner(name):
    """Return the module of the package that a dotted name means, or None."""
    if name[0] != "landlab_debrisflow":
        return None
    for end in range(len(name), 1, -1):
        if (module := "/".join(name[1:end])) in MODULES or f"{module}/__init__" in MODULES:
            return module
    return "__init__"


@pytest.mark.slow
@pytest.mark.parametrize("module", MODULES)
def test_imports_go_downward_only(module):
    for name in imports(MODULES[module]):
        target = inner(name)
        if target is None or layer(module) in ("top", "cli"):
            continue
        assert target != "__init__", f"{module} imports the whole package"
        # terrain samples what it carries to particles with spatial/transfer; nothing goes the other way
        assert level(target) <= level(module), f"{module} imports {target} above it"
        assert (layer(module), layer(target)) != ("spatial", "terrain")
        if layer(module) == layer(target) == "physics":
            one, other = module.split("/")[1:], target.split("/")[1:]
            assert len(one) < 2 or len(other) < 2 or one[0] == other[0], f"{module} knows another kind of law: {target}"


def test_kernels_are_in_the_rooms_whose_sources_name_their_cache():
    """tests/conftest.py names numba's cache by a hash of these rooms."""
    compiled = {
        layer(module) for module, path in MODULES.items()
        if any(inner(name) == "core/jit" for name in imports(path)) and module != "laws"
    }  # fmt: skip
    assert compiled <= {"core", "spatial", "terrain", "physics", "model"}


def test_imports_have_no_circle():
    known = {module: {t for name in imports(path) if (t := inner(name))} - {module} for module, path in MODULES.items()}
    known = {m: {t if t in MODULES else f"{t}/__init__" for t in targets} for m, targets in known.items()}
    while leaves := [module for module, targets in known.items() if not targets & known.keys()]:
        for module in leaves:
            del known[module]
    assert known == {}, "these import each other"


WHOLE = {"sim", "simulation"}
"""Names of parameters that are the whole simulation."""

ROOMS = {"model": 1, "grid": 1}
"""Most functions of a room that may take it."""


def test_few_functions_take_the_whole_simulation():
    found = {}
    for module, path in MODULES.items():
        for node in ast.walk(ast.parse(path.read_text())):
            if isinstance(node, ast.FunctionDef):
                arguments = node.args.posonlyargs + node.args.args + node.args.kwonlyargs
                if WHOLE & {argument.arg for argument in arguments}:
                    found.setdefault(layer(module), []).append(f"{module}.{node.name}")
    assert {room: names for room, names in found.items() if len(names) > ROOMS.get(room, 0)} == {}


AROUND = {"tests", "benchmarks", "validation", "examples"}
FORBIDDEN = {
    "landlab_debrisflow": AROUND, "examples": {"tests", "benchmarks", "validation"}, "tests/benchmarks": {"examples"},
    "tests": {"benchmarks", "examples"}, "benchmarks": {"tests"}, "validation": {"tests", "benchmarks", "examples"},
    "validation/rivals": {"validation.cases"},
}  # fmt: skip
"""What no file of a folder imports; the longest name of a folder holds. Tests of benchmarks have a folder."""
OUTSIDE = {
    path.relative_to(ROOT).as_posix(): path for folder in FORBIDDEN for path in sorted((ROOT / folder).rglob("*.py"))
}


@pytest.mark.parametrize("path", OUTSIDE)
def test_cases_are_shared_and_nothing_else(path):
    """Tests and benchmarks both take their cases from validation, and know nothing of each other."""
    names = {".".join(name) for name in imports(OUTSIDE[path], ROOT)}
    for folder in (folder for folder in FORBIDDEN if path.startswith(f"{folder}/")):
        if folder == "tests" and path.startswith("tests/benchmarks/"):
            continue
        for other in FORBIDDEN[folder]:
            assert not [name for name in names if f"{name}.".startswith(f"{other}.")], f"{path} imports {other}"


def test_validation_imports_in_no_circle():
    files = {path.removesuffix(".py").replace("/", "."): OUTSIDE[path] for path in OUTSIDE}
    files = {name: path for name, path in files.items() if name.startswith("validation.")}
    graph = {
        name: {
            target for one in imports(path, ROOT)
            for target in (".".join(one), ".".join(one[:-1])) if target in files and target != name
        }
        for name, path in files.items()
    }  # fmt: skip
    tuple(graphlib.TopologicalSorter(graph).static_order())  # raises CycleError


def test_the_layers_are_all_known():
    folders = {layer(module) for module in MODULES} - {"top"}
    assert folders == set(LEVEL)


@pytest.mark.parametrize("module", MODULES)
def test_only_what_stands_on_top_knows_landlab(module):
    if module in KNOWS_LANDLAB:
        return
    assert not [name for name in imports(MODULES[module]) if name[0] == "landlab"]


@pytest.mark.parametrize("module", MODULES)
def test_numba_is_named_in_two_places(module):
    named = any(name[0] == "numba" for name in imports(MODULES[module]))
    assert named == (module in ("core/jit", "core/lanes"))


@pytest.mark.parametrize("module", MODULES)
def test_a_kernel_calls_no_kernel(module):
    # the copies in the callers differ by rounding, and which one is called depends on the cache (core/jit.py)
    known = vars(importlib.import_module(f"landlab_debrisflow.{module}".replace("/", ".").removesuffix(".__init__")))
    kernels = {name: value.py_func for name, value in known.items() if hasattr(value, "py_func")}
    calls = {name: set(function.__code__.co_names) & set(kernels) for name, function in kernels.items()}
    assert {name: called for name, called in calls.items() if called} == {}


@pytest.mark.parametrize("module", MODULES)
def test_files_are_short(module):
    assert len(MODULES[module].read_text().splitlines()) <= 300


@pytest.mark.parametrize("module", MODULES)
def test_the_library_does_not_print(module):
    calls = [node.func for node in ast.walk(ast.parse(MODULES[module].read_text())) if isinstance(node, ast.Call)]
    assert module == "cli/main" or not [f for f in calls if isinstance(f, ast.Name) and f.id == "print"]


def test_every_module_says_what_it_is():
    assert [module for module, path in MODULES.items() if not ast.get_docstring(ast.parse(path.read_text()))] == []


def test_public_names_exist():
    names = landlab_debrisflow.__all__
    assert "DebrisFlow" in names and len(set(names)) == len(names)
    assert [name for name in names if not hasattr(landlab_debrisflow, name)] == []


def test_info_has_the_six_keys_landlab_asks_for():
    keys = {"doc", "dtype", "intent", "mapping", "optional", "units"}
    for name, entry in landlab_debrisflow.DebrisFlow._info.items():
        assert set(entry) == keys, name
        assert entry["intent"] in ("in", "out", "inout") and entry["mapping"] == "node" and entry["doc"]
        assert entry["dtype"] in (float, int)


def test_shared_fields_are_described_in_landlabs_words():
    shared = 0
    for name, entry in landlab_debrisflow.DebrisFlow._info.items():
        words = {component._info[name]["doc"] for component in COMPONENTS if name in component._info}
        assert not words or entry["doc"] in words, name
        shared += bool(words)
    assert shared >= 3  # elevation, soil, ids of mass wasting


def test_the_citation_is_bibtex():
    text = landlab_debrisflow.DebrisFlow._cite_as.strip()
    assert text.startswith("@article{") and text.endswith("}")
    assert text.count("{") == text.count("}")
    registry = type(landlab.registry)()  # not the one of all: some of Landlab's own components break it
    registry.add(landlab_debrisflow.DebrisFlow)
    assert "10.1002/nag.3339" in registry.format_citations()


def test_no_public_attribute_is_called_update():
    # wrap_as_bmi would call it without dt
    assert not hasattr(landlab_debrisflow.DebrisFlow, "update")
