"""Writer of typed functions for languages with braces, statement by statement.

A variable is declared where it is assigned first, or before the branches that assign it. A tuple assigned to several
names is taken apart; where a part needs a name that an earlier part changes, its old value is kept first.
"""

import ast
import re
from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

from bench.translation.dialect import ARITHMETIC, COMPARISONS, SIGNS, WHOLE
from bench.translation.inference import Typed
from bench.translation.kinds import INTEGER, REAL, Array, External, Kind, Known, Pointer, Tuple, is_static
from bench.translation.layout import INDENT, wrapped
from bench.translation.loop_syntax import LoopSyntax
from bench.translation.trees import count_assignments, names_in, place_of

STRENGTH = {ast.Mult: 6, ast.Div: 6, ast.Add: 5, ast.Sub: 5}
BITS = {ast.BitAnd: " & ", ast.BitOr: " | "}
"""How an operator binds: a call 9, a sign 7, a comparison 4, `and` 3, `or` 2, a choice 1, in every such language."""


class Braces(NamedTuple):
    """A language with braces, by the functions that write its parts.

    reserved: its words. declaration(kind, name, is_changed): `double x`, of a variable that is assigned again or not.
    built(kind, items): a tuple. part(kind, value, place): an item of a tuple; place: a number, or a variable where all
    items are numbers. head(function): all that is before the opening brace. function_name(name): that of a function of
    the program. primitive(name): that of sqrt, sin and so on. The others are templates: a condition, a choice, a loop,
    the last statement of a function, and what marks a parameter that is not read. loops: what only loops need.
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
    loops: LoopSyntax | None = None

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
        self.loops: Any = language.loops  # where a function of a loop is written, it is there
        self.spare = 0

    def lines(self) -> Iterator[str]:
        """Write the statements, and before each of them the declarations of the variables that begin there."""
        undeclared = self.undeclared()
        for statement in self.function.node.body:
            due = undeclared & names_in(statement)
            undeclared -= due
            if not isinstance(statement, ast.Assign):
                yield from (f"{INDENT}{self.declared(name)};" for name in sorted(due))
            yield from self.statement(statement, due, INDENT, statement is self.function.node.body[-1])

    def undeclared(self) -> set[str]:
        """Return the variables to declare; those of loops that count are declared there."""
        counters = {
            node.target.id
            for node in ast.walk(self.function.node)
            if isinstance(node, ast.For) and isinstance(node.target, ast.Name)
        }
        kinds = self.function.variables
        return {name for name in kinds if name not in counters and not is_static(kinds[name]) and self.is_read(name)}

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
        elif isinstance(node, ast.Return):
            yield from self.result(node, indent, is_last)
        elif isinstance(node, ast.If) and node.test in self.function.decided:
            for branch in self.function.taken(node):
                for inner in branch:
                    yield from self.statement(inner, set(), indent, is_last and inner is branch[-1])
        elif isinstance(node, ast.If):
            yield from self.branches(node, indent, is_last)
        elif isinstance(node, ast.For):
            yield from self.loop(node, indent)
        elif isinstance(node, ast.While):
            yield indent + self.loops.repeat.format(self.expression(node.test))
            yield from self.block(node.body, indent)
            yield f"{indent}}}"
        elif isinstance(node, ast.Expr):
            yield f"{indent}{self.expression(node.value)};"
        elif isinstance(node, ast.Try) and node in self.function.caught:
            yield from self.guarded(node, indent)
        elif isinstance(node, ast.Try):  # nothing raises in it
            for inner in node.body:
                yield from self.statement(inner, set(), indent, is_last)
        elif isinstance(node, ast.Raise):
            yield f"{indent}{self.loops.error};"
        elif isinstance(node, ast.Break | ast.Continue):
            yield f"{indent}{type(node).__name__.lower()};"

    def guarded(self, node: ast.Try, indent: str) -> Iterator[str]:
        """Write what an error in the body ends, and what is then done."""
        self.spare += 1
        begin, end, otherwise, after = (text.format(self.spare) for text in self.loops.guard)
        yield f"{indent}{begin}"
        yield from self.block(node.body, indent)
        yield f"{indent}{INDENT}{end}"
        yield f"{indent}{otherwise}"
        yield from self.block(node.handlers[0].body, indent)
        yield f"{indent}{after}"

    def result(self, node: ast.Return, indent: str, is_last: bool) -> Iterator[str]:
        if node.value is not None and not is_static(self.function.returns):
            yield indent + (self.language.last if is_last else "return {};").format(self.expression(node.value))
            return
        if isinstance(node.value, ast.Call):
            yield f"{indent}{self.expression(node.value)};"
        if not is_last:
            yield f"{indent}return;"

    def branches(self, node: ast.If, indent: str, is_last: bool) -> Iterator[str]:
        condition = self.language.condition
        yield f"{indent}if {condition.format(self.expression(node.test))} {{"
        yield from self.block(node.body, indent, is_last)
        while len(node.orelse) == 1 and isinstance(node.orelse[0], ast.If):
            if node.orelse[0].test in self.function.decided:
                break
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
        declared = self.language.declaration(INTEGER, name, True)
        if self.language.loops and not re.fullmatch(r"\w+", last):
            self.spare += 1
            yield f"{indent}{self.language.declaration(INTEGER, f'last_{self.spare}', False)} = {last};"
            last = f"last_{self.spare}"
        yield f"{indent}{self.language.loop.format(declared=declared, name=name, first=first, last=last)} {{"
        yield from self.block(node.body, indent)
        yield f"{indent}}}"

    def assigned(self, target: ast.expr, value: ast.expr, fresh: set[str]) -> Iterator[str]:
        """Write the assignments of one target; fresh: the names that are declared by it."""
        parts: list[list] = []
        yield from self.taken_apart(target, value, parts)
        for at, part in enumerate(parts):
            name, text, used, kind = part
            if used & {earlier for earlier, *_ in parts[:at]} or (
                used and any(not earlier.isidentifier() for earlier, *_ in parts[:at])
            ):  # an element that is stored before may be what this value reads
                part[1] = f"before_{self.spare}"
                yield self.temporary(kind, part[1], text)
        for name, text, *_ in parts:
            yield f"{self.declared(name) if name in fresh else self.place(name)} = {text}"

    def place(self, name: str) -> str:
        """Return a variable, or an element of an array as it is."""
        return self.language.variable(name) if name.isidentifier() else name

    def taken_apart(
        self, target: ast.expr, value: ast.expr | str, parts: list[list], kind: Any = None
    ) -> Iterator[str]:
        """Collect name, text, names in it and kind of every part of a target; write what is kept before."""
        kind = self.function.kinds[value] if isinstance(value, ast.expr) else kind
        if isinstance(target, ast.Tuple) and isinstance(value, ast.Tuple):
            for one, item in zip(target.elts, value.elts, strict=True):
                yield from self.taken_apart(one, item, parts)
        elif is_static(kind):
            if isinstance(value, ast.Call) and (text := self.expression(value)):
                yield text
        elif isinstance(target, ast.Tuple):
            source = self.expression(value, 9) if isinstance(value, ast.expr) else value
            if isinstance(value, ast.expr) and not isinstance(value, ast.Name | ast.Attribute):
                call, source = source, f"parts_{self.spare}"
                yield self.temporary(kind, source, call)
            for place, one in enumerate(target.elts):
                part = self.language.part(kind, source, place)
                yield from self.taken_apart(one, part, parts, kind.items[place])
        elif isinstance(target, ast.Subscript) or (isinstance(target, ast.Name) and self.is_read(target.id)):
            name = target.id if isinstance(target, ast.Name) else self.expression(target)
            known = (self.expression(value), names_in(value)) if isinstance(value, ast.expr) else (value, set())
            parts.append([name, *known, kind])

    def temporary(self, kind: Kind, name: str, value: str) -> str:
        self.spare += 1
        return f"{self.language.declaration(kind, name, False)} = {value}"

    def is_read(self, name: str) -> bool:
        return name in self.function.read

    def expression(self, node: ast.expr, outside: int = 0) -> str:
        """Write an expression, in parentheses if it binds less than what is outside."""
        text, strength = self.bound(node)
        return f"({text})" if strength < outside else text

    def bound(self, node: ast.expr) -> tuple[str, int]:
        """Return the text of an expression and how strongly it binds."""
        node = self.function.rewritten.get(node, node)
        kinds, language = self.function.kinds, self.language
        kind = kinds[node]
        if kind == INTEGER and (place := place_of(node)) is not None:
            return str(place), 9 if place >= 0 else 7
        if is_static(kind) and not isinstance(node, ast.Call):
            return "", 9
        if node in self.function.decided:
            return self.value(self.function.decided[node], kind), 9
        match node:
            case ast.Constant():
                return self.value(node.value, kind), 9
            case ast.Name() if node.id in self.function.names and node.id not in self.function.variables:
                return self.constant(self.function.names[node.id], kind)
            case ast.Name():
                return language.variable(node.id), 9
            case ast.Attribute() if isinstance(of := kinds[node.value], Known):
                return self.constant(getattr(of.value, node.attr), kind)
            case ast.Attribute() if isinstance(kinds[node.value], Array):
                array = self.expression(node.value, 9)
                return (self.loops.address.format(array) if node.attr == "data" else array), 9
            case ast.Attribute():
                of = kinds[node.value]
                return language.part(of, self.expression(node.value, 9), of.fields.index(node.attr)), 9
            case ast.Subscript():
                return self.item(node), 9
            case ast.Tuple():
                return language.built(kind, self.expressions(node.elts)), 9
            case ast.Call():
                return self.call(node, kind)
            case ast.BinOp():
                return self.operation(node)
            case ast.UnaryOp():
                sign = "!" if isinstance(node.op, ast.Not) else SIGNS[type(node.op)]
                return sign + self.expression(node.operand, 8), 7
            case ast.Compare():
                sides = [self.expression(one, 5) for one in (node.left, *node.comparators)]
                signs = [COMPARISONS[type(one)] for one in node.ops]
                pairs = [f"{left} {sign} {right}" for left, sign, right in zip(sides, signs, sides[1:], strict=False)]
                return " && ".join(pairs), 4 if len(pairs) == 1 else 3
            case ast.BoolOp():
                return self.logic(node)
            case ast.IfExp() if node.test in self.function.decided:
                return self.bound(node.body if self.function.decided[node.test] else node.orelse)
            case ast.IfExp():
                parts = [self.expression(one, 2) for one in (node.test, node.body, node.orelse)]
                return language.choice.format(*parts), 1
        raise TypeError(f"{ast.dump(node)} has passed the type inference")  # pragma: no cover

    def expressions(self, nodes: list[ast.expr]) -> list[str]:
        """Write expressions of which something is there when the code runs."""
        return [self.expression(node) for node in nodes if not is_static(self.function.kinds[node])]

    def constant(self, value: Any, kind: Kind) -> tuple[str, int]:
        """Write a constant, and how strongly it binds."""
        text = "" if is_static(kind) else self.value(value, kind)
        return text, 7 if text.startswith("-") else 9

    def item(self, node: ast.Subscript) -> str:
        """Write an item of a tuple, an element or a part of an array, or its size along an index."""
        of = self.function.kinds[node.value]
        if isinstance(of, Array):
            return self.part_of_array(of, node)
        place = place_of(node.slice)
        at = self.expression(node.slice) if place is None else place % len(of.items)
        if isinstance(node.value, ast.Attribute) and isinstance(self.function.kinds[node.value.value], Array):
            return self.loops.size(self.expression(node.value.value, 9), at)
        return self.language.part(of, self.expression(node.value, 9), at)

    def part_of_array(self, of: Array, node: ast.Subscript) -> str:
        array = self.expression(node.value, 9)
        indices = node.slice.elts if isinstance(node.slice, ast.Tuple) else [node.slice]
        texts = [self.expression(one) for one in indices if not isinstance(one, ast.Slice)]
        if not isinstance(self.function.kinds[node], Array):
            return self.loops.element(of, array, texts)
        bounds = [(one.lower, one.upper) for one in indices if isinstance(one, ast.Slice)]
        lower, upper = bounds[0] if bounds else (None, None)
        first = self.expression(lower) if lower else "0"
        last = self.expression(upper) if upper else self.loops.size(array, len(texts))
        return self.loops.view(of, array, texts, first, last)

    def operation(self, node: ast.BinOp) -> tuple[str, int]:
        operator, kinds = type(node.op), self.function.kinds
        if operator in BITS:
            return f"{self.expression(node.left, 9)}{BITS[operator]}{self.expression(node.right, 9)}", 1
        if operator in WHOLE:
            sides = self.expression(node.left), self.expression(node.right)
            return self.loops.operations[operator].format(*sides), 9
        if operator is ast.Div and REAL not in (kinds[node.left], kinds[node.right]):
            sides = self.expression(node.left), self.expression(node.right)
            return self.loops.operations[operator].format(*sides), 9
        strength = STRENGTH[operator]
        left, right = self.expression(node.left, strength), self.expression(node.right, strength + 1)
        return f"{left} {ARITHMETIC[operator]} {right}", strength

    def logic(self, node: ast.BoolOp) -> tuple[str, int]:
        """Write `and` and `or` without values that are known and change nothing."""
        word, strength = (" && ", 3) if isinstance(node.op, ast.And) else (" || ", 2)
        decides, decided = isinstance(node.op, ast.Or), self.function.decided
        texts = []
        for value in node.values:
            if decided.get(value) is not (not decides):
                texts.append(self.expression(value, 4))
            if decided.get(value) is decides:
                break
        return word.join(texts), strength

    def call(self, node: ast.Call, kind: Kind) -> tuple[str, int]:
        if callee := self.function.calls.get(node):
            if callee.identity:
                place = list(callee.parameters).index(callee.identity)
                return self.bound(node.args[place])
            return f"{self.language.function_name(callee.name)}({', '.join(self.expressions(node.args))})", 9
        value = self.function.callee(node.func)
        if isinstance(value, Pointer):
            texts = self.expressions(node.args)
            return self.loops.by_pointer(value, self.expression(node.func), texts), 9
        if isinstance(value, External):
            return self.loops.external(value, self.expressions(node.args)), 9
        if isinstance(kind, Tuple):
            return self.language.built(kind, self.expressions(node.args)), 9
        texts = self.expressions(node.args)
        if isinstance(value, type) or value in (min, max, abs, len):
            return self.builtin(node, value, kind, texts), 9
        return f"{self.language.primitive(value.__name__)}({', '.join(texts)})", 9

    def builtin(self, node: ast.Call, value: Any, kind: Kind, texts: list[str]) -> str:
        """Write a built-in function; the length of a tuple, and a number in a text, are known."""
        (of, *_) = (self.function.kinds[one] for one in node.args)
        if isinstance(of, Known):
            return self.value(float(of.value), kind)
        if value is len:
            return self.loops.size(texts[0], 0) if isinstance(of, Array) else str(len(of.items))
        return self.loops.builtin(value.__name__, kind, texts)

    def value(self, value: Any, kind: Kind) -> str:
        """Write a constant; numbers read back as the same bits."""
        if isinstance(kind, Tuple):
            pairs = zip(value, kind.items, strict=True)
            return self.language.built(kind, [self.value(*pair) for pair in pairs if not is_static(pair[1])])
        if self.language.loops:
            return self.loops.constant(value, kind)
        return repr(float(value)) if kind == REAL else str(value).lower()
