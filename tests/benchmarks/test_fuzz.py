"""Files drawn at random, most of them odd, are read or refused; thousands by ``python -m benchmarks.fuzz``."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from benchmarks.fuzz.cases import KINDS, case
from benchmarks.fuzz.readers import Outcome, read
from benchmarks.fuzz.trial import GOOD

ROOT = Path(__file__).parents[2]
WITHOUT_FLOWS = [one for one in (case(5, number) for number in range(400)) if one.kind not in ("checkpoint", "record")]


@pytest.mark.parametrize("one", [one for one in WITHOUT_FLOWS if one.number % 4][:12], ids=lambda one: f"{one.number}")
def test_files_are_read_or_refused(one, tmp_path):
    outcome = read(one, tmp_path)
    assert outcome.name in GOOD, outcome


@pytest.mark.slow  # 20 s: every file in a process of its own, flows and checkpoints as well
def test_files_in_a_process_of_their_own():
    """The first of the cases of the benchmark: none crashes, hangs, writes beside, or ends in another exception."""
    command = [sys.executable, "-m", "benchmarks.fuzz", "--count", "200", "--seed", "3"]
    environment = os.environ | {"PYTHONPATH": str(ROOT)}
    found = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True, timeout=900)
    assert found.returncode == 0, found.stdout[-5000:] + found.stderr[-2000:]
    for kind in KINDS:
        assert kind in found.stdout


def test_a_reader_that_fails_is_told(tmp_path, monkeypatch):
    """An exception that is no refusal, and a file that a reader writes, are faults."""
    one = next(one for one in WITHOUT_FLOWS if one.form == "valid" and one.kind == "scene")

    def fail(folder, run):
        raise KeyError("depth")

    def litter(folder, run):
        (folder / "dem.asc.aux.xml").write_text("")
        return []

    for k, (reader, name) in enumerate([(fail, "error"), (litter, "written"), (lambda *_: [], "accepted")]):
        monkeypatch.setattr("benchmarks.fuzz.readers.read_scene", reader)
        (tmp_path / str(k)).mkdir()
        outcome = read(one, tmp_path / str(k))
        assert isinstance(outcome, Outcome) and outcome.name == name, outcome


def test_the_same_number_makes_the_same_files(tmp_path):
    for one in WITHOUT_FLOWS[:12]:
        first, second = tmp_path / f"{one.number}a", tmp_path / f"{one.number}b"
        first.mkdir(), second.mkdir()
        assert one.write(first) == one.write(second)
        for path in first.iterdir():
            if path.is_file() and path.suffix != ".nc":  # HDF5 writes the time into its files
                assert path.read_bytes() == (second / path.name).read_bytes(), path
