"""What can be timed: a name, the work, and how many ticks of it a call does."""

from collections.abc import Callable
from typing import NamedTuple

from bench.law.contender import Contender

KERNEL, LAW, LOOP, ENGINE, THREADS = "reference-kernel", "law", "loop", "engine", "threads"
ROLLOUT, DM_CONTROL = "rollout", "dm-control"

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
