"""Blocks of which sections of a report are made: sentences, tables, pictures, text as it is."""

import dataclasses
import re
from collections.abc import Sequence

from ..core.words import printable


@dataclasses.dataclass(frozen=True, kw_only=True)
class Table:
    """Table of a report.

    Attributes
    ----------
    caption : str
    head : sequence of str
        Headings of the columns; empty: the first cell of a row is its heading.
    rows : sequence of sequences of str
    numbers : sequence of int
        Columns that hold numbers, which are flush right, counted from 0.
    note : str
        Sentence below the caption.
    """

    caption: str
    rows: Sequence[Sequence[str]]
    head: Sequence[str] = ()
    numbers: Sequence[int] = ()
    note: str = ""
    kind = "table"

    def __post_init__(self) -> None:
        _make_printable(self, "caption", "note")
        object.__setattr__(self, "head", [line(cell) for cell in self.head])
        object.__setattr__(self, "rows", [[line(cell) for cell in row] for row in self.rows])


@dataclasses.dataclass(frozen=True, kw_only=True)
class Picture:
    """Picture of a report.

    Attributes
    ----------
    uri : str
        Data URI of the picture.
    text : str
        Words in place of the picture, for screen readers.
    caption : str
    moving : bool
        Whether it moves: then it is shown on request only.
    """

    uri: str
    text: str
    caption: str
    moving: bool = False
    kind = "picture"

    def __post_init__(self) -> None:
        _make_printable(self, "text", "caption")


@dataclasses.dataclass(frozen=True)
class Sentences:
    """Sentences of a report, as a paragraph or a list.

    Attributes
    ----------
    texts : sequence of str
    listed : bool
        Whether each is a point of a list.
    """

    texts: Sequence[str]
    listed: bool = False
    kind = "sentences"

    def __post_init__(self) -> None:
        object.__setattr__(self, "texts", [line(text) for text in self.texts])


@dataclasses.dataclass(frozen=True)
class Verbatim:
    """Text of a report that is shown as it is, line by line.

    Attributes
    ----------
    text : str
    """

    text: str
    kind = "verbatim"

    def __post_init__(self) -> None:
        object.__setattr__(self, "text", printable(self.text, lines=True))


def line(text: object) -> str:
    r"""Return a text in one line without control characters; no-break spaces stay.

    Examples
    --------
    >>> line("5\N{NO-BREAK SPACE}m\n deep") == "5\N{NO-BREAK SPACE}m deep"
    True
    """
    return printable(re.sub(r"[ \t\r\n]+", " ", str(text)).strip(), lines=True)


def _make_printable(block: object, *names: str) -> None:
    for name in names:
        object.__setattr__(block, name, line(getattr(block, name)))


Block = Table | Picture | Sentences | Verbatim


@dataclasses.dataclass(frozen=True)
class Section:
    """Section of a report.

    Attributes
    ----------
    name : str
        Name of its anchor.
    title : str
    blocks : sequence of Block
    """

    name: str
    title: str
    blocks: Sequence[Block]
