"""What can be timed: a name, the work, and how many ticks of it a call does."""

from collections.abc import Callable
from typing import Any, NamedTuple

import mujoco
import numpy as np
from mujoco.rollout import Rollout

from bench.engines.binding import memory_of
from bench.engines.curve import blank_curves
from bench.engines.episode import TICKS, Settings, numbers, start_rows
from bench.engines.simulate import simulate
from bench.law.contender import Contender
from tasks.base import Start

KERNEL, LAW, LOOP, ENGINE, THREADS = "reference-kernel", "law", "loop", "engine", "threads"
CONTROLLER = "controller"
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


def open_loop(
    model: mujoco.MjModel, data: mujoco.MjData, states: np.ndarray, control: np.ndarray, arm: str = ""
) -> Benchmark:
    """mujoco.rollout over a model from states (qpos, qvel), with commands (starts, ticks, nu) drawn beforehand."""
    count, ticks, _ = control.shape
    width = mujoco.mj_stateSize(model, mujoco.mjtState.mjSTATE_FULLPHYSICS)
    initial = np.zeros((count, width))
    initial[:, 1 : 1 + states.shape[1]] = states  # time comes first
    state, sensors = np.zeros((count, ticks, width)), np.zeros((count, ticks, model.nsensordata))
    rollout = Rollout(nthread=0)  # no pool: everything happens on the calling thread, whose time is taken

    def call() -> None:
        rollout.rollout(model, data, initial, control, state=state, sensordata=sensors)

    call()
    return Benchmark(ENGINE, None, ROLLOUT, count * ticks, call, arm)


def closed_loop(
    engine: str, one: Contender, loop: Any, laws: tuple, world: Any, starts: list[Start], settings: Settings,
    fresh: np.ndarray, arm: str = "", kept: Any = None,
) -> Benchmark:  # fmt: skip
    """Return the compiled loop of an engine from these starts; fresh: its rows before it.

    kept: what the world holds the addresses of.
    """
    rows = fresh.copy()
    given = memory_of(one), start_rows(starts), numbers(settings), rows, blank_curves(len(starts))

    def call() -> Any:
        rows[:] = fresh
        simulate(loop, laws, world, *given)
        return kept

    call()
    return Benchmark(ENGINE, one, engine, int(rows[:, TICKS].sum()), call, arm)
