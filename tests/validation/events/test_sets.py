"""Sets of parameters: values have sources and are chosen as they say; changes must be committed."""

import subprocess

import pytest

from landlab_debrisflow import InputError
from validation.events import EVENTS, find_event
from validation.events.sets import read_set, set_names

from .synthetic import SET


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "made_up.yaml").write_text(SET, encoding="utf-8")
    return tmp_path


def git(folder, *arguments):
    name = ["-c", "user.name=n", "-c", "user.email=e@x.org"]
    return subprocess.run(["git", "-C", str(folder), *name, *arguments], check=True, capture_output=True, text=True)


def test_values_are_plain_keywords(folder):
    found = read_set(folder, "made_up")
    assert found.keywords() == {
        "friction": {"law": "voellmy", "basal_friction_angle": 20.0, "turbulent_coefficient": 500.0},
        "column": {"law": "ale", "levels": 11},
    }
    assert found.plain("site") == {"soil_depth": 0.5} and found.known_when_chosen == "nothing"


def test_a_set_that_is_based_on_another_has_its_values(folder):
    nested = "column:\n  dilatancy:\n    permeability: {value: 1e-9, unit: m2, range: [1e-10, 1e-8], " \
        "choice: geometric centre, source: s}\n"  # fmt: skip
    (folder / "b.yaml").write_text(f"title: b\nknown_when_chosen: k\nbased_on: made_up\n{nested}", encoding="utf-8")
    found = read_set(folder, "b")
    assert found.keywords()["column"] == {"law": "ale", "levels": 11, "dilatancy": {"permeability": 1e-9}}
    assert found.keywords()["friction"]["turbulent_coefficient"] == 500.0
    assert [path.stem for path in found.paths] == ["b", "made_up"]
    other = "friction:\n  law: coulomb\n"
    (folder / "c.yaml").write_text(f"title: c\nknown_when_chosen: k\nbased_on: made_up\n{other}", encoding="utf-8")
    assert read_set(folder, "c").keywords()["friction"] == {"law": "coulomb"}  # another law: nothing of the first


@pytest.mark.parametrize(
    ("before", "after", "message"),
    [
        ("value: 20.0", "value: 24.0", r"basal_friction_angle is 24, but the centre of \[15.0, 25.0\] is 20"),
        ("source: a book", "source: ''", r"basal_friction_angle needs a source"),
        ("unit: deg, ", "", r"basal_friction_angle needs a unit"),
        ("choice: measured", "choice: guessed", r"choice of site.soil_depth must be one of centre, .*got 'guessed'"),
        ("range: [15.0, 25.0]", "range: [25.0, 15.0]", r"must be two increasing numbers"),
        ("range: [15.0, 25.0], ", "", r"is the centre of a range; give range"),
        ("friction:", "fricton:", r"unknown key 'fricton' \(did you mean 'friction'\?\)"),
        ("known_when_chosen: nothing", "", r"known_when_chosen must be a text"),
        ("{value: 0.5, unit: m, choice: measured, source: a pit}", "0.5", r"site.soil_depth must have value, unit"),
    ],
)  # fmt: skip
def test_a_value_without_its_source_is_refused(folder, before, after, message):
    assert before in SET
    (folder / "made_up.yaml").write_text(SET.replace(before, after, 1), encoding="utf-8")
    with pytest.raises(InputError, match=message):
        read_set(folder, "made_up")


def test_an_unknown_set_is_asked_back(folder):
    with pytest.raises(InputError, match=r"no set 'made-up' \(did you mean 'made_up'\?\)"):
        read_set(folder, "made-up")
    with pytest.raises(InputError, match=r"no event 's100' \(did you mean 's1000'\?\)"):
        find_event("s100")


def test_a_scan_changes_one_value(folder):
    changed = list(read_set(folder, "made_up").scan())
    assert [each.change for each in changed] == ["basal_friction_angle = 15 deg", "basal_friction_angle = 25 deg"]
    assert [each.plain("friction")["basal_friction_angle"] for each in changed] == [15.0, 25.0]
    assert all(each.plain("friction")["turbulent_coefficient"] == 500.0 for each in changed)


def test_a_wide_range_is_scanned_between_its_ends(folder):
    wide = SET.replace("value: 500.0, unit: m s-2,", "value: 1e-9, unit: m s-2, range: [1e-10, 1e-8],")
    (folder / "wide.yaml").write_text(wide, encoding="utf-8")
    changed = [each.plain("friction")["turbulent_coefficient"] for each in read_set(folder, "wide").scan("turbulent")]
    assert changed == [1e-10, 3.16e-10, 3.16e-9, 1e-8]
    assert list(read_set(folder, "wide").scan("nothing")) == []


@pytest.mark.slow
def test_changes_of_a_set_must_be_committed(folder):
    with pytest.raises(InputError, match="use a checkout"):
        read_set(folder, "made_up").commit()
    git(folder, "init", "-q")
    with pytest.raises(InputError, match=r"not committed: made_up\.yaml"):
        read_set(folder, "made_up").commit()
    git(folder, "add", "made_up.yaml")
    git(folder, "commit", "-qm", "first")
    assert git(folder, "rev-parse", "HEAD").stdout.startswith(read_set(folder, "made_up").commit().name)
    (folder / "made_up.yaml").write_text(SET + "\n# a comment\n", encoding="utf-8")
    with pytest.raises(InputError, match="commit it before it is scored"):
        read_set(folder, "made_up").commit()


@pytest.mark.parametrize("name", EVENTS)
def test_the_sets_of_events_can_be_read(name):
    folder = find_event(name).read_set().paths[0].parent
    for set_name in set_names(folder):
        found = read_set(folder, set_name)
        assert list(found.sourced()) and len(found.known_when_chosen) > 40
