"""Kinds of the expressions of a law: a number, a truth value, an index, or a tuple of kinds."""

import ast
from typing import Any, NamedTuple


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


class Typed(NamedTuple):
    """A function for one list of kinds of its arguments: its unique name, its tree, and the kind of each expression.

    calls: the function that each call calls. values: the value of each constant, by name.
    """

    name: str
    node: ast.FunctionDef
    summary: str
    parameters: dict[str, Kind]
    returns: Kind
    kinds: dict[ast.AST, Any]
    calls: dict[ast.Call, "Typed"]
    values: dict[str, Any]
    variables: dict[str, Kind]

    @property
    def identity(self) -> str | None:
        """Return the name of the argument that the function returns as it is; None if it does anything else."""
        last = self.node.body[-1]
        value = last.value if isinstance(last, ast.Return) and len(self.node.body) == 1 else None
        return value.id if isinstance(value, ast.Name) and value.id in self.parameters else None


def kind_of_value(value: Any) -> Kind:
    """Return the kind of a constant."""
    if isinstance(value, tuple):
        items = tuple(kind_of_value(one) for one in value)
        return Tuple(items, type(value).__name__, value._fields) if hasattr(value, "_fields") else Tuple(items)
    return TRUTH if isinstance(value, bool) else REAL


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
