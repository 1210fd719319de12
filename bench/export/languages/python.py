"""Python: one module on nothing but the standard library, the law's own functions with all that they call."""

import ast
import copy
import textwrap
from collections.abc import Iterator

from bench.export.entries import Entry
from bench.export.heading import RESET, WIDTH, heading
from bench.export.language import Language, write_arguments
from bench.export.layout import fill_template
from bench.export.short import short_files
from bench.export.subject import Subject, translated
from bench.law.scalar import PRIMITIVES
from bench.translation.inference import Typed
from bench.translation.layout import INDENT, wrapped

NUMBERS = (
    "Numbers   matrices are three rows of three numbers, vectors three numbers: lists, tuples or NumPy arrays",
    "Errors    where C gives infinity or NaN, ZeroDivisionError or ValueError is raised",
)
DECLARED = {"gains": "kp, kv", "tuning": "kp, kv, bound, delay", "": "{name}"}
PASSED = {
    "number": "{name}",
    "gains": "Gains(kp, kv)",
    "tuning": "Tuning(kp, kv, bound, delay)",
    "matrix": "Rotation(*_columns({name}))",
    "rows": "sum(_columns({name}), ())",
    "": "_numbers({name})",
}


class _Resolved(ast.NodeTransformer):
    """A function with the names that it has in the module: callees are private, constants are numbers."""

    def __init__(self, function: Typed, memo: dict) -> None:
        self.calls = {memo[id(call)]: callee for call, callee in function.calls.items()}
        self.values = {name: value for name, value in function.values.items() if name not in function.variables}

    def visit_Call(self, node: ast.Call) -> ast.AST:
        """Name the callee."""
        callee = self.calls.get(node)
        self.generic_visit(node)
        if callee is not None and callee.identity:
            return node.args[list(callee.parameters).index(callee.identity)]
        if callee is not None:
            node.func = ast.Name(f"_{callee.name}")
        return node

    def visit_Name(self, node: ast.Name) -> ast.AST:
        """Write the value of a constant."""
        return ast.parse(repr(self.values[node.id]), mode="eval").body if node.id in self.values else node


def write_module(subject: Subject) -> str:
    """Write the law as one module: angular_acceleration(R, omega, R_d, kp, kv) and so on."""
    program = translated(subject)
    named = {kind.name: kind.fields for kind in program.tuples if kind.name}
    classes = (
        f"class {name}(NamedTuple):\n" + "\n".join(f"{INDENT}{one}: Any" for one in named[name]) for name in named
    )
    reset = (f"def reset():\n{_docstring(RESET)}\n{INDENT}return {subject.memory}\n",) if subject.memory else ()
    imports = f"from math import {', '.join(one.__name__ for one in PRIMITIVES)}\nfrom typing import Any, NamedTuple"
    return "\n\n".join(
        (
            f'r"""{heading(subject, *NUMBERS)}\n"""\n\n{imports}\n',
            *(f"{one}\n" for one in classes),
            fill_template("reading.python"),
            *(write_function(one) for one in program.functions),
            *reset,
            *("\n".join(write_entry(one, f"_{program.entries[one.name].name}")) for one in subject.entries),
        )
    )


def write_function(function: Typed) -> str:
    """Write a function of the program."""
    memo: dict = {}
    node = copy.deepcopy(function.node, memo)
    node.name, node.decorator_list = f"_{function.name}", []
    resolved = _Resolved(function, memo).visit(node)
    head, *body = ast.unparse(ast.fix_missing_locations(resolved)).split("\n")
    return "\n".join(wrapped((head, *_docstring(function.summary).splitlines(), *body, "")))


def write_entry(entry: Entry, function: str) -> Iterator[str]:
    """Write one entry."""
    given, passed = write_arguments(entry, DECLARED, PASSED)
    call = f"{function}({passed})"
    result = f"tuple(zip(*{call}))" if entry.returns.kind == "matrix" else call
    doc = f"Return {entry.doc}{'; and the new memory' if entry.has_memory else ''}."
    yield from wrapped((f"def {entry.name}({given}):", *_docstring(doc).splitlines(), f"{INDENT}return {result}", ""))


def _docstring(text: str) -> str:
    """Return a text as an indented docstring; nothing if it is empty."""
    lines = textwrap.wrap(text.replace("\\", "\\\\"), WIDTH)
    closed = [f'"""{lines[0]}"""'] if len(lines) == 1 else [f'"""{lines[0]}', *lines[1:], '"""'] if lines else []
    return textwrap.indent("\n".join(closed), INDENT)


def write_test(subject: Subject) -> str:
    """Write the program that runs the vectors."""
    return fill_template("test.python", NAME=subject.identifier)


FILES = "{name}.py", "test_{name}.py"
TEST = "python test_{name}.py"
LANGUAGE = Language("python", "Python", FILES, write_module, write_test, TEST, beside=short_files)
