"""Scene files as mappings of plain values, with the line of every key.

YAML 1.2 with its core schema: `3e-3` is a number, `no` and `12:30` are words. Values are built from the events of the
parser, so that no tag, alias or class of YAML has a meaning here.
"""

import io
import math
import re
from pathlib import Path
from typing import Any, NamedTuple

from ..core.errors import InputError

MOST_BYTES = 1_000_000
"""Size of the largest scene file that is read; tables and coordinates in such numbers belong into files."""
MOST_LEVELS = 20
"""Levels of nesting at most; a scene has up to eight."""
WORDS = {
    "": None, "~": None, "null": None, "Null": None, "NULL": None, "true": True, "True": True, "TRUE": True,
    "false": False, "False": False, "FALSE": False, ".nan": math.nan, ".NaN": math.nan, ".NAN": math.nan,
} | {sign + word: float(sign + "inf") for sign in ("", "-", "+") for word in (".inf", ".Inf", ".INF")}  # fmt: skip
INTEGER = re.compile(r"[-+]?[0-9]+\Z")
NUMBER = re.compile(r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?\Z")
ENCODINGS = {b"\xff\xfe": "UTF-16", b"\xfe\xff": "UTF-16", b"\x00\x00\xfe\xff": "UTF-32"}


class YamlFile(NamedTuple):
    """Content of a YAML file.

    Attributes
    ----------
    path : Path
        The file.
    mapping : dict
        Plain values.
    lines : dict
        Number of the line of every key and list entry, by its path: a tuple of keys and indices.
    text : str
        The text of the file.
    """

    path: Path
    mapping: dict[str, Any]
    lines: dict[tuple, int]
    text: str


def read_yaml(path: str | Path) -> YamlFile:
    """Read a YAML file that holds a mapping.

    Parameters
    ----------
    path : str or Path

    Returns
    -------
    YamlFile

    Raises
    ------
    InputError
        If the file cannot be read, is no text in UTF-8, no YAML, holds no mapping, a key twice, an alias or a tag.
    """
    path = Path(path)
    text = _read_text(path)
    reader = _Reader(path, text)
    mapping = reader.read()
    if not isinstance(mapping, dict):
        kind = "a list" if isinstance(mapping, list) else f"{mapping!r:.60}"
        raise InputError(f"{path}: a scene is a mapping with the keys terrain and release, got {kind}")
    return YamlFile(path, mapping, reader.lines, text)


def _read_text(path: Path) -> str:
    try:
        usable = path.is_file() or not path.exists()
        with path.open("rb") if usable else io.BytesIO() as file:
            data = file.read(MOST_BYTES + 1)
    except (OSError, ValueError) as error:  # ValueError: a null character in the name
        reason = getattr(error, "strerror", None) or str(error)
        raise InputError(f"cannot read {path}: {reason}; give the name of a scene file") from error
    if not usable:
        raise InputError(f"cannot read {path}: it is a directory or a device; give the name of a scene file")
    if len(data) > MOST_BYTES:
        raise InputError(
            f"cannot read {path}: it has more than {MOST_BYTES / 1e6:g} MB, too much for a scene; put polygons and "
            "tables into files of their own"
        )
    for mark, encoding in ENCODINGS.items():
        if data.startswith(mark):
            raise InputError(f"cannot read {path}: it is encoded in {encoding}; save it as UTF-8")
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        byte = f"byte 0x{data[error.start]:02x}"
        raise InputError(f"{path} line {line}: {byte} is no text in UTF-8; save the scene as UTF-8") from error
    if found := re.search(r"[\x00-\x08\x0b\x0c\x0e-\x1f\x7f]", text):
        line = text.count("\n", 0, found.start()) + 1
        raise InputError(f"{path} line {line}: it holds a control character {found.group()!r}; a scene is a text file")
    if not text.strip():
        raise InputError(f"{path} is empty; landlab-debrisflow new writes a scene to start from")
    return text


class _Reader:
    """Plain values out of the events of a YAML parser; `lines` is filled on the way."""

    def __init__(self, path: Path, text: str) -> None:
        try:
            import yaml
        except ImportError as error:
            raise InputError(f'{path}: YAML needs PyYAML; pip install "landlab_debrisflow[geo]"') from error
        self._yaml, self._path, self._text = yaml, path, text
        self.lines: dict[tuple, int] = {}
        self._events = yaml.parse(text, Loader=getattr(yaml, "CSafeLoader", yaml.SafeLoader))

    def read(self) -> Any:
        """Return the only document, or None if there is none."""
        yaml, value = self._yaml, None
        try:
            documents = 0
            for event in self._events:
                if isinstance(event, yaml.DocumentStartEvent):
                    if documents:
                        self._refuse(event, "a second document begins; a scene is one document, without a line ---")
                    value, documents = self._value(next(self._events), ()), 1
        except yaml.YAMLError as error:
            mark = getattr(error, "problem_mark", None)
            words = getattr(error, "problem", None) or str(error).split("\n")[0]
            raise InputError(f"{self._place(mark)}: no YAML: {words}{self._remedy(mark, words)}") from error
        return value

    def _value(self, event, path: tuple) -> Any:
        yaml = self._yaml
        self._check(event)
        if isinstance(event, yaml.ScalarEvent):
            return self._scalar(event)
        if len(path) >= MOST_LEVELS:
            self._refuse(event, f"more than {MOST_LEVELS} levels of nesting; a scene has fewer")
        if isinstance(event, yaml.SequenceStartEvent):
            return self._list(path)
        return self._mapping(path)

    def _check(self, event) -> None:
        """Refuse tags and aliases, whose meaning is not in the text."""
        if isinstance(event, self._yaml.AliasEvent) or event.anchor is not None:
            self._refuse(event, "anchors (&) and aliases (*) are not read; write the value out")
        if event.tag is not None:
            self._refuse(event, f"the tag {event.tag!r:.60} is not read; write plain values")

    def _list(self, path) -> list:
        values: list[Any] = []
        while not isinstance(event := next(self._events), self._yaml.SequenceEndEvent):
            here = (*path, len(values))
            self.lines[here] = event.start_mark.line + 1
            values.append(self._value(event, here))
        return values

    def _mapping(self, path) -> dict:
        values: dict[str, Any] = {}
        while not isinstance(event := next(self._events), self._yaml.MappingEndEvent):
            self._check(event)
            if not isinstance(event, self._yaml.ScalarEvent):
                self._refuse(event, "a key must be a word, not a list or mapping")
            key, here = event.value, (*path, event.value)
            if key in values:
                self._refuse(event, f"the key {key!r:.60} is there already, in line {self.lines[here]}; keep one")
            self.lines[here] = event.start_mark.line + 1
            values[key] = self._value(next(self._events), here)
        return values

    def _scalar(self, event) -> Any:
        text = event.value
        if not event.implicit[0]:  # quoted text stays text
            return text
        if text in WORDS:
            return WORDS[text]
        if INTEGER.match(text) and len(text) < 400:
            return int(text)
        return float(text) if NUMBER.match(text) else text

    def _remedy(self, mark, words: str) -> str:
        lines = self._text.split("\n")
        if mark is not None and mark.line < len(lines) and "\t" in lines[mark.line][: mark.column + 1]:
            return "; indent with blanks, not with tabs"
        return "; put text with : # ` @ or % into quotes" if re.search("mapping values|cannot start", words) else ""

    def _refuse(self, event, words: str):
        raise InputError(f"{self._place(event.start_mark)}: {words}")

    def _place(self, mark) -> str:
        return str(self._path) if mark is None else f"{self._path} line {mark.line + 1}, column {mark.column + 1}"
