"""What is timed on arms: every controller in the compiled loop, and the usual ones alone.

The compiled loop is the real one, all metrics on, with no early stop; its model, data and buffers are made once,
outside what is timed.
"""

import tasks
from bench.engines import simulate_arms
from bench.engines.arm_episode import blank_arm
from bench.engines.metrics.registry import metrics_of
from bench.engines.simulate import compiled_loop
from bench.experiments.experiment import Settings
from bench.experiments.suites import suite
from bench.law.contender import Contender
from bench.law.contenders import combinations
from bench.running.timing.benchmark import NEVER, Benchmark, closed_loop
from bench.running.timing.controller import controller
from tasks.base import Start

TASK = "arm-regulation"
SETTINGS = Settings().limits(6.0)._replace(hold_ticks=NEVER)
"""6000 ticks of 1 ms, some 20 ms of time: handing the loop its arguments takes a hundredth of it, 0.19 ms a call."""

FEWEST_TICKS = 4000
"""A controller that fails sooner is not timed: what a call costs beside its ticks would show."""


def controllers(laws: list[Contender], arm: str) -> list[Contender]:
    """Return the default suite's controllers that use these laws; a user's law by the geometric Jacobian."""
    by_name, part = {one.name: one for one in laws}, suite("default").on_arms
    own = tuple(f"{one.name}@geometric+standard" for one in laws if one.regulator.origin)
    return combinations.on((*part.words, *part.compared, *own), by_name, tasks.arm(arm).joints)


def of_arm(arm: str, laws: list[Contender]) -> list[Benchmark]:
    """Everything of one arm; all is compiled and has run once."""
    each = controllers(laws, arm)
    standard = "solve" if tasks.arm(arm).joints == 6 else "pseudo-inverse"  # as the arm's standard controllers invert
    usual = (one for one in each if one.way == ("geometric", standard))
    return [*(native(arm, one) for one in each), *(controller(TASK, arm, one, _start(arm)) for one in usual)]


def _start(arm: str) -> Start:
    """Return a turn of some 20 degrees."""
    return tasks.start_set("clear", 8, arm=arm)[-1]


def native(arm: str, one: Contender, start: Start | None = None, fewest: int = FEWEST_TICKS) -> Benchmark:
    """Return a controller in the compiled loop; one that fails from the start is held at it, to last longer."""
    start, metrics = start or _start(arm), metrics_of(on_arm=True)
    loop, laws = compiled_loop("arm", tuple(metrics)), simulate_arms.pointers(one)
    for begin in (start, start._replace(goal_wxyz=start.quat_wxyz)):
        kept, world = simulate_arms.arm_world(one, TASK, arm, [begin], SETTINGS, "euler")
        made = closed_loop("native", one, loop, laws, world, [begin], SETTINGS, blank_arm(1, metrics), arm, kept)
        if made.ticks >= fewest:
            break
    return made if made.ticks >= fewest else made._replace(ticks=0)
