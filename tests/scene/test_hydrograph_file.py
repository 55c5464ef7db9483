"""Tables of time and discharge in the forms that gauges and spreadsheets write."""

import pytest

from landlab_debrisflow.core.errors import InputError
from landlab_debrisflow.scene.hydrograph_file import read_hydrograph

SURGE = ((0.0, 0.0), (60.0, 20.5))


@pytest.mark.parametrize(
    "text",
    [
        "time,discharge\n0,0\n60,20.5\n", "0,0\n60,20.5\n", "0 0\n60   20.5", "0\t0\n60\t20.5\n", "t;Q\n0;0\n60;20,5\n",
        "Time [s], Q (m3/s)\n0, 0\n60, 20.5\n", "discharge,time\n0,0\n20.5,60\n", "\ufefftime,q\n0,0\n60,20.5\n",
        "# gauge 7\n\ntime,stage,Q_m3s\r\n0,1,0\r\n60,2,20.5\r\n", '"time","discharge"\n"0","0"\n"60","20.5"\n',
    ],
)  # fmt: skip
def test_forms(tmp_path, text):
    path = tmp_path / "surge.csv"
    path.write_text(text, encoding="utf-8")
    assert read_hydrograph(path) == SURGE


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"", "is empty"), (b"\n# nothing\n", "is empty"), (b"time,discharge\n", "no line with numbers"),
        (b"hour,discharge\n0,1\n", "no column time; its columns are hour, discharge"),
        (b"time,q,flow\n0,1,2\n", "more than one column discharge"), (b"time,q\n0,1\n5,x\n", "line 3: column 2 .* 'x'"),
        (b"time,q\n0,1\n5\n", "line 3: column 2 must be a number, got ''"), (b"0,nan\n", "line 1: column 2"),
        (b"time,q\n0,\xff\n", "no text in UTF-8"), (b"t,q\n0,\x00\n", "no text"),
        (b"0,1\n" * 1_300_000, "more than 5 MB"),
        (b'time,q\n"0,1\n', "."),
    ],
)  # fmt: skip
def test_refusals(tmp_path, content, words):
    path = tmp_path / "surge.csv"
    path.write_bytes(content)
    with pytest.raises(InputError, match=words):
        read_hydrograph(path)


def test_no_file(tmp_path):
    for path in (tmp_path / "missing.csv", tmp_path, tmp_path / "a\0b"):
        with pytest.raises(InputError, match="cannot read"):
            read_hydrograph(path)
