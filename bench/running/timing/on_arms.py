"""What is timed on arms: rollout, every controller in the compiled loop, the usual ones alone, dm_control with numpy.

The compiled loop is the real one, all metrics on, with no early stop; its model, data and buffers are made once,
outside what is timed. `rollout` is the same model, start and number of ticks in open loop.
"""

import mujoco
import numpy as np

import tasks
from bench.engines import simulate_arms
from bench.engines.arm_episode import blank_arm
from bench.engines.episode import Settings as EngineSettings
from bench.engines.metrics.registry import metrics_of
from bench.engines.native.libmujoco import model_of
from bench.engines.simulate import compiled_loop
from bench.experiments.experiment import Settings
from bench.experiments.suites import suite
from bench.law.contender import Contender
from bench.law.contenders import combinations
from bench.law.inputs import PAPERS_GAINS
from bench.running.timing import dm_control_loop
from bench.running.timing.benchmark import DM_CONTROL, ENGINE, NEVER, Benchmark, closed_loop, open_loop
from bench.running.timing.controller import controller
from tasks.base import Start

TASK = "arm-regulation"
HORIZON_S = 6.0
"""6000 ticks of 1 ms, some 20 ms: handing the loop its arguments takes 0.19 ms of a call, a hundredth of it; in a run
it does so once for many episodes. A tick costs the same at any time."""

FEWEST_TICKS = 4000
"""A controller that fails sooner is not timed: what a call costs beside its ticks would show."""

SLOW_TICKS = 50
"""Ticks of dm_control's loop, which takes as long for them as the compiled one for twenty times as many."""

PUSH = 0.02
"""Standard deviation of rollout's torques over the rated ones; the arm also falls, so that all joints turn."""

IN_NUMPY = "rotation-matrix@geometric+standard"
"""What dm_control's loop runs, written in numpy."""


def controllers(laws: list[Contender], arm: str) -> list[Contender]:
    """Return the default suite's controllers that use these laws; a user's law by the geometric Jacobian."""
    by_name = {one.name: one for one in laws}
    own = tuple(f"{one.name}@geometric+standard" for one in laws if one.regulator.origin)
    return combinations.on((*suite("default").on_arms.words, *own), by_name, tasks.arm(arm).joints)


def of_arm(arm: str, laws: list[Contender]) -> list[Benchmark]:
    """Everything of one arm, rollout first; all is compiled and has run once."""
    each = controllers(laws, arm)
    found = [rollout(arm), *(native(arm, one) for one in each)]
    usual = (one for one in each if one.jacobian and one.jacobian.name == "geometric" and is_standard(one, arm))
    found += [controller(TASK, arm, one, _start(arm)) for one in usual]
    by_name = {one.name: one for one in laws}
    in_numpy = combinations.on((IN_NUMPY,), by_name, tasks.arm(arm).joints)
    return [*found, *(dm_control(arm, one) for one in in_numpy)]


def is_standard(one: Contender, arm: str) -> bool:
    """Tell whether a controller inverts its Jacobian as the arm's standard controllers do."""
    return bool(one.inverse and one.inverse.name == ("solve" if tasks.arm(arm).joints == 6 else "pseudo-inverse"))


def _start(arm: str) -> Start:
    """Return a turn of some 20 degrees."""
    return tasks.start_set("clear", 8, arm=arm)[-1]


def _settings(horizon_s: float) -> EngineSettings:
    return Settings().limits(horizon_s)._replace(hold_ticks=NEVER)


def native(
    arm: str, one: Contender, horizon_s: float = HORIZON_S, start: Start | None = None, fewest: int = FEWEST_TICKS
) -> Benchmark:
    """Return a controller in the compiled loop; one that fails from the start is held at it, to last longer."""
    start = start or _start(arm)
    benchmark = _native(arm, one, start, horizon_s, fewest)
    at_rest = start._replace(goal_wxyz=start.quat_wxyz)
    return benchmark if benchmark.ticks else _native(arm, one, at_rest, horizon_s, fewest)


def _native(arm: str, one: Contender, start: Start, horizon_s: float, fewest: int) -> Benchmark:
    metrics = metrics_of(on_arm=True)
    settings = _settings(horizon_s)
    kept, world = simulate_arms.arm_world(one, TASK, arm, [start], settings, "euler")
    loop, laws = compiled_loop("arm", tuple(metrics)), simulate_arms.pointers(one)
    made = closed_loop("native", one, loop, laws, world, [start], settings, blank_arm(1, metrics), arm, kept)
    return made if made.ticks >= fewest else made._replace(ticks=0)


def rollout(arm: str) -> Benchmark:
    """mujoco.rollout on the arm's model, its torques drawn beforehand."""
    settings, start, rated = _settings(HORIZON_S), _start(arm), np.array(tasks.arm(arm).rated)
    model = model_of(tasks.task(TASK, arm).xml(settings.dt_s), "euler")
    control = np.random.default_rng(0).normal(size=(1, settings.ticks, model.nu)) * (PUSH * rated)
    return open_loop(model, mujoco.MjData(model), np.array([[*start.q, *start.qdot]]), control, arm)


def dm_control(arm: str, one: Contender) -> Benchmark:
    """dm_control's loop; `one` is the controller that it has written in numpy."""
    dt_s = _settings(HORIZON_S).dt_s
    call = dm_control_loop.loop(TASK, arm, _start(arm), dt_s, SLOW_TICKS, PAPERS_GAINS)
    call()
    return Benchmark(ENGINE, one, DM_CONTROL, SLOW_TICKS, call, arm)
