"""How far something is: a line that changes on a terminal; elsewhere, as in a log, a line now and then."""

import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from datetime import timedelta

from rich.console import Console
from rich.text import Text

from bench.cli.screen import console

LINE_S = 25.0
"""Between two lines where there is no terminal [s]; logs of services that end silent jobs see one every half minute."""

SURE_S = 5.0
"""Nothing is said of the time left before so many seconds are counted."""


class Steps:
    """Hold the current step, the number done, the total (None if unknown) and the start time."""

    def __init__(self, unit: str, doing: str = "", clock: Callable[[], float] = time.monotonic):
        self.unit, self.clock, self.doing = unit, clock, doing
        self.done, self.before = 0, 0
        self.total: int | None = None
        self.began = self.counting = clock()

    def now(self, doing: str, done: int = 0, total: int | None = None) -> None:
        """Say what is done now; with a total, how much of it."""
        if total is not None and self.total is None:
            self.counting, self.before = self.clock(), done
        self.doing, self.done, self.total = doing, done, total

    @property
    def line(self) -> str:
        """All of it in one line."""
        passed = _clock(self.clock() - self.began)
        if self.total is None:
            return f"{passed}  {self.doing}"
        share = f"{self.done:,} of {self.total:,} {self.unit} ({self.done / max(1, self.total):.0%})"
        counted_s, made = self.clock() - self.counting, self.done - self.before
        is_sure = self.total and made > 0 and counted_s >= SURE_S
        left = f", {_clock(counted_s * (self.total - self.done) / made)} left" if is_sure else ""
        return f"{passed}  {share}{left}: {self.doing}"

    def __rich__(self) -> Text:
        return Text(self.line, overflow="ellipsis", no_wrap=True)


def _clock(seconds: float) -> str:
    return str(timedelta(seconds=round(seconds)))


@contextmanager
def progress(unit: str, doing: str = "", screen: Console | None = None, line_s: float = LINE_S) -> Iterator[Steps]:
    """Shown on stderr, or another screen, until the block ends; `unit` is what is counted, as episodes."""
    steps, screen = Steps(unit, doing), screen or console(stderr=True)
    with screen.status(steps) if screen.is_terminal else _lines(steps, screen, line_s):
        yield steps


@contextmanager
def _lines(steps: Steps, screen: Console, line_s: float) -> Iterator[None]:
    """Print a line every so many seconds, from its own thread."""
    ended = threading.Event()

    def repeat() -> None:
        while not ended.wait(line_s):
            screen.print(steps.line, soft_wrap=True)

    thread = threading.Thread(target=repeat, daemon=True)
    thread.start()
    try:
        yield
    finally:
        ended.set()
        thread.join()
