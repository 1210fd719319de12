"""Kinds of expressions: what a translator knows of a value when it writes code for it.

A number, a whole number or a truth value is there when the code runs, and so are tuples and arrays of them. Other
values are known when the code is written and are nothing in it: None, a function, a module, a class, a text. A test
of such a value is decided then, and only the branch that is taken is written.
"""

import inspect
from types import ModuleType
from typing import Any, NamedTuple

import numpy as np


class Tuple(NamedTuple):
    """The kind of a tuple: the kinds of its items and, for a NamedTuple, its name and the names of its fields."""

    items: tuple
    name: str = ""
    fields: tuple[str, ...] = ()

    @property
    def is_numbers(self) -> bool:
        """Tell whether it is a plain tuple of numbers."""
        return not self.name and all(item == REAL for item in self.items)

    @property
    def is_even(self) -> bool:
        """Tell whether it is a plain tuple of items of one kind, so that a variable can be its index."""
        return not self.name and len(set(self.items)) == 1 and not is_static(self.items[0])


class Array(NamedTuple):
    """The kind of a contiguous array: how many indices it has, and the kind of an element."""

    dimensions: int
    element: str


class StaticFunction(NamedTuple):
    """The kind of a function that is known when the code is written; it is translated for each list of kinds."""

    function: Any


class Pointer(NamedTuple):
    """The kind of a function that is known when the code runs: the kinds of its arguments and of its result."""

    parameters: tuple
    returns: Any


class External(NamedTuple):
    """The kind of a function of a C library, which is found by its name; it takes numbers and gives one, or none."""

    name: str
    returns: str


class Known(NamedTuple):
    """The kind of a module, a class, a built-in function or a text."""

    value: Any


REAL, TRUTH, INTEGER, NONE = "real", "truth", "integer", "none"
Kind = str | Tuple | Array | StaticFunction | Pointer | External | Known

NUMERIC = (TRUTH, INTEGER, REAL)
"""Kinds of numbers, the narrowest first."""


def is_static(kind: Kind) -> bool:
    """Tell whether nothing of a value of this kind is there when the code runs."""
    if isinstance(kind, Tuple):
        return all(map(is_static, kind.items))
    return kind == NONE or isinstance(kind, StaticFunction | External | Known)


def numbers(count: int) -> Tuple:
    """Return the kind of a tuple of so many numbers."""
    return Tuple((REAL,) * count)


def kind_of_constant(value: Any) -> Kind:
    """Return the kind of a constant of a law, all numbers of which are real."""
    kind = kind_of(value)
    return _with_reals(kind)


def _with_reals(kind: Kind) -> Kind:
    if isinstance(kind, Tuple):
        return kind._replace(items=tuple(map(_with_reals, kind.items)))
    return REAL if kind == INTEGER else kind


def kind_of(value: Any) -> Kind:
    """Return the kind of a value.

    Errors:
        TypeError: a value that no code can be written for.
    """
    if value is None:
        return NONE
    if isinstance(value, bool | np.bool_):
        return TRUTH
    if isinstance(value, int | np.integer):
        return INTEGER
    if isinstance(value, float):
        return REAL
    if isinstance(value, tuple):
        items = tuple(map(kind_of, value))
        return Tuple(items, type(value).__name__, value._fields) if hasattr(value, "_fields") else Tuple(items)
    if isinstance(value, np.ndarray):
        return _kind_of_array(value)
    if inspect.isfunction(value):
        return StaticFunction(value)
    if isinstance(value, str | type | ModuleType) or inspect.isbuiltin(value):
        return Known(value)
    if hasattr(value, "symbol"):
        return External(value.symbol, NONE if str(value.sig.return_type) == "none" else INTEGER)
    raise TypeError(f"no code can be written for a {type(value).__name__}: {value!r}")


def _kind_of_array(array: np.ndarray) -> Array:
    elements = {np.dtype(np.float64): REAL, np.dtype(np.int64): INTEGER}
    if array.dtype not in elements or not array.flags.c_contiguous:
        raise TypeError(
            f"an array of {array.dtype}, contiguous: {array.flags.c_contiguous}; "
            "allowed: contiguous arrays of float64 or int64"
        )
    return Array(array.ndim, elements[array.dtype])


def widest(first: Kind, second: Kind) -> Kind | None:
    """Return the kind that holds values of both; None if there is none."""
    if first == second:
        return first
    if first in NUMERIC and second in NUMERIC:
        return max(first, second, key=NUMERIC.index)
    return None
