"""Blocks of memory of particles: numbers of one type are rows of one array, so that few calls move all of them."""

from typing import NamedTuple

import numpy as np


class Block(NamedTuple):
    """Variables whose values lie in one array.

    Attributes
    ----------
    axis : int
        Axis of the array along which particles are counted.
    parts : dict of str to int or slice
        Index of the values of each variable in the array: a row, the rows of a vector, or all.
    initial : ndarray, shape (rows, 1) or (1, width)
        Values of a new particle.
    """

    axis: int
    parts: dict
    initial: np.ndarray

    def new(self, count: int, values) -> np.ndarray:
        """Return the array of new particles, shape (rows, count) or (count, width).

        `values` maps names of variables to numbers or arrays; other variables get their initial value.
        """
        array = np.repeat(self.initial, count, self.axis)
        for name, part in self.parts.items():
            if name in values:
                array[part] = values[name]
        return array


def blocks_of(variables, levels: int) -> tuple[Block, ...]:
    """Return the blocks of variables: one for all numbers and vectors of a type, one for each table of columns.

    Parameters
    ----------
    variables : sequence of Variable
    levels : int
        Levels of a pore-pressure column.

    Examples
    --------
    >>> from .variables import PARTICLE_VARIABLES
    >>> blocks = blocks_of(PARTICLE_VARIABLES[:6], levels=11)
    >>> blocks[1].parts
    {'x': 0, 'y': 1, 'z': 2, 'lowest_z': 3, 'velocity': slice(4, 7, None)}
    >>> blocks[1].initial.T
    array([[ 0.,  0.,  0., inf,  0.,  0.,  0.]])
    """
    rows: dict[np.dtype, list] = {}
    tables = []
    for variable in variables:
        if len(variable.shape(1, levels)) == 1 or variable.components:
            rows.setdefault(np.dtype(variable.dtype), []).append(variable)
        else:
            initial = np.full(variable.shape(1, levels), variable.initial, variable.dtype)
            tables.append(Block(0, {variable.name: slice(None)}, initial))
    return *(_rows(dtype, members) for dtype, members in rows.items()), *tables


def _rows(dtype: np.dtype, members) -> Block:
    """Return the block of numbers and vectors of one type, in the order of the variables."""
    parts, initial = {}, []
    for variable in members:
        first = len(initial)
        initial += [variable.initial] * max(variable.components, 1)
        parts[variable.name] = slice(first, len(initial)) if variable.components else first
    return Block(1, parts, np.array(initial, dtype)[:, None])
