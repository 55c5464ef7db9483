"""Notice that kernels are compiled, on standard error, once; numba's events stand for compilations."""

import pytest
from numba.core.event import trigger_event

from landlab_debrisflow.cli import demo, main
from landlab_debrisflow.core.errors import InputError
from landlab_debrisflow.record.monitor import COMPILING
from landlab_debrisflow.run import runner

SCENE = """\
terrain: {example: gully, soil_depth: 2.0}
release: {polygons: [[[400020, 5200145], [400050, 5200145], [400050, 5200170], [400020, 5200170]]], depth: 1.5}
output: {max_duration: 3.0}
numerics: {particle_count: 60}
"""


def events_of(kernels):
    """Return a function that stands for a run in which some kernels are compiled and which then fails."""

    def run(*_):
        for _ in range(kernels):
            with trigger_event("numba:compile"):
                pass
        raise InputError("over")

    return run


def notices(words, tmp_path, capsys) -> int:
    """Return how many lines on standard error tell of kernels that are compiled."""
    scene = tmp_path / "slope.yaml"
    scene.write_text(SCENE, encoding="utf-8")
    main.main([str(scene) if word == "SCENE" else word for word in words])
    out, err = capsys.readouterr()
    assert out == "" and err.splitlines()[-1].startswith("landlab-debrisflow: over")
    return sum(COMPILING in line for line in err.splitlines())


@pytest.mark.parametrize(
    ("words", "kernels", "told"),
    [
        (["demo"], 2, 1), (["demo"], 0, 0), (["run", "SCENE"], 2, 1), (["run", "SCENE"], 0, 0),
        (["run", "SCENE", "--quiet"], 2, 0),
    ],
)  # fmt: skip
def test_a_command_tells_once_if_it_compiles_and_is_not_quiet(words, kernels, told, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    for module, name in ((demo, "run_demo"), (runner, "advance")):
        monkeypatch.setattr(module, name, events_of(kernels))
    assert notices(words, tmp_path, capsys) == told
