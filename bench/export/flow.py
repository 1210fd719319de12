"""What the statements of a function do to its variables: which they set, and which are looked at behind them."""

import ast

from bench.export.braces import names_in


def stored(*statements: ast.stmt) -> list[str]:
    """Variables that are set, in order."""
    names = [one for statement in statements for one in ast.walk(statement) if isinstance(one, ast.Name)]
    return list(dict.fromkeys(one.id for one in names if isinstance(one.ctx, ast.Store)))


def needed(statements: list[ast.stmt], after: set[str]) -> set[str]:
    """Names that are looked at before they are set, where those of `after` are looked at behind."""
    found = set(after)
    for one in reversed(statements):
        if isinstance(one, ast.Assign):
            found = found - set(stored(one)) | names_in(one.value)
        elif isinstance(one, ast.AugAssign):
            found |= names_in(one)
        elif isinstance(one, ast.Return) and one.value is not None:
            found = names_in(one.value)
        elif isinstance(one, ast.If):
            found = names_in(one.test) | needed(one.body, found) | needed(one.orelse, found)
        elif isinstance(one, ast.For):
            found |= needed(one.body, set()) - names_in(one.target)
    return found


def returns(node: ast.stmt) -> bool:
    """Whether it ends the function, somewhere in it."""
    return any(isinstance(one, ast.Return) for one in ast.walk(node))


def only_hands_back(statements: list[ast.stmt]) -> bool:
    """Whether nothing is left but to return variables: that may stand on either side of what comes before."""
    if len(statements) != 1 or not isinstance(statements[0], ast.Return):
        return False
    value = statements[0].value
    return all(isinstance(one, ast.Name) for one in (value.elts if isinstance(value, ast.Tuple) else [value]))
