"""Writer of typed functions for languages with braces, statement by statement.

A variable is declared where it is assigned first, or before the branches that assign it. A tuple assigned to several
names is taken apart; where a part needs a name that an earlier part changes, its old value is kept first.
"""

import ast
import re
from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

from bench.export.layout import INDENT, wrapped
from bench.export.program import ARITHMETIC, COMPARISONS, INDEX, REAL, SIGNS, Kind, Tuple, arguments, place_of
from bench.export.reading import Typed

STRENGTH = {ast.Mult: 6, ast.Div: 6, ast.Add: 5, ast.Sub: 5}
"""How an operator binds: a call 9, a sign 7, a comparison 4, `and` 3, `or` 2, a choice 1, in every such language."""


class Braces(NamedTuple):
    """A language with braces, by the functions that write its parts.

    reserved: its words. declaration(kind, name, is_changed): `double x`, of a variable that is assigned again or not.
    built(kind, items): a tuple. part(kind, value, place): an item of a tuple; place: a number, or a variable where all
    items are numbers. head(function): all that is before the opening brace. function_name(name): that of a function of
    the program. primitive(name): that of sqrt, sin and so on. The others are templates: a condition, a choice, a loop,
    the last statement of a function, and what marks a parameter that is not read.
    """

    reserved: frozenset[str]
    declaration: Callable[[Kind, str, bool], str]
    built: Callable[[Tuple, list[str]], str]
    part: Callable[[Tuple, str, int | str], str]
    head: Callable[[Typed], str]
    function_name: Callable[[str], str]
    primitive: Callable[[str], str]
    condition: str = "({})"
    choice: str = "{} ? {} : {}"
    loop: str = "for ({declared} = {first}; {name} < {last}; {name}++)"
    last: str = "return {};"
    unused: str = ""

    def variable(self, name: str) -> str:
        """Return a local name, with an underscore after it if it is a word of the language."""
        return f"{name}_" if name in self.reserved else name

    def write(self, function: Typed) -> list[str]:
        """Return the lines of a function, the first of them its whole head."""
        body = list(_Body(self, function).lines())
        read = set(re.findall(r"\w+", "\n".join(body)))
        names = [name for name in map(self.variable, function.parameters) if self.unused and name not in read]
        unused = (INDENT + self.unused.format(name) for name in names)
        return ["\n".join(wrapped([f"{self.head(function)} {{"])), *wrapped((*unused, *body, "}"))]


class _Body:
    """One function while it is written."""

    def __init__(self, language: Braces, function: Typed) -> None:
        self.language, self.function = language, function
        self.spare = 0

    def lines(self) -> Iterator[str]:
        """Write the statements, and before each of them the declarations of the variables that begin there."""
        undeclared = {name for name, kind in self.function.variables.items() if kind != INDEX and self.is_read(name)}
        for statement in self.function.node.body:
            due = undeclared & names_in(statement)
            undeclared -= due
            if not isinstance(statement, ast.Assign):
                yield from (f"{INDENT}{self.declared(name)};" for name in sorted(due))
            yield from self.statement(statement, due, INDENT, statement is self.function.node.body[-1])

    def block(self, statements: list[ast.stmt], indent: str, is_last: bool = False) -> Iterator[str]:
        """Write the statements of a branch or a loop; is_last: nothing of the function follows."""
        for one in statements:
            yield from self.statement(one, set(), indent + INDENT, is_last and one is statements[-1])

    def declared(self, name: str) -> str:
        is_changed = count_assignments(name, self.function.node.body) > 1
        return self.language.declaration(self.function.variables[name], self.language.variable(name), is_changed)

    def statement(self, node: ast.stmt, due: set[str], indent: str, is_last: bool) -> Iterator[str]:
        """Write a statement; due: the names that an assignment declares."""
        if isinstance(node, ast.Assign):
            for target in node.targets:
                yield from (f"{indent}{one};" for one in self.assigned(target, node.value, due))
        elif isinstance(node, ast.AugAssign):
            name = self.expression(node.target)
            yield f"{indent}{name} {ARITHMETIC[type(node.op)]}= {self.expression(node.value)};"
        elif isinstance(node, ast.Return) and node.value is not None:
            yield indent + (self.language.last if is_last else "return {};").format(self.expression(node.value))
        elif isinstance(node, ast.If):
            yield from self.branches(node, indent, is_last)
        elif isinstance(node, ast.For):
            yield from self.loop(node, indent)
        elif isinstance(node, ast.Break | ast.Continue):
            yield f"{indent}{type(node).__name__.lower()};"

    def branches(self, node: ast.If, indent: str, is_last: bool) -> Iterator[str]:
        condition = self.language.condition
        yield f"{indent}if {condition.format(self.expression(node.test))} {{"
        yield from self.block(node.body, indent, is_last)
        while len(node.orelse) == 1 and isinstance(node.orelse[0], ast.If):
            node = node.orelse[0]
            yield f"{indent}}} else if {condition.format(self.expression(node.test))} {{"
            yield from self.block(node.body, indent, is_last)
        if node.orelse:
            yield f"{indent}}} else {{"
            yield from self.block(node.orelse, indent, is_last)
        yield f"{indent}}}"

    def loop(self, node: ast.For, indent: str) -> Iterator[str]:
        bounds = [self.expression(each) for each in node.iter.args] if isinstance(node.iter, ast.Call) else []
        first, last = ("0", bounds[0]) if len(bounds) == 1 else bounds[:2]
        name = self.expression(node.target)
        declared = self.language.declaration(INDEX, name, True)
        yield f"{indent}{self.language.loop.format(declared=declared, name=name, first=first, last=last)} {{"
        yield from self.block(node.body, indent)
        yield f"{indent}}}"

    def assigned(self, target: ast.expr, value: ast.expr, fresh: set[str]) -> Iterator[str]:
        """Write the assignments of one target; fresh: the names that are declared by it."""
        parts: list[list] = []
        yield from self.taken_apart(target, value, parts)
        for at, part in enumerate(parts):
            name, text, used, kind = part
            if used & {earlier for earlier, *_ in parts[:at]}:
                part[1] = f"before_{self.spare}"
                yield self.temporary(kind, part[1], text)
        for name, text, *_ in parts:
            yield f"{self.declared(name) if name in fresh else self.language.variable(name)} = {text}"

    def taken_apart(
        self, target: ast.expr, value: ast.expr | str, parts: list[list], kind: Any = None
    ) -> Iterator[str]:
        """Collect name, text, names in it and kind of every part of a target; write what is kept before."""
        kind = self.function.kinds[value] if isinstance(value, ast.expr) else kind
        if isinstance(target, ast.Tuple) and isinstance(value, ast.Tuple):
            for one, item in zip(target.elts, value.elts, strict=True):
                yield from self.taken_apart(one, item, parts)
        elif isinstance(target, ast.Tuple):
            source = self.expression(value, 9) if isinstance(value, ast.expr) else value
            if isinstance(value, ast.expr) and not isinstance(value, ast.Name | ast.Attribute):
                call, source = source, f"parts_{self.spare}"
                yield self.temporary(kind, source, call)
            for place, one in enumerate(target.elts):
                part = self.language.part(kind, source, place)
                yield from self.taken_apart(one, part, parts, kind.items[place])
        elif isinstance(target, ast.Name) and self.is_read(target.id):
            known = (self.expression(value), names_in(value)) if isinstance(value, ast.expr) else (value, set())
            parts.append([target.id, *known, kind])

    def temporary(self, kind: Kind, name: str, value: str) -> str:
        self.spare += 1
        return f"{self.language.declaration(kind, name, False)} = {value}"

    def is_read(self, name: str) -> bool:
        nodes = (one for one in ast.walk(self.function.node) if isinstance(one, ast.Name) and one.id == name)
        return any(isinstance(one.ctx, ast.Load) for one in nodes)

    def expression(self, node: ast.expr, outside: int = 0) -> str:
        """Write an expression, in parentheses if it binds less than what is outside."""
        text, strength = self.bound(node)
        return f"({text})" if strength < outside else text

    def bound(self, node: ast.expr) -> tuple[str, int]:
        """Return the text of an expression and how strongly it binds."""
        kinds, language = self.function.kinds, self.language
        kind = kinds[node]
        if kind == INDEX and place_of(node) is not None:
            return str(place_of(node)), 9
        match node:
            case ast.Constant():
                return self.value(node.value, kind), 9
            case ast.Name() if node.id in self.function.values and node.id not in self.function.variables:
                text = self.value(self.function.values[node.id], kind)
                return text, 7 if text.startswith("-") else 9
            case ast.Name():
                return language.variable(node.id), 9
            case ast.Attribute():
                of = kinds[node.value]
                return language.part(of, self.expression(node.value, 9), of.fields.index(node.attr)), 9
            case ast.Subscript():
                of, place = kinds[node.value], place_of(node.slice)
                at = self.expression(node.slice) if place is None else place % len(of.items)
                return language.part(of, self.expression(node.value, 9), at), 9
            case ast.Tuple():
                return language.built(kind, [self.expression(one) for one in node.elts]), 9
            case ast.Call():
                return self.call(node, kind)
            case ast.BinOp():
                strength = STRENGTH[type(node.op)]
                left, right = self.expression(node.left, strength), self.expression(node.right, strength + 1)
                return f"{left} {ARITHMETIC[type(node.op)]} {right}", strength
            case ast.UnaryOp():
                sign = "!" if isinstance(node.op, ast.Not) else SIGNS[type(node.op)]
                return sign + self.expression(node.operand, 8), 7
            case ast.Compare():
                sides = [self.expression(one, 5) for one in (node.left, *node.comparators)]
                signs = [COMPARISONS[type(one)] for one in node.ops]
                pairs = [f"{left} {sign} {right}" for left, sign, right in zip(sides, signs, sides[1:], strict=False)]
                return " && ".join(pairs), 4 if len(pairs) == 1 else 3
            case ast.BoolOp():
                word, strength = (" && ", 3) if isinstance(node.op, ast.And) else (" || ", 2)
                return word.join(self.expression(one, 4) for one in node.values), strength
            case ast.IfExp():
                parts = [self.expression(one, 2) for one in (node.test, node.body, node.orelse)]
                return language.choice.format(*parts), 1
        raise TypeError(f"{ast.dump(node)} has passed the type inference")  # pragma: no cover

    def call(self, node: ast.Call, kind: Kind) -> tuple[str, int]:
        if callee := self.function.calls.get(node):
            given = dict(zip(callee.parameters, arguments(node, list(callee.parameters)), strict=True))
            if callee.identity:
                return self.bound(given[callee.identity])
            texts = map(self.expression, given.values())
            return f"{self.language.function_name(callee.name)}({', '.join(texts)})", 9
        if isinstance(kind, Tuple):
            return self.language.built(kind, [self.expression(one) for one in arguments(node, kind.fields)]), 9
        name = node.func.id if isinstance(node.func, ast.Name) else ""
        return f"{self.language.primitive(name)}({', '.join(map(self.expression, node.args))})", 9

    def value(self, value: Any, kind: Kind) -> str:
        """Write a constant; numbers read back as the same bits."""
        if isinstance(kind, Tuple):
            return self.language.built(kind, [self.value(*one) for one in zip(value, kind.items, strict=True)])
        return repr(float(value)) if kind == REAL else str(value).lower()


def count_assignments(name: str, statements: list[ast.stmt]) -> int:
    """Return how often a variable is assigned on the path with most assignments; in a loop each counts twice."""
    count = 0
    for node in statements:
        if isinstance(node, ast.If):
            branches = (each for each in (node.body, node.orelse) if each and not isinstance(each[-1], ast.Return))
            count += max((count_assignments(name, each) for each in branches), default=0)
        elif isinstance(node, ast.For):
            count += 2 * count_assignments(name, node.body)
        else:
            stored = (one for one in ast.walk(node) if isinstance(one, ast.Name) and isinstance(one.ctx, ast.Store))
            count += sum(one.id == name for one in stored)
    return count


def names_in(node: ast.AST) -> set[str]:
    """Return every name in a tree."""
    return {one.id for one in ast.walk(node) if isinstance(one, ast.Name)}
