"""The judge: plants, starts, goals, rules and ground truth. Imports nothing of `bench`.

    tasks.load("free-body", tasks.start_set("half-turn")[0])    a dm_control Environment, reset to that start and goal
    tasks.load("arm-regulation", arm="ur5e")                    the same of an arm, at the first of its usual starts

Frames and units: everything is in the base frame unless its name ends in `_body`; radians, seconds;
quaternions are (w, x, y, z) and take body coordinates to base coordinates.

One file adds a task (constant TASK, tasks/domains), a start set (STARTS, tasks/starts or tasks/arm_starts), an arm
(MJCF, tasks/arms) or a perturbation of the free body (AXIS, tasks/conditions). `free_body.py` is `free-body` on the
command line and in the results.
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from tasks import arm_starts, domains, starts
from tasks.arm import arm as arm
from tasks.arm import arm_names as arm_names
from tasks.arm_model import Arm
from tasks.axis import Axis
from tasks.base import ArmStartSet, ArmTask, Start, StartSet, Task
from tasks.condition import known_axes
from tasks.contact import ContactTask
from tasks.discovery import constants, pick
from tasks.errors import BadValue, UnknownName
from tasks.variations import VARIATIONS, Variation

if TYPE_CHECKING:
    import mujoco
    from dm_control.rl.control import Environment

HORIZON_S = 20.0
"""Length of an episode that is not in contact [s], unless another one is asked for."""

_find_arm = arm  # several functions below have an argument of that name


def names() -> list[str]:
    """Return the names of all tasks, sorted."""
    return sorted(_tasks(Task, ArmTask))


def is_for_arms(task: str) -> bool:
    """Whether a task of this name is done by an arm, which must then be named."""
    return isinstance(described(task), ArmTask)


def pairs() -> list[tuple[str, str]]:
    """Return every pair (task, arm) that `load` accepts; the name of the arm is empty if the task has no arm."""
    return [(name, arm) for name in names() for arm in (arm_names() if is_for_arms(name) else [""])]


def described(name: str) -> Task | ArmTask:
    """Return what the file of a task says of it, whether or not it needs an arm; UnknownName lists the known ones."""
    if name in _tasks(ContactTask):
        raise UnknownName(f"task '{name}' is one in contact (try: tasks.load('{name}', arm='ur5e'))")
    return pick("task", name, constants(domains, "TASK"), "tasks/domains")


def task(name: str, arm: str = "") -> Task:
    """Return the task of this name on this arm.

    The error BadValue says that a task for arms needs an arm, or that the task has no arm.
    """
    found = described(name)
    if isinstance(found, ArmTask):
        return found.on(_needed(arm, name))
    if arm:
        with_arms = ", ".join(_tasks(ArmTask))
        raise BadValue(
            f"task '{name}' has no arm, but '{arm}' was named (leave it out, or choose a task for arms: {with_arms})"
        )
    return found


_find_task = task


def _needed(arm: str, task: str) -> Arm:
    if not arm:
        known = arm_names()
        raise BadValue(f"task '{task}' needs an arm; known: {', '.join(known)} (try: arm='{(known or ['ur5e'])[-1]}')")
    return _find_arm(arm)


def load(
    task: str | Task = "free-body",
    start: Any = None,
    dt: float = 1e-3,
    horizon: float | None = None,
    integrator: str | None = None,
    arm: str = "",
    vary: Callable[[mujoco.MjModel], None] | None = None,
) -> Environment:
    """Return a dm_control Environment. Every episode begins at `start` and lasts `horizon` seconds.

    Args:
        start: a Start; for a task in contact, a Trial. The default is the first start of the set `paper`; on an arm,
            the first start of the first set of the task; for a task in contact, the first Trial of the task.
        dt: control period and integration step [s].
        horizon: length of an episode [s], rounded to whole control periods. The default is HORIZON_S (20 s); for a task
            in contact, the length that the task sets.
        integrator: "euler" (the default), "rk4", "implicit" or "implicitfast" (the default for tasks in contact).
        vary: a function that changes the compiled model before the first episode. The plant then differs from the model
            that the controller uses.
    """
    from tasks import contact_episode  # dm_control takes a second to import; listing names must not
    from tasks.episode import environment

    if isinstance(task, str) and task in _tasks(ContactTask):
        one = contact_task(task)
        one = one._replace(horizon_s=one.horizon_s if horizon is None else horizon)
        return contact_episode.environment(one, _needed(arm, task), start, dt, integrator or "implicitfast", vary=vary)
    chosen = task if isinstance(task, Task) else _find_task(task, arm)
    if start is None:
        start = start_set(chosen.start_sets[0], 1, arm=chosen.arm)[0] if chosen.arm else start_set("paper")[0]
    return environment(chosen, start, dt, HORIZON_S if horizon is None else horizon, integrator or "euler", vary)


def start_set_names(arm: bool = False) -> list[str]:
    """Names of all start sets of the free body, or of arms, sorted."""
    return sorted(_start_sets(arm))


def knows_joints(name: str) -> bool:
    """Whether the starts of a set of arms say at which joint angles the tool is at its goal."""
    chosen = find_start_set(name, True)
    return isinstance(chosen, ArmStartSet) and chosen.knows_joints


def start_set(name: str, count: int | None = None, seed: int = 0, arm: str = "") -> list[Start]:
    """Return the first `count` starts of a set; by default as many as the set defines.

    For one seed, the starts and their order are always the same. If a set is sampled, `count` may exceed the number of
    starts that the set defines.
    """
    if count is not None and count < 1:
        raise BadValue(f"count {count} starts of '{name}': a start set needs at least 1 (try: count=10)")
    chosen = find_start_set(name, bool(arm))
    wanted = chosen.size if count is None else count
    if isinstance(chosen, ArmStartSet):
        return list(_starts_on(_find_arm(arm), chosen, max(wanted, chosen.size), seed)[:wanted])
    return chosen.build(wanted, seed)[:wanted]


@functools.lru_cache(maxsize=128)
def _starts_on(arm: Arm, chosen: ArmStartSet, count: int, seed: int) -> tuple[Start, ...]:
    """Find the starts once: it takes searches of seconds."""
    from tasks import found_starts  # it is run by its name, too

    known = found_starts.read(arm, chosen, count, seed)
    return tuple(chosen.build(arm, count, seed)) if known is None else known


def start_set_length(name: str, count: int | None = None, seed: int = 0, arm: str = "") -> int:
    """How many starts `start_set` has with the same arguments; none of a sampled set is made to know it."""
    chosen = find_start_set(name, bool(arm))
    if isinstance(chosen, StartSet) and chosen.between:
        return chosen.size if count is None else count
    return len(start_set(name, count, seed, arm))


def starts_between(name: str, first: int, end: int, seed: int = 0) -> list[Start]:
    """Return the starts of the free body from number `first` to number `end` - 1: start_set(name, end, seed)[first:].

    If the set is sampled, only these starts are computed, and starts with large numbers do not take longer to compute.
    """
    chosen = find_start_set(name, False)
    if isinstance(chosen, StartSet) and chosen.between:
        return chosen.between(first, end, seed)
    return start_set(name, end, seed)[first:]


def axis_names() -> list[str]:
    """Names of all perturbations, sorted."""
    return list(known_axes())


def axis(name: str) -> Axis:
    """Return the perturbation of this name; the error UnknownName lists the known names."""
    return pick("axis", name, known_axes(), "tasks/conditions")


def variation_names(arm: str = "") -> list[str]:
    """Names of all variations, `nominal` first; of an arm those that it has: not every one states a range of motors."""
    has_range = not arm or bool(_find_arm(arm).motors)
    return [name for name, one in VARIATIONS.items() if has_range or not one.needs_range]


def variation(name: str) -> Variation:
    """Return the model variation of this name; the error UnknownName lists the known names."""
    return pick("variation", name, VARIATIONS, "tasks/variations.py")


def contact_names() -> list[str]:
    """Names of all tasks in contact, sorted."""
    return sorted(_tasks(ContactTask))


def contact_task(name: str) -> ContactTask:
    """Return the task in contact of this name; UnknownName lists the known ones."""
    return pick("task in contact", name, _tasks(ContactTask), "tasks/domains")


def _tasks(*kinds: type) -> dict[str, Any]:
    return {name: one for name, one in constants(domains, "TASK").items() if isinstance(one, kinds)}


def _start_sets(arm: bool) -> dict[str, StartSet | ArmStartSet]:
    return constants(arm_starts if arm else starts, "STARTS")


def find_start_set(name: str, arm: bool = False) -> StartSet | ArmStartSet:
    """Return the start set of this name, of the free body or of arms; UnknownName lists the known ones."""
    return pick("start set", name, _start_sets(arm), "tasks/arm_starts" if arm else "tasks/starts")


def __dir__() -> list[str]:
    """Return the names that are this package's own."""
    own = {name: getattr(one, "__module__", "") for name, one in globals().items() if not name.startswith("_")}
    return sorted(name for name, module in own.items() if str(module).partition(".")[0] == __name__)
