"""Printing: one console, the same width rules everywhere, plain text when the output is not a terminal.

A screen without UTF-8 gets ASCII: `spelled` writes its units and signs as words, before a line is broken.
"""

import os
import re
import shlex
import tomllib
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from rich.cells import cell_len
from rich.console import Console, ConsoleOptions, JustifyMethod, RenderableType
from rich.measure import Measurement
from rich.table import Table
from rich.text import Text

from bench.base.signs import spell

PIPED = 200
"""Characters a line where neither a terminal nor COLUMNS says how many it has."""


class Screen(Console):
    """A console that prints brackets, as in [1/s^2], unchanged, and spells what its encoding lacks."""

    def print(self, *objects: Any, **how: Any) -> None:
        """Print texts, tables and other things that rich knows."""
        shown = [spelled(one, self) if isinstance(one, str) else one for one in objects]
        super().print(*shown, **how)


def console(stderr: bool = False) -> Screen:
    """Return a console: as wide as the terminal or COLUMNS says, else wide enough for tables in a file."""
    made = Screen(stderr=stderr, highlight=False, markup=False, emoji=False)
    if not (made.is_terminal or os.environ.get("COLUMNS", "").isdigit()):
        made.width = PIPED
    return made


def spelled(text: str, screen: Console) -> str:
    """Return a text as a screen can print it: in ASCII where it has no UTF-8, as 1/sqrt(kp), rad/s^2, 180 deg."""
    return spell(text) if screen.options.ascii_only else text


def shown_path(path: Path) -> str:
    """Return a path as one types it here: relative if below the working directory, quoted if it has a space."""
    relative = os.path.relpath(path)
    return shlex.quote(str(path) if relative.startswith("..") else relative)


def counted(number: int, word: str) -> str:
    """Return a number and its noun: 1 law, 1,200 laws."""
    return f"{number:,} {word}{'' if number == 1 else 's'}"


EXAMPLES = tomllib.loads(Path(__file__).with_name("examples.toml").read_text(encoding="utf-8"))


def examples(command: str) -> Text:
    """Return the end of a command's help: what each example does, and its words on their own line (60 characters)."""
    said, own = Text(), EXAMPLES[command]
    for what, words in own["examples"]:
        said.append(f"{what}:\n").append(f"  bench {words}\n", "bold")
    return said.append(own.get("after", ""))


UNIT_BEHIND = re.compile(r" (?=[\[(])")
"""Before what stands in brackets in the name of a column."""

SENTENCE = 30
"""Longest cell with a space in it that is kept on one line; longer ones wrap, to no less than this width."""


class ScreenColumn(NamedTuple):
    """One column and its cells as text."""

    name: str
    cells: list[str]
    is_number: bool = False


class ScreenTable:
    """A data frame as a table, numbers to the right; no name is broken while the screen has room for it.

    Where it is too wide, units go under the names of their columns; what is still too wide goes below in blocks of
    columns, each with the first column again. Nothing is cut off.
    """

    def __init__(self, columns: list[ScreenColumn], title: str):
        self.columns, self.title = columns, title

    def __rich_console__(self, screen: Console, options: ConsoleOptions) -> Iterator[RenderableType]:
        if self.title:
            yield Text(spelled(self.title, screen), "bold")
        columns = [_spelled_column(column, screen) for column in self.columns]
        if not _fits(columns, screen, options):
            columns = [column._replace(name=UNIT_BEHIND.sub("\n", column.name)) for column in columns]
        first, *others = blocks = _blocks(columns, screen, options)
        if others:
            yield Text(f"{len(columns) - len(first)} of {len(columns)} columns do not fit and are below.")
        for place, block in enumerate(blocks):
            if place:
                yield Text()
            yield _table(block, is_folded=not _fits(block, screen, options))


def word_table(names: Sequence[str], rows: Iterable[Sequence], title: str = "") -> ScreenTable:
    """Rows of words, for a console to print; as a data frame of them is, and without pandas."""
    cells = [*zip(*rows, strict=True)] or [()] * len(names)
    return ScreenTable(
        [ScreenColumn(name, [*map(str, own)]) for name, own in zip(names, cells, strict=True)],
        title,
    )


def frame_table(frame: Any, title: str = "") -> ScreenTable:
    """Return a data frame, for a console to print."""
    columns = []
    for name in frame.columns:
        cells = ["" if value is None or value != value else str(value) for value in frame[name]]
        columns.append(ScreenColumn(str(name), cells, frame[name].dtype.kind in "iuf"))
    return ScreenTable(columns, title)


def _spelled_column(column: ScreenColumn, screen: Console) -> ScreenColumn:
    return column._replace(name=spelled(column.name, screen), cells=[spelled(cell, screen) for cell in column.cells])


def _blocks(
    columns: list[ScreenColumn], screen: Console, options: ConsoleOptions
) -> list[list[ScreenColumn]]:
    """Return the columns in blocks that fit, the first column in each."""
    if _fits(columns, screen, options):
        return [columns]
    key, *others = columns
    key = key._replace(cells=[cell.replace("@", "\n  @") for cell in key.cells])
    blocks = [[key]]
    for one in others:
        if len(blocks[-1]) > 1 and not _fits([*blocks[-1], one], screen, options):
            blocks.append([key])
        blocks[-1].append(one)
    return blocks


def _fits(columns: Sequence[ScreenColumn], screen: Console, options: ConsoleOptions) -> bool:
    return Measurement.get(screen, options.update_width(10**6), _table(columns)).minimum <= options.max_width


def _table(columns: Sequence[ScreenColumn], is_folded: bool = False) -> Table:
    table = Table(box=None, pad_edge=False)
    for one in columns:
        side: JustifyMethod = "right" if one.is_number else "left"
        wraps = any(" " in cell and len(cell) > SENTENCE for cell in one.cells)
        longest = max(cell_len(line) for cell in (one.name, *one.cells) for line in cell.split("\n"))
        width = None if is_folded else SENTENCE if wraps else longest
        is_whole = not (wraps or is_folded)
        table.add_column(Text(one.name), justify=side, overflow="fold", no_wrap=is_whole, min_width=width)
    for row in zip(*(one.cells for one in columns), strict=True):
        table.add_row(*map(Text, row))
    return table
