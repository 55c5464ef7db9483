"""A full disk is told of as such, whatever the library that met it says."""

import errno
import os
import tempfile

import pytest

from landlab_debrisflow.record import write_atomically


def test_what_a_library_says_of_a_full_disk_is_replaced(tmp_path, monkeypatch):
    def full(*_, **__):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    def write(path):
        path.write_bytes(b"half")
        monkeypatch.setattr(tempfile, "TemporaryFile", full)
        raise RuntimeError("NetCDF: HDF error")

    with pytest.raises(OSError, match=r"No space left on device: '.*maps\.nc'") as refused:
        write_atomically(tmp_path / "maps.nc", write)
    assert isinstance(refused.value.__cause__, RuntimeError) and os.listdir(tmp_path) == []


def test_other_failures_stay_what_they_are(tmp_path):
    def write(path):
        raise RuntimeError("NetCDF: HDF error")

    with pytest.raises(RuntimeError, match="HDF error"):
        write_atomically(tmp_path / "maps.nc", write)
    assert os.listdir(tmp_path) == []
