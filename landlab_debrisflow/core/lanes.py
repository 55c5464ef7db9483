"""Lanes of the vector unit: how many floats one register holds, and arrays that live in registers.

A kernel that treats as many targets at once as there are lanes keeps their values in such arrays, and loops over the
lanes innermost: the compiler turns this loop into single instructions, and the arrays into registers. Arrays of numpy
would be written to memory in every turn.
"""

import numpy as np
from llvmlite import ir
from numba import types
from numba.core.cgutils import get_or_insert_function
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

DOUBLES = LANES // 2
"""Numbers of double precision in one vector register."""


def lane_floats():
    """Return an array of float32, shape (LANES,), not initialised; it lives until the kernel that asked for it ends."""
    return np.empty(LANES, np.float32)


def lane_places():
    """Return an array of int32, shape (LANES,), not initialised; it lives until the kernel that asked for it ends."""
    return np.empty(LANES, np.int32)


def lane_doubles():
    """Return an array of float64, shape (DOUBLES,), not initialised; it lives until the kernel that asked ends."""
    return np.empty(DOUBLES)


def lane_surroundings():
    """Return an array of float64, shape (16 DOUBLES,), for 16 nodes per lane, as `lane_doubles` does."""
    return np.empty(16 * DOUBLES)


def _on_the_stack(function, number, count):
    """Let kernels have the array of `count` numbers of a numba type that `function` returns on their stack."""

    @type_callable(function)
    def find_type(context):
        return lambda: types.Array(number, 1, "C")

    @lower_builtin(function)
    def make(context, builder, signature, arguments):
        size = context.get_abi_sizeof(context.get_value_type(number))
        with builder.goto_entry_block():
            room = builder.alloca(ir.ArrayType(context.get_value_type(number), count))
            room.align = 4 * LANES
        array = make_array(signature.return_type)(context, builder)

        def constant(value):
            return context.get_constant(types.intp, value)

        populate_array(
            array, data=builder.bitcast(room, array.data.type), shape=(constant(count),), strides=(constant(size),),
            itemsize=constant(size), meminfo=None,
        )  # fmt: skip
        return array._getvalue()


def append_hits(hits, first, found, count):
    """Append ``first + lane`` to the numbers found for every lane that is hit, and return how many these are now.

    `hits` are lanes of int32, 1 or 0; `found`, uint32, has `count` numbers and room for LANES more.
    """
    for lane in range(LANES):
        found[count] = first + lane
        count += hits[lane]
    return count


@type_callable(append_hits)
def _type_of_count(context):
    return lambda hits, first, found, count: types.intp


@lower_builtin(append_hits, types.Array, types.Integer, types.Array, types.Integer)
def _append_hits(context, builder, signature, arguments):
    """Write all lanes that are hit with one store if the processor can move them together (vpcompressd)."""
    integer, lanes = ir.IntType(32), ir.VectorType(ir.IntType(32), LANES)
    hits, found = (
        make_array(signature.args[k])(context, builder, arguments[k]) for k in (0, 2)
    )  # fmt: skip
    hit = builder.load(builder.bitcast(hits.data, lanes.as_pointer()), align=4 * LANES)
    first, count = builder.trunc(arguments[1], integer), arguments[3]
    if max(REGISTERS.values()) > LANES:
        for lane in range(LANES):
            number = builder.add(first, ir.Constant(integer, lane))
            builder.store(number, builder.gep(found.data, [count]))
            moved = builder.extract_element(hit, ir.Constant(integer, lane))
            count = builder.add(count, builder.zext(moved, count.type))
        return count
    mask = builder.icmp_unsigned("!=", hit, ir.Constant(lanes, None))
    numbers = ir.Constant(lanes, list(range(LANES)))
    spread = builder.insert_element(ir.Constant(lanes, ir.Undefined), first, ir.Constant(integer, 0))
    numbers = builder.add(
        numbers, builder.shuffle_vector(spread, ir.Constant(lanes, ir.Undefined), ir.Constant(lanes, None))
    )
    name, compressed = f"llvm.x86.avx512.mask.compress.v{LANES}i32", ir.FunctionType(lanes, [lanes, lanes, mask.type])
    compress = get_or_insert_function(builder.module, compressed, name)
    together = builder.call(compress, [numbers, ir.Constant(lanes, None), mask])
    place = builder.bitcast(builder.gep(found.data, [count]), lanes.as_pointer())
    builder.store(together, place, align=4)
    moved = builder.ctpop(builder.bitcast(mask, ir.IntType(LANES)))
    return builder.add(count, builder.zext(moved, count.type))


_on_the_stack(lane_floats, types.float32, LANES)
_on_the_stack(lane_places, types.int32, LANES)
_on_the_stack(lane_doubles, types.float64, DOUBLES)
_on_the_stack(lane_surroundings, types.float64, 16 * DOUBLES)
