"""The judge: plants, starts, goals, rules and ground truth. Imports nothing of `bench`.

    tasks.load("free-body", start)      a dm_control Environment, reset to that start and goal
    tasks.task(name), tasks.names()     the plants: one file each in tasks/domains
    tasks.start_set(name, count, seed)  the starts: one file each in tasks/starts
    tasks.start_set_names()

    base.py       Start, Task, StartSet; the sensors of every model; the errors
    truth.py      angle and haversine: the judge's own measure of the error
    rules.py      the numbers of the rules: band, limits, hold window
    verdict.py    the rules at work, tick by tick: the six outcomes
    rotations.py  quaternions that are exact where a double can be exact (half turns, poles)
    haar.py       low-discrepancy points on SO(3)
    episode.py    one episode of any Task as a dm_control Environment
    discovery.py  finds the one named constant of every module in a folder

Frames and units: everything is in the base frame unless its name ends in `_body`; radians, seconds;
quaternions are (w, x, y, z) and take body coordinates to base coordinates.

To add a task, put one file with a constant TASK in tasks/domains; to add a start set, one file with a
constant STARTS in tasks/starts. `free_body.py` is `free-body` on the command line and in the results.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tasks import domains, starts
from tasks.base import BadValue, Start, StartSet, Task
from tasks.discovery import constants, pick

if TYPE_CHECKING:
    from dm_control.rl.control import Environment

__all__ = ["load", "names", "start_set", "start_set_names", "start_set_title", "task"]


def names() -> list[str]:
    """Names of all tasks, sorted."""
    return sorted(_tasks())


def task(name: str) -> Task:
    """The task of this name; UnknownName lists the known ones."""
    return pick("task", name, _tasks(), "tasks/domains")


def load(
    task: str | Task = "free-body",
    start: Start | None = None,
    dt: float = 1e-3,
    horizon: float = 20.0,
    integrator: str = "euler",
) -> Environment:
    """A dm_control Environment that begins every episode at `start` and lasts `horizon` seconds.

    Args:
        task: name of a task, or a Task of the caller's own.
        start: orientation, angular velocity and goal; the first start of `paper` if none is given.
        dt: control period and integration step [s].
        horizon: length of an episode [s], a whole number of ticks after rounding.
        integrator: "euler", "rk4", "implicit" or "implicitfast".
    """
    from tasks.episode import environment  # dm_control takes a second to import; listing names must not

    chosen = task if isinstance(task, Task) else pick("task", task, _tasks(), "tasks/domains")
    return environment(chosen, start or start_set("paper")[0], dt, horizon, integrator)


def start_set_names() -> list[str]:
    """Names of all start sets, sorted."""
    return sorted(_start_sets())


def start_set_title(name: str) -> str:
    """What a start set is, in a few words."""
    return pick("start set", name, _start_sets(), "tasks/starts").title


def start_set(name: str, count: int | None = None, seed: int = 0) -> list[Start]:
    """The starts of a set, always the same ones in the same order.

    Args:
        name: one of `start_set_names()`.
        count: how many; the set's own number if None. A sampled set is prefix-stable (a longer one begins
            with the shorter one). A fixed set has no more than its own number and then gives them all.
        seed: of the sampled points and the random axes.
    """
    chosen = pick("start set", name, _start_sets(), "tasks/starts")
    if count is not None and count < 1:
        raise BadValue(f"count {count} starts of '{name}': a start set needs at least 1 (try: count=10)")
    wanted = chosen.size if count is None else count
    return chosen.build(wanted, seed)[:wanted]


def _tasks() -> dict[str, Task]:
    return constants(domains, "TASK")


def _start_sets() -> dict[str, StartSet]:
    return constants(starts, "STARTS")
