"""Whether a law's source is of the law dialect, so that a trace with symbols stands for a run with numbers.

A trace follows arithmetic, comparisons and the functions of `bench.law.scalar`. What else a source may do, it may do
otherwise with symbols than with numbers: look at a type, catch an exception, count its calls, read a list that changes.
So the functions that a law calls are read, and what is not of the dialect is refused, with its line.
"""

import ast
import importlib
import inspect
import math
import textwrap
import types
from collections.abc import Iterator
from typing import Any

import numpy as np

from bench.findings.proofs.reasons import Untraceable
from bench.law.inputs import LIMITS, Gains, Goal
from bench.law.kinds import Law
from bench.law.scalar import PRIMITIVES, kernel
from bench.law.so3 import Rotation

BUILTINS = (abs, min, max, range, len, tuple, sum, float, zip, enumerate)
RECORDS = (Rotation, Gains, Goal)
NUMBERS = (int, float, bool, np.float64)
FIELDS = {"n", "o", "a", "R", "kp", "kv", "omega", "alpha"}
"""Attributes: of a rotation, a goal and the gains."""

ALLOWED = (
    *(ast.FunctionDef, ast.arguments, ast.arg, ast.Return, ast.Assign, ast.AugAssign, ast.AnnAssign, ast.If, ast.For),
    *(ast.Expr, ast.Pass, ast.Break, ast.Continue, ast.Name, ast.Load, ast.Store, ast.Constant, ast.Tuple, ast.Starred),
    *(ast.Subscript, ast.Slice, ast.Attribute, ast.Call, ast.keyword, ast.IfExp),
    *(ast.BinOp, ast.Add, ast.Sub, ast.Mult, ast.Div, ast.Pow, ast.UnaryOp, ast.UAdd, ast.USub, ast.Not),
    *(ast.BoolOp, ast.And, ast.Or, ast.Compare, ast.Lt, ast.LtE, ast.Gt, ast.GtE, ast.Eq, ast.NotEq),
)
"""Parts of a function's source that the dialect has."""

LAW = ("so3", "scalar", "side", "inputs", "kinds", "display", "linalg")
MODULES = ("bench.law", *(f"bench.law.{name}" for name in LAW), "math", "__future__")
REGULATORS = "bench.law.contenders.regulators."
"""What a law's file may import names from, if it is to be proved.

numpy has the system among its modules, and typing evaluates texts.
"""
FORBIDDEN = frozenset(
    (
        "exec", "eval", "compile", "open", "input",
        "setattr", "getattr", "delattr", "globals",
        "locals", "vars", "__import__", "breakpoint", "random",
    )
)
STATEMENTS = (ast.Global, ast.Nonlocal, ast.Delete, ast.ClassDef, ast.AsyncFunctionDef, ast.Try, ast.With)
"""Statements that no file needs whose law is to be proved."""
RISKY = frozenset(("random", "load", "fromfile", "memmap", "seterr", "modules", "settrace", "setprofile", "contenders"))
"""Attributes by which a file could make its constants by chance, or reach the prover."""


def check(law: Law) -> None:
    """Read the functions that a law calls. A user's whole file is read by `check_file`, before it runs.

    Errors:
        Untraceable: a part of it is not of the dialect.
    """
    checked: set[int] = set()
    waiting: list[Any] = [law.law]
    while waiting:
        function = waiting.pop()
        if id(function) not in checked:
            checked.add(id(function))
            waiting += _check_function(function)


def _check_function(function: Any) -> list[Any]:
    """Check one function; return the functions that it calls."""
    if not isinstance(function, types.FunctionType):
        raise Untraceable(f"it calls {function!r}, which is no function of the law dialect")
    tree = _read(function)
    where = f"in {function.__name__}"
    for node in ast.walk(tree):
        if not isinstance(node, ALLOWED):
            raise _refusal(node, where, f"{type(node).__name__} is not of the law dialect")
        if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store) and node.id.startswith("__"):
            raise _refusal(node, where, f"it sets {node.id}")
        if isinstance(node, ast.Attribute | ast.Subscript) and not isinstance(node.ctx, ast.Load):
            raise _refusal(node, where, "it changes what it was given, or what lasts from call to call")
    functions = []
    by_place, by_keyword = function.__defaults__ or (), function.__kwdefaults__ or {}
    for default in (*by_place, *by_keyword.values()):
        functions += _check_value(default, where)
    return functions + list(_check_names(function, tree, where))


def _read(function: types.FunctionType) -> ast.FunctionDef:
    """Return the source of a function, by its code: so what is read is what runs."""
    code = function.__code__
    try:
        tree = ast.parse(textwrap.dedent(inspect.getsource(code)))
    except (OSError, SyntaxError, TypeError) as error:
        raise Untraceable(f"the source of its function {function.__name__} cannot be read ({error})") from error
    definition = tree.body[0]
    if not isinstance(definition, ast.FunctionDef) or len(tree.body) != 1 or definition.name != code.co_name:
        raise Untraceable(f"its function {function.__name__} is not written as def {code.co_name}(...)")
    definition.decorator_list = []  # what they made of it is the function that is given
    definition.returns = None
    definition.args.defaults = []  # what they are is checked by their values
    definition.args.kw_defaults = [None] * len(definition.args.kwonlyargs)
    for argument in ast.walk(definition.args):
        if isinstance(argument, ast.arg):
            argument.annotation = None
    return definition


def _check_names(function: types.FunctionType, tree: ast.FunctionDef, where: str) -> Iterator[Any]:
    """Check what names of the outside stand for; yield the functions among them."""
    local = {argument.arg for argument in ast.walk(tree.args) if isinstance(argument, ast.arg)}
    local |= {node.id for node in ast.walk(tree) if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store)}
    outside = inspect.getclosurevars(function)
    known = {**outside.builtins, **outside.globals, **outside.nonlocals}
    modules = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Attribute):
            name = node.value.id if isinstance(node.value, ast.Name) else ""
            owner = known.get(name)
            if isinstance(owner, types.ModuleType) and name not in local:
                modules.add(name)
                yield from _check_value(getattr(owner, node.attr, None), f"{where}, line {node.lineno}")
            elif node.attr in LIMITS:
                reason = f"it reads gains.{node.attr}, and the theorems are about a command without limits"
                raise _refusal(node, where, reason)
            elif node.attr not in FIELDS:
                raise _refusal(node, where, f"it reads .{node.attr}")
    names = {node.id for node in ast.walk(tree) if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load)}
    for name in sorted(names - local - modules):
        if name not in known:
            raise Untraceable(f"{where}: the name {name} is not defined")
        yield from _check_value(known[name], where)


def _check_value(value: Any, where: str) -> list[Any]:
    """Check what a name stands for; return it if it is a function to be read."""
    if value in BUILTINS if isinstance(value, types.BuiltinFunctionType | type) else False:
        return []
    if any(value is known for known in (*PRIMITIVES, *RECORDS, kernel)):
        return []
    if type(value) in NUMBERS:
        if not math.isfinite(value):
            raise Untraceable(f"{where}: its constant {value!r} is no finite number")
        return []
    if type(value) in (tuple, *RECORDS):
        return [function for part in value for function in _check_value(part, where)]
    if isinstance(value, types.FunctionType):
        return [value]
    raise Untraceable(f"{where}: it uses {_shown(value)}, which is not of the law dialect (see bench/law/scalar.py)")


def _shown(value: Any) -> str:
    module = getattr(value, "__module__", "")
    if isinstance(value, types.BuiltinFunctionType | type):
        return f"{module}.{value.__name__}" if module else value.__name__
    return f"a {type(value).__name__}"


def _refusal(node: ast.AST, where: str, why: str) -> Untraceable:
    return Untraceable(f"{where}, line {getattr(node, 'lineno', 0)} of it: {why}")


def check_file(text: str) -> None:
    """Refuse a user's file that may change more than its own names: what a proof uses, or what its law does later."""
    try:
        tree = ast.parse(text)
    except (SyntaxError, ValueError) as error:
        raise Untraceable(f"its file cannot be read ({error})") from error
    for node in ast.walk(tree):
        for why in _faults_of(node):
            raise Untraceable(f"line {getattr(node, 'lineno', 0)} of its file: {why}; such a file is not proved")


def _faults_of_import(node: ast.ImportFrom) -> Iterator[str]:
    """Yield why an import of names is refused: a module among them would give all that it imports itself."""
    name = node.module or ""
    if node.level or (name not in MODULES and not name.startswith(REGULATORS)):
        yield f"it imports {name or 'a file beside it'}"
        return
    module = importlib.import_module(name)
    for alias in node.names:
        value = getattr(module, alias.name, None)
        if value is None or isinstance(value, types.ModuleType):
            yield f"it imports {alias.name} from {name}"


def _faults_of(node: ast.AST) -> Iterator[str]:
    """Yield why a part of a file is refused."""
    if isinstance(node, ast.Import):
        yield from (f"it imports {alias.name}" for alias in node.names if alias.name != "math")
    if isinstance(node, ast.ImportFrom):
        yield from _faults_of_import(node)
    if isinstance(node, STATEMENTS):
        yield f"it has a {type(node).__name__} statement"
    if isinstance(node, ast.Name) and node.id in FORBIDDEN:
        yield f"it uses {node.id}"
    if isinstance(node, ast.Attribute):
        is_private = node.attr.startswith("_") and node.attr != "_replace"  # which makes a new tuple
        if is_private or node.attr in RISKY:
            yield f"it reads .{node.attr}"
        if not isinstance(node.ctx, ast.Load):
            yield f"it sets .{node.attr}"
    if isinstance(node, ast.Subscript) and not isinstance(node.ctx, ast.Load):
        yield "it sets a part of something"
