"""Numbers of a report in words: rounded, with thousands apart, never split from their units."""

import math

from ..core.words import duration_text, grouped

SPACE = "\N{NO-BREAK SPACE}"


def rounded(value: float, unit: str = "", digits: int = 3) -> str:
    """Return a number with some significant digits and its unit, with spaces at which no line breaks.

    Examples
    --------
    >>> [rounded(value, "m").split() for value in (0.0, 3.14159, 1234.5, 0.00123, float("nan"))]
    [['0', 'm'], ['3.14', 'm'], ['1', '230', 'm'], ['0.00123', 'm'], ['not', 'known']]
    """
    if not math.isfinite(value):
        return f"not{SPACE}known"
    value = float(f"{value:.12g}")  # 1125 is 1125, also as a sum that is 1e-13 less
    if abs(value) >= 10.0 ** (digits - 1):
        scale = 10.0 ** (math.floor(math.log10(abs(value))) + 1 - digits)
        words = grouped(math.copysign(math.floor(abs(value) / scale + 0.5), value) * scale)
    else:
        words = f"{value:.{digits}g}"
    return f"{words}{'' if unit == '°' else ' '}{unit}".strip().replace(" ", SPACE)


def volume(value: float) -> str:
    """Return a volume [m3], to three digits."""
    return rounded(value, "m³")


def area(value: float) -> str:
    """Return an area [m2] in m2 or hectares.

    Examples
    --------
    >>> area(950.0).split(), area(123400.0).split()
    (['950', 'm²'], ['12.3', 'ha'])
    """
    return rounded(value, "m²") if value < 1e4 else rounded(value / 1e4, "ha")


def duration(seconds: float) -> str:
    """Return a duration [s] in the units in which people say it."""
    return duration_text(seconds).replace(" ", SPACE)


def plain(value: object, unit: str = "") -> str:
    """Return a value of a scene in words: numbers in full, coordinates by their number.

    Examples
    --------
    >>> plain(0.0004), plain(True), plain([1.0, 2.0]), plain([[[0.0, 1.0], [2.0, 3.0]]]), plain({"mill": [0.0, 1.0]})
    ('0.0004', 'yes', '1, 2', '2 pairs', 'mill: 0, 1')
    """
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float | int):
        return f"{value:.10g}" if abs(value) >= 1e5 else f"{value:.6g}"  # map coordinates have seven digits
    if isinstance(value, dict):
        return "; ".join(f"{name}: {plain(one)}" for name, one in value.items()) or "none"
    if isinstance(value, list | tuple):
        pairs = _pairs(value)
        if pairs:
            return ", ".join(plain(one) for one in value[0]) if len(value) == pairs == 1 else f"{pairs} pairs"
        return ", ".join(plain(one) for one in value) or "none"
    return str(value)


def _pairs(value: object) -> int:
    """Return the number of lists of numbers in nested lists; 0 for numbers alone."""
    if not isinstance(value, list | tuple) or not value or not isinstance(value[0], list | tuple):
        return 0
    inner = sum(_pairs(one) for one in value)
    return inner or len(value)
