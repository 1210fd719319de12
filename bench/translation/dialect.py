"""Functions of a dialect of Python, read back from their source.

A law is a closure of plain functions (`bench.law.scalar` says what they may contain). A name in one of them is a local
variable, a function of the dialect, a tuple type, a constant of a file or of the closure, or a function of a number.
The loops that run laws are written in a wider dialect: see `LOOPS`.
"""

import ast
import builtins
import inspect
from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

from bench.base.errors import BadLaw
from bench.law.scalar import KERNELS, PRIMITIVES
from bench.translation.source import tree_of
from bench.translation.trees import free_names

ARITHMETIC: dict[type, str] = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/"}
COMPARISONS: dict[type, str] = {ast.Lt: "<", ast.LtE: "<=", ast.Gt: ">", ast.GtE: ">=", ast.Eq: "==", ast.NotEq: "!="}
SIGNS: dict[type, str] = {ast.USub: "-", ast.UAdd: "+", ast.Not: "not"}
CURES: dict[type, tuple[str, str]] = {
    ast.Pow: ("**", "write a power as a product, a root with sqrt, a constant outside the functions"),
    ast.FloorDiv: ("//", "divide with /, or write a whole number outside the functions"),
    ast.Mod: ("%", "write a whole number outside the functions, or keep an angle with atan2"),
}
"""Operators that Python has and a law has not: how each is written, and what to write in its place."""


class Dialect(NamedTuple):
    """What the functions of a dialect may contain.

    Attributes:
        operators: The text of each operator.
        has_integers: Whether a whole number is one in the code, too; in a law every number is real.
    """

    operators: Mapping[type, str]
    has_integers: bool


LAWS = Dialect({**ARITHMETIC, **COMPARISONS, **SIGNS}, has_integers=False)
"""What a law may contain, and every language of the export can say."""

WHOLE: dict[type, str] = {ast.FloorDiv: "//", ast.Mod: "%", ast.BitAnd: "&", ast.BitOr: "|", ast.Pow: "**"}
IDENTITY: dict[type, str] = {ast.Is: "is", ast.IsNot: "is not"}
LOOPS = Dialect({**LAWS.operators, **WHOLE, **IDENTITY}, has_integers=True)
"""What the loops, plants and judges may contain besides, for which only C is written.

Whole numbers and counters, arrays, `while`, functions as arguments and in tuples, None as an argument, calls as
statements, and names of modules. Of powers only the square; `is` compares with None alone. `try` writes its body only:
nothing raises in code that is translated.
"""


STATE = "a law keeps its state only in memory=..., which it takes as its last argument and returns beside its command"

OURS = ("bench", "tasks")
"""Packages whose functions need no mark: the loops and judges."""


def require_mark(function: Callable) -> None:
    """Raise BadLaw for a function of a user's file that is not marked as a kernel."""
    is_ours = function.__module__.partition(".")[0] in OURS
    if not is_ours and not any(kernel is function for kernel in KERNELS):
        name = function.__name__
        raise BadLaw(f"'{name}' is a plain function of Python; put @kernel above def {name}")


REPLACED: dict[Callable, Callable] = {}
"""Functions that do in Python what a kernel does in code, and the kernel."""


class DialectFunction(NamedTuple):
    """A function of a dialect.

    Attributes:
        name: Its name.
        node: Its tree, without the docstring.
        names: The value of each free name.
        summary: The summary of its docstring.
        defaults: The values of its last parameters where a call gives none.
    """

    name: str
    node: ast.FunctionDef
    names: dict[str, Any]
    summary: str
    defaults: tuple = ()

    @property
    def parameters(self) -> list[str]:
        """Return the names of the parameters in order."""
        return [one.arg for one in self.node.args.args]


def read_function(function: Callable, dialect: Dialect = LAWS) -> DialectFunction:
    """Read a function; BadLaw if its text cannot be read, or a name or an operator in it cannot be translated."""
    node = tree_of(function)
    if ast.get_docstring(node) is not None:
        node.body = node.body[1:]
    refuse_operators(node, dialect)
    closure = inspect.getclosurevars(function)
    values = {**vars(builtins), **closure.globals, **closure.nonlocals}
    names = {name: _resolved(function, name, values, dialect) for name in free_names(node)}
    summary = (inspect.getdoc(function) or "").partition("\n\n")[0]
    defaults = function.__defaults__ or ()
    return DialectFunction(function.__name__, node, names, " ".join(summary.split()), defaults)


def refuse_operators(function: ast.FunctionDef, dialect: Dialect) -> None:
    """Raise BadLaw for operators that the dialect lacks."""
    allowed = dialect.operators
    for node in (one for statement in function.body for one in ast.walk(statement)):
        for used in map(type, getattr(node, "ops", [getattr(node, "op", None)])):
            if issubclass(used, ast.operator | ast.unaryop | ast.cmpop) and used not in allowed:
                written, cure = CURES.get(used, (used.__name__, "write it with those"))
                raise BadLaw(
                    f"{function.name}: `{ast.unparse(node)}` has the operator {written}, which cannot be exported; "
                    f"allowed: {' '.join(dict.fromkeys(allowed.values()))} and or; {cure}"
                )


def _resolved(function: Callable, name: str, values: dict[str, Any], dialect: Dialect) -> Any:
    if name not in values:
        raise BadLaw(f"{function.__qualname__}: '{name}' is not defined (a law uses its file's constants and kernels)")
    value = values[name]
    if dialect is LOOPS:  # a value without a kind is refused where it is used
        return value
    is_tuple_type = isinstance(value, type) and issubclass(value, tuple) and hasattr(value, "_fields")
    if value in PRIMITIVES or value is range or is_tuple_type or _is_constant(value) or inspect.isfunction(value):
        return value
    raise BadLaw(
        f"{function.__qualname__}: '{name}' is {type(value).__name__}, which the law dialect lacks "
        "(allowed: numbers, tuples of numbers, functions marked @kernel)"
    )


def _is_constant(value: Any) -> bool:
    if isinstance(value, tuple):
        return all(map(_is_constant, value))
    return isinstance(value, int | float) and not isinstance(value, type)
