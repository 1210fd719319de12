"""Questions about syntax trees."""

import ast


def place_of(node: ast.expr) -> int | None:
    """Return the whole number that an expression is; None if it is none."""
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
        place = place_of(node.operand)
        return None if place is None else -place
    return node.value if isinstance(node, ast.Constant) and type(node.value) is int else None


def free_names(node: ast.FunctionDef) -> list[str]:
    """Return the names that a function reads and does not bind, sorted."""
    names = [one for statement in node.body for one in ast.walk(statement) if isinstance(one, ast.Name)]
    bound = {one.arg for one in node.args.args} | {one.id for one in names if isinstance(one.ctx, ast.Store)}
    return sorted({one.id for one in names} - bound)


def names_read(function: ast.FunctionDef) -> set[str]:
    """Return the names that a function reads; `x += 1` reads x."""
    names = set()
    for node in ast.walk(function):
        if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load):
            names.add(node.id)
        elif isinstance(node, ast.AugAssign) and isinstance(node.target, ast.Name):
            names.add(node.target.id)
    return names


def item_of(node: ast.expr, place: int) -> ast.expr:
    """Return the expression of an item of a tuple."""
    return ast.copy_location(ast.Subscript(node, ast.Constant(place), ast.Load()), node)


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
