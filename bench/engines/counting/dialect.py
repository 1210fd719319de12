"""The law dialect checked in a file's text: violations(source) -> a line for each thing it may not contain.

Counting would meet most of these only on the branch that holds them; the text shows every branch.
"""

import ast
import importlib
from collections.abc import Iterator
from typing import TypeGuard

from bench.law.scalar import KERNELS, PRIMITIVES

FACE = "bench.law"
"""It holds what a law needs of the modules below: from it, but not from everything in its folder, any law imports."""

SOURCES = (
    *("bench.law.scalar", "bench.law.so3", "bench.law.linalg", "bench.law.weighting", "bench.law.display"),
    *("bench.law.kinds", "bench.law.inputs", "bench.law.euler"),
)
"""Modules of ours a law may import from; and NamedTuple from typing, to name its tuples."""

CONTROLLER_SOURCES = (
    *SOURCES,
    *("bench.law.chain", "bench.law.contender", "bench.law.control.hybrid", "bench.law.control.impedance"),
    *(
        "bench.law.control.resolved_acceleration",
        "bench.base.errors",
        "collections.abc",
        "bench.law.contenders.representations",
    ),
    *("bench.law.contenders.regulators", "bench.law.contenders.jacobians", "bench.law.contenders.inverses"),
    "bench.law.contenders.impedances",
)
"""What a controller in contact may import from: it is put together of laws, coordinates, Jacobians and inverses."""

OPERATORS = (ast.Add, ast.Sub, ast.Mult, ast.Div, ast.USub, ast.UAdd, ast.Not)
COMPARISONS = (ast.Lt, ast.LtE, ast.Gt, ast.GtE)
FORMS = (
    *(ast.FunctionDef, ast.arguments, ast.arg, ast.Return, ast.Assign, ast.AugAssign, ast.AnnAssign, ast.Pass),
    *(ast.If, ast.IfExp, ast.For, ast.Break, ast.Continue, ast.Expr, ast.Tuple, ast.Starred, ast.Name),
    *(ast.Attribute, ast.Subscript, ast.Slice, ast.Constant, ast.Call, ast.keyword, ast.BoolOp, ast.boolop),
    *(ast.BinOp, ast.UnaryOp, ast.Compare, ast.operator, ast.unaryop, ast.cmpop, ast.expr_context),
)
"""Everything a kernel may be written with; operators and calls are looked at more closely."""


def violations(source: str, modules: tuple[str, ...] = SOURCES) -> list[str]:
    """What a file contains that the dialect does not, in the order of its lines.

    Args:
        source: the text of a law or representation file. modules: those it may import from, or the packages of them.
    """
    tree = ast.parse(source)
    found = list(_imports(tree, modules))
    callables = {"range"} | _imported(tree, modules) | _defined(tree)
    for function in _kernels(tree):
        for node in _body(function):
            found += _outside(node, function, callables)
    return [f"line {line}: {what}" for line, what in sorted(set(found))]


def _imports(tree: ast.Module, modules: tuple[str, ...]) -> Iterator[tuple[int, str]]:
    for node in ast.walk(tree):
        if isinstance(node, ast.Import) or (
            isinstance(node, ast.ImportFrom) and not _is_among(node.module, (*modules, "typing"))
        ):
            yield node.lineno, f"`{ast.unparse(node)}`: a law file imports from {', '.join((FACE, *modules))} only"


def _is_among(module: str | None, modules: tuple[str, ...]) -> bool:
    return module is not None and (module in (FACE, *modules) or module.rpartition(".")[0] in modules)


def _imported(tree: ast.Module, modules: tuple[str, ...]) -> set[str]:
    """Names imported from our modules that a kernel may call: kernels, primitives and tuple types."""
    names = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and node.module is not None and _is_among(node.module, modules):
            module = importlib.import_module(node.module)
            for alias in node.names:
                value = getattr(module, alias.name, None)
                if isinstance(value, type) or value in (*KERNELS, *PRIMITIVES):
                    names.add(alias.asname or alias.name)
    return names


def _defined(tree: ast.Module) -> set[str]:
    """Names a kernel may call that the file itself makes.

    Its kernels, its tuple types, and what a plain function around a kernel is given or binds: law_in's functions of
    the representation, whose own file is checked.
    """
    names = {node.name for node in ast.walk(tree) if isinstance(node, ast.ClassDef) or _is_kernel(node)}
    for maker in ast.walk(tree):
        if isinstance(maker, ast.FunctionDef) and not _is_kernel(maker):
            names |= {argument.arg for argument in maker.args.args}
            for statement in maker.body:
                if isinstance(statement, ast.Assign):
                    targets = [part for target in statement.targets for part in ast.walk(target)]
                    names |= {part.id for part in targets if isinstance(part, ast.Name)}
    return names


def _is_kernel(node: ast.AST) -> TypeGuard[ast.FunctionDef]:
    return isinstance(node, ast.FunctionDef) and any(
        isinstance(mark, ast.Name) and mark.id == "kernel" for mark in node.decorator_list
    )


def _kernels(tree: ast.Module) -> list[ast.FunctionDef]:
    return [node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef) and _is_kernel(node)]


def _body(function: ast.FunctionDef) -> Iterator[ast.AST]:
    statements = function.body[1:] if ast.get_docstring(function) is not None else function.body
    for statement in statements:
        yield from ast.walk(statement)


def _outside(node: ast.AST, function: ast.FunctionDef, callables: set[str]) -> Iterator[tuple[int, str]]:
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
    elif isinstance(node, ast.Call) and not (isinstance(node.func, ast.Name) and node.func.id in callables):
        yield line, f"`{_shown(node)}`: call functions of {', '.join(SOURCES[:3])} or marked @kernel only"


def _is_range(node: ast.expr) -> bool:
    return isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "range"


def _shown(node: ast.AST) -> str:
    return ast.unparse(node).splitlines()[0]
