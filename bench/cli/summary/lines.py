"""Lines of a summary: at most WIDTH columns on every screen and in every pipe; names and commands stay whole."""

import math
import textwrap

from bench.cli.screen import console, spelled

WIDTH = 80
HEAD = 22
"""Width of the first column of a table, where names of laws stand."""

ABOUT = 12
"""Width of the first column beside sentences: what they are about."""


def print_lines(*lines: str) -> None:
    """Print lines that are laid out already."""
    screen = console()
    for line in lines:
        screen.print(line.rstrip(), soft_wrap=True)


def print_text(head: str, *sentences: str, indent: int = HEAD) -> None:
    """Print sentences, each on a line of its own, in a column beside a head; they are broken at WIDTH."""
    screen = console()
    by = textwrap.TextWrapper(WIDTH, break_long_words=False, break_on_hyphens=False)
    by.subsequent_indent = " " * indent
    for place, sentence in enumerate(sentences):
        by.initial_indent = f"{'' if place else head:{indent}}"
        for line in by.wrap(spelled(sentence, screen)):
            screen.print(line, soft_wrap=True)


def write_percent(share: float) -> str:
    """Write a share in per cent: whole numbers, with a digit more close to 0 and 100, where it says the most."""
    percent = 100.0 * share
    if percent in (0.0, 100.0) or 1.0 <= percent <= 99.0:
        return f"{percent:.0f}"
    return f"{min(max(percent, 0.1), 99.9):.1f}"


def write_seconds(seconds: float) -> str:
    """Write a settling time; "never" where too few starts settle."""
    return f"{seconds:.2f}" if math.isfinite(seconds) else "never"


def write_ratio(ratio: float) -> str:
    """Write a ratio with two significant digits, as the book does."""
    return f"{float(f'{ratio:.2g}'):,g}" if math.isfinite(ratio) else "inf"
