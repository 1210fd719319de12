"""Infer types: each list of kinds of its arguments makes a function of the dialect another one, as a compiler does."""

import ast
import copy
import functools
import inspect
from collections.abc import Callable
from typing import Any

from bench.base.errors import BadLaw
from bench.export.program import (
    INDEX,
    REAL,
    TRUTH,
    DialectFunction,
    Kind,
    Tuple,
    arguments,
    place_of,
    read_function,
)
from bench.law.scalar import PRIMITIVES

CALLS_OF_LIBM = {"sin", "cos", "acos", "atan2"}


class Program:
    """Typed functions, callees first, each with a unique name, without those that return an argument as it is."""

    def __init__(self) -> None:
        self.functions: list[Typed] = []
        self.entries: dict[str, Typed] = {}
        self._done: dict[tuple, Typed] = {}
        self._names: set[str] = set()
        self.read = functools.cache(read_function)

    def add(self, function: Callable, kinds: tuple[Kind, ...]) -> "Typed":
        """Add a function for these kinds of its arguments, and all that it calls."""
        if (function, kinds) not in self._done:
            self._done[function, kinds] = typed = Typed(self, self.read(function), kinds)
            if typed.identity is None:
                self.functions.append(typed)
        return self._done[function, kinds]

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


def kind_of_value(value: Any) -> Kind:
    """Return the kind of a constant."""
    if isinstance(value, tuple):
        items = tuple(kind_of_value(one) for one in value)
        return Tuple(items, type(value).__name__, value._fields) if hasattr(value, "_fields") else Tuple(items)
    return TRUTH if isinstance(value, bool) else REAL


class Typed:
    """A function for one list of kinds of its arguments: its unique name, its tree, and the kind of each expression.

    parameters, variables: the kind of each, by name. values: that of each constant. calls: the function that each call
    calls. returns: the kind of the result. identity: the argument that it returns as it is; None if it does anything
    else.
    """

    def __init__(self, program: Program, function: DialectFunction, kinds: tuple[Kind, ...]):
        if len(kinds) != len(function.parameters):
            raise BadLaw(f"{function.name}: called with {len(kinds)} arguments, it takes {len(function.parameters)}")
        self.program, self.function, self.summary = program, function, function.summary
        self.node = copy.deepcopy(function.node)
        self.parameters = dict(zip(function.parameters, kinds, strict=True))
        self.values = {name: value for name, value in function.names.items() if not callable(value)}
        self.variables: dict[str, Kind] = {}
        self.kinds: dict[ast.AST, Any] = {}
        self.calls: dict[ast.Call, Typed] = {}
        self.results: list[Kind] = []
        for statement in self.node.body:
            self._statement(statement)
        if not self.results or any(one != self.results[0] for one in self.results):
            raise BadLaw(f"{function.name}: every path returns the same kind of value; given: {self.results}")
        self.name, self.returns = program.name(function.name), self.results[0]
        first = self.node.body[0]
        value = first.value if isinstance(first, ast.Return) else None
        self.identity = value.id if isinstance(value, ast.Name) and value.id in self.parameters else None

    def _statement(self, node: ast.stmt) -> None:
        if isinstance(node, ast.Assign):
            kind = self.of(node.value)
            for target in node.targets:
                self.bind(target, kind)
        elif isinstance(node, ast.AugAssign):
            self.of(node.value)
            self.bind(node.target, REAL)
        elif isinstance(node, ast.Return) and node.value is not None:
            self.results.append(self.of(node.value))
        elif isinstance(node, ast.If):
            self.of(node.test)
            for one in (*node.body, *node.orelse):
                self._statement(one)
        elif isinstance(node, ast.For) and isinstance(node.iter, ast.Call):
            for bound in node.iter.args:
                self.index(bound)
            self.bind(node.target, INDEX)
            for one in node.body:
                self._statement(one)
        elif not isinstance(node, ast.Pass | ast.Break | ast.Continue):
            raise self._outside(node)

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
            raise self._outside(target)

    def of(self, node: ast.expr) -> Kind:
        """Infer and record the kind of an expression."""
        kind = self.infer(node)
        if kind is None:
            raise self._outside(node)
        self.kinds[node] = kind
        return kind

    def infer(self, node: ast.expr) -> Kind | None:
        """Return the kind of an expression; None if it is outside the dialect."""
        match node:
            case ast.Constant(value=value):
                return kind_of_value(value)
            case ast.Name(id=name):
                known = self.variables | self.parameters | {one: kind_of_value(at) for one, at in self.values.items()}
                return known.get(name)
            case ast.Attribute(value=value, attr=field):
                kind = self.of(value)
                known = dict(zip(kind.fields, kind.items, strict=True)) if isinstance(kind, Tuple) and kind.name else {}
                return known.get(field)
            case ast.Subscript(value=value, slice=index):
                kind, place = self.of(value), place_of(index)
                if place is None:
                    self.index(index)
                items = kind.items if isinstance(kind, Tuple) else ()
                return items[place or 0] if items and (place is not None or len(set(items)) == 1) else None
            case ast.Tuple(elts=items):
                return Tuple(tuple(map(self.of, items)))
            case ast.Call(func=ast.Name(id=name)):
                return self._call(node, self.function.names.get(name))
            case ast.BinOp(left=left, right=right):
                return REAL if {self.of(left), self.of(right)} == {REAL} else None
            case ast.UnaryOp(op=sign, operand=operand):
                self.of(operand)
                return TRUTH if isinstance(sign, ast.Not) else REAL
            case ast.Compare(left=left, comparators=others):
                return TRUTH if [self.of(one) for one in (left, *others)] else None
            case ast.BoolOp(values=values):
                return TRUTH if [self.of(one) for one in values] else None
            case ast.IfExp(test=test, body=body, orelse=otherwise):
                self.of(test)
                kinds = {self.of(body), self.of(otherwise)}
                return kinds.pop() if len(kinds) == 1 else None
        return None

    def index(self, node: ast.expr) -> None:
        """Record an index: a whole number, the variable of a loop, or a sum of such."""
        if isinstance(node, ast.BinOp):
            self.index(node.left)
            self.index(node.right)
        elif place_of(node) is None and not (isinstance(node, ast.Name) and self.of(node) == INDEX):
            raise self._outside(node)
        self.kinds[node] = INDEX

    def _call(self, node: ast.Call, value: Any) -> Kind | None:
        if value in PRIMITIVES:
            return REAL if [self.of(one) for one in node.args] else None
        if isinstance(value, type) and value is not range:
            fields = vars(value)["_fields"]
            return Tuple(tuple(map(self.of, arguments(node, fields))), value.__name__, fields)
        if not inspect.isfunction(value):
            return None
        kinds = tuple(map(self.of, arguments(node, self.program.read(value).parameters)))
        self.calls[node] = self.program.add(value, kinds)
        return self.calls[node].returns

    def _outside(self, node: ast.AST) -> BadLaw:
        line = ast.unparse(node).splitlines()[0]
        return BadLaw(f"{self.function.name}: `{line}` cannot be translated (bench/law/scalar.py has the dialect)")
