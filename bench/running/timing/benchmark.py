"""What can be timed: a name, the work, and how many ticks of it a call does."""

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from bench.engines.binding import memory_of
from bench.engines.curve import blank_curves
from bench.engines.episode import TICKS, Settings, numbers, start_rows
from bench.engines.simulate import simulate
from bench.law.contender import Contender
from tasks.base import Start

KERNEL, LAW, LOOP, ENGINE, CONTROLLER = "reference-kernel", "law", "loop", "engine", "controller"

NEVER = 10**9
"""Ticks of quiet before an early stop: more than there are."""


class Benchmark(NamedTuple):
    """A benchmark: `call()` does `ticks` ticks of it; 0 ticks if it cannot be timed (a law that fails)."""

    what: str
    contender: Contender | None
    engine: str
    ticks: int
    call: Callable
    arm: str = ""

    @property
    def name(self) -> str:
        """A word for progress and for the passes."""
        parts = (self.what, self.arm, self.engine, self.contender.name if self.contender else "")
        return " ".join(part for part in parts if part)


def closed_loop(
    engine: str, one: Contender, loop: Any, laws: tuple, world: Any, starts: list[Start], settings: Settings,
    fresh: np.ndarray, arm: str = "", kept: Any = None,
) -> Benchmark:  # fmt: skip
    """Return the compiled loop of an engine; fresh: its rows before it; kept: what the world has the addresses of."""
    rows = fresh.copy()
    given = memory_of(one), start_rows(starts), numbers(settings), rows, blank_curves(len(starts))

    def call() -> Any:
        rows[:] = fresh
        simulate(loop, laws, world, *given)
        return kept

    call()
    return Benchmark(ENGINE, one, engine, int(rows[:, TICKS].sum()), call, arm)
