"""Infer kinds: each list of kinds of its arguments makes a function of the dialect another one, as a compiler does."""

import ast
import copy
import functools
import inspect
import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from bench.base.errors import BadLaw
from bench.law.scalar import PRIMITIVES
from bench.translation.dialect import ARITHMETIC, REPLACED, DialectFunction, place_of
from bench.translation.kinds import (
    INTEGER,
    NONE,
    NUMERIC,
    REAL,
    TRUTH,
    Array,
    External,
    Function,
    Kind,
    Known,
    Pointer,
    Tuple,
    widest,
)

if TYPE_CHECKING:
    from bench.translation.program import Program

CONVERSIONS: dict[Any, Kind] = {float: REAL, int: INTEGER, bool: TRUTH, len: INTEGER}
"""Built-in functions with a kind of their own; those of `math` give a real number, min, max and abs what they get."""


class Wider(Exception):
    """A variable holds numbers of two kinds: the kinds of the whole function are inferred again."""


class Typed:
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
    """

    def __init__(self, program: "Program", function: DialectFunction, kinds: tuple[Kind, ...]):
        missing = len(function.parameters) - len(kinds)
        if not 0 <= missing <= len(function.defaults):
            raise BadLaw(f"{function.name}: called with {len(kinds)} arguments, it takes {len(function.parameters)}")
        given = (*kinds, *map(program.kind_of, function.defaults[len(function.defaults) - missing :]))
        self.program, self.function, self.summary = program, function, function.summary
        self.parameters = dict(zip(function.parameters, given, strict=True))
        self.names = function.names
        self.read = _names_read(function.node)
        self._widened: dict[str, Kind] = {}
        while not self._infer():
            pass
        self.writes = self._find_writes()
        self._refuse_unordered()
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
        results: list[Kind] = []
        try:
            self._block(self.node.body, results)
        except Wider:
            return False
        self.returns = functools.reduce(self._widest_result, results or [NONE])
        if not results and not self.program.dialect.has_integers:
            raise BadLaw(f"{self.function.name}: every path returns the same kind of value; given: {results}")
        return True

    def _widest_result(self, first: Kind, second: Kind) -> Kind:
        kind = widest(first, second)
        if kind is None:
            raise BadLaw(
                f"{self.function.name}: every path returns the same kind of value; given: {[first, second]}"
            )
        return kind

    def _block(self, statements: list[ast.stmt], results: list[Kind]) -> None:
        """Infer statements; those behind a branch that is taken and returns are taken out."""
        for place, statement in enumerate(statements, start=1):
            self._statement(statement, results)
            if isinstance(statement, ast.If) and statement.test in self.decided:
                (branch,) = self.taken(statement)
                if branch and isinstance(branch[-1], ast.Return):
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
            self._test(node.test)
            for branch in self.taken(node):
                self._block(branch, results)
        elif isinstance(node, ast.While) and has_integers:
            self._test(node.test)
            self._block(node.body, results)
        elif isinstance(node, ast.For) and isinstance(node.iter, ast.Call):
            for bound in node.iter.args:
                self.index(bound)
            self.bind(node.target, INTEGER)
            self._block(node.body, results)
        elif isinstance(node, ast.Expr) and isinstance(node.value, ast.Call) and has_integers:
            self.of(node.value)
        elif isinstance(node, ast.Try) and has_integers:
            self._block(node.body, results)
        elif not isinstance(node, ast.Pass | ast.Break | ast.Continue):
            raise self._outside(node)

    def _augment(self, node: ast.AugAssign) -> None:
        """Infer `x += y` as x = x + y."""
        if type(node.op) not in ARITHMETIC:
            raise self._outside(node)
        target = copy.deepcopy(node.target)
        for part in ast.walk(target):
            if hasattr(part, "ctx"):
                part.ctx = ast.Load()
        sum_of_both = ast.copy_location(ast.BinOp(target, node.op, node.value), node)
        self.bind(node.target, self.of(sum_of_both))

    def _test(self, node: ast.expr) -> None:
        """Infer a condition; None is false, and a tuple is none."""
        kind = self.of(node)
        if kind == NONE:
            self.decided[node] = False
        elif kind not in NUMERIC:
            raise self._outside(node)

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
                raise self._outside(target)
        else:
            raise self._outside(target)

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
                return self.program.kind_of(value)
            case ast.Name(id=name):
                return self._kind_of_name(name)
            case ast.Attribute(value=value, attr=field):
                return self._kind_of_field(self.of(value), field)
            case ast.Subscript(value=value, slice=index):
                return self._kind_of_item(self.of(value), index)
            case ast.Tuple(elts=items):
                items[:] = self._spread(items)
                return Tuple(tuple(map(self.of, items)))
            case ast.Call():
                return self._call(node)
            case ast.BinOp(left=left, op=operator, right=right):
                kinds = self.of(left), self.of(right)
                if isinstance(operator, ast.Add) and all(isinstance(kind, Tuple) for kind in kinds):
                    self.rewritten[node] = joined = ast.Tuple(self._items_of(left) + self._items_of(right))
                    return self.of(joined)
                return self._kind_of_operation(*kinds, operator, right)
            case ast.UnaryOp(op=sign, operand=operand):
                return self._kind_of_sign(node, sign, self.of(operand))
            case ast.Compare():
                return self._kind_of_comparison(node)
            case ast.BoolOp(values=values):
                return self._kind_of_logic(node, values)
            case ast.IfExp(test=test, body=body, orelse=otherwise):
                self._test(test)
                if (decided := self.decided.get(test)) is not None:
                    return self.of(body if decided else otherwise)
                return widest(self.of(body), self.of(otherwise))
        return None

    def _kind_of_name(self, name: str) -> Kind | None:
        if name in self.variables:
            return self.variables[name]
        if name in self.parameters:
            return self.parameters[name]
        if name in self.names and (self.program.dialect.has_integers or not callable(self.names[name])):
            try:
                return self.program.kind_of(self.names[name])
            except TypeError as error:
                raise BadLaw(f"{self.function.name}: '{name}': {error}") from error
        return None

    def _kind_of_field(self, kind: Kind, field: str) -> Kind | None:
        if isinstance(kind, Tuple) and kind.name:
            return dict(zip(kind.fields, kind.items, strict=True)).get(field)
        if isinstance(kind, Known) and hasattr(kind.value, field):
            return self.program.kind_of(getattr(kind.value, field))
        if isinstance(kind, Array):
            parts: dict[str, Kind] = {"shape": Tuple((INTEGER,) * kind.dimensions), "ctypes": kind, "data": INTEGER}
            return parts.get(field)
        return None

    def _kind_of_item(self, kind: Kind, index: ast.expr) -> Kind | None:
        if isinstance(kind, Array):
            return self._kind_of_view(kind, index)
        place = place_of(index)
        if place is None:
            self.index(index)
        items = kind.items if isinstance(kind, Tuple) else ()
        if not items or (place is None and len(set(items)) > 1):
            return None
        return items[place or 0]

    def _kind_of_view(self, kind: Array, index: ast.expr) -> Kind | None:
        """Return the kind of an element, a row or a contiguous part of an array."""
        indices = index.elts if isinstance(index, ast.Tuple) else [index]
        left = kind.dimensions - len(indices)
        for number, one in enumerate(indices, start=1):
            if not isinstance(one, ast.Slice):
                self.index(one)
                continue
            if number < kind.dimensions or one.step is not None:
                return None  # its elements would not lie side by side
            left += 1
            for bound in (one.lower, one.upper):
                if bound is not None:
                    self.index(bound)
        return Array(left, kind.element) if left else kind.element

    def _spread(self, items: list[ast.expr]) -> list[ast.expr]:
        """Return expressions with `*t` taken apart into t[0], t[1] and so on."""
        parts: list[ast.expr] = []
        for item in items:
            if isinstance(item, ast.Starred) and self.program.dialect.has_integers:
                parts += self._items_of(item.value)
            else:
                parts.append(item)
        return parts

    def _items_of(self, node: ast.expr) -> list[ast.expr]:
        """Return the items of a tuple, which is named in each of them."""
        kind = self.of(node)
        if isinstance(node, ast.Tuple):
            return node.elts
        if not isinstance(kind, Tuple) or not isinstance(node, ast.Name | ast.Attribute):
            raise self._outside(node)
        return [_item(node, place) for place in range(len(kind.items))]

    def _kind_of_operation(
        self, left: Kind, right: Kind, operator: ast.operator, exponent: ast.expr
    ) -> Kind | None:
        if not self.program.dialect.has_integers:
            return REAL if {left, right} == {REAL} else None
        kind = widest(left, right)
        if kind not in NUMERIC:
            return None
        if isinstance(operator, ast.Pow):
            return left if place_of(exponent) == 2 else None
        if isinstance(operator, ast.Div):
            return REAL
        if isinstance(operator, ast.FloorDiv | ast.Mod):
            return INTEGER if kind == INTEGER else None
        if isinstance(operator, ast.BitAnd | ast.BitOr):
            return kind if kind != REAL else None
        return INTEGER if kind == TRUTH else kind

    def _kind_of_sign(self, node: ast.UnaryOp, sign: ast.unaryop, kind: Kind) -> Kind | None:
        if isinstance(sign, ast.Not):
            if node.operand in self.decided:
                self.decided[node] = not self.decided[node.operand]
            return TRUTH
        return INTEGER if kind in (INTEGER, TRUTH) else REAL if kind == REAL else None

    def _kind_of_comparison(self, node: ast.Compare) -> Kind | None:
        kinds = [self.of(side) for side in (node.left, *node.comparators)]
        if isinstance(node.ops[0], ast.Is | ast.IsNot):
            if NONE not in kinds or len(kinds) > 2:
                return None
            self.decided[node] = (kinds[0] == kinds[1]) == isinstance(node.ops[0], ast.Is)
            return TRUTH
        return TRUTH if all(kind in NUMERIC for kind in kinds) else None

    def _kind_of_logic(self, node: ast.BoolOp, values: list[ast.expr]) -> Kind:
        """Infer `and` and `or`; what is behind a value that decides is not looked at."""
        decides = isinstance(node.op, ast.Or)
        known: list[bool | None] = []
        for value in values:
            self.of(value)
            known.append(self.decided.get(value))
            if known[-1] is decides:
                break
        if known[-1] is decides and all(one is not None for one in known):
            self.decided[node] = decides
        elif all(one is not None for one in known):
            self.decided[node] = not decides
        return TRUTH

    def _find_writes(self) -> bool:
        nodes = list(ast.walk(self.node))
        stores = (one for one in nodes if isinstance(one, ast.Subscript) and isinstance(one.ctx, ast.Store))
        return any(one in self.kinds for one in stores) or any(map(self._is_writing_call, nodes))

    def _is_writing_call(self, node: ast.AST) -> bool:
        """Tell whether a node is a call of what writes; what is called by pointer does where it gets an array."""
        if not isinstance(node, ast.Call) or node not in self.kinds:
            return False
        if node in self.calls:
            return self.calls[node].writes
        callee = self.callee(node.func)
        if isinstance(callee, Pointer):
            return any(map(_holds_array, callee.parameters))
        return isinstance(callee, External)

    def _refuse_unordered(self) -> None:
        """Refuse a call that writes into an array beside what reads one: C does not order them, and Python does."""
        for node in ast.walk(self.node):
            if not isinstance(node, ast.Call | ast.BinOp | ast.Compare | ast.Tuple) or node not in self.kinds:
                continue
            parts = [part for part in ast.iter_child_nodes(node) if isinstance(part, ast.expr)]
            writing = [any(map(self._is_writing_call, ast.walk(part))) for part in parts]
            reading = [any(map(self._reads_array, ast.walk(part))) for part in parts]
            if any(writing) and sum(writes or reads for writes, reads in zip(writing, reading, strict=True)) > 1:
                raise BadLaw(
                    f"{self.function.name}: `{ast.unparse(node)}` has a call that writes into an array beside what "
                    "reads one, and C does not order them; give the call's result a name first"
                )

    def _reads_array(self, node: ast.AST) -> bool:
        """Tell whether a node reads an element of an array, or calls what is given an array."""
        if isinstance(node, ast.Subscript):
            return isinstance(self.kinds.get(node.value), Array) and not isinstance(self.kinds.get(node), Array)
        given = node.args if isinstance(node, ast.Call) else []
        return any(_holds_array(self.kinds.get(one, NONE)) for one in given)

    def index(self, node: ast.expr) -> None:
        """Record an index: a whole number, the variable of a loop, or a sum of such."""
        if self.program.dialect.has_integers:
            if self.of(node) != INTEGER:
                raise self._outside(node)
            return
        if isinstance(node, ast.BinOp):
            self.index(node.left)
            self.index(node.right)
        elif place_of(node) is None and not (isinstance(node, ast.Name) and self.of(node) == INTEGER):
            raise self._outside(node)
        self.kinds[node] = INTEGER

    def callee(self, node: ast.expr) -> Any:
        """Return the function that a call names, or the kind of the pointer that it calls."""
        if isinstance(node, ast.Name) and node.id not in self.variables | self.parameters:
            value = self.names.get(node.id)
            if inspect.isfunction(value) or inspect.isbuiltin(value) or isinstance(value, type):
                return value
        kind = self.of(node)
        if isinstance(kind, Function):
            return kind.function
        return kind.value if isinstance(kind, Known) else kind

    def _call(self, node: ast.Call) -> Kind | None:
        value = self.callee(node.func)
        if value in PRIMITIVES:
            return REAL if [self.of(one) for one in node.args] else None
        if isinstance(value, type) and issubclass(value, tuple) and hasattr(value, "_fields"):
            given = self._given(node, value._fields, vars(value)["_field_defaults"])
            return Tuple(tuple(map(self.of, given)), value.__name__, value._fields)
        if isinstance(value, Pointer):
            return self._call_by_pointer(node, value)
        if isinstance(value, External):
            return value.returns if all(self.of(one) == INTEGER for one in node.args) else None
        if inspect.isfunction(value):
            value = REPLACED.get(value, value)
            given = self._given(node, self.program.read(value).parameters, {})
            self.calls[node] = self.program.typed(value, tuple(map(self.of, given)))
            return self.calls[node].returns
        return self._call_of_builtin(node, value) if self.program.dialect.has_integers else None

    def _given(self, node: ast.Call, names: Sequence[str], defaults: dict[str, Any]) -> list[ast.expr]:
        """Return the arguments of a call in the order of the parameters, and make the call so.

        Those that are not given are defaults; the last may be missing.
        """
        named = {one.arg: one.value for one in node.keywords}
        node.args, node.keywords = self._spread(node.args), []
        for name in names[len(node.args) :]:
            if name in named or name in defaults:
                node.args.append(named[name] if name in named else ast.Constant(defaults[name]))
        return node.args

    def _call_by_pointer(self, node: ast.Call, pointer: Pointer) -> Kind | None:
        kinds = [self.of(one) for one in node.args]
        fitting = [widest(kind, wanted) == wanted for kind, wanted in zip(kinds, pointer.parameters, strict=True)]
        return pointer.returns if all(fitting) else None

    def _call_of_builtin(self, node: ast.Call, value: Any) -> Kind | None:
        if value is getattr:
            owner, field = node.args
            name = self.of(field)
            if not isinstance(name, Known):
                return None
            self.rewritten[node] = attribute = ast.Attribute(owner, name.value, ast.Load())
            return self.of(attribute)
        kinds = [self.of(one) for one in node.args]
        if value in CONVERSIONS:
            if kinds == [Known("nan")] or kinds == [Known("inf")]:
                return REAL
            return CONVERSIONS[value]
        if value in (min, max, abs):
            return max(kinds, key=NUMERIC.index) if all(kind in NUMERIC for kind in kinds) else None
        if getattr(math, getattr(value, "__name__", ""), None) is value:
            return REAL
        return None

    def _outside(self, node: ast.AST) -> BadLaw:
        line = ast.unparse(node).splitlines()[0]
        return BadLaw(f"{self.function.name}: `{line}` cannot be translated (bench/law/scalar.py has the dialect)")


def _holds_array(kind: Kind) -> bool:
    return isinstance(kind, Array) or (isinstance(kind, Tuple) and any(map(_holds_array, kind.items)))


def _item(node: ast.expr, place: int) -> ast.expr:
    """Return the expression of an item of a tuple."""
    return ast.copy_location(ast.Subscript(node, ast.Constant(place), ast.Load()), node)


def _names_read(function: ast.FunctionDef) -> set[str]:
    """Return the names that a function reads; `x += 1` reads x."""
    names = set()
    for node in ast.walk(function):
        if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load):
            names.add(node.id)
        elif isinstance(node, ast.AugAssign) and isinstance(node.target, ast.Name):
            names.add(node.target.id)
    return names
