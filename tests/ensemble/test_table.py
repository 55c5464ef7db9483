"""Members from a table."""

import numpy as np
import pandas as pd
import pytest

from landlab_debrisflow import InputError, ParameterError
from landlab_debrisflow.ensemble import Ensemble
from landlab_debrisflow.run.scene import Scene

from .scenes import ANGLE, SCENE, VARY, same, square

COLUMNS = {ANGLE: [24.0, 26.0, 28.5], "release.volume": [500.0, 600.0, 700.0]}


def test_a_mapping_a_frame_and_a_file_give_the_same_members(tmp_path):
    (tmp_path / "members.csv").write_text(
        f"{ANGLE},release.volume\n" + "\n".join(f"{a},{v}" for a, v in zip(*COLUMNS.values(), strict=True)) + "\n"
    )
    scene = Scene.from_mapping(SCENE, tmp_path)
    lines = (f"{a};{v}".replace(".", ",") for a, v in zip(*COLUMNS.values(), strict=True))
    (tmp_path / "excel.csv").write_text(f"\ufeff{ANGLE} ; release.volume\r\n" + "\r\n".join(lines) + "\r\n\r\n")
    tables = COLUMNS, pd.DataFrame(COLUMNS), "members.csv", tmp_path / "members.csv", "excel.csv"
    ensembles = [Ensemble(scene, sampling=table) for table in tables]
    assert ensembles[0].values(2) == {ANGLE: 28.5, "release.volume": 700.0}
    assert len({one.digest() for one in ensembles}) == 1 and ensembles[0].sampling == "table"


def test_a_member_does_not_depend_on_members_before_it():
    """Members run on one grid, one after the other."""
    ensemble = Ensemble(SCENE, VARY, 2, "random")
    alone = Ensemble(SCENE, sampling=ensemble.design.isel(member=[1])).run(workers=1)
    (first,), (_, second) = alone.members(), ensemble.run(workers=1).members()
    assert first.measures["budget_eroded"] > 0.0 and same(first._replace(member=1), second)


@pytest.mark.slow
def test_members_of_a_design_give_their_results_again():
    vary = VARY | {
        "terrain.elevation_noise": {"rms": 0.1, "length": 10.0},
        "release.polygons": [square(20.0, 140.0), square(60.0, 140.0)],
    }
    ensemble = Ensemble(SCENE, vary, 4, seed=3)
    chosen = Ensemble(SCENE, sampling=ensemble.design.isel(member=[3, 1]), seed=3)
    assert [chosen.values(k) for k in (0, 1)] == [ensemble.values(k) for k in (3, 1)]
    whole, part = (list(one.run(workers=1).members()) for one in (ensemble, chosen))
    assert same(part[0]._replace(member=3), whole[3]) and same(part[1]._replace(member=1), whole[1])


def test_noise_beside_a_table_has_the_numbers_of_the_members():
    noise = {"terrain.elevation_noise": {"rms": 0.1, "length": 10.0}}
    ensemble = Ensemble(SCENE, noise, sampling=COLUMNS)
    assert [ensemble.values(k)["terrain.elevation_noise"] for k in range(3)] == [0, 1, 2]


def test_words_of_a_table_are_choices():
    ensemble = Ensemble(SCENE, sampling={"friction": ["coulomb", "voellmy", "coulomb"]})
    assert [ensemble.values(k)["friction"] for k in range(3)] == ["coulomb", "voellmy", "coulomb"]


@pytest.mark.parametrize(
    ("arguments", "error", "message"),
    [
        ({"sampling": {ANGLE: [24.0, 99.0]}}, ParameterError, r"basal_friction_angle must lie in .* of member 1"),
        ({"sampling": {ANGLE: [24.0, np.nan]}}, ParameterError, r"must lie in .*, got nan of member 1"),
        ({"sampling": {ANGLE: ["steep"]}}, ParameterError, r"must be numbers \[deg\] or names of rasters, got 'steep'"),
        ({"sampling": {ANGLE: [24.0], "release.volume": [1.0, 2.0]}}, InputError, r"must have one length"),
        ({"sampling": {ANGLE: []}}, InputError, r"must have one length of 1 or more, got \[0\]"),
        ({"sampling": COLUMNS, "members": 3}, ParameterError, r"a table has its own members; leave members out"),
        ({"sampling": COLUMNS, "vary": VARY}, ParameterError, r"a table holds the members"),
        ({"sampling": {"friction.angle": [1.0]}}, ParameterError, r"unknown name 'friction.angle'"),
        ({"sampling": "none.csv"}, InputError, r"cannot read none.csv: there is no such file"),
        ({"sampling": 3}, InputError, r"a table must be a Dataset, a DataFrame, a mapping or a file, got 3"),
    ],
)
def test_a_table_that_cannot_be_used_is_refused(arguments, error, message):
    with pytest.raises(error, match=message):
        Ensemble(SCENE, **arguments)


def test_a_gap_in_a_file_is_named(tmp_path):
    (tmp_path / "members.csv").write_text(f"{ANGLE},release.volume\n24,500\n25,\n")
    with pytest.raises(InputError, match=r"members.csv: release.volume has no value for member 1, line 3"):
        Ensemble(Scene.from_mapping(SCENE, tmp_path), sampling="members.csv")
