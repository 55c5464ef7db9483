"""Odd values, and damage to bytes."""

from typing import Any

import numpy as np

HOSTILE = (
    "[red]x[/red]", "[/]", "<script>alert(1)</script>", "\x1b[31mred", "a\nb", "a\x00b", "\u202eabc", "../../x",
    "/dev/zero",
    "/dev/stdin", "/etc/passwd", "/proc/self/mem", "..", ".", "~", "", " ", "a" * 5000, "%s%n", "{0}", "$HOME",
    "file:dem.asc",
    "/vsicurl/http://localhost:1/a.tif", "http://localhost:1/a.tif", "dem.asc:2", "dem.asc:", ":", "CON", "\ud7ff",
    "Ж", "🌋",
    "pipe", "folder", "loop", "missing.tif", "scene.yaml", "!!python/object/apply:os.system ['true']",
)  # fmt: skip
"""Texts that terminals, pages, shells, format strings and file systems might take for more than text."""

NUMBERS = (
    0, -1, 1, 2, -0.0, 1e-320, 1e-9, 0.5, 1e3, 1e6, 1e9, 1e15, 1e300, 1e308, -1e308, float("nan"), float("inf"),
    -float("inf"),
    2**31, 2**63, -(2**63), 2**64, 10**30, 10**400, 3, 7, 45.0, 89.9, 90.0, 180.0, 360.0, -9999, 1000, 273.15, 9.81,
)  # fmt: skip

WORDS = (
    "5 m",
    "28,5",
    "1e5",
    "1_000",
    "0x10",
    "12:30",
    "2020-01-01",
    "yes",
    "none",
    "nan",
    "inf",
    "None",
    "true",
    "1.5deg",
)


def odd_value(rng: np.random.Generator, depth: int = 0) -> Any:
    """Return a value that is hardly expected anywhere."""
    pick = rng.integers(9)
    if pick < 4:
        return NUMBERS[rng.integers(len(NUMBERS))]
    if pick == 4:
        return WORDS[rng.integers(len(WORDS))]
    if pick == 5:
        return HOSTILE[rng.integers(len(HOSTILE))]
    if pick == 6:
        return (None, True, False)[rng.integers(3)]
    if depth > 2:
        return []
    if pick == 7:
        return [odd_value(rng, depth + 1) for _ in range(rng.integers(4))]
    return {("a", "law", "name", "", "0")[k]: odd_value(rng, depth + 1) for k in range(rng.integers(3))}


def damaged(rng: np.random.Generator, data: bytes, most: int = 8) -> tuple[bytes, str]:
    """Return bytes with a few changes, and the change as text."""
    done = []
    for _ in range(rng.integers(1, most + 1)):
        size = len(data)
        at = int(rng.integers(size + 1))
        length = int(min(rng.integers(1, 2 ** rng.integers(1, 10)), size))
        end = min(at + length, size)
        way = int(rng.integers(7))
        if way == 0 and size:
            at = min(at, size - 1)
            data = data[:at] + bytes([data[at] ^ (1 << int(rng.integers(8)))]) + data[at + 1 :]
        elif way == 1:
            data = data[:at]
        elif way == 2:
            data = data[:at] + data[end:]
        elif way == 3:
            data = data[:at] + rng.bytes(length) + data[at:]
        elif way == 4:
            data = data[:end] + data[at:end] * int(rng.integers(1, 4)) + data[end:]
        elif way == 5:
            data = data[:at] + (b"\x00", b"\xff", b" ", b"9")[rng.integers(4)] * (end - at) + data[end:]
        else:
            data = data[:at] + rng.bytes(end - at) + data[end:]
        done.append(f"{('flip', 'cut', 'remove', 'insert', 'repeat', 'fill', 'overwrite')[way]} at {at}")
    return data, ", ".join(done)


def one(rng: np.random.Generator, choices) -> Any:
    """Return one of the choices."""
    return choices[int(rng.integers(len(choices)))]
