"""Tasks in contact: which controllers do which tasks on which arms, in units of some seconds.

A suite leaves out an arm that does not fit a task; an error says why if the user names both.
"""

from __future__ import annotations

import functools
from collections.abc import Iterator

import tasks
from bench.base.errors import Incompatible
from bench.base.on_first_use import pd
from bench.experiments.choice import Choice
from bench.experiments.contact.poses import TABLE, frame
from bench.experiments.experiment import Asked, Experiment, Settings, Unit
from bench.law.control.contact_controller import ContactController
from bench.law.control.registry import all_controllers, find_controller
from tasks.arm_model import Arm
from tasks.contact import ContactTask, Trial, can_do, refuse

LONGEST_S = 300.0
"""Simulated time of a unit [s], if it has more than one pose: two seconds in free space, some five in contact."""

TRIAL_S = 0.025
"""CPU seconds an episode, see `free_body`: from 0.0035 (probed) to 0.06 (a peg)."""

DENSE = "dense"
"""The selector of a task's dense set of trials."""


@functools.lru_cache(maxsize=8)
def units(asked: Asked) -> tuple[Unit, ...]:
    """Return the units of a suite's part in contact, narrowed or widened by the user; `count` poses of each task.

    Errors:
        BadValue: an arm that was named cannot be set a task that was. Incompatible: no controller is left.
    """
    part, choice = asked.suite.in_contact, asked.choice
    if asked.own and choice.is_about_contact and set(choice.tasks) <= set(tasks.contact_names()):
        raise Incompatible(
            f"tasks in contact take controllers, not the regulator '{asked.own[0].name}' (leave --law away)"
        )
    found: list[Unit] = []
    pairs = [(task, arm) for task in _tasks(choice) for arm in _arms(task, choice)]
    for task, arm in pairs:
        words, poses = part.on(arm.joints)
        for one in _controllers(words, choice):
            if one.law in part.in_free_space and task.touches(arm) and not choice.controllers:
                continue
            found += cut(one, task, arm, asked.count or poses, part.dense, asked.horizon_s or task.horizon_s)
    if not found and choice.is_about_contact:
        if not pairs:
            raise Incompatible("nothing to run: no arm has a site 'wrist' (add one to a file of tasks/arms)")
        raise Incompatible(
            f"nothing to run: no controller of the suite's, or that was named, acts on "
            f"{', '.join(choice.representations)} (try: bench list controllers, and --controller)"
        )
    return tuple(found)


def _tasks(choice: Choice) -> list[ContactTask]:
    others = [word for word in choice.tasks if word not in tasks.contact_names()]
    if choice.controllers and others:
        raise Incompatible(
            f"task '{others[0]}' takes regulators and no controller '{choice.controllers[0]}' (try: --task "
            f"{tasks.contact_names()[0]})"
        )
    return [tasks.contact_task(word) for word in choice.tasks or tasks.contact_names() if word not in others]


def _controllers(words: tuple[str, ...], choice: Choice) -> list[ContactController]:
    found = [find_controller(word) for word in choice.controllers or words] or all_controllers()
    if choice.representations:
        found = [one for one in found if one.representation and one.representation.name in choice.representations]
    return found


def _arms(task: ContactTask, choice: Choice) -> list[Arm]:
    for name in choice.arms if choice.is_about_contact else ():
        refuse(task, tasks.arm(name))
    return [one for one in map(tasks.arm, choice.arms or tasks.arm_names()) if can_do(task, one)]


def cut(
    one: ContactController,
    task: ContactTask,
    arm: Arm,
    size: int | None,
    dense: bool,
    horizon_s: float,
    longest_s: float = LONGEST_S,
) -> Iterator[Unit]:
    """Return the units of a controller on a task's first so many poses."""
    every = poses_of(one, task, arm, dense)[:size]
    step = max(1, int(longest_s / (max(map(len, every)) * horizon_s)))
    for first in range(0, len(every), step):
        some = every[first : first + step]
        yield Unit(
            "contact",
            one.name,
            task.name,
            arm.name,
            selector=DENSE if dense else "",
            first=first,
            count=len(some),
            total=len(every),
            episodes=sum(map(len, some)),
            horizon_s=horizon_s,
        )


def poses_of(one: ContactController, task: ContactTask, arm: Arm, dense: bool) -> tuple[tuple[Trial, ...], ...]:
    """Return the trials that a controller is set, by pose, in the task's order.

    To an impedance, which heeds no selection, trials that differ in nothing else are the same, and it is set the first.
    """
    return _poses(task, arm, dense, one.impedance is not None)


@functools.lru_cache(maxsize=64)
def _poses(task: ContactTask, arm: Arm, dense: bool, is_impedance: bool) -> tuple[tuple[Trial, ...], ...]:
    kept: dict[Trial, Trial] = {}
    for trial in task.trials(arm, dense=dense):
        without = trial.specification._replace(name="", selection=(1, 1, 1, 1, 1, 1))
        kept.setdefault(trial._replace(id="", pose="", specification=without) if is_impedance else trial, trial)
    found: dict[str, list[Trial]] = {}
    for trial in kept.values():
        found.setdefault(trial.pose, []).append(trial)
    return tuple(map(tuple, found.values()))


def rows(settings: Settings, unit: Unit) -> pd.DataFrame:
    """Return one row a pose."""
    from bench.engines.contact_episode import Conditions

    one, arm = find_controller(unit.contender), tasks.arm(unit.arm)
    task = tasks.contact_task(unit.task)
    some = poses_of(one, task, arm, unit.selector == DENSE)[unit.first : unit.first + unit.count]
    conditions = Conditions(settings.gains, dt_s=settings.dt_s, integrator=settings.contact_integrator)
    return frame(settings.suite, one, task._replace(horizon_s=unit.horizon_s), arm, some, conditions)


def prepare(settings: Settings, unit: Unit) -> None:
    """Compile the loop and the controller."""
    from bench.engines.simulate_contact import prepare_contact

    prepare_contact(find_controller(unit.contender))


EXPERIMENT = Experiment.of(
    globals(),
    "controllers of a hand in contact",
    table=TABLE,
    takes=("tasks", "arms", "controllers", "representations"),
    cost_s=lambda unit: unit.episodes * TRIAL_S,
    rank=2,
)
