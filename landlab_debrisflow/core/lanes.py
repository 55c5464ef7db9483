"""Lanes of the vector unit: how many floats one register holds, and arrays that live in registers.

A kernel that treats as many targets at once as there are lanes keeps their values in such arrays, and loops over the
lanes innermost: the compiler turns this loop into single instructions, and the arrays into registers. Arrays of numpy
would be written to memory in every turn.
"""

import numpy as np
from llvmlite import ir
from numba import types
from numba.core.registry import cpu_target
from numba.extending import lower_builtin, type_callable
from numba.np.arrayobj import make_array, populate_array

REGISTERS = {"+avx512f": 16, "+avx": 8}
"""Floats in a register of a processor with some feature, the widest first; 4 without any of them."""


def _lanes() -> int:
    """Return the number of floats in the widest register of the processor that numba compiles for."""
    _, _, features = cpu_target.target_context.codegen().magic_tuple()
    present = features.split(",")
    return next((floats for feature, floats in REGISTERS.items() if feature in present), 4)


LANES = _lanes()
"""Floats in one vector register."""


def lane_floats():
    """Return an array of float32, shape (LANES,), not initialised; it lives until the kernel that asked for it ends."""
    return np.empty(LANES, np.float32)


def lane_places():
    """Return an array of int32, shape (LANES,), not initialised; it lives until the kernel that asked for it ends."""
    return np.empty(LANES, np.int32)


def _on_the_stack(function, number):
    """Let kernels have the array that `function` returns on their stack, as numbers of a numba type."""

    @type_callable(function)
    def find_type(context):
        return lambda: types.Array(number, 1, "C")

    @lower_builtin(function)
    def make(context, builder, signature, arguments):
        size = context.get_abi_sizeof(context.get_value_type(number))
        with builder.goto_entry_block():
            room = builder.alloca(ir.ArrayType(context.get_value_type(number), LANES))
            room.align = size * LANES
        array = make_array(signature.return_type)(context, builder)

        def constant(value):
            return context.get_constant(types.intp, value)

        populate_array(
            array, data=builder.bitcast(room, array.data.type), shape=(constant(LANES),), strides=(constant(size),),
            itemsize=constant(size), meminfo=None,
        )  # fmt: skip
        return array._getvalue()


_on_the_stack(lane_floats, types.float32)
_on_the_stack(lane_places, types.int32)
