"""Place of a wrong value in a scene file, put before the message that refuses it."""

import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import Any

from ..core.errors import InputError, ParameterError
from .read_yaml import YamlFile


@contextmanager
def located(file: YamlFile | None, *path: str | int) -> Iterator[None]:
    """Enter a block; its refusals begin with the name of a part of a scene and its line in the file.

    Parameters
    ----------
    file : YamlFile or None
        File from which the scene was read; None without a file.
    *path : str or int
        Keys and indices that lead to the part, such as ``"release", 0``; none: the whole scene.

    Raises
    ------
    ParameterError, InputError
        As the block does, with ``scene.yaml line 12: release[0]: `` before the message.
    """
    try:
        yield
    except (ParameterError, InputError) as error:
        message = str(error)
        if file is not None and message.startswith(f"{file.path} line "):
            raise
        blamed = path if file is None else _blamed(file.mapping, path, message)
        if blamed[:1] != path[:1]:  # the terrain reads files of releases to find its window
            path = blamed[:2] if len(blamed) > 1 and isinstance(blamed[1], int) else blamed[:1]
        first = str(path[0]) if path else "scene"
        label = first + "".join(f"[{step}]" if isinstance(step, int) else f": {step}" for step in path[1:])
        if not message.startswith(label):
            message = f"{label}: {message.removeprefix(f'{first}: ').removeprefix(f'{first.capitalize()}: ')}"
        place = "" if file is None else f"{file.path} line {file.lines.get(blamed, 1)}: "
        raise type(error)(place + message) from error


def _blamed(mapping: Any, path: tuple, message: str) -> tuple:
    """Return the path of the key that a message names: below `path` by its word or value, else anywhere by value."""
    value, named = mapping, path
    for step in path:
        if not _holds(value, step):
            return path
        value = value[step]
    for index, word in re.findall(r"\[(\d+)\]|(\w+)", re.split(r", got |; | must ", message)[0]):
        step = int(index) if index else word
        if _holds(value, step):
            named, value = (*named, step), value[step]
    here = [inner for inner, text in _texts(value, named) if text in message]
    anywhere = [inner for inner, text in _texts(mapping, ()) if text in message] if named == path else []
    return (here or anywhere or [named])[0]


def _holds(value: Any, step: str | int) -> bool:
    """Return whether a mapping has a key, or a list an index."""
    if isinstance(value, list):
        return isinstance(step, int) and step < len(value)
    return isinstance(value, Mapping) and step in value


def _texts(value: Any, path: tuple) -> Iterator[tuple]:
    """Yield path and value of every text of some length below a value."""
    if isinstance(value, Mapping):
        for key, inner in value.items():
            yield from _texts(inner, (*path, key))
    elif isinstance(value, list):
        for k, inner in enumerate(value):
            yield from _texts(inner, (*path, k))
    elif isinstance(value, str) and len(value) > 3:
        yield path, value
