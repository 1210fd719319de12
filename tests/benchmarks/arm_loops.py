"""A controller in the compiled loop of an arm: the real loop, all metrics on, no early stop.

Model, data and buffers are made once, outside what is timed.
"""

import tasks
from bench.engines import simulate_arms
from bench.engines.arm_episode import blank_arm
from bench.engines.metrics.registry import metrics_of
from bench.engines.simulate import compiled_loop
from bench.experiments.arm import on_real_motors
from bench.experiments.request import Request
from bench.experiments.suites import suite
from bench.law.contender import Contender
from bench.law.contenders import combinations
from benchmarks.subject import NEVER, Episodes, Subject, time_episodes
from tasks.base import Start

TASK = "arm-regulation"

SETTINGS = Request().limits(6.0)._replace(hold_ticks=NEVER)
"""6000 ticks of 1 ms, some 20 ms of time: handing the loop its arguments takes 0.19 ms of them."""

FEWEST_TICKS = 4000
"""A controller that fails sooner is not timed: what a call costs beside its ticks would show."""


def list_controllers(laws: list[Contender], arm: str) -> list[Contender]:
    """Return the default suite's controllers of these laws; a user's by the geometric Jacobian."""
    section = suite("default").sections["arm"]
    by_name = {law.name: law for law in laws}
    words = [*section["words"], *on_real_motors(section)]
    for law in laws:
        if law.regulator.origin:
            words.append(f"{law.name}@geometric+standard")
    return combinations.on(tuple(words), by_name, tasks.arm(arm).joints)


def list_usual(laws: list[Contender], arm: str) -> list[Contender]:
    """Return those that invert the geometric Jacobian as the arm's standard controllers do."""
    inverse = "solve" if tasks.arm(arm).joints == 6 else "pseudo-inverse"
    controllers = list_controllers(laws, arm)
    return [controller for controller in controllers if controller.way == ("geometric", inverse)]


def turn_by_20_degrees(arm: str) -> Start:
    """Return a start whose goal is some 20 degrees away."""
    return tasks.start_set("clear", 8, arm=arm)[-1]


def arm_loop(
    arm: str,
    contender: Contender,
    start: Start | None = None,
    fewest_ticks: int = FEWEST_TICKS,
) -> Subject:
    """Return the subject of a controller on an arm.

    One that fails too soon from the start is held at it, to last longer; one that fails even there
    has no ticks.
    """
    moving = start or turn_by_20_degrees(arm)
    held = moving._replace(goal_wxyz=moving.quat_wxyz)
    subject = _run_from(moving, arm, contender)
    if subject.ticks < fewest_ticks:
        subject = _run_from(held, arm, contender)
    if subject.ticks < fewest_ticks:
        return Subject(subject.what, subject.call, 0, contender, subject.engine, arm)
    return subject


def _run_from(start: Start, arm: str, contender: Contender) -> Subject:
    metrics = metrics_of(on_arm=True)
    owners, world = simulate_arms.arm_world(contender, TASK, arm, [start], SETTINGS, "euler")
    episodes = Episodes(
        loop=compiled_loop("arm", tuple(metrics)),
        laws=simulate_arms.pointers(contender),
        world=world,
        starts=[start],
        settings=SETTINGS,
        blank_rows=blank_arm(1, metrics),
        owners=owners,
    )
    return time_episodes(contender, episodes, "native", arm)
