"""What languages with braces share: a typed function, statement by statement.

A variable is declared where it is assigned first, or before the branches that assign it. A tuple assigned to several
names is taken apart; where a part needs a name that an earlier part changes, the old values are kept first.
"""

import ast
from collections.abc import Iterable, Iterator

from bench.export.types import INDEX, REAL, Kind, Tuple, Typed, arguments, place_of, place_of_constant

INDENT, WIDTH = "    ", 120
NAMES = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/"}
SIGNS = {ast.Lt: "<", ast.LtE: "<=", ast.Gt: ">", ast.GtE: ">=", ast.Eq: "==", ast.NotEq: "!="}
STRENGTH = {ast.Mult: 6, ast.Div: 6, ast.Add: 5, ast.Sub: 5}
"""How an operator binds: a call 9, a sign 7, a comparison 4, `and` 3, `or` 2, a choice 1, as in all of them."""


class Braces:
    """A language with braces; a subclass says how it writes tuples, declarations and the names of functions."""

    end = ";"

    def declaration(self, kind: Kind, name: str, value: str | None) -> str:
        """`double x = 1.0`."""
        raise NotImplementedError

    def built(self, kind: Tuple, items: list[str]) -> str:
        """A tuple of these items."""
        raise NotImplementedError

    def part(self, kind: Tuple, value: str, place: int) -> str:
        """One item of a tuple."""
        raise NotImplementedError

    def chosen(self, kind: Tuple, value: str, index: str) -> str:
        """The item that a variable says."""
        raise NotImplementedError

    def function_name(self, name: str) -> str:
        """Of a function of the program."""
        return name

    def primitive(self, name: str) -> str:
        """Of sqrt, sin and so on."""
        return name

    def variable(self, name: str) -> str:
        """A local name that is no word of the language."""
        return name

    def head(self, function: Typed) -> str:
        """All before the opening brace."""
        raise NotImplementedError

    def function(self, function: Typed) -> str:
        """The whole function with its comment."""
        return "\n".join(_Body(self, function).lines())


class _Body:
    """One function while it is written."""

    def __init__(self, language: Braces, function: Typed):
        self.language, self.function = language, function
        self.spare = 0

    def lines(self) -> Iterator[str]:
        yield self.language.head(self.function) + " {"
        yield from self.block(self.function.node.body, set(self.function.variables), INDENT)
        yield "}"

    def block(self, statements: list[ast.stmt], undeclared: set[str], indent: str) -> Iterator[str]:
        """The statements, and in their places the declarations of the variables that live in this block alone."""
        here = {}
        for name in sorted(undeclared):
            users = [at for at, one in enumerate(statements) if name in names_in(one)]
            if users and not _is_inside(name, statements[users[0]], len(users)):
                here[name] = users[0]
        inner = undeclared - set(here)
        for at, statement in enumerate(statements):
            due = [name for name, first in here.items() if first == at]
            if isinstance(statement, ast.Assign):
                yield from self.statement(statement, set(due), inner, indent)
                continue
            for name in due:
                yield f"{indent}{self.declared(name)}{self.language.end}"
            yield from self.statement(statement, set(), inner, indent)

    def declared(self, name: str, value: str | None = None) -> str:
        return self.language.declaration(self.function.variables[name], self.language.variable(name), value)

    def statement(self, node: ast.stmt, fresh: set[str], inner: set[str], indent: str) -> Iterator[str]:
        end = self.language.end
        if isinstance(node, ast.Assign):
            for target in node.targets:
                yield from (f"{indent}{one}{end}" for one in self.assigned(target, node.value, fresh))
        elif isinstance(node, ast.AugAssign):
            name = self.expression(node.target)
            yield f"{indent}{name} = {name} {NAMES[type(node.op)]} {self.expression(node.value, 7)}{end}"
        elif isinstance(node, ast.Return) and node.value is not None:
            yield f"{indent}return {self.expression(node.value)}{end}"
        elif isinstance(node, ast.If):
            yield from self.branches(node, inner, indent)
        elif isinstance(node, ast.For):
            yield from self.loop(node, inner, indent)
        elif isinstance(node, ast.Break | ast.Continue):
            yield f"{indent}{type(node).__name__.lower()}{end}"

    def branches(self, node: ast.If, inner: set[str], indent: str) -> Iterator[str]:
        yield f"{indent}if ({self.expression(node.test)}) {{"
        yield from self.block(node.body, inner, indent + INDENT)
        while len(node.orelse) == 1 and isinstance(node.orelse[0], ast.If):
            node = node.orelse[0]
            yield f"{indent}}} else if ({self.expression(node.test)}) {{"
            yield from self.block(node.body, inner, indent + INDENT)
        if node.orelse:
            yield f"{indent}}} else {{"
            yield from self.block(node.orelse, inner, indent + INDENT)
        yield f"{indent}}}"

    def loop(self, node: ast.For, inner: set[str], indent: str) -> Iterator[str]:
        bounds = [self.expression(each) for each in node.iter.args] if isinstance(node.iter, ast.Call) else []
        first, last = ("0", bounds[0]) if len(bounds) == 1 else bounds[:2]
        name = self.expression(node.target)
        begin = self.language.declaration(INDEX, name, first)
        yield f"{indent}for ({begin}; {name} < {last}; {name}++) {{"
        yield from self.block(node.body, inner - names_in(node.target), indent + INDENT)
        yield f"{indent}}}"

    def assigned(self, target: ast.expr, value: ast.expr, fresh: set[str]) -> Iterator[str]:
        """The assignments of one target, declarations where a name is fresh."""
        if isinstance(target, ast.Name):
            yield self.given(target, self.expression(value), fresh)
            return
        if not isinstance(target, ast.Tuple):
            return
        if isinstance(value, ast.Tuple):
            yield from self.together(target.elts, value.elts, fresh)
            return
        kind = self.function.kinds[value]
        source = self.expression(value, 9)
        if not isinstance(value, ast.Name | ast.Attribute):
            source, made = self.temporary(kind, source)
            yield made
        yield from self.taken_apart(target, kind, source, fresh)

    def taken_apart(self, target: ast.Tuple, kind: Kind, source: str, fresh: set[str]) -> Iterator[str]:
        if isinstance(kind, Tuple):
            for place, one in enumerate(target.elts):
                part = self.language.part(kind, source, place)
                if isinstance(one, ast.Tuple):
                    yield from self.taken_apart(one, kind.items[place], part, fresh)
                elif isinstance(one, ast.Name) and self.is_read(one.id):
                    yield self.given(one, part, fresh)

    def together(self, targets: list[ast.expr], values: list[ast.expr], fresh: set[str]) -> Iterator[str]:
        """a, b = b, a: values that an earlier target changes are kept before."""
        sources: list[str | None] = [None] * len(values)
        for place, value in enumerate(values):
            changed = {name for one in targets[:place] for name in names_in(one)}
            if changed & names_in(value):
                sources[place], made = self.temporary(self.function.kinds[value], self.expression(value))
                yield made
        for one, value, source in zip(targets, values, sources, strict=True):
            if source is None:
                yield from self.assigned(one, value, fresh)
            elif isinstance(one, ast.Name):
                yield self.given(one, source, fresh)
            elif isinstance(one, ast.Tuple):
                yield from self.taken_apart(one, self.function.kinds[value], source, fresh)

    def given(self, target: ast.Name, value: str, fresh: set[str]) -> str:
        """`name = value`, declared if it is fresh."""
        if target.id in fresh:
            fresh.discard(target.id)
            return self.declared(target.id, value)
        return f"{self.language.variable(target.id)} = {value}"

    def temporary(self, kind: Kind, value: str) -> tuple[str, str]:
        """A name for a value, and its declaration."""
        self.spare += 1
        name = f"parts_{self.spare}" if isinstance(kind, Tuple) else f"before_{self.spare}"
        return name, self.language.declaration(kind, name, value)

    def is_read(self, name: str) -> bool:
        """Whether a variable is looked at anywhere."""
        nodes = (one for statement in self.function.node.body for one in ast.walk(statement))
        return any(isinstance(one, ast.Name) and one.id == name and isinstance(one.ctx, ast.Load) for one in nodes)

    def expression(self, node: ast.expr, outside: int = 0) -> str:
        """An expression, in parentheses if it binds less than what is outside."""
        text, strength = self.bound(node)
        return f"({text})" if strength < outside else text

    def bound(self, node: ast.expr) -> tuple[str, int]:
        """The text of an expression and how strongly it binds."""
        kinds, language = self.function.kinds, self.language
        kind = kinds[node]
        if kind == INDEX and place_of_constant(node) is not None:
            return str(place_of_constant(node)), 9
        if isinstance(node, ast.Constant):
            return self.value(node.value, kind), 9
        if isinstance(node, ast.Name):
            if node.id in self.function.values and node.id not in self.function.variables:
                text = self.value(self.function.values[node.id], kind)
                return text, 7 if text.startswith("-") else 9
            return language.variable(node.id), 9
        if isinstance(node, ast.Attribute):
            of = kinds[node.value]
            return language.part(of, self.expression(node.value, 9), of.fields.index(node.attr)), 9
        if isinstance(node, ast.Subscript):
            return self.subscript(node), 9
        if isinstance(node, ast.Tuple):
            return language.built(kind, [self.expression(one) for one in node.elts]), 9
        if isinstance(node, ast.Call):
            return self.call(node, kind), 9
        if isinstance(node, ast.BinOp):
            strength = STRENGTH[type(node.op)]
            left, right = self.expression(node.left, strength), self.expression(node.right, strength + 1)
            return f"{left} {NAMES[type(node.op)]} {right}", strength
        if isinstance(node, ast.UnaryOp):
            sign = {ast.USub: "-", ast.UAdd: "+", ast.Not: "!"}[type(node.op)]
            return sign + self.expression(node.operand, 8), 7
        if isinstance(node, ast.Compare):
            sides = [self.expression(one, 5) for one in (node.left, *node.comparators)]
            signs = [SIGNS[type(one)] for one in node.ops]
            pairs = [f"{left} {sign} {right}" for left, sign, right in zip(sides, signs, sides[1:], strict=False)]
            return " && ".join(pairs), 4 if len(pairs) == 1 else 3
        if isinstance(node, ast.BoolOp):
            word, strength = (" && ", 3) if isinstance(node.op, ast.And) else (" || ", 2)
            return word.join(self.expression(one, 4) for one in node.values), strength
        if isinstance(node, ast.IfExp):
            parts = [self.expression(one, 2) for one in (node.test, node.body, node.orelse)]
            return f"{parts[0]} ? {parts[1]} : {parts[2]}", 1
        raise TypeError(f"{ast.dump(node)} has passed the reading of types")  # pragma: no cover

    def subscript(self, node: ast.Subscript) -> str:
        kind, value = self.function.kinds[node.value], self.expression(node.value, 9)
        place = place_of(node)
        if place is None:
            return self.language.chosen(kind, value, self.expression(node.slice))
        return self.language.part(kind, value, place % len(kind.items))

    def call(self, node: ast.Call, kind: Kind) -> str:
        if node in self.function.calls:
            callee = self.function.calls[node]
            given = [self.expression(one) for one in arguments(node, list(callee.parameters))]
            if is_identity(callee):
                return self.expression(arguments(node, list(callee.parameters))[0], 9)
            return f"{self.language.function_name(callee.name)}({', '.join(given)})"
        name = node.func.id if isinstance(node.func, ast.Name) else ""
        if isinstance(kind, Tuple):
            return self.language.built(kind, [self.expression(one) for one in arguments(node, kind.fields)])
        return f"{self.language.primitive(name)}({', '.join(self.expression(one) for one in node.args)})"

    def value(self, value, kind: Kind) -> str:
        """A constant."""
        if isinstance(kind, Tuple):
            items = [self.value(one, item) for one, item in zip(value, kind.items, strict=True)]
            return self.language.built(kind, items)
        return number(value) if kind == REAL else str(value).lower()


def number(value: float) -> str:
    """A double as text that reads back as the same bits."""
    return repr(float(value))


def is_identity(function: Typed) -> bool:
    """Whether a function returns its one argument: a call of it is that argument."""
    [last] = function.node.body[-1:]
    value = last.value if isinstance(last, ast.Return) and len(function.node.body) == 1 else None
    return isinstance(value, ast.Name) and list(function.parameters) == [value.id]


def names_in(node: ast.AST) -> set[str]:
    """Every name in a tree."""
    return {one.id for one in ast.walk(node) if isinstance(one, ast.Name)}


def _is_inside(name: str, statement: ast.stmt, users: int) -> bool:
    """Whether a variable that one statement alone looks at lives within one of its branches."""
    return users == 1 and isinstance(statement, ast.If) and name not in names_in(statement.test)


def wrapped(lines: Iterable[str]) -> Iterator[str]:
    """Lines of code, those that are too long broken after commas in brackets."""
    for line in lines:
        indent, depth = " " * (len(line) - len(line.lstrip())), 0
        while len(line) > WIDTH and (breaks := list(_breaks(line, depth))):
            fitting = [one for one in breaks if one[0] <= WIDTH + 1] or breaks[:1]
            late = [one for one in fitting if one[0] > WIDTH // 2] or fitting
            outermost = min(at for _, at in late)
            place, depth = [one for one in late if one[1] == outermost][-1]
            yield line[:place].rstrip()
            line = f"{indent}{INDENT}{line[place:]}"
        yield line


def _breaks(line: str, depth: int) -> Iterator[tuple[int, int]]:
    """Places after commas in brackets, with how many brackets are open there; depth: at the beginning of the line."""
    for place, sign in enumerate(line, start=1):
        depth += (sign in "([{") - (sign in ")]}")
        if depth and line[place - 1 : place + 1] == ", ":
            yield place + 1, depth
