"""Arrays in compiled code made from addresses.

An array that Python passes in is counted by reference each time it is handed on, atomically, and a call with nine of
them takes 120 ns; of an array made here nobody keeps count, and the call takes 10. Whoever passes an address keeps
what it points to alive.
"""

from numba import carray, float64, int64, types
from numba.extending import intrinsic, register_jitable


@intrinsic
def _pointer(typing_context, address):
    """The address as a pointer to float64."""
    pointer = types.CPointer(float64)

    def generate(context, builder, signature, arguments):
        return builder.inttoptr(arguments[0], context.get_value_type(pointer))

    return pointer(address), generate


@intrinsic
def _integer_pointer(typing_context, address):
    """The address as a pointer to int64."""
    pointer = types.CPointer(int64)

    def generate(context, builder, signature, arguments):
        return builder.inttoptr(arguments[0], context.get_value_type(pointer))

    return pointer(address), generate


@register_jitable
def vector(address, n):
    """The n numbers at an address."""
    return carray(_pointer(address), (n,))


@register_jitable
def matrix(address, rows, n):
    """The rows x n numbers at an address, row after row."""
    return carray(_pointer(address), (rows, n))


@register_jitable
def integers(address, n):
    """The n integers at an address."""
    return carray(_integer_pointer(address), (n,))


def address_of(array) -> int:
    """Where the numbers of a numpy array begin; it must be contiguous."""
    return array.ctypes.data
