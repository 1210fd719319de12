"""What is tested of a library: functions that its users take for the error between two orientations, and controllers.

Every function is asked for the turn T that leads from R = I to R_d = T, so that R_d R^T, R^T R_d and R_d are one and
the same, exactly, and the base and the body frame agree on its axis.
"""

import functools
import warnings
from collections.abc import Callable, Iterator
from typing import Any, NamedTuple, TypeAlias

import numpy as np

MATRIX, QUATERNION = "matrix", "quaternion"
ANGLES = "z-y-x"
"""The form of functions that return angles, which are no error along the axis."""


class Function(NamedTuple):
    """One function of a library.

    call(turn) -> three numbers: of a 3 x 3 array if it takes a matrix, else of a unit quaternion (w, x, y, z). Scaled
    so that near the identity they are theta k; angles stand as those about x, y and z.
    form: what the three numbers are, a word of `forms.FORMS`.
    kind: "idiom" for what users write on functions of the library, none of which promises an orientation error.
    fix: the smallest change that cures its fault, where the library has one or its source needs one.
    thread: where the fault is known upstream, as owner/repository#number.
    """

    name: str
    takes: str
    call: Callable[[np.ndarray], Any]
    form: str = "rotation-vector"
    kind: str = "function"
    fix: str = ""
    thread: str = ""


def vector_part(name: str, call: Callable[[np.ndarray], Any], fix: str = "", is_logarithm: bool = False) -> Function:
    """Return the idiom that doubles the vector part of a matrix's quaternion, or of a quaternion's logarithm."""
    takes, form = (QUATERNION, "rotation-vector") if is_logarithm else (MATRIX, "sine-of-half")
    return Function(f"2 {name}, vector part", takes, call, form, "idiom", fix)


class Controller(NamedTuple):
    """A controller as its users run it, with its own plant or command.

    motion(quat_wxyz of T) -> what is left to go, T, as a quaternion after every tick of dt_s, the start first.
    error: the function of its library that it takes for the error, by name; empty if it has none of its own.
    command: what it commands, `acceleration` or `velocity`; title: what is run, with its gains.
    pull(quat_wxyz of T) -> its acceleration from rest, where that is no multiple of the error.
    is_our_loop: only the error is theirs; the law around it is written here.
    """

    name: str
    error: str
    command: str
    title: str
    dt_s: float
    motion: Callable[[Any], Iterator[tuple]]
    pull: Callable[[Any], np.ndarray] | None = None
    is_our_loop: bool = False


class Library(NamedTuple):
    """A library by the name that its package is installed under, and what is tested of it.

    is_debian: the package is one of Debian's, compiled here. is_restated: nothing of theirs runs; what their source
    says is restated here, and `package` is where it stands. is_single: it computes in single precision by design.
    note: what a reader of its version should know.
    """

    name: str
    package: str
    functions: tuple[Function, ...]
    controllers: tuple[Controller, ...] = ()
    is_debian: bool = False
    is_restated: bool = False
    is_single: bool = False
    note: str = ""


Tested: TypeAlias = Function | Controller


def library(package: str, name: str = "", **facts: Any) -> Callable[[Callable], Callable[[], list[Library]]]:
    """Make a function that yields what is tested of a package into one that returns its Library, alone in a list."""

    def decorate(tested: Callable[[], Iterator[Tested]]) -> Callable[[], list[Library]]:
        def asked() -> list[Library]:
            found = [*tested()]
            functions = tuple(one for one in found if isinstance(one, Function))
            controllers = tuple(one for one in found if isinstance(one, Controller))
            return [Library(name or tested.__name__, package, functions, controllers, **facts)]

        return asked

    return decorate


def answer(function: Function, value: np.ndarray) -> np.ndarray:
    """Return the three numbers."""
    return np.asarray(function.call(value), dtype=float).reshape(3)


def quiet(asking: Callable) -> Callable:
    """Return a library that warns is taken at its word all the same."""

    @functools.wraps(asking)
    def called(*given: Any) -> Any:
        with warnings.catch_warnings(action="ignore"), np.errstate(all="ignore"):
            return asking(*given)

    return called
