"""Types of our named tuples for the compiler, from their annotations, and arrays that compiled code does not count."""

import typing
from typing import Annotated, Any

from numba import float64, int64, types
from numba.extending import intrinsic, overload
from numba.np.arrayobj import make_array

from bench.engines.arrays import Matrix, Three, Vector
from bench.law.chain import Chain, Scratch
from bench.law.control.resolved_acceleration import Buffers
from bench.law.control.setpoint import ContactBuffers, Rows, Setpoint
from bench.law.inputs import Goal
from bench.law.so3 import Rotation
from tasks.condition import FIELDS, Condition

UNTYPED: dict[Any, tuple] = {
    Rotation: (Three, Three, Three),
    Goal: (Rotation, Three, Three),
    Chain: (int, Matrix, Matrix, Vector, Three, Rotation),
    Scratch: (Matrix, Matrix, Matrix, Vector, Vector),
    Buffers: (Matrix, Vector, Vector, Vector, Scratch),
    Rows: (Vector,) * 5,
    ContactBuffers: (Vector, Vector, Vector, Matrix, Scratch),
    Setpoint: (Rotation, Three, Three, Three, Three),
    Condition: tuple(Three if isinstance(one.default, tuple) else type(one.default) for one in FIELDS),
}
"""Annotations of tuples without their own, since counting scalars and symbols go into them or files declare them."""

SCALARS: dict[Any, types.Type] = {int: int64, float: float64, bool: types.boolean, None: types.none}


PART = {"error_model": "numpy", "no_cpython_wrapper": True, "no_cfunc_wrapper": True}
"""Options of what only compiled code calls: without wrappers for Python and C, which take apart every array of a tuple,
a loop of arms compiles in four fifths of the time."""


def type_of(hint: Any) -> types.Type:
    """Return the type of an annotation: of a number, an array, or a tuple, plain or named, of such."""
    if hint in SCALARS:
        return SCALARS[hint]
    if typing.get_origin(hint) is Annotated:
        (kind,) = hint.__metadata__
        return int64[::1] if kind == "integers" else types.Array(float64, kind, "C")
    if typing.get_origin(hint) is tuple:
        return types.Tuple(tuple(map(type_of, typing.get_args(hint))))
    hints = UNTYPED.get(hint) or typing.get_type_hints(hint, include_extras=True).values()
    return types.BaseTuple.from_types([*map(type_of, hints)], hint)


def borrow(given):
    """Return what is given; in compiled code with arrays that nobody counts references to, tuples and all.

    An array that Python passes in is counted each time it is handed on, atomically, and a call with nine of them takes
    120 ns; without it takes 10. Whoever calls the loop keeps them alive.
    """
    return given


def _uncount(context, builder, kind, value):
    if isinstance(kind, types.Array):
        array = make_array(kind)(context, builder, value=value)
        array.meminfo, array.parent = array.meminfo.type(None), array.parent.type(None)
        return array._getvalue()
    if isinstance(kind, types.BaseTuple):
        for i, part in enumerate(kind.types):
            value = builder.insert_value(value, _uncount(context, builder, part, builder.extract_value(value, i)), i)
    return value


@intrinsic
def _uncounted(typing_context, given):
    """Return the arrays without the record of who counts them."""
    return given(given), lambda context, builder, _, values: _uncount(context, builder, given, values[0])


@overload(borrow, jit_options=PART | {"forceinline": True})
def _borrow(given):
    return lambda given: _uncounted(given)
