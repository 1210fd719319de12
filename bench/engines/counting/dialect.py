"""The law dialect checked in a file's text: violations(source) -> a line for each thing it may not contain.

Counting would meet most of these only on the branch that holds them; the text shows every branch.
"""

import ast
import builtins
from collections.abc import Iterator
from typing import TypeGuard

OTHERS = ("typing", "collections.abc", "bench.base.errors")
"""Modules outside bench.law that a law's file may import from: to name its tuples, and to refuse."""

CALLS = set(dir(builtins)) - {"range"}
"""Functions that no kernel may call; one that is no kernel, the compiler refuses."""

OPERATORS = (ast.Add, ast.Sub, ast.Mult, ast.Div, ast.USub, ast.UAdd, ast.Not)
COMPARISONS = (ast.Lt, ast.LtE, ast.Gt, ast.GtE)
FORMS = (
    *(ast.FunctionDef, ast.arguments, ast.arg, ast.Return, ast.Assign, ast.AugAssign, ast.AnnAssign, ast.Pass),
    *(ast.If, ast.IfExp, ast.For, ast.Break, ast.Continue, ast.Expr, ast.Tuple, ast.Starred, ast.Name),
    *(ast.Attribute, ast.Subscript, ast.Slice, ast.Constant, ast.Call, ast.keyword, ast.BoolOp, ast.boolop),
    *(ast.BinOp, ast.UnaryOp, ast.Compare, ast.operator, ast.unaryop, ast.cmpop, ast.expr_context),
)
"""Everything a kernel may be written with; operators and calls are looked at more closely."""


def violations(source: str) -> list[str]:
    """Return what a file contains that the dialect does not, in the order of its lines.

    Args:
        source: the text of a law or representation file.
    """
    tree = ast.parse(source)
    found = list(_imports(tree))
    for function in filter(_is_kernel, ast.walk(tree)):
        for node in _body(function):
            found += _outside(node, function)
    return [f"line {line}: {what}" for line, what in sorted(set(found))]


def _imports(tree: ast.Module) -> Iterator[tuple[int, str]]:
    for node in ast.walk(tree):
        module = (node.module or "") if isinstance(node, ast.ImportFrom) else ""
        is_law = module == "bench.law" or module.startswith("bench.law.")
        if isinstance(node, ast.Import | ast.ImportFrom) and not is_law and module not in OTHERS:
            yield node.lineno, f"`{ast.unparse(node)}`: a law file imports from bench.law alone"


def _is_kernel(node: ast.AST) -> TypeGuard[ast.FunctionDef]:
    return isinstance(node, ast.FunctionDef) and any(
        isinstance(mark, ast.Name) and mark.id == "kernel" for mark in node.decorator_list
    )


def _body(function: ast.FunctionDef) -> Iterator[ast.AST]:
    statements = function.body[1:] if ast.get_docstring(function) is not None else function.body
    for statement in statements:
        yield from ast.walk(statement)


def _outside(node: ast.AST, function: ast.FunctionDef) -> Iterator[tuple[int, str]]:
    line = getattr(node, "lineno", function.lineno)
    if not isinstance(node, FORMS) or isinstance(node, ast.FunctionDef):
        yield line, f"`{_shown(node)}`: not in the law dialect"
    elif isinstance(node, ast.BinOp | ast.AugAssign | ast.UnaryOp) and not isinstance(node.op, OPERATORS):
        yield line, f"`{_shown(node)}`: the dialect has + - * / only"
    elif isinstance(node, ast.Compare) and not all(isinstance(sign, COMPARISONS) for sign in node.ops):
        yield line, f"`{_shown(node)}`: the dialect compares by < <= > >= only"
    elif isinstance(node, ast.Constant) and isinstance(node.value, str | bytes | complex):
        yield line, f"`{_shown(node)}`: numbers only"
    elif isinstance(node, ast.For) and not _is_range(node.iter):
        yield line, f"`{_shown(node)}`: the dialect loops over a fixed range only"
    elif isinstance(node, ast.Call) and (not isinstance(node.func, ast.Name) or node.func.id in CALLS):
        yield line, f"`{_shown(node)}`: call functions of bench.law or marked @kernel only"


def _is_range(node: ast.expr) -> bool:
    return isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "range"


def _shown(node: ast.AST) -> str:
    return ast.unparse(node).splitlines()[0]
