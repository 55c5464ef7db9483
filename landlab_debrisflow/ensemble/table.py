"""Members of an ensemble from a table of the user's own."""

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from ..core.checks import in_range
from ..core.errors import InputError, ParameterError
from ..core.hints import number_in
from ..scene.content import SceneContent
from ..scene.text_table import table_rows
from .design import Varied, design_keys, make_dataset
from .distributions import Choices, NoiseRealisations, check_file, distribution_of
from .names import NOISE, Name, find_name


class Listed(NamedTuple):
    """Numbers that a table lists, drawn from no distribution."""

    def values_at(self, uniform: np.ndarray) -> np.ndarray:
        """Refuse to draw values.

        Raises
        ------
        InputError
            Always.
        """
        raise InputError("ensemble: the values of a table are listed, no distribution draws them")


def design_of_table(
    table: Any, vary: Mapping[str, Any], content: SceneContent, folder: Path
) -> tuple[tuple[Varied, ...], xr.Dataset]:
    """Return the varied values and the design of a table of members.

    Parameters
    ----------
    table : Dataset, DataFrame, mapping of str to array_like, str or Path
        A column for each dotted name; a Dataset may be the design of another ensemble, or some members of it; the name
        of a file (text with commas, semicolons or tabs between columns, names in its first line).
    vary : mapping of str to object
        Only noise on the elevation, of which the table then holds the number of the realisation, or no column: then the
        number of the member counts.
    content : SceneContent
    folder : Path
        Directory to which the name of a file is relative.

    Returns
    -------
    varied : tuple of Varied
    design : xarray.Dataset

    Raises
    ------
    InputError, ParameterError
        If the table cannot be read, a name is unknown, or a value is out of bounds.
    """
    columns, known = _columns(table, folder)
    for key in vary:
        if not str(key).endswith(f".{NOISE}"):
            raise ParameterError(
                f"ensemble: vary: {key}: a table holds the members; keep vary or the table, with vary only for "
                f"terrain.{NOISE}"
            )
    counts = {values.size for values in columns.values()}
    if len(counts) != 1 or counts == {0}:
        raise InputError(f"ensemble: the columns of a table must have one length of 1 or more, got {sorted(counts)}")
    count = counts.pop()
    for key in vary:
        columns.setdefault(key, np.arange(count))
    varied, values = [], []
    for key, column in columns.items():
        name = find_name(key, content)
        if name.path[-1] == NOISE:
            one: Any = distribution_of(name, vary[key] if key in vary else known.get(key))
            found = _whole(name, column)
        else:
            one, found = _column(name, column)
        varied.append(Varied(name, one))
        values.append(found)
    return tuple(varied), make_dataset(varied, values, np.zeros(count, int))


def _column(name: Name, column: np.ndarray) -> tuple[Any, np.ndarray]:
    """Return the distribution that stands for a column, and its values in the design."""
    if column.dtype.kind in "iuf" and name.number is not None:
        in_range(
            f"ensemble: table: {name.key}", column, *name.bounds, name.unit, lambda bad: f" of member {bad[0]}",
            open_ends=(name.open_below, False),
        )  # fmt: skip
        return Listed(), _whole(name, column) if name.number is int else column.astype(float)
    words = [value.item() if hasattr(value, "item") else value for value in column]
    if name.number is not None:
        for value in words:
            check_file(name, f"ensemble: table: {name.key}", value)
    texts = [json.dumps(value) for value in words]
    different = list(dict.fromkeys(texts))
    choices = Choices(tuple(json.loads(text) for text in different), (1.0 / len(different),) * len(different))
    if choices.numeric:
        raise ParameterError(f"ensemble: table: {name.key} is no number, got {words[0]!r}")
    return choices, np.array([different.index(text) for text in texts])


def _whole(name: Name, column: np.ndarray) -> np.ndarray:
    numbers = np.asarray(column, float)
    if not np.array_equal(numbers, np.rint(numbers)):
        raise ParameterError(f"ensemble: table: {name.key} must be whole numbers, got {column[:3].tolist()}")
    return numbers.astype(np.int64)


def _columns(table: Any, folder: Path) -> tuple[dict[str, np.ndarray], dict[str, dict[str, float]]]:
    """Return the columns of a table by dotted name, and rms and length of noise by its name."""
    if isinstance(table, xr.Dataset):
        return _dataset_columns(table)
    if isinstance(table, str | Path):
        return _file_columns(folder / table), {}
    if isinstance(table, Mapping) or hasattr(table, "columns"):
        names = list(table) if isinstance(table, Mapping) else list(table.columns)
        found = {str(name): np.asarray(table[name]) for name in names}
        return {name: values if values.ndim == 1 else _objects(table[name]) for name, values in found.items()}, {}
    raise InputError(f"ensemble: a table must be a Dataset, a DataFrame, a mapping or a file, got {table!r:.60}")


def _dataset_columns(table: xr.Dataset) -> tuple[dict[str, np.ndarray], dict[str, dict[str, float]]]:
    keys = design_keys(table) or {str(name): str(name) for name in table.data_vars}
    columns, known = {}, {}
    for variable, key in keys.items():
        values, attributes = table[variable].values, table[variable].attrs
        if "choices" in attributes:
            choices = json.loads(attributes["choices"])
            values = _objects([choices[int(index)] for index in values])
        if "rms" in attributes:
            known[key] = {name: float(attributes[name]) for name in NoiseRealisations._fields}
        columns[key] = np.asarray(values)
    return columns, known


def _objects(values: Any) -> np.ndarray:
    found = np.empty(len(values), object)
    found[:] = list(values)
    return found


def _file_columns(path: Path) -> dict[str, np.ndarray]:
    (first, head), *rows = table_rows(path, "the table of an ensemble: names in the first line, then a line per member")
    if len(set(head)) < len(head):
        raise InputError(f"{path} line {first}: a name stands there twice; give each column one of its own")
    columns = {}
    for k, name in enumerate(head):
        texts = [row[k] if k < len(row) else "" for _, row in rows]
        if missing := [number for number, text in enumerate(texts) if not text]:
            raise InputError(f"{path}: {name} has no value for member {missing[0]}, line {rows[missing[0]][0]}")
        numbers = [number_in(text) for text in texts]
        columns[name] = np.array(texts if None in numbers else numbers)
    return columns
