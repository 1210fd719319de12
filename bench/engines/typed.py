"""Types of our named tuples for the compiler, from their annotations, and arrays that compiled code does not count."""

import typing
from typing import Annotated, Any

from numba import float64, int64, types
from numba.core import cgutils
from numba.core.imputils import lower_getattr_generic
from numba.core.typeconv import Conversion
from numba.core.typing.templates import AttributeTemplate, infer_getattr
from numba.extending import lower_builtin, lower_cast, models, register_model, type_callable
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


class Lent(types.Type):
    """A tuple that stays where the loop has stored it; of its parts only those are read that a function names.

    A tuple that is passed by value is taken apart and put together again at each call: the hundreds of words of a world
    made a loop compile in twice the time.
    """

    def __init__(self, whole: types.BaseTuple) -> None:
        self.whole = whole
        super().__init__(f"Lent({whole})")

    def can_convert_to(self, typing_context: Any, other: types.Type) -> Conversion | None:
        """Allow a function to take the tuple itself."""
        return Conversion.safe if other == self.whole else None

    def part(self, name: str) -> types.Type:
        """Return the type of a field: of a tuple with names lent too."""
        kind = self.whole.types[self.whole.fields.index(name)]
        return Lent(kind) if isinstance(kind, types.BaseNamedTuple) else kind


@register_model(Lent)
class _Pointer(models.PrimitiveModel):
    def __init__(self, manager: Any, lent: Lent) -> None:
        super().__init__(manager, lent, manager[lent.whole].get_value_type().as_pointer())


@infer_getattr
class _Fields(AttributeTemplate):
    key = Lent

    def generic_resolve(self, lent: Lent, name: str) -> types.Type | None:
        return lent.part(name) if name in lent.whole.fields else None


@lower_getattr_generic(Lent)
def _field(context, builder, lent, value, name):
    kind = lent.part(name)
    place = cgutils.gep_inbounds(builder, value, 0, lent.whole.fields.index(name))
    return place if isinstance(kind, Lent) else _uncount(context, builder, kind, builder.load(place))


@lower_cast(Lent, types.BaseTuple)
def _whole(context, builder, lent, whole, value):
    return _uncount(context, builder, whole, builder.load(value))


def borrow(given):
    """Return what is given; in compiled code lent, with arrays that nobody counts references to.

    An array that Python passes in is counted each time it is handed on, atomically, and a call with nine of them takes
    120 ns; without it takes 10. Whoever calls the loop keeps them alive.
    """
    return given


@type_callable(borrow)
def _type_borrow(typing_context):
    return lambda given: Lent(given) if isinstance(given, types.BaseNamedTuple) else given


@lower_builtin(borrow, types.Any)
def _borrow(context, builder, signature, values):
    (value,) = values
    return cgutils.alloca_once_value(builder, value) if isinstance(signature.return_type, Lent) else value


def _uncount(context, builder, kind, value):
    """Return arrays without the record of who counts them."""
    if isinstance(kind, types.Array):
        array = make_array(kind)(context, builder, value=value)
        array.meminfo, array.parent = array.meminfo.type(None), array.parent.type(None)
        return array._getvalue()
    if isinstance(kind, types.BaseTuple):
        for i, part in enumerate(kind.types):
            value = builder.insert_value(value, _uncount(context, builder, part, builder.extract_value(value, i)), i)
    return value
