"""Describe what is timed: some work, and how many control ticks of it a call does."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from bench.engines.binding import memory_of
from bench.engines.curve import blank_curves
from bench.engines.episode import TICKS, Settings, numbers, start_rows
from bench.engines.simulate import simulate
from bench.law.contender import Contender
from tasks.base import Start

KERNEL = "reference-kernel"
LAW = "law"
LOOP = "loop"
ENGINE = "engine"
CONTROLLER = "controller"

NEVER = 10**9
"""Ticks of rest before an episode stops early: more than there are."""


def do_nothing(number: int) -> None:
    """Prepare a round of a subject that needs no preparation."""


@dataclass(frozen=True)
class Subject:
    """Hold what is timed; it is compiled, and has run once.

    Attributes:
        what: KERNEL, LAW, LOOP, ENGINE or CONTROLLER.
        call: Does the work.
        ticks: Control ticks of a call; 0 if the law fails, so that there is nothing to time.
        contender: The law, on arms with its Jacobian and inverse; None for the kernel and the empty
            loop.
        engine: Engine of a loop; else empty.
        arm: Arm of a loop or a controller; else empty.
        prepare: Is called before each round, with the round's number.
    """

    what: str
    call: Callable[[], Any]
    ticks: int
    contender: Contender | None = None
    engine: str = ""
    arm: str = ""
    prepare: Callable[[int], None] = do_nothing

    def describe(self) -> dict[str, Any]:
        """Return what the saved file says of the subject."""
        return {
            "what": self.what,
            "arm": self.arm,
            "contender": self.contender.words if self.contender else {},
            "engine": self.engine,
            "ticks": self.ticks,
        }


@dataclass(frozen=True)
class Episodes:
    """Hold a compiled loop with all that it is called with.

    Attributes:
        loop: Loop of `compiled_loop`.
        laws: Functions that the loop calls by pointer.
        world: Plant and buffers.
        starts: Starts of the episodes, one a row.
        settings: Settings of the episodes.
        blank_rows: Rows as they are before a call, shape (starts, columns).
        owners: Objects that own the memory whose addresses the world holds.
    """

    loop: Callable
    laws: tuple
    world: Any
    starts: list[Start]
    settings: Settings
    blank_rows: np.ndarray
    owners: Any = None


def time_episodes(
    contender: Contender,
    episodes: Episodes,
    engine: str,
    arm: str = "",
) -> Subject:
    """Return the subject that runs all episodes of a loop in each call."""
    rows = episodes.blank_rows.copy()
    memory = memory_of(contender)
    begun = start_rows(episodes.starts)
    limits = numbers(episodes.settings)
    curves = blank_curves(len(episodes.starts))

    def call() -> Any:
        rows[:] = episodes.blank_rows
        simulate(episodes.loop, episodes.laws, episodes.world, memory, begun, limits, rows, curves)
        return episodes.owners

    call()
    ticks = int(rows[:, TICKS].sum())
    return Subject(ENGINE, call, ticks, contender, engine, arm)
