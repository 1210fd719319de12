"""A typed function as Python for arrays: branches become masks, as `bench.export.lanes` has them.

`if` becomes two functions, `_then` and `_else`, which take what they change as default arguments and return what is
looked at afterwards; where one of them returns from the law, all that follows belongs to the other. Divisors, and
arguments of roots and arcs, are made safe for lanes that are not there.
"""

import ast

from bench.errors import BadLaw
from bench.export.braces import is_identity, names_in
from bench.export.flow import needed, only_hands_back, returns, stored
from bench.export.types import INDEX, Typed, arguments
from bench.law.scalar import PRIMITIVES

LANES, THEN, ELSE = "lanes", "_then", "_else"
PRIMITIVE_NAMES = {one.__name__ for one in PRIMITIVES}


def function_name(function: Typed) -> str:
    """Of a function of the program: private, for what a file offers has the plain names."""
    return f"_{function.name}"


def masked(function: Typed, taken: set[str], tuples: dict[str, str]) -> ast.FunctionDef:
    """The function on lanes, which are its first argument.

    Args:
        taken: names that no variable may have. tuples: by name of a NamedTuple, its name in the file.
    Errors:
        BadLaw: a loop is left early, a variable is set on one side of a branch alone, or a path returns nothing.
    """
    body = _Body(function, taken, tuples)
    statements = body.block(function.node.body, set(function.parameters), set())
    return _function(function_name(function), [body.variable(one) for one in function.parameters], [], statements)


class _Body:
    """One function while it is written."""

    def __init__(self, function: Typed, taken: set[str], tuples: dict[str, str]):
        self.function, self.taken, self.tuples = function, taken, tuples

    def variable(self, name: str) -> str:
        return f"{name}_" if name in self.taken else name

    def block(self, statements: list[ast.stmt], bound: set[str], after: set[str]) -> list[ast.stmt]:
        """The statements on lanes; bound: variables that exist before, after: those that are looked at behind them."""
        done: list[ast.stmt] = []
        for place, one in enumerate(statements):
            rest = statements[place + 1 :]
            if isinstance(one, ast.Return) and one.value is not None:
                return [*done, ast.Return(self.of(one.value))]
            if isinstance(one, ast.If) and (returns(one) or only_hands_back(rest)):
                return [*done, *self.sides(one, rest, bound, None)]
            if isinstance(one, ast.If):
                wanted = [name for name in stored(one) if name in needed(rest, after)]
                done += self.sides(one, [], bound, wanted) if wanted else []
                bound = bound | set(wanted)
            else:
                done.append(self.statement(one, bound, after | needed(rest, after)))
                bound = bound | set(stored(one))
        return done

    def sides(self, node: ast.If, rest: list[ast.stmt], bound: set[str], wanted: list[str] | None) -> list[ast.stmt]:
        """Both sides as functions, and what is made of their results: variables, or if there are none to return it."""
        answer: list[ast.stmt] = []
        if wanted is not None:
            named: list[ast.expr] = [ast.Name(name, ast.Load()) for name in wanted]
            answer = [ast.Return(named[0] if len(named) == 1 else ast.Tuple(named))]
        done: list[ast.stmt] = []
        passed: list[ast.expr] = [self.of(node.test)]
        for name, body in ((THEN, node.body), (ELSE, node.orelse)):
            statements = [*body, *rest, *answer]
            lost = needed(statements, set()) & set(self.function.variables) - bound
            if lost:
                raise BadLaw(
                    f"{self.function.name}: {', '.join(sorted(lost))}: set on one side alone of "
                    f"`if {ast.unparse(node.test)}`; set it on both, or before"
                )
            changed = set(stored(*statements)) & needed(statements, set())
            written = self.block(statements, bound, set())
            if not written or not isinstance(written[-1], ast.Return):
                raise BadLaw(
                    f"{self.function.name}: `if {ast.unparse(node.test)}`: one side returns nothing; end it so"
                )
            if isinstance(written[0], ast.Return) and written[0].value is not None:
                passed.append(_lambda(written[0].value))
            else:
                done.append(_function(name, [], [self.variable(one) for one in sorted(changed)], written))
                passed.append(ast.Name(name))
        merged = _on_lanes("either", passed)
        if wanted is None:
            return [*done, ast.Return(merged)]
        targets: list[ast.expr] = [ast.Name(self.variable(name)) for name in wanted]
        return [*done, ast.Assign([targets[0] if len(targets) == 1 else ast.Tuple(targets)], merged)]

    def statement(self, node: ast.stmt, bound: set[str], after: set[str]) -> ast.stmt:
        if isinstance(node, ast.Assign):
            return ast.Assign([self.of(one) for one in node.targets], self.of(node.value))
        if isinstance(node, ast.AugAssign):  # never in place: an argument may be looked at again
            return ast.Assign([self.of(node.target)], self.quotient(node.target, node.op, node.value))
        if isinstance(node, ast.For) and isinstance(node.iter, ast.Call):
            return self.loop(node, node.iter, bound, after)
        if isinstance(node, ast.Pass):
            return node
        raise self.refused(node)

    def loop(self, node: ast.For, times: ast.Call, bound: set[str], after: set[str]) -> ast.stmt:
        left = [one for one in ast.walk(node) if isinstance(one, ast.Return | ast.Break | ast.Continue)]
        if left:
            raise self.refused(left[0])
        looked_at = after | needed(node.body, set())
        body = self.block(node.body, bound | set(stored(node)), looked_at)
        iterated = ast.Call(times.func, [self.index(one) for one in times.args], [])
        return ast.For(self.of(node.target), iterated, body or [ast.Pass()], [])

    def refused(self, node: ast.AST) -> BadLaw:
        return BadLaw(
            f"{self.function.name}: `{ast.unparse(node)}` within a loop cannot be translated to arrays, whose lanes "
            "all go round as often (allowed: a loop to its end, with branches that set variables)"
        )

    def of(self, node: ast.expr) -> ast.expr:
        """An expression on lanes; the tree that is given stays as it is."""
        kind = self.function.kinds.get(node)
        if isinstance(node, ast.Constant):
            return node if kind == INDEX else self.value(node.value)
        if isinstance(node, ast.Name):
            return self.name(node.id)
        if isinstance(node, ast.Attribute):
            return ast.Attribute(self.of(node.value), node.attr)
        if isinstance(node, ast.Subscript):
            return ast.Subscript(self.of(node.value), self.index(node.slice))
        if isinstance(node, ast.Tuple):
            return ast.Tuple([self.of(one) for one in node.elts])
        if isinstance(node, ast.Call):
            return self.call(node)
        if isinstance(node, ast.BinOp):
            return self.quotient(node.left, node.op, node.right)
        if isinstance(node, ast.UnaryOp):
            if isinstance(node.op, ast.Not):
                return _either(self.of(node.operand), ast.Constant(False), ast.Constant(True))
            return ast.UnaryOp(node.op, self.of(node.operand))
        if isinstance(node, ast.Compare):
            sides = [self.of(one) for one in (node.left, *node.comparators)]
            pairs = zip(sides, node.ops, sides[1:], strict=False)
            return _all([ast.Compare(left, [sign], [right]) for left, sign, right in pairs])
        if isinstance(node, ast.BoolOp):
            return self.connected(node.op, [self.of(one) for one in node.values])
        if isinstance(node, ast.IfExp):
            return _either(self.of(node.test), self.of(node.body), self.of(node.orelse))
        raise TypeError(f"{ast.dump(node)} has passed the reading of types")  # pragma: no cover

    def name(self, name: str) -> ast.expr:
        if name in self.function.values and name not in self.function.variables:
            return self.value(self.function.values[name])
        return ast.Name(self.variable(name))

    def value(self, value) -> ast.expr:
        """A constant of a file or of the closure."""
        if isinstance(value, tuple):
            items = [self.value(one) for one in value]
            return (
                ast.Call(ast.Name(self.tuples[type(value).__name__]), items, [])
                if hasattr(value, "_fields")
                else (ast.Tuple(items))
            )
        return ast.Constant(value if isinstance(value, bool) else float(value))

    def index(self, node: ast.expr) -> ast.expr:
        """A place: whole numbers and variables of loops."""
        if isinstance(node, ast.BinOp):
            return ast.BinOp(self.index(node.left), node.op, self.index(node.right))
        return ast.Name(self.variable(node.id)) if isinstance(node, ast.Name) else node

    def quotient(self, left: ast.expr, op: ast.operator, right: ast.expr) -> ast.expr:
        """Two numbers and what is between them; divisors that may be 0 are made safe."""
        by = self.of(right)
        if isinstance(op, ast.Div) and not (isinstance(by, ast.Constant) and by.value):
            by = _on_lanes("safe", [by])
        return ast.BinOp(self.of(left), op, by)

    def connected(self, op: ast.boolop, values: list[ast.expr]) -> ast.expr:
        """`and`, `or`: what may be outside its domain is asked only where it counts."""
        first, *others = values
        for one in others:
            is_and = isinstance(op, ast.And)
            if LANES not in names_in(one):
                first = ast.BinOp(first, ast.BitAnd() if is_and else ast.BitOr(), one)
            else:
                first = _either(first, *((one, ast.Constant(False)) if is_and else (ast.Constant(True), one)))
        return first

    def call(self, node: ast.Call) -> ast.expr:
        if node in self.function.calls:
            callee = self.function.calls[node]
            given = [self.of(one) for one in arguments(node, list(callee.parameters))]
            if is_identity(callee):
                return given[0]
            return ast.Call(ast.Name(function_name(callee)), [ast.Name(LANES), *given], [])
        name = node.func.id if isinstance(node.func, ast.Name) else ""
        if name in PRIMITIVE_NAMES and name not in self.tuples:
            return _on_lanes(name, [self.of(one) for one in node.args])
        kind = self.function.kinds[node]
        return ast.Call(ast.Name(self.tuples[kind.name]), [self.of(one) for one in arguments(node, kind.fields)], [])


def _on_lanes(name: str, given: list[ast.expr]) -> ast.Call:
    return ast.Call(ast.Attribute(ast.Name(LANES), name), given, [])


def _either(test: ast.expr, then: ast.expr, otherwise: ast.expr) -> ast.Call:
    return _on_lanes("either", [test, _lambda(then), _lambda(otherwise)])


def _lambda(value: ast.expr) -> ast.Lambda:
    return ast.Lambda(_parameters([LANES], []), value)


def _function(name: str, parameters: list[str], changed: list[str], body: list[ast.stmt]) -> ast.FunctionDef:
    return ast.FunctionDef(name, _parameters([LANES, *parameters], changed), body, [])


def _parameters(plain: list[str], changed: list[str]) -> ast.arguments:
    """Those that are changed begin as what they are where the function is made."""
    named = [ast.arg(one) for one in (*plain, *changed)]
    return ast.arguments([], named, None, [], [], None, [ast.Name(one) for one in changed])


def _all(tests: list[ast.expr]) -> ast.expr:
    first, *others = tests
    for one in others:
        first = ast.BinOp(first, ast.BitAnd(), one)
    return first
