"""What each expression of a law is: a number, a truth, an index, or a tuple of such; a function once for each use.

    typed(function, kinds of its arguments, ...) -> Typed, and before it in `program.functions` all that it calls

A function that is called with other kinds of arguments (the product of three numbers, and of four) becomes another one,
as it does where laws are compiled.
"""

import ast
import copy
from collections.abc import Callable
from typing import Any, NamedTuple

from bench.errors import BadLaw
from bench.export.program import Function
from bench.law.scalar import PRIMITIVES


class Tuple(NamedTuple):
    """A tuple: its kinds, and of a NamedTuple its name and the names of its fields."""

    items: tuple
    name: str = ""
    fields: tuple[str, ...] = ()

    @property
    def is_numbers(self) -> bool:
        """Whether it has no names and is of numbers alone."""
        return not self.name and all(one == REAL for one in self.items)


CALLS_OF_LIBM = {"sin", "cos", "acos", "atan2"}

REAL, TRUTH, INDEX = "real", "truth", "index"
Kind = str | Tuple


def numbers(count: int) -> Tuple:
    """A tuple of so many numbers."""
    return Tuple((REAL,) * count)


class Typed(NamedTuple):
    """A function for one list of kinds: a name of its own, its tree, and the kinds of its expressions by node.

    calls: by call, the function that is called. values: by name of a constant, its value.
    """

    name: str
    node: ast.FunctionDef
    text: str
    parameters: dict[str, Kind]
    returns: Kind
    kinds: dict[ast.AST, Any]
    calls: dict[ast.Call, "Typed"]
    values: dict[str, Any]
    variables: dict[str, Kind]


class Program:
    """Typed functions, callees first, each with a name that no other has."""

    def __init__(self):
        self.functions: list[Typed] = []
        self._done: dict[tuple, Typed] = {}
        self._names: set[str] = set()

    def add(self, function: Function, kinds: tuple[Kind, ...]) -> Typed:
        """The function for these kinds of its arguments, and all that it calls."""
        key = id(function.node), kinds
        if key not in self._done:
            self._done[key] = _Reading(self, function, kinds).typed()
            self.functions.append(self._done[key])
        return self._done[key]

    @property
    def is_algebraic(self) -> bool:
        """Whether nothing but sums, products, quotients and roots is taken: what every processor rounds alike."""
        trees = (one for function in self.functions for one in ast.walk(function.node) if isinstance(one, ast.Call))
        return not {one.func.id for one in trees if isinstance(one.func, ast.Name)} & CALLS_OF_LIBM

    def name(self, wanted: str) -> str:
        """The wanted name, or with a number after it if it is taken."""
        name, number = wanted, 2
        while name in self._names:
            name, number = f"{wanted}_{number}", number + 1
        self._names.add(name)
        return name

    @property
    def tuples(self) -> list[Tuple]:
        """Every kind of tuple that is used, the parts of one before it."""
        found: dict[Tuple, None] = {}
        for one in self.functions:
            for kind in (*one.parameters.values(), *one.kinds.values(), one.returns):
                _collect(kind, found)
        return list(found)


def _collect(kind: Kind, found: dict) -> None:
    if isinstance(kind, Tuple):
        for item in kind.items:
            _collect(item, found)
        found.setdefault(kind)


def kind_of_value(value: Any) -> Kind:
    """Of a constant."""
    if isinstance(value, tuple):
        items = tuple(kind_of_value(one) for one in value)
        return Tuple(items, type(value).__name__, value._fields) if hasattr(value, "_fields") else Tuple(items)
    return TRUTH if isinstance(value, bool) else REAL


class _Reading:
    """One function, read with the kinds of its arguments known."""

    def __init__(self, program: Program, function: Function, kinds: tuple[Kind, ...]):
        if len(kinds) != len(function.parameters):
            raise BadLaw(f"{function.name}: called with {len(kinds)} arguments, it takes {len(function.parameters)}")
        self.program, self.function = program, function
        self.node = copy.deepcopy(function.node)
        self.parameters = dict(zip(function.parameters, kinds, strict=True))
        self.variables: dict[str, Kind] = {}
        self.kinds: dict[ast.AST, Kind] = {}
        self.calls: dict[ast.Call, Typed] = {}
        self.returns: list[Kind] = []

    def typed(self) -> Typed:
        """Of all that it says."""
        for statement in self.node.body:
            self.statement(statement)
        if not self.returns or any(one != self.returns[0] for one in self.returns):
            raise BadLaw(f"{self.function.name}: every path returns the same kind of value; given: {self.returns}")
        values = {
            name: value
            for name, value in self.function.names.items()
            if not isinstance(value, Function) and not callable(value)
        }
        return Typed(
            self.program.name(self.function.name),
            self.node,
            self.function.text,
            self.parameters,
            self.returns[0],
            self.kinds,
            self.calls,
            values,
            self.variables,
        )

    def statement(self, node: ast.stmt) -> None:
        if isinstance(node, ast.Assign):
            kind = self.of(node.value)
            for target in node.targets:
                self.bind(target, kind)
        elif isinstance(node, ast.AugAssign):
            self.of(node.value)
            self.bind(node.target, REAL)
        elif isinstance(node, ast.Return) and node.value is not None:
            self.returns.append(self.of(node.value))
        elif isinstance(node, ast.If):
            self.of(node.test)
            for one in (*node.body, *node.orelse):
                self.statement(one)
        elif isinstance(node, ast.For) and isinstance(node.iter, ast.Call):
            for bound in node.iter.args:
                self.index(bound)
            self.bind(node.target, INDEX)
            for one in node.body:
                self.statement(one)
        elif not isinstance(node, ast.Pass | ast.Break | ast.Continue):
            raise self.outside(node)

    def bind(self, target: ast.expr, kind: Kind) -> None:
        """A variable takes a kind, and keeps it."""
        self.kinds[target] = kind
        if isinstance(target, ast.Name):
            known = self.variables.get(target.id, self.parameters.get(target.id, kind))
            if known != kind:
                raise BadLaw(f"{self.function.name}: '{target.id}' is {known} and becomes {kind}; use another name")
            if target.id not in self.parameters:
                self.variables[target.id] = kind
        elif isinstance(target, ast.Tuple) and isinstance(kind, Tuple) and len(target.elts) == len(kind.items):
            for one, item in zip(target.elts, kind.items, strict=True):
                self.bind(one, item)
        else:
            raise self.outside(target)

    def of(self, node: ast.expr) -> Kind:
        """The kind of an expression, which is noted."""
        readers: dict[type, Callable[[Any], Kind]] = {
            ast.Constant: lambda at: kind_of_value(at.value),
            ast.Name: self.name,
            ast.Attribute: self.attribute,
            ast.Subscript: self.subscript,
            ast.Tuple: lambda at: Tuple(tuple(self.of(one) for one in at.elts)),
            ast.Call: self.call,
            ast.BinOp: self.operation,
            ast.UnaryOp: self.unary,
            ast.Compare: self.compare,
            ast.BoolOp: lambda at: self.all_of(TRUTH, *at.values),
            ast.IfExp: self.choice,
        }
        if type(node) not in readers:
            raise self.outside(node)
        self.kinds[node] = kind = readers[type(node)](node)
        return kind

    def all_of(self, kind: Kind, *nodes: ast.expr) -> Kind:
        for one in nodes:
            self.of(one)
        return kind

    def name(self, node: ast.Name) -> Kind:
        for known in (self.variables, self.parameters):
            if node.id in known:
                return known[node.id]
        value = self.function.names[node.id]
        if isinstance(value, Function) or callable(value):
            raise self.outside(node)
        return kind_of_value(value)

    def attribute(self, node: ast.Attribute) -> Kind:
        kind = self.of(node.value)
        if not isinstance(kind, Tuple) or node.attr not in kind.fields:
            raise self.outside(node)
        return kind.items[kind.fields.index(node.attr)]

    def subscript(self, node: ast.Subscript) -> Kind:
        kind = self.of(node.value)
        if not isinstance(kind, Tuple):
            raise self.outside(node)
        place = place_of(node)
        if place is not None:
            return kind.items[place]
        self.index(node.slice)
        if len(set(kind.items)) != 1:
            raise BadLaw(f"{self.function.name}: `{ast.unparse(node)}`: what a variable chooses from is of one kind")
        return kind.items[0]

    def index(self, node: ast.expr) -> None:
        """A whole number: a constant, a loop's variable, or a sum of such."""
        if isinstance(node, ast.BinOp):
            self.index(node.left)
            self.index(node.right)
        elif isinstance(node, ast.Name):
            if self.of(node) != INDEX:
                raise self.outside(node)
        elif place_of_constant(node) is None:
            raise self.outside(node)
        self.kinds[node] = INDEX

    def call(self, node: ast.Call) -> Kind:
        value = self.function.names.get(node.func.id) if isinstance(node.func, ast.Name) else None
        if isinstance(value, Function):
            kinds = tuple(self.of(one) for one in _in_order(node, value.parameters))
            self.calls[node] = self.program.add(value, kinds)
            return self.calls[node].returns
        if value in PRIMITIVES:
            return self.all_of(REAL, *node.args)
        if isinstance(value, type):
            fields = vars(value)["_fields"]
            return Tuple(tuple(self.of(one) for one in _in_order(node, fields)), value.__name__, fields)
        raise self.outside(node)

    def operation(self, node: ast.BinOp) -> Kind:
        self.all_of(REAL, node.left, node.right)
        if {self.kinds[node.left], self.kinds[node.right]} != {REAL}:
            raise self.outside(node)
        return REAL

    def unary(self, node: ast.UnaryOp) -> Kind:
        return self.all_of(TRUTH if isinstance(node.op, ast.Not) else REAL, node.operand)

    def compare(self, node: ast.Compare) -> Kind:
        return self.all_of(TRUTH, node.left, *node.comparators)

    def choice(self, node: ast.IfExp) -> Kind:
        self.of(node.test)
        kind = self.of(node.body)
        if self.of(node.orelse) != kind:
            raise self.outside(node)
        return kind

    def outside(self, node: ast.AST) -> BadLaw:
        line = ast.unparse(node).splitlines()[0]
        return BadLaw(f"{self.function.name}: `{line}` cannot be translated (bench/law/scalar.py has the dialect)")


def _in_order(node: ast.Call, names: tuple[str, ...] | list[str]) -> list[ast.expr]:
    """The arguments in the order of the parameters, those given by name in their places."""
    named = {one.arg: one.value for one in node.keywords}
    return [*node.args, *(named[name] for name in names[len(node.args) :] if name in named)]


arguments = _in_order


def place_of(node: ast.Subscript) -> int | None:
    """The constant place that is asked for; None if a variable says it."""
    return place_of_constant(node.slice)


def place_of_constant(node: ast.expr) -> int | None:
    """The whole number that is written here, with its sign; None if it is none."""
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
        place = place_of_constant(node.operand)
        return None if place is None else -place
    return node.value if isinstance(node, ast.Constant) and type(node.value) is int else None
