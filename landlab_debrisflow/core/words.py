"""Text for people: names and messages from files are shown, and never obeyed by a terminal."""

import math
import unicodedata


def printable(text: object, *, lines: bool = False) -> str:
    r"""Return a text whose control characters are written as their codes, and which is one line unless `lines` is set.

    Terminals obey control characters; names and messages from files may hold any. Characters that reverse the
    direction of writing, or that no file can hold, are written as codes as well.

    Parameters
    ----------
    text : object
        Text, or an object such as an error that has one.
    lines : bool
        Whether line breaks stay.

    Returns
    -------
    str

    Examples
    --------
    >>> print(printable("a\x1b[31m\nb\u202e"))
    a\x1b[31m b\u202e
    """
    text = str(text)
    text = text if lines else " ".join(text.split())
    return "".join(_code(character) for character in text)


def _code(character: str) -> str:
    if character == "\n" or unicodedata.category(character) not in ("Cc", "Cf", "Cs", "Co", "Cn"):
        return character
    return character.encode("unicode_escape").decode("ascii")


def duration_text(seconds: float) -> str:
    """Return a duration in the unit in which people say it.

    Examples
    --------
    >>> [duration_text(t) for t in (0.34, 47.0, 100.0, 1500.0, 9000.0, 4e5)]
    ['0.3 s', '47 s', '1 min 40 s', '25 min', '2 h 30 min', '4 d 15 h']
    """
    if seconds < 10.0:
        return f"{seconds:.1f} s"
    for above, unit, smaller, per in ((86400.0, "d", "h", 24), (3600.0, "h", "min", 60), (60.0, "min", "s", 60)):
        if seconds >= above:
            count, rest = divmod(round(seconds * per / above), per)
            return f"{count} {unit}" + (f" {rest} {smaller}" if rest and count < 10 else "")
    return f"{seconds:.0f} s"


def grouped(number: float) -> str:
    """Return a whole number with its thousands apart.

    Examples
    --------
    >>> grouped(1234567.8), grouped(-1e-9), grouped(float("inf"))
    ('1 234 568', '0', 'inf')
    """
    return f"{round(number):,}".replace(",", " ") if math.isfinite(number) else f"{number:g}"
