"""Hints that end a refusal: the word or number that a user probably meant."""

import difflib
import re
from collections.abc import Iterable
from typing import Any


def python_value(value: Any):
    """Return the Python value of a scalar of numpy, or of an array without dimensions; anything else as it is."""
    return value.item() if getattr(value, "ndim", None) == 0 and hasattr(value, "item") else value


def same_word(word: Any, allowed: Iterable[str]) -> str | None:
    """Return the allowed word that equals `word` if case is ignored, or None.

    Examples
    --------
    >>> same_word("Voellmy", ("coulomb", "voellmy")), same_word("voelmy", ("coulomb", "voellmy"))
    ('voellmy', None)
    """
    if not isinstance(word, str):
        return None
    allowed = list(allowed)
    return word if word in allowed else next((name for name in allowed if name.lower() == word.lower()), None)


def did_you_mean(word: Any, allowed: Iterable[str]) -> str:
    """Return the question after the allowed word nearest to a refused one; an empty text if no word is near.

    Examples
    --------
    >>> did_you_mean("Herschel-Bulkly", ("coulomb", "herschel_bulkley"))
    " (did you mean 'herschel_bulkley'?)"
    >>> did_you_mean("ice", ("coulomb", "herschel_bulkley"))
    ''
    """
    names = {_folded(name): name for name in allowed}
    near = difflib.get_close_matches(_folded(word), names, 1) if isinstance(word, str) else ()
    return f" (did you mean {names[near[0]]!r}?)" if near else ""


def _folded(word: str) -> str:
    return word.lower().replace("-", "_").replace(" ", "_")


def number_in(text: Any) -> float | None:
    """Return the number that a text holds, with decimal point or comma, or None."""
    try:
        return float(text.replace(",", ".")) if isinstance(text, str) else None
    except ValueError:
        return None


def number_with_unit(text: Any) -> float | None:
    """Return the number in front of the unit in a text, or None.

    Examples
    --------
    >>> number_with_unit("28,5 deg"), number_with_unit("1.5m"), number_with_unit("2020_angle.tif")
    (28.5, 1.5, None)
    """
    found = re.fullmatch(r"\s*([-+]?[0-9][0-9.,]*(?:[eE][-+]?[0-9]+)?)\s*[^\W\d_][^\d_.]{0,11}[23]?\s*", str(text))
    return number_in(found[1]) if found and isinstance(text, str) else None


def give_number(value: Any, whole: bool = False) -> str:
    """Return a remedy for a value that is no number, or no whole number, as the end of a sentence; "" if none is known.

    Examples
    --------
    >>> give_number("30.0"), give_number(2000.0, whole=True), give_number(2000.5, whole=True)
    ('; give the number 30.0 without quotes', '; give 2000', '; round it')
    >>> give_number("28 deg")
    '; give the number 28 alone, without its unit'
    """
    number = number_in(value)
    if number is not None:
        exact = int(number) if whole and number.is_integer() else number
        return f"; give the number {exact!r} without quotes"
    if (number := number_with_unit(value)) is not None:
        return f"; give the number {number:g} alone, without its unit"
    if whole and isinstance(value, float):
        return f"; give {int(value)}" if value.is_integer() else "; round it"
    if hasattr(value, "__len__") and not isinstance(value, str):
        return "; give one number, it is the same everywhere"
    return ""
