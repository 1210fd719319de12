"""The part of a plan that is in contact: which controllers do which tasks on which arms, in units of some seconds.

A suite leaves an arm out that cannot be set a task; the user who names both is told why.
"""

from __future__ import annotations

import functools
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import tasks
from bench.control.contact_controller import Compliant
from bench.control.registry import all_compliants, find_compliant
from bench.errors import Incompatible
from bench.experiments.choice import Choice
from bench.experiments.suites import InContact
from tasks.base import BadValue

if TYPE_CHECKING:
    from tasks.arm_model import Arm
    from tasks.contact import ContactTask, Trial

LONGEST_S = 300.0
"""Simulated time of a unit [s], if it has more than one pose: two seconds in free space, some five in contact."""


@dataclass(frozen=True)
class ContactUnit:
    """A piece of work that is done or not done: one controller on a stretch of a task's poses.

    count: its episodes. dense: of the task's dense set.
    """

    contender: str
    task: str
    arm: str
    first: int
    poses: int
    count: int
    dense: bool
    horizon_s: float

    table = "compliance"

    @property
    def key(self) -> str:
        """A name for a file."""
        return f"contact_{self.contender.replace('/', '~')}_{self.task}_{self.arm}_{self.first:06d}"

    @property
    def label(self) -> str:
        """Where it is and what it runs, in a few words."""
        return f"{self.arm} {self.contender}"


def units(
    part: InContact, choice: Choice, poses: int | None = None, horizon_s: float | None = None
) -> tuple[ContactUnit, ...]:
    """The units of a suite's part in contact, narrowed or widened by what the user named.

    Args:
        poses: the first so many of each task; the suite's number if None.
    Errors:
        BadValue: an arm that was named cannot be set a task that was. Incompatible: no controller is left.
    """
    if not choice.takes_contact:
        return ()
    chosen = _controllers(part, choice)
    if not chosen and choice.is_about_contact:
        raise Incompatible(
            f"nothing to run: no controller of the suite's, or that was named, acts on "
            f"{', '.join(choice.representations)} (try: python -m bench list controllers, and --controller)"
        )
    found = []
    for task in _tasks(choice):
        for arm in _arms(task, choice):
            for one in chosen:
                found += _cut(one, task, arm, poses or part.poses, part.dense, horizon_s or task.horizon_s)
    if not found and choice.is_about_contact:
        raise Incompatible("nothing to run: no arm has six joints and a site 'wrist' (add one to a file of tasks/arms)")
    return tuple(found)


def _tasks(choice: Choice) -> list[ContactTask]:
    named = [word for word in choice.tasks if word in tasks.contact_names()]
    return [tasks.contact_task(word) for word in named or tasks.contact_names()]


def _controllers(part: InContact, choice: Choice) -> list[Compliant]:
    words = choice.controllers or part.controllers
    found = [find_compliant(word) for word in words] or all_compliants()
    if choice.representations:
        found = [one for one in found if one.representation and one.representation.name in choice.representations]
    return found


def _arms(task: ContactTask, choice: Choice) -> list[Arm]:
    is_named = bool(choice.arms) and choice.is_about_contact
    every = map(tasks.arm, choice.arms or tasks.arm_names())
    return [one for one in every if can_do(task, one, or_refuse=is_named)]


def can_do(task: ContactTask, arm: Arm, or_refuse: bool = False) -> bool:
    """Whether an arm can be set a task.

    Errors:
        BadValue: it cannot, and `or_refuse` asks for the reason.
    """
    from tasks.contact import refuse  # MuJoCo takes a moment to import; what comes before must not

    try:
        refuse(task, arm)
    except BadValue:
        if or_refuse:
            raise
        return False
    return True


def _cut(one: Compliant, task: ContactTask, arm: Arm, size: int | None, dense: bool, horizon_s: float):
    every = poses_of(one, task, arm, dense)[:size]
    longest = max(map(len, every)) * horizon_s
    step = max(1, int(LONGEST_S / longest))
    for first in range(0, len(every), step):
        some = every[first : first + step]
        yield ContactUnit(one.name, task.name, arm.name, first, len(some), sum(map(len, some)), dense, horizon_s)


def poses_of(one: Compliant, task: ContactTask, arm: Arm, dense: bool) -> tuple[tuple[Trial, ...], ...]:
    """The trials that a controller is set, by pose, in the task's order.

    To an impedance, which heeds no selection, trials that differ in nothing else are the same, and it is set the first.
    """
    return _poses(task, arm, dense, one.impedance is not None)


@functools.lru_cache(maxsize=64)
def _poses(task: ContactTask, arm: Arm, dense: bool, is_impedance: bool) -> tuple[tuple[Trial, ...], ...]:
    trials = task.dense(arm) if dense and task.dense else task.trials(arm)
    kept = _without_selection(trials) if is_impedance else trials
    found: dict[str, list[Trial]] = {}
    for trial in kept:
        found.setdefault(trial.pose, []).append(trial)
    return tuple(map(tuple, found.values()))


def _without_selection(trials: tuple[Trial, ...]) -> Iterator[Trial]:
    seen = set()
    for trial in trials:
        what = trial._replace(id="", pose="", order=trial.order._replace(name="", held=(1, 1, 1, 1, 1, 1)))
        if what not in seen:
            seen.add(what)
            yield trial
