"""Scene files are YAML 1.2 of plain values; whatever else is refused with its place."""

import math

import pytest

from landlab_debrisflow.core.errors import InputError
from landlab_debrisflow.scene.read_yaml import MOST_BYTES, MOST_LEVELS, read_yaml


def read(folder, text):
    path = folder / "scene.yaml"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return read_yaml(path)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("3e-3", 3e-3), ("1E5", 1e5), ("-.5", -0.5), ("5.", 5.0), ("010", 10), ("+7", 7), ("-0", 0),
        ("true", True), ("False", False), ("null", None), ("~", None), ("", None), (".inf", math.inf),
        ("no", "no"), ("on", "on"), ("off", "off"), ("y", "y"), ("yes", "yes"),
        ("12:30", "12:30"), ("1_000", "1_000"), ("0o17", "0o17"), ("0x1f", "0x1f"), ("2026-11-26", "2026-11-26"),
        ("1.2.3", "1.2.3"), ("'3'", "3"), ('"no"', "no"), ("dem 5m.tif", "dem 5m.tif"),
        ("[1, 2.5, a]", [1, 2.5, "a"]), ("{b: {c: 1}}", {"b": {"c": 1}}), ("é", "é"),
    ],
)  # fmt: skip
def test_words_and_numbers_of_yaml_1_2(tmp_path, text, value):
    found = read(tmp_path, f"a: {text}\n").mapping["a"]
    assert found == value and type(found) is type(value)


@pytest.mark.parametrize("text", [b"\xef\xbb\xbfa: 1\r\nb: 2\r\n", b"a: 1\nb: 2", b"# c\n---\na: 1\nb: 2\n...\n"])
def test_line_ends_and_marks_do_not_matter(tmp_path, text):
    assert read(tmp_path, text).mapping == {"a": 1, "b": 2}


def test_integers_of_thousands_of_digits_are_numbers(tmp_path):
    assert read(tmp_path, f"a: {'9' * 9000}\n").mapping["a"] == math.inf


def test_every_key_and_entry_has_its_line(tmp_path):
    lines = read(tmp_path, "a:\n  b: 1\n\nc:\n  - d: 2\n    e: 3\n  - [4,\n     5]\n").lines
    assert lines == {
        ("a",): 1, ("a", "b"): 2, ("c",): 4, ("c", 0): 5, ("c", 0, "d"): 5, ("c", 0, "e"): 6, ("c", 1): 7,
        ("c", 1, 0): 7, ("c", 1, 1): 8,
    }  # fmt: skip


LAUGHS = "a: &a [x, x]\nb: &b [*a, *a]\nc: &c [*b, *b]\n"


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("a:\n\tb: 1\n", "line 2, column 1: no YAML.*not with tabs"),
        ("a: b: c\n", "line 1, column 5: no YAML.*into quotes"),
        ("a: 'b\n", "no YAML"), ("a: [1, 2\nb: 3\n", "no YAML"), ("a: 1\n b: 2\n", "line 2"),
        ("a: 1\nb: 2\na: 3\n", "line 3, column 1: the key 'a' is there already, in line 1"),
        (LAUGHS, "line 1, column 4: anchors"), ("a: *b\n", "line 1, column 4: anchors"),
        ("a: !!python/object/apply:os.system [ls]\n", "line 1, column 4: the tag"), ("a: !!int 3\n", "the tag"),
        ("a: ! 3\n", "the tag"),
        ("a: 1\n---\nb: 2\n", "line 2, column 1: a second document"),
        ("? [a]\n: 1\n", "a key must be a word"), ("{{a: 1}: 2}\n", "a key must be a word"),
        ("? " * 100_000, "a key must be a word|nesting"), ("- " * 100_000, "nesting"), ("*a : 1\n", "anchors"),
        ("a: " * 100_000, "no YAML"), ("!!str a: 1\n", "the tag"), ("{" * 100_000, "nesting|a key must be a word"),
        (f"a: {'[' * (MOST_LEVELS + 1)}", "levels of nesting"), ("a: " + "[" * 5000, "nesting"),
        ("", "is empty"), ("  \n\n", "is empty"), ("# only this\n", "got None"), ("- 1\n", "got a list"),
        ("3\n", "got 3"), ("a: \x00\n", "line 1: .* control character"), ("a: 1\nb: \x1b[2J\n", "line 2: .* control"),
        (b"a: 1\nb: \xfc\n", "line 2: byte 0xfc is no text in UTF-8"), ("a: 1".encode("utf-16"), "UTF-16"),
        (bytes(range(256)), "no text in UTF-8"), (b"a: b\n" * (MOST_BYTES // 4), "more than 1 MB"),
    ],
)  # fmt: skip
def test_what_is_refused_says_where(tmp_path, text, words):
    with pytest.raises(InputError, match=rf"(?s)scene\.yaml.*{words}"):
        read(tmp_path, text)


@pytest.mark.parametrize("name", ["missing.yaml", ".", "a\0b", "/dev/zero", "x" * 5000])
def test_what_is_no_file(tmp_path, name):
    with pytest.raises(InputError, match="cannot read"):
        read_yaml(tmp_path / name)
