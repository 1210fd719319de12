"""Printing: one console, the same width rules everywhere, plain text when the output is not a terminal."""

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, ProgressColumn, TextColumn, TimeRemainingColumn
from rich.table import Table
from rich.text import Text


def console(stderr: bool = False) -> Console:
    """A console; wide enough for tables when piped into a file. It prints brackets, as in [1/s^2], as they are."""
    made = Console(stderr=stderr, highlight=False, markup=False, emoji=False)
    if not made.is_terminal:
        made.width = 200
    return made


class Rate(ProgressColumn):
    """Episodes a second."""

    def render(self, task) -> Text:
        """The rate, once there is one."""
        return Text(f"{task.speed:,.0f}/s" if task.speed else "")


def episode_progress() -> Progress:
    """A bar of episodes with rate and time left; nothing where there is no terminal to draw it on."""
    screen = console(stderr=True)
    return Progress(
        TextColumn("{task.description:34}"),
        BarColumn(bar_width=30),
        MofNCompleteColumn(),
        Rate(),
        TimeRemainingColumn(),
        console=screen,
        disable=not screen.is_terminal,
    )


def count_progress() -> Progress:
    """A bar of measurements with time left."""
    return Progress(
        TextColumn("{task.description:34}"),
        BarColumn(bar_width=30),
        MofNCompleteColumn(),
        TimeRemainingColumn(),
        console=console(stderr=True),
    )


def frame_table(frame, title: str = "") -> Table:
    """A data frame as a table, numbers to the right."""
    table = Table(title=title or None, title_justify="left", title_style="bold", box=None, pad_edge=False)
    for name in frame.columns:
        numeric = frame[name].dtype.kind in "iuf"
        table.add_column(Text(str(name)), justify="right" if numeric else "left", overflow="fold")
    for row in frame.itertuples(index=False):
        table.add_row(*(Text("" if value is None or value != value else str(value)) for value in row))
    return table
