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


class ByReference(types.Type):
    """A tuple that stays where the loop has stored it; of its parts only those are read that a function names.

    A tuple that is passed by value is taken apart and put together again at each call: the hundreds of words of a world
    made a loop compile in twice the time.
    """

    def __init__(self, whole: types.BaseTuple) -> None:
        self.whole = whole
        super().__init__(f"ByReference({whole})")

    def can_convert_to(self, typing_context: Any, other: types.Type) -> Conversion | None:
        """Allow a function to take the tuple itself."""
        return Conversion.safe if other == self.whole else None

    def part(self, name: str) -> types.Type:
        """Return the type of a field; a named tuple is passed by reference too."""
        kind = self.whole.types[self.whole.fields.index(name)]
        return ByReference(kind) if isinstance(kind, types.BaseNamedTuple) else kind


@register_model(ByReference)
class _Pointer(models.PrimitiveModel):
    def __init__(self, manager: Any, reference: ByReference) -> None:
        super().__init__(manager, reference, manager[reference.whole].get_value_type().as_pointer())


@infer_getattr
class _Fields(AttributeTemplate):
    key = ByReference

    def generic_resolve(self, reference: ByReference, name: str) -> types.Type | None:
        return reference.part(name) if name in reference.whole.fields else None


@lower_getattr_generic(ByReference)
def _field(context, builder, reference, value, name):
    kind = reference.part(name)
    place = cgutils.gep_inbounds(builder, value, 0, reference.whole.fields.index(name))
    if isinstance(kind, ByReference):
        return place
    return _drop_reference_count(context, builder, kind, builder.load(place))


@lower_cast(ByReference, types.BaseTuple)
def _load_whole(context, builder, reference, whole, value):
    return _drop_reference_count(context, builder, whole, builder.load(value))


def pass_by_reference(value):
    """Return the value; compiled code passes it by reference, and counts no references to its arrays.

    An array that Python passes in is counted each time it is handed on, atomically, and a call with nine of them takes
    120 ns; without it takes 10. Whoever calls the loop keeps them alive.
    """
    return value


@type_callable(pass_by_reference)
def _type_reference(typing_context):
    return lambda value: ByReference(value) if isinstance(value, types.BaseNamedTuple) else value


@lower_builtin(pass_by_reference, types.Any)
def _pass_by_reference(context, builder, signature, values):
    (value,) = values
    if isinstance(signature.return_type, ByReference):
        return cgutils.alloca_once_value(builder, value)
    return value


def _drop_reference_count(context, builder, kind, value):
    """Return a value whose arrays do not count their references."""
    if isinstance(kind, types.Array):
        array = make_array(kind)(context, builder, value=value)
        array.meminfo, array.parent = array.meminfo.type(None), array.parent.type(None)
        return array._getvalue()
    if isinstance(kind, types.BaseTuple):
        for i, part in enumerate(kind.types):
            element = builder.extract_value(value, i)
            element = _drop_reference_count(context, builder, part, element)
            value = builder.insert_value(value, element, i)
    return value
