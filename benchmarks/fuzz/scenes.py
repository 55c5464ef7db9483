"""Scene files: good ones, with one change of a key, a value or a line."""

import os
from pathlib import Path
from typing import Any

import numpy as np
import yaml

from . import ground
from .odd import HOSTILE, damaged, odd_value, one

SCALES = (-1.0, 1e-6, 1e-3, 1e3, 1e6, 0.0)


def write_mapping(path: Path, mapping: dict[str, Any]) -> str:
    """Write a mapping as YAML; return the text."""
    text = yaml.safe_dump(mapping, sort_keys=False, allow_unicode=True)
    path.write_text(text, encoding="utf-8", errors="surrogateescape", newline="")
    return text


def write_oddities(folder: Path) -> None:
    """Make what is no file: a pipe, a directory, a link to itself."""
    os.mkfifo(folder / "pipe")
    (folder / "folder").mkdir()
    (folder / "loop").symlink_to("loop")


def write(rng: np.random.Generator, folder: Path, form: str) -> str:
    """Write a scene of some form; return the change as text."""
    ground.write_files(folder)
    write_oddities(folder)
    path, mapping = folder / "scene.yaml", ground.mapping(rng)
    if form == "valid":
        write_mapping(path, mapping)
        return "nothing"
    if form == "bytes":
        data, done = damaged(rng, write_mapping(path, mapping).encode())
        path.write_bytes(data)
        return done
    if rng.random() < 0.7:
        done = change_value(rng, mapping)
        write_mapping(path, mapping)
        return done
    text, done = change_line(rng, write_mapping(path, mapping))
    path.write_bytes(text)
    return done


def places(value: Any, path: tuple = ()) -> list[tuple]:
    """Return the paths of all values in nested mappings and lists."""
    found = [path] if path else []
    entries = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, inner in entries:
        found += places(inner, (*path, key))
    return found


def change_value(rng: np.random.Generator, mapping: dict[str, Any]) -> str:
    """Change one key or value of nested mappings and lists in place; return the change as text."""
    path = one(rng, places(mapping))
    owner: Any = mapping
    for key in path[:-1]:
        owner = owner[key]
    key, where = path[-1], ".".join(map(str, path))
    way = int(rng.integers(8))
    if way == 0:
        del owner[key]
        return f"{where} removed"
    if way == 1 and isinstance(key, str):
        new = one(rng, (key[:-1], key + "s", key.upper(), key.replace("_", "-"), f" {key}", *HOSTILE))
        owner[new] = owner.pop(key)
        return f"{where} renamed {new!r:.60}"
    if way == 2:
        owner[key] = [owner[key]]
        return f"{where} in a list"
    if way == 3 and isinstance(owner[key], list) and owner[key]:
        owner[key] = owner[key][0]
        return f"{where} its first entry"
    if way == 4 and isinstance(owner[key], float | int):
        owner[key] = owner[key] * one(rng, SCALES)
        return f"{where} scaled to {owner[key]!r}"
    if way == 5 and isinstance(owner, dict):
        new = one(
            rng,
            ("depth", "elevation", "law", "interval", "zones", "edits", "window", "spacing", "directory", "thalweg"),
        )
        owner[new] = odd_value(rng)
        return f"{where}: {new} added, {owner[new]!r:.60}"
    if way == 6 and isinstance(owner[key], str):
        owner[key] = one(rng, HOSTILE)
        return f"{where} = {owner[key]!r:.60}"
    owner[key] = odd_value(rng)
    return f"{where} = {owner[key]!r:.60}"


def change_line(rng: np.random.Generator, text: str) -> tuple[bytes, str]:
    """Return the bytes of a text with one line changed, and the change as text."""
    lines = text.split("\n")
    k = int(rng.integers(len(lines)))
    line = lines[k]
    ways = {
        "indented more": f" {line}", "indented less": line[1:] if line.startswith(" ") else f"- {line}",
        "tab": f"\t{line}",
        "removed": None, "twice": f"{line}\n{line}", "no colon": line.replace(":", "", 1),
        "quote": line.replace(": ", ': "', 1),
        "comment": line.replace(": ", ": # ", 1), "anchor": line.replace(": ", ": &a ", 1),
        "alias": line.replace(": ", ": *a ", 1),
        "tag": line.replace(": ", ": !!python/name:os.system ", 1), "merge": f"<<: {{a: 1}}\n{line}",
        "document": f"---\n{line}",
        "end": f"...\n{line}", "deep": line + "[" * 300, "braces": line + "{" * 30, "control": f"{line}\x07",
        "text block": f"{line} |",
        "question": f"? {line}", "unit": f"{line} m", "comma": line.replace(".", ","), "semicolon": f"{line};",
        "null": f"{line}\x00",
        "percent": f"%YAML 9.9\n{line}", "long": f"{line}{'x' * 100_000}", "carriage": line.replace(" ", "\r"),
        "backtick": f"`{line}",
    }  # fmt: skip
    name = one(rng, [*ways, "byte order mark", "utf-16", "latin-1", "utf-32", "empty", "list", "spaces"])
    if name in ways:
        lines[k : k + 1] = [] if ways[name] is None else [ways[name]]
        return "\n".join(lines).encode(), f"line {k + 1}: {name}"
    if name == "latin-1":
        return (text + "# Grüß\n").encode("latin-1"), name
    data = {
        "byte order mark": text.encode("utf-8-sig"), "utf-16": text.encode("utf-16"), "utf-32": text.encode("utf-32"),
        "empty": b"",
        "list": b"- a\n- b\n", "spaces": b" \n\t\n",
    }  # fmt: skip
    return data[name], name
