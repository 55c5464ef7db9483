"""Tables in text files: separators, comments, and what is no table."""

import pytest

from landlab_debrisflow import InputError
from landlab_debrisflow.scene.text_table import MOST_BYTES, table_rows


@pytest.mark.parametrize(
    ("text", "head", "cells"),
    [
        ("angle,factor\n25.5,1\n", ["angle", "factor"], ["25.5", "1"]),
        ("angle, in degrees;factor\n25,5;1,0\n", ["angle, in degrees", "factor"], ["25,5", "1,0"]),
        ("angle\tfactor\r\n25,5\t1\r\n", ["angle", "factor"], ["25,5", "1"]),
        ("angle   factor\n25.5     1\n", ["angle", "factor"], ["25.5", "1"]),
        ('"angle, steep", factor\n"25,5", 1\n', ["angle, steep", "factor"], ["25,5", "1"]),
    ],
)
def test_the_first_line_tells_what_separates_columns(text, head, cells, tmp_path):
    path = tmp_path / "table.csv"
    path.write_bytes(("\ufeff# survey of May, Überlingen; draft\n\n" + text).encode())
    assert table_rows(path, "a table") == [(3, head), (4, cells)]


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"", "the file is empty"), (b"# nothing\n", "is empty; give a table"), (b"\xff\xfea\x00", "no text in UTF-8"),
        (b"a\x00b\n", "it is no text"), (b"1\n" * (MOST_BYTES // 2 + 1), "more than 5 MB"),
    ],
)  # fmt: skip
def test_what_is_no_table_is_refused(content, words, tmp_path):
    path = tmp_path / "table.csv"
    path.write_bytes(content)
    with pytest.raises(InputError, match=words):
        table_rows(path, "a table")
