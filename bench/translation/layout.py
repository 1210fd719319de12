"""Lines of code: indented, and wrapped after commas."""

from collections.abc import Iterable, Iterator

INDENT, WIDTH = "    ", 120


def wrapped(lines: Iterable[str]) -> Iterator[str]:
    """Break lines of code that are too long after commas in brackets."""
    for line in lines:
        indent, depth = " " * (len(line) - len(line.lstrip())), 0
        while len(line) > WIDTH and (breaks := list(_breaks(line, depth))):
            fitting = [one for one in breaks if one[0] <= WIDTH + 1] or breaks[:1]
            late = [one for one in fitting if one[0] > WIDTH // 2] or fitting
            outermost = min(at for _, at in late)
            place, depth = [one for one in late if one[1] == outermost][-1]
            yield line[:place].rstrip()
            line = f"{indent}{INDENT}{line[place:]}"
        yield line


def _breaks(line: str, depth: int) -> Iterator[tuple[int, int]]:
    """Yield the places after commas in brackets, and how many are open there; depth: how many before the line."""
    for place, sign in enumerate(line, start=1):
        depth += (sign in "([{") - (sign in ")]}")
        if depth and line[place - 1 : place + 1] == ", ":
            yield place + 1, depth
