"""Infer kinds: each list of kinds of its arguments makes a function of the dialect another one, as a compiler does."""

import ast
import copy
import functools
from typing import TYPE_CHECKING, Any

from bench.base.errors import BadLaw
from bench.translation.dialect import ARITHMETIC, STATE, DialectFunction
from bench.translation.expressions import Expressions
from bench.translation.kinds import INTEGER, NONE, Kind, Tuple, widest
from bench.translation.order import find_writes, refuse_unordered
from bench.translation.trees import names_read

if TYPE_CHECKING:
    from bench.translation.program import Program

class Wider(Exception):
    """A variable holds numbers of two kinds: the kinds of the whole function are inferred again."""


class Typed(Expressions):
    """A function for one list of kinds of its arguments.

    Attributes:
        name: Its unique name.
        node: Its tree.
        parameters: The kind of each parameter.
        variables: The kind of each variable.
        names: The value of each free name.
        kinds: The kind of each expression.
        calls: The function that each call calls.
        decided: The value of each test that is known when the code is written.
        rewritten: The tuple that is written in place of a sum of tuples.
        returns: The kind of the result.
        identity: The argument that it returns as it is; None if it does anything else.
        writes: Whether it writes into an array, or calls what does.
        raises: Whether it can raise an error that it does not catch.
        caught: Every `try` in which an error can be raised.
    """

    def __init__(self, program: "Program", function: DialectFunction, kinds: tuple[Kind, ...]):
        missing = len(function.parameters) - len(kinds)
        if not 0 <= missing <= len(function.defaults):
            raise BadLaw(f"{function.name}: called with {len(kinds)} arguments, it takes {len(function.parameters)}")
        given = (*kinds, *map(program.kind_of, function.defaults[len(function.defaults) - missing :]))
        self.program, self.function, self.summary = program, function, function.summary
        self.parameters = dict(zip(function.parameters, given, strict=True))
        self.names = function.names
        self.read = names_read(function.node)
        self._widened: dict[str, Kind] = {}
        while not self._infer():
            pass
        self.writes = find_writes(self)
        refuse_unordered(self)
        self.name = program.name(function.name)
        first = self.node.body[0]
        value = first.value if isinstance(first, ast.Return) else None
        self.identity = value.id if isinstance(value, ast.Name) and value.id in self.parameters else None

    @property
    def values(self) -> dict[str, Any]:
        """Return the value of each constant."""
        return {name: value for name, value in self.names.items() if not callable(value)}

    def _infer(self) -> bool:
        """Infer all kinds; return False if a variable turned out to hold a wider kind, which it then has at first."""
        self.node = copy.deepcopy(self.function.node)
        self.variables = dict(self._widened)
        self.kinds: dict[ast.AST, Any] = {}
        self.calls: dict[ast.Call, Typed] = {}
        self.decided: dict[ast.expr, bool] = {}
        self.rewritten: dict[ast.expr, ast.expr] = {}
        self.caught: set[ast.Try] = set()
        self.raises = False
        results: list[Kind] = []
        try:
            self._block(self.node.body, results)
        except Wider:
            return False
        self.returns = functools.reduce(self._widest_result, results or [NONE])
        if not results and not self.program.dialect.has_integers:
            raise BadLaw(f"{self.function.name}: every path returns the same kind of value; given: {results}")
        if self.program.dialect.has_integers and self.returns != NONE and self._can_end(self.node.body):
            raise BadLaw(f"{self.function.name}: a path of it returns nothing")
        return True

    def _can_end(self, statements: list[ast.stmt]) -> bool:
        """Tell whether statements can be left at their end."""
        last = statements[-1] if statements else None
        if isinstance(last, ast.If):
            return any(map(self._can_end, self.taken(last)))
        if isinstance(last, ast.Try):
            handlers = [one.body for one in last.handlers] if last in self.caught else []
            return any(map(self._can_end, (last.body, *handlers)))
        if isinstance(last, ast.While):
            is_endless = isinstance(last.test, ast.Constant) and last.test.value is True
            return not is_endless or any(isinstance(one, ast.Break) for one in ast.walk(last))
        return not isinstance(last, ast.Return | ast.Raise)

    def _widest_result(self, first: Kind, second: Kind) -> Kind:
        kind = widest(first, second)
        if kind is None:
            raise BadLaw(
                f"{self.function.name}: every path returns the same kind of value; given: {[first, second]}"
            )
        return kind

    def _block(self, statements: list[ast.stmt], results: list[Kind]) -> None:
        """Infer statements; those that cannot be reached are taken out."""
        for place, statement in enumerate(statements, start=1):
            self._statement(statement, results)
            if self.program.dialect.has_integers and not self._can_end([statement]):
                del statements[place:]

    def _statement(self, node: ast.stmt, results: list[Kind]) -> None:
        has_integers = self.program.dialect.has_integers
        if isinstance(node, ast.Assign):
            kind = self.of(node.value)
            for target in node.targets:
                self.bind(target, kind)
        elif isinstance(node, ast.AugAssign):
            self._augment(node)
        elif isinstance(node, ast.Return) and node.value is not None:
            results.append(self.of(node.value))
        elif isinstance(node, ast.Return) and has_integers:
            results.append(NONE)
        elif isinstance(node, ast.If):
            self.test(node.test)
            for branch in self.taken(node):
                self._block(branch, results)
        elif isinstance(node, ast.While) and has_integers:
            self.test(node.test)
            self._block(node.body, results)
        elif isinstance(node, ast.For) and isinstance(node.iter, ast.Call):
            for bound in node.iter.args:
                self.index(bound)
            self.bind(node.target, INTEGER)
            self._block(node.body, results)
        elif isinstance(node, ast.Expr) and isinstance(node.value, ast.Call) and has_integers:
            self.of(node.value)
        elif isinstance(node, ast.Try) and has_integers:
            self._try(node, results)
        elif isinstance(node, ast.Raise) and has_integers:
            self.raises = True
        elif isinstance(node, ast.Global):
            raise BadLaw(f"it assigns a global of the file; {STATE}")
        elif not isinstance(node, ast.Pass | ast.Break | ast.Continue):
            raise self.outside(node)

    def _try(self, node: ast.Try, results: list[Kind]) -> None:
        """Infer `try`; where nothing in it raises, its body is all that is written."""
        raises_elsewhere, self.raises = self.raises, False
        self._block(node.body, results)
        if self.raises:
            leaves = (ast.Return, ast.Break, ast.Continue)
            is_left = any(isinstance(one, leaves) for statement in node.body for one in ast.walk(statement))
            if is_left or len(node.handlers) != 1 or node.handlers[0].name or node.orelse or node.finalbody:
                raise self.outside(node)
            self.caught.add(node)
            self.raises = False
            self._block(node.handlers[0].body, results)
        self.raises |= raises_elsewhere

    def _augment(self, node: ast.AugAssign) -> None:
        """Infer `x += y` as x = x + y."""
        if type(node.op) not in ARITHMETIC:
            raise self.outside(node)
        target = copy.deepcopy(node.target)
        for part in ast.walk(target):
            if hasattr(part, "ctx"):
                part.ctx = ast.Load()
        sum_of_both = ast.copy_location(ast.BinOp(target, node.op, node.value), node)
        self.bind(node.target, self.of(sum_of_both))

    def taken(self, node: ast.If) -> list[list[ast.stmt]]:
        """Return the branches of an `if` that can be reached."""
        decided = self.decided.get(node.test)
        return [node.body] * (decided is not False) + [node.orelse] * (decided is not True)

    def bind(self, target: ast.expr, kind: Kind) -> None:
        """Give a variable its kind, which it keeps."""
        self.kinds[target] = kind
        if isinstance(target, ast.Name):
            if target.id in self.read or not self.program.dialect.has_integers:
                self._bind_name(target.id, kind)
        elif isinstance(target, ast.Tuple) and isinstance(kind, Tuple) and len(target.elts) == len(kind.items):
            for one, item in zip(target.elts, kind.items, strict=True):
                self.bind(one, item)
        elif isinstance(target, ast.Subscript) and self.program.dialect.has_integers:
            if widest(self.of(target), kind) != self.kinds[target]:
                raise self.outside(target)
        else:
            raise self.outside(target)

    def _bind_name(self, name: str, kind: Kind) -> None:
        known = self.variables.get(name, self.parameters.get(name, kind))
        if known != kind:
            wider = widest(known, kind) if self.program.dialect.has_integers else None
            if wider is None or (name in self.parameters and wider != known):
                raise BadLaw(f"{self.function.name}: '{name}' is {known} and becomes {kind}; use another name")
            if wider != known:
                self._widened[name] = wider
                raise Wider
            kind = wider
        if name not in self.parameters:
            self.variables[name] = kind
