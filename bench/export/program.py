"""The functions that a law calls, and what each of their free names stands for: what is translated.

A law is a closure of plain functions (`bench.law.scalar` says what they may contain). Here they are read back as syntax
trees: a name in one of them is a local variable, a function of the law dialect, a tuple type, a constant of a file or
of the closure, or one of the functions of a number.
"""

import ast
import builtins
import inspect
import textwrap
from collections.abc import Callable
from typing import Any, NamedTuple

from bench.errors import BadLaw
from bench.law.scalar import PRIMITIVES


class Function(NamedTuple):
    """A function of the dialect: its tree, and by free name what it refers to.

    A value is a Function, a NamedTuple class, a function of PRIMITIVES, `range`, a number, or a tuple of values.
    """

    name: str
    node: ast.FunctionDef
    names: dict[str, Any]
    text: str

    @property
    def parameters(self) -> list[str]:
        """In order."""
        return [one.arg for one in self.node.args.args]


def read_function(function: Callable, known: dict[Callable, Function] | None = None) -> Function:
    """A function with all that it calls.

    Args:
        known: functions that were read already; those read here are added.
    Errors:
        BadLaw: its text cannot be read, or a name in it is nothing that can be translated.
    """
    known = {} if known is None else known
    if function not in known:
        node = _tree(function)
        values = _values(function)
        names = {name: _resolved(function, name, values, known) for name in free_names(node)}
        text = inspect.getdoc(function) or ""
        known[function] = Function(function.__name__, node, names, text)
    return known[function]


def free_names(node: ast.FunctionDef) -> list[str]:
    """Names that a function reads and does not bind, sorted."""
    bound = {one.arg for one in node.args.args}
    names = [one for statement in node.body for one in ast.walk(statement) if isinstance(one, ast.Name)]
    bound |= {one.id for one in names if isinstance(one.ctx, ast.Store)}
    return sorted({one.id for one in names} - bound)


def _tree(function: Callable) -> ast.FunctionDef:
    try:
        text = textwrap.dedent(inspect.getsource(function))
    except (OSError, TypeError) as error:
        raise BadLaw(f"{function.__qualname__}: its source cannot be read ({error}); keep the law in a file") from error
    node = ast.parse(text).body[0]
    if not isinstance(node, ast.FunctionDef):
        raise BadLaw(f"{function.__qualname__}: a law is a function written with def, not {type(node).__name__}")
    if ast.get_docstring(node) is not None:
        node.body = node.body[1:]
    return node


def _values(function: Callable) -> dict[str, Any]:
    """What free names are bound to: by the closure first, then by the file, then by Python."""
    closure = inspect.getclosurevars(function)
    return {**vars(builtins), **closure.globals, **closure.nonlocals}


def _resolved(function: Callable, name: str, values: dict[str, Any], known: dict[Callable, Function]) -> Any:
    if name not in values:
        raise BadLaw(f"{function.__qualname__}: '{name}' is not defined (a law uses its file's constants and kernels)")
    value = values[name]
    if value in PRIMITIVES or value is range or _is_tuple_type(value) or _is_constant(value):
        return value
    if inspect.isfunction(value):
        return read_function(value, known)
    raise BadLaw(
        f"{function.__qualname__}: '{name}' is {type(value).__name__}, which the law dialect lacks "
        "(allowed: numbers, tuples of numbers, functions marked @kernel)"
    )


def _is_tuple_type(value: Any) -> bool:
    return isinstance(value, type) and issubclass(value, tuple) and hasattr(value, "_fields")


def _is_constant(value: Any) -> bool:
    if isinstance(value, tuple):
        return all(_is_constant(one) for one in value)
    return isinstance(value, int | float) and not isinstance(value, type)
