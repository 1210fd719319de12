"""The order in which parts of an expression are evaluated: Python's is from left to right, C has none."""

import ast
from typing import TYPE_CHECKING

from bench.base.errors import BadLaw
from bench.translation.kinds import NONE, Array, External, Kind, Pointer, Tuple

if TYPE_CHECKING:
    from bench.translation.inference import Typed


def find_writes(typed: "Typed") -> bool:
    """Tell whether a function writes into an array, or calls what does."""
    nodes = list(ast.walk(typed.node))
    stores = (one for one in nodes if isinstance(one, ast.Subscript) and isinstance(one.ctx, ast.Store))
    return any(one in typed.kinds for one in stores) or any(_is_writing_call(typed, one) for one in nodes)


def _is_writing_call(typed: "Typed", node: ast.AST) -> bool:
    """Tell whether a node is a call of what writes; what is called by pointer does where it gets an array."""
    if not isinstance(node, ast.Call) or node not in typed.kinds:
        return False
    if node in typed.calls:
        return typed.calls[node].writes
    callee = typed.callee(node.func)
    if isinstance(callee, Pointer):
        return any(map(holds_array, callee.parameters))
    return isinstance(callee, External)


def refuse_unordered(typed: "Typed") -> None:
    """Refuse a call that writes into an array beside what reads one: C does not order them, and Python does."""
    for node in ast.walk(typed.node):
        if not isinstance(node, ast.Call | ast.BinOp | ast.Compare | ast.Tuple) or node not in typed.kinds:
            continue
        parts = [part for part in ast.iter_child_nodes(node) if isinstance(part, ast.expr)]
        writing = [any(_is_writing_call(typed, one) for one in ast.walk(part)) for part in parts]
        reading = [any(_reads_array(typed, one) for one in ast.walk(part)) for part in parts]
        if any(writing) and sum(writes or reads for writes, reads in zip(writing, reading, strict=True)) > 1:
            raise BadLaw(
                f"{typed.function.name}: `{ast.unparse(node)}` has a call that writes into an array beside what "
                "reads one, and C does not order them; give the call's result a name first"
            )


def _reads_array(typed: "Typed", node: ast.AST) -> bool:
    """Tell whether a node reads an element of an array, or calls what is given an array."""
    if isinstance(node, ast.Subscript):
        return isinstance(typed.kinds.get(node.value), Array) and not isinstance(typed.kinds.get(node), Array)
    given = node.args if isinstance(node, ast.Call) else []
    return any(holds_array(typed.kinds.get(one, NONE)) for one in given)


def holds_array(kind: Kind) -> bool:
    """Tell whether a value of a kind has an array in it."""
    return isinstance(kind, Array) or (isinstance(kind, Tuple) and any(map(holds_array, kind.items)))
