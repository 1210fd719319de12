"""Type inference: a function of the dialect, read once for each list of kinds of its arguments.

A function that is called with other kinds of arguments (the product of three numbers, and of four) becomes another one,
as it does where laws are compiled.
"""

import ast
import copy
from collections.abc import Callable
from typing import Any

from bench.errors import BadLaw
from bench.export.program import Function
from bench.export.types import INDEX, REAL, TRUTH, Kind, Tuple, Typed, arguments, kind_of_value, place_of
from bench.law.scalar import PRIMITIVES

CALLS_OF_LIBM = {"sin", "cos", "acos", "atan2"}


class Program:
    """Typed functions, callees first, each with a unique name; those that return an argument as it is are left out."""

    def __init__(self) -> None:
        self.functions: list[Typed] = []
        self._done: dict[tuple, Typed] = {}
        self._names: set[str] = set()

    def add(self, function: Function, kinds: tuple[Kind, ...]) -> Typed:
        """Add a function for these kinds of its arguments, and all that it calls."""
        key = id(function.node), kinds
        if key not in self._done:
            self._done[key] = _Reading(self, function, kinds).typed()
            if self._done[key].identity is None:
                self.functions.append(self._done[key])
        return self._done[key]

    @property
    def is_algebraic(self) -> bool:
        """Tell whether it takes only sums, products, quotients and roots, which every processor rounds alike."""
        trees = (one for function in self.functions for one in ast.walk(function.node) if isinstance(one, ast.Call))
        return not {one.func.id for one in trees if isinstance(one.func, ast.Name)} & CALLS_OF_LIBM

    def name(self, wanted: str) -> str:
        """Return the wanted name, with a number after it if it is taken, and reserve it."""
        name, number = wanted, 2
        while name in self._names:
            name, number = f"{wanted}_{number}", number + 1
        self._names.add(name)
        return name

    @property
    def tuples(self) -> list[Tuple]:
        """Return every kind of tuple in use, its parts before it."""
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


class _Reading:
    """The inference of one function, given the kinds of its arguments."""

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
        """Return the function with the kinds of its expressions."""
        for statement in self.node.body:
            self.statement(statement)
        if not self.returns or any(one != self.returns[0] for one in self.returns):
            raise BadLaw(f"{self.function.name}: every path returns the same kind of value; given: {self.returns}")
        name, names = self.program.name(self.function.name), self.function.names
        values = {name: value for name, value in names.items() if not (isinstance(value, Function) or callable(value))}
        known = self.parameters, self.returns[0], self.kinds, self.calls, values, self.variables
        return Typed(name, self.node, self.function.text, *known)

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
        """Give a variable its kind, which it keeps."""
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
        """Infer and record the kind of an expression."""
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
        place = place_of(node.slice)
        if place is not None:
            return kind.items[place]
        self.index(node.slice)
        if len(set(kind.items)) != 1:
            raise BadLaw(f"{self.function.name}: `{ast.unparse(node)}`: what a variable chooses from is of one kind")
        return kind.items[0]

    def index(self, node: ast.expr) -> None:
        """Record an index: a whole number, the variable of a loop, or a sum of such."""
        if isinstance(node, ast.BinOp):
            self.index(node.left)
            self.index(node.right)
        elif isinstance(node, ast.Name):
            if self.of(node) != INDEX:
                raise self.outside(node)
        elif place_of(node) is None:
            raise self.outside(node)
        self.kinds[node] = INDEX

    def call(self, node: ast.Call) -> Kind:
        value = self.function.names.get(node.func.id) if isinstance(node.func, ast.Name) else None
        if isinstance(value, Function):
            kinds = tuple(self.of(one) for one in arguments(node, value.parameters))
            self.calls[node] = self.program.add(value, kinds)
            return self.calls[node].returns
        if value in PRIMITIVES:
            return self.all_of(REAL, *node.args)
        if isinstance(value, type):
            fields = vars(value)["_fields"]
            return Tuple(tuple(self.of(one) for one in arguments(node, fields)), value.__name__, fields)
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
