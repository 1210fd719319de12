"""Kinds of expressions."""

import ast
import inspect
import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from bench.base.errors import BadLaw
from bench.law.scalar import PRIMITIVES
from bench.translation.dialect import REPLACED, STATE, DialectFunction
from bench.translation.kinds import (
    INTEGER,
    NONE,
    NUMERIC,
    REAL,
    TRUTH,
    Array,
    External,
    Kind,
    Known,
    Pointer,
    StaticFunction,
    Tuple,
    widest,
)
from bench.translation.trees import item_of, place_of

if TYPE_CHECKING:
    from bench.translation.inference import Typed
    from bench.translation.program import Program

CONVERSIONS: dict[Any, Kind] = {float: REAL, int: INTEGER, bool: TRUTH, len: INTEGER}
"""Built-in functions with a kind of their own; those of `math` give a real number, min, max and abs what they get."""


class Expressions:
    """The expressions of a function, and what is known of each; see `inference.Typed`, which has the statements."""

    program: "Program"
    function: DialectFunction
    parameters: dict[str, Kind]
    variables: dict[str, Kind]
    names: dict[str, Any]
    kinds: dict[ast.AST, Any]
    calls: dict[ast.Call, "Typed"]
    decided: dict[ast.expr, bool]
    rewritten: dict[ast.expr, ast.expr]
    raises: bool

    def of(self, node: ast.expr) -> Kind:
        """Infer and record the kind of an expression."""
        kind = self.infer(node)
        if kind is None:
            raise self.outside(node)
        self.kinds[node] = kind
        return kind

    def test(self, node: ast.expr) -> None:
        """Infer a condition; None is false, and a tuple is none."""
        kind = self.of(node)
        if kind == NONE:
            self.decided[node] = False
        elif kind not in NUMERIC:
            raise self.outside(node)

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
                self.test(test)
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
            return self._kind_of_constant(name, self.names[name])
        return None

    def _kind_of_constant(self, name: str, value: Any) -> Kind:
        try:
            kind = self.program.kind_of(value)
        except TypeError as error:
            raise BadLaw(f"'{name}' of the file is no number, tuple or kernel; {STATE}") from error
        if isinstance(kind, Array):
            raise BadLaw(f"'{name}' of the file is an array; write a tuple of numbers. If the law changes it: {STATE}")
        return kind

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
            raise self.outside(node)
        return [item_of(node, place) for place in range(len(kind.items))]

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

    def index(self, node: ast.expr) -> None:
        """Record an index: a whole number, the variable of a loop, or a sum of such."""
        if self.program.dialect.has_integers:
            if self.of(node) != INTEGER:
                raise self.outside(node)
            return
        if isinstance(node, ast.BinOp):
            self.index(node.left)
            self.index(node.right)
        elif place_of(node) is None and not (isinstance(node, ast.Name) and self.of(node) == INTEGER):
            raise self.outside(node)
        self.kinds[node] = INTEGER

    def callee(self, node: ast.expr) -> Any:
        """Return the function that a call names, or the kind of the pointer that it calls."""
        if isinstance(node, ast.Name) and node.id not in self.variables | self.parameters:
            value = self.names.get(node.id)
            if inspect.isfunction(value) or inspect.isbuiltin(value) or isinstance(value, type):
                return value
        kind = self.of(node)
        if isinstance(kind, StaticFunction):
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
            self.raises |= self.calls[node].raises
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

    def outside(self, node: ast.AST) -> BadLaw:
        """Return the error that names an expression that is outside the dialect."""
        line = ast.unparse(node).splitlines()[0]
        return BadLaw(f"{self.function.name}: `{line}` cannot be translated (bench/law/scalar.py has the dialect)")
