"""Measure how dense our Python is, room by room.

`python -m tests.support.density` prints `tests/repository/density.toml`, whose limits `test_density.py` holds.

A syntax node is a node of Python's own syntax tree. Docstrings are not counted, so that an explanation costs nothing,
nor are the marks of an expression's context (load, store, delete), which no reader sees. A code line has at least one
token that is neither a comment nor part of a docstring.
"""

import ast
import io
import math
import tokenize
import tomllib
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[2]
LIMITS = ROOT / "tests" / "repository" / "density.toml"

PACKAGES = ("bench", "report", "tasks", "tests")
SPLIT = "bench"
"""The package whose folders are rooms of their own. Each of the others is one room."""
BUILT = ("_build", "__pycache__")
"""Folders that hold no source."""

WIDE_COLUMNS = 100
SLACK = 1.03
"""A room may grow by 3 % between two releases: some fixes and a file or two, but no second mechanism."""
RATIO_SLACK = 1.01
"""A room's two ratios may exceed their limits by 1 %: removing a few short lines raises them, too."""

WITHOUT_CODE = frozenset(
    (tokenize.COMMENT, tokenize.NL, tokenize.NEWLINE, tokenize.INDENT, tokenize.DEDENT, tokenize.ENDMARKER)
)

HEADER = """\
# The limits of each room that test_density.py holds: syntax nodes (3 % more are allowed), nodes per code line, and the
# percentage of lines over 100 columns (1 % more of these two). They are moved once a release; the file is printed by
# python -m tests.support.density. Goals: at most 220,000 nodes in the product and 130,000 in the tests, 6.0 nodes per
# code line (no room over 6.5), and 1 % of wide lines.
"""


@dataclass(frozen=True)
class Density:
    """Counts of one file, or the sums of several.

    Attributes:
        nodes: Syntax nodes, without docstrings and contexts.
        code_lines: Lines with code on them.
        lines: All lines, with blank lines, comments and docstrings.
        wide_lines: Lines of more than 100 columns.
    """

    nodes: int = 0
    code_lines: int = 0
    lines: int = 0
    wide_lines: int = 0

    @property
    def nodes_per_line(self) -> float:
        """Return the syntax nodes per code line, 0 where there is no code."""
        return self.nodes / self.code_lines if self.code_lines else 0.0

    @property
    def wide_percent(self) -> float:
        """Return the percentage of lines over 100 columns, 0 where there are no lines."""
        return 100.0 * self.wide_lines / self.lines if self.lines else 0.0

    def __add__(self, other: "Density") -> "Density":
        """Return the sums of both."""
        return Density(
            nodes=self.nodes + other.nodes,
            code_lines=self.code_lines + other.code_lines,
            lines=self.lines + other.lines,
            wide_lines=self.wide_lines + other.wide_lines,
        )


def is_docstring(node: ast.AST) -> bool:
    """Return whether a statement is nothing but a string: the docstring of a module, class, function or constant."""
    return isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant) and isinstance(node.value.value, str)


def walk_code(node: ast.AST) -> Iterator[ast.AST]:
    """Yield a node and all below it, without docstrings and expression contexts."""
    yield node
    for child in ast.iter_child_nodes(node):
        if not is_docstring(child) and not isinstance(child, ast.expr_context):
            yield from walk_code(child)


def list_docstring_lines(tree: ast.AST) -> set[int]:
    """Return the numbers of the lines that docstrings take."""
    numbers: set[int] = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Expr) and is_docstring(node):
            last_line = node.end_lineno or node.lineno
            numbers.update(range(node.lineno, last_line + 1))
    return numbers


def list_token_lines(source: str) -> set[int]:
    """Return the numbers of the lines that tokens take, without comments and line ends."""
    numbers: set[int] = set()
    for token in tokenize.generate_tokens(io.StringIO(source).readline):
        if token.type not in WITHOUT_CODE:
            first_line, last_line = token.start[0], token.end[0]
            numbers.update(range(first_line, last_line + 1))
    return numbers


def measure_source(source: str) -> Density:
    """Return the counts of one file's text."""
    tree = ast.parse(source)
    lines = source.splitlines()
    return Density(
        nodes=sum(1 for _ in walk_code(tree)),
        code_lines=len(list_token_lines(source) - list_docstring_lines(tree)),
        lines=len(lines),
        wide_lines=sum(len(line) > WIDE_COLUMNS for line in lines),
    )


def measure_files(paths: Iterable[Path]) -> Density:
    """Return the sums over files."""
    total = Density()
    for path in paths:
        total += measure_source(path.read_text(encoding="utf-8"))
    return total


def name_room(path: Path, root: Path = ROOT) -> str:
    """Return the room of a file: `tasks`, `report`, `tests`, `bench/law`; `bench` for the files of no folder."""
    package, *below = path.relative_to(root).parts
    if package == SPLIT and len(below) > 1:
        return f"{package}/{below[0]}"
    return package


def list_rooms(root: Path = ROOT) -> dict[str, list[Path]]:
    """Return the rooms with their Python files, both sorted."""
    rooms: dict[str, list[Path]] = {}
    for package in PACKAGES:
        for path in sorted((root / package).rglob("*.py")):
            if not set(BUILT) & set(path.relative_to(root).parts):
                rooms.setdefault(name_room(path, root), []).append(path)
    return dict(sorted(rooms.items()))


def read_limits() -> dict[str, dict[str, Any]]:
    """Return the limits of each room as they are committed."""
    return tomllib.loads(LIMITS.read_text(encoding="utf-8"))


def round_up(number: float) -> float:
    """Return a number with two decimals that is not below the given one."""
    return math.ceil(round(100 * number, 6)) / 100


def set_limits(density: Density, previous: dict[str, Any]) -> dict[str, float]:
    """Return the new limits of a room: its nodes of today, and the two ratios, which only fall."""
    nodes_per_line = round_up(density.nodes_per_line)
    wide_percent = round_up(density.wide_percent)
    return {
        "nodes": density.nodes,
        "nodes_per_line": min(nodes_per_line, previous.get("nodes_per_line", nodes_per_line)),
        "wide_percent": min(wide_percent, previous.get("wide_percent", wide_percent)),
    }


def write_limits() -> str:
    """Return the text of `density.toml` for the tree as it stands."""
    previous = read_limits() if LIMITS.exists() else {}
    parts = [HEADER]
    for room, paths in list_rooms().items():
        limits = set_limits(measure_files(paths), previous.get(room, {}))
        entries = [f"{name} = {limit}\n" for name, limit in limits.items()]
        parts.append(f'\n["{room}"]\n' + "".join(entries))
    return "".join(parts)


if __name__ == "__main__":
    print(write_limits(), end="")
