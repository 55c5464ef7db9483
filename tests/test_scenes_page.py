"""The page of scenes: its tables are the declarations, its scenes are scenes, its code runs."""

import math
import re
from pathlib import Path

import pytest
from jsonschema import Draft202012Validator

from landlab_debrisflow import Material
from landlab_debrisflow.cli.main import main
from landlab_debrisflow.laws import Coulomb, Growth
from landlab_debrisflow.scene.content import read_content
from landlab_debrisflow.scene.key_tables import with_tables
from landlab_debrisflow.scene.new_scene import new_scene
from landlab_debrisflow.scene.read_yaml import read_yaml
from landlab_debrisflow.scene.schema import scene_schema

ROOT = Path(__file__).parents[1]
PAGE = (ROOT / "docs" / "scenes.md").read_text(encoding="utf-8")
SCENES = re.findall(r"```yaml\n(.*?)```", PAGE, re.S)


def test_the_tables_are_up_to_date():
    assert (with_tables(PAGE) == PAGE) is True, "docs/scenes.md is out of date; run: python -m benchmarks.scene_keys"


@pytest.mark.parametrize("text", SCENES, ids=range(len(SCENES)))
def test_scenes_are_scenes(text, tmp_path):
    path = tmp_path / "scene.yaml"
    path.write_text(text if "terrain:" in text else "terrain: {example: gully}\n" + text)
    file = read_yaml(path)
    read_content(file.mapping, file)
    assert list(Draft202012Validator(scene_schema()).iter_errors(file.mapping)) == []


def test_the_apparent_friction_of_the_page_is_that_of_the_defaults():
    material, friction = Material(), Coulomb()
    density = material.density
    buoyant = math.tan(math.radians(friction.basal_friction_angle)) * (1.0 - material.water_density / density)
    apparent = buoyant * (1.0 - material.initial_pressure_ratio)
    words = " ".join(PAGE.split())
    assert f"make it {apparent:.3f}, that is {math.degrees(math.atan(apparent)):.0f}°" in words
    assert f"then it is {buoyant:.2f}." in words
    assert material.initial_pressure_ratio == material.bed_pressure_ratio == 0.65
    assert f"doubles every {10.0 * round(0.1 * math.log(2.0) / Growth().growth_rate):.0f} m" in words


@pytest.mark.slow
def test_the_code_runs(tmp_path, monkeypatch, capsys):
    (code,) = re.findall(r"```python\n(.*?)```", PAGE, re.S)
    monkeypatch.chdir(tmp_path)
    new_scene("scene.yaml")
    exec(compile(code, "scenes.md", "exec"), {})
    here, softer = map(float, capsys.readouterr().out.splitlines()[-2].split())
    assert 5.0 < here < softer < 40.0


def test_commands_and_links_exist(capsys):
    assert [link for link in re.findall(r"\]\(([^)#:]+)\)", PAGE) if not (ROOT / "docs" / link).exists()] == []
    for command in {words.split()[0] for words in re.findall(r"landlab-debrisflow (\w+ )", PAGE)}:
        with pytest.raises(SystemExit) as end:
            main([command, "--help"])
        assert end.value.code == 0
    capsys.readouterr()
