"""How a language writes what loops have, and laws have not."""

from collections.abc import Callable
from typing import Any, NamedTuple

from bench.translation.kinds import Array, External, Kind, Pointer


class LoopSyntax(NamedTuple):
    """How a language writes what only the dialect of the loops has.

    Attributes:
        element: element(kind, array, indices) -> an element.
        view: view(kind, array, indices, lower, upper) -> a row, or the part from lower to upper of one.
        size: size(array, place) -> how many elements lie along an index.
        by_pointer: by_pointer(pointer, function, arguments) -> a call.
        external: external(function, arguments) -> a call of a function of a library.
        address: Template of the address of an array, a whole number.
        operations: Templates of `//`, `%` and the square.
        builtin: builtin(name, kind, arguments) -> min, max, abs, float, int or bool.
        constant: constant(value, kind) -> a number or a truth value.
        error: What ends the body of a guard.
        guard: Templates of the lines around the body of `try`: before it, at its end, before and after the handler.
        repeat: Template of `while`.
    """

    element: Callable[[Array, str, list[str]], str]
    view: Callable[[Array, str, list[str], str, str], str]
    size: Callable[[str, int | str], str]
    by_pointer: Callable[[Pointer, str, list[str]], str]
    external: Callable[[External, list[str]], str]
    address: str
    operations: dict[type, str]
    builtin: Callable[[str, Kind, list[str]], str]
    constant: Callable[[Any, Kind], str]
    error: str
    guard: tuple[str, str, str, str]
    repeat: str = "while ({}) {{"
