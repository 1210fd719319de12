"""Functions of the law dialect, read back from their source, and the kinds of their expressions.

A law is a closure of plain functions (`bench.law.scalar` says what they may contain). A name in one of them is a local
variable, a function of the dialect, a tuple type, a constant of a file or of the closure, or a function of a number.
A kind is a number, a truth value, an index, or a tuple of kinds.
"""

import ast
import builtins
import inspect
import textwrap
from collections.abc import Callable
from typing import Any, NamedTuple

from bench.base.errors import BadLaw
from bench.law.scalar import PRIMITIVES

ARITHMETIC = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/"}
COMPARISONS = {ast.Lt: "<", ast.LtE: "<=", ast.Gt: ">", ast.GtE: ">=", ast.Eq: "==", ast.NotEq: "!="}
SIGNS = {ast.USub: "-", ast.UAdd: "+", ast.Not: "not"}
CURES: dict[type, tuple[str, str]] = {
    ast.Pow: ("**", "write a power as a product, a root with sqrt, a constant outside the functions"),
    ast.FloorDiv: ("//", "divide with /, or write a whole number outside the functions"),
    ast.Mod: ("%", "write a whole number outside the functions, or keep an angle with atan2"),
}
"""Operators that Python has and a law has not: how each is written, and what to write in its place."""


class DialectFunction(NamedTuple):
    """A function of the dialect: its tree, the value of each free name (as above), and its docstring's summary."""

    name: str
    node: ast.FunctionDef
    names: dict[str, Any]
    summary: str

    @property
    def parameters(self) -> list[str]:
        """Return the names of the parameters in order."""
        return [one.arg for one in self.node.args.args]


def read_function(function: Callable) -> DialectFunction:
    """Read a function; BadLaw if its text cannot be read, or a name or an operator in it cannot be translated."""
    try:
        text = textwrap.dedent(inspect.getsource(function))
    except (OSError, TypeError) as error:
        raise BadLaw(f"{function.__qualname__}: its source cannot be read ({error}); keep the law in a file") from error
    node = ast.parse(text).body[0]
    if not isinstance(node, ast.FunctionDef):
        raise BadLaw(f"{function.__qualname__}: a law is a function written with def, not {type(node).__name__}")
    if ast.get_docstring(node) is not None:
        node.body = node.body[1:]
    refuse_operators(node)
    closure = inspect.getclosurevars(function)
    values = {**vars(builtins), **closure.globals, **closure.nonlocals}
    names = {name: _resolved(function, name, values) for name in free_names(node)}
    summary = (inspect.getdoc(function) or "").partition("\n\n")[0]
    return DialectFunction(function.__name__, node, names, " ".join(summary.split()))


def refuse_operators(function: ast.FunctionDef) -> None:
    """Raise BadLaw for operators that the languages of the export do not all have."""
    allowed = ARITHMETIC | COMPARISONS | SIGNS
    for node in (one for statement in function.body for one in ast.walk(statement)):
        for used in map(type, getattr(node, "ops", [getattr(node, "op", None)])):
            if issubclass(used, ast.operator | ast.unaryop | ast.cmpop) and used not in allowed:
                written, cure = CURES.get(used, (used.__name__, "write it with those"))
                raise BadLaw(
                    f"{function.name}: `{ast.unparse(node)}` has the operator {written}, which cannot be exported; "
                    f"allowed: {' '.join(dict.fromkeys(allowed.values()))} and or; {cure}"
                )


def free_names(node: ast.FunctionDef) -> list[str]:
    """Return the names that a function reads and does not bind, sorted."""
    names = [one for statement in node.body for one in ast.walk(statement) if isinstance(one, ast.Name)]
    bound = {one.arg for one in node.args.args} | {one.id for one in names if isinstance(one.ctx, ast.Store)}
    return sorted({one.id for one in names} - bound)


def _resolved(function: Callable, name: str, values: dict[str, Any]) -> Any:
    if name not in values:
        raise BadLaw(f"{function.__qualname__}: '{name}' is not defined (a law uses its file's constants and kernels)")
    value = values[name]
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


class Tuple(NamedTuple):
    """The kind of a tuple: the kinds of its items and, for a NamedTuple, its name and the names of its fields."""

    items: tuple
    name: str = ""
    fields: tuple[str, ...] = ()

    @property
    def is_numbers(self) -> bool:
        """Tell whether it is a plain tuple of numbers."""
        return not self.name and all(one == REAL for one in self.items)


REAL, TRUTH, INDEX = "real", "truth", "index"
Kind = str | Tuple


def numbers(count: int) -> Tuple:
    """Return the kind of a tuple of so many numbers."""
    return Tuple((REAL,) * count)


def arguments(node: ast.Call, names: tuple[str, ...] | list[str]) -> list[ast.expr]:
    """Return the arguments of a call in the order of the parameters."""
    named = {one.arg: one.value for one in node.keywords}
    return [*node.args, *(named[name] for name in names[len(node.args) :] if name in named)]


def place_of(node: ast.expr) -> int | None:
    """Return the whole number that an expression is; None if it is none."""
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
        place = place_of(node.operand)
        return None if place is None else -place
    return node.value if isinstance(node, ast.Constant) and type(node.value) is int else None
