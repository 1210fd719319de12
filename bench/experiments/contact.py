"""Tasks in contact: which controllers do which tasks on which arms, in units of some seconds; a pose a row.

A suite leaves out arms that do not fit a task. Records, 25 doubles a tick, are folded and dropped pose by pose.
"""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

import tasks
from bench.base.errors import Incompatible
from bench.base.on_first_use import pd
from bench.engines.metrics.contact_metric import Pose, response
from bench.engines.metrics.measured_compliance import compliance
from bench.engines.metrics.registry import known_contact_metrics
from bench.experiments.columns import of_metrics, read_table
from bench.experiments.experiment import Experiment, Unit
from bench.experiments.request import Request
from bench.law.contenders.representations.zyx_euler import chart
from bench.law.control.contact_controller import ContactController
from bench.law.control.registry import all_controllers, find_controller
from bench.law.so3 import from_quaternion
from tasks.arm_model import Arm
from tasks.contact import ContactTask, Trial, can_do, refuse

if TYPE_CHECKING:
    from bench.engines.contact_episode import Conditions, EndedEpisode

DONE, *_ = WORST_LAST = ("done", "singular", "saturated", "diverged", "broken")
"""Outcomes of `engines.contact_episode`; a pose has the worst of its trials'."""

AT_REST, CREEPING = "at-rest", "creeping"

MEASURED = tuple(f"c_{i}{j}" for i in "xyz" for j in "xyz")

LONGEST_S = 300.0
"""Simulated time of a unit [s], if it has more than one pose: two seconds in free space, some five in contact."""

TRIAL_S = 0.025
"""CPU seconds an episode, see `free_body`: from 0.0035 (probed) to 0.06 (a peg)."""

DENSE = "dense"
"""The selector of a task's dense set of trials."""


@functools.lru_cache(maxsize=8)
def units(request: Request) -> tuple[Unit, ...]:
    """Return a suite's units in contact, as the user narrowed them; BadValue if a named arm cannot do a named task."""
    section = request.section("contact")
    if request.user_laws and request.is_about_contact and set(request.tasks) <= set(tasks.contact_names()):
        raise Incompatible(
            f"tasks in contact take controllers, not the regulator '{request.user_laws[0].name}' (leave --law away)"
        )
    found: list[Unit] = []
    pairs = [(task, arm) for task in _tasks(request) for arm in _arms(task, request)]
    for task, arm in pairs:
        words, poses = controllers_and_poses(section, arm.joints)
        for one in _controllers(words, request):
            if not request.controllers and is_left_out(section, one, task, arm):
                continue
            horizon_s = request.horizon_s or task.horizon_s
            found += cut(one, task, arm, request.count or poses, section["dense"], horizon_s)
    if not found and request.is_about_contact:
        if not pairs:
            raise Incompatible("nothing to run: no arm has a site 'wrist' (add one to a file of tasks/arms)")
        raise Incompatible(
            f"nothing to run: no controller of the suite's, or that was named, acts on "
            f"{', '.join(request.representations)} (try: bench list controllers, and --controller)"
        )
    return tuple(found)


def controllers_and_poses(section: Mapping[str, Any], joints: int) -> tuple[tuple[str, ...], int | None]:
    """Return the controllers and the number of poses of a task on an arm of so many joints, by a suite's section."""
    if joints > 6:
        return section["redundant"], section["redundant_poses"]
    return section["controllers"], section["poses"]


def is_left_out(section: Mapping[str, Any], one: ContactController, task: ContactTask, arm: Arm) -> bool:
    """Tell whether a suite leaves out a controller: there is something to touch, or nothing."""
    if task.touches(arm):
        return one.law in section["in_free_space"]
    return one.name in section["in_touch"]


def _tasks(request: Request) -> list[ContactTask]:
    others = [word for word in request.tasks if word not in tasks.contact_names()]
    if request.controllers and others:
        raise Incompatible(
            f"task '{others[0]}' takes regulators and no controller '{request.controllers[0]}' (try: --task "
            f"{tasks.contact_names()[0]})"
        )
    words = [word for word in request.tasks or tasks.contact_names() if word not in others]
    return [tasks.contact_task(word) for word in words]


def _controllers(words: tuple[str, ...], request: Request) -> list[ContactController]:
    found = [find_controller(word) for word in request.controllers or words] or all_controllers()
    if request.representations:
        found = [one for one in found if one.representation and one.representation.name in request.representations]
    return found


def _arms(task: ContactTask, request: Request) -> list[Arm]:
    for name in request.arms if request.is_about_contact else ():
        refuse(task, tasks.arm(name))
    return [one for one in map(tasks.arm, request.arms or tasks.arm_names()) if can_do(task, one)]


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
    """Return a controller's trials, by pose, in order; an impedance heeds no selection, so it is set each once."""
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


def rows(request: Request, unit: Unit) -> pd.DataFrame:
    """Return one row a pose."""
    from bench.engines.contact_episode import Conditions

    one, arm = find_controller(unit.contender), tasks.arm(unit.arm)
    task = tasks.contact_task(unit.task)
    some = poses_of(one, task, arm, unit.selector == DENSE)[unit.first : unit.first + unit.count]
    conditions = Conditions(request.gains, dt_s=request.dt_s, integrator=request.contact_integrator)
    return frame(request.suite, one, task._replace(horizon_s=unit.horizon_s), arm, some, conditions)


def prepare(request: Request, unit: Unit) -> None:
    """Compile the loop and the controller."""
    from bench.engines.simulate_contact import prepare_contact

    prepare_contact(find_controller(unit.contender))


def frame(
    suite: str,
    controller: ContactController,
    task: ContactTask,
    arm: Arm,
    poses: tuple[tuple[Trial, ...], ...],
    conditions: Conditions,
    simulate: Callable[..., Iterator[EndedEpisode]] | None = None,
) -> pd.DataFrame:
    """Return one row a pose; a pose is the trials that share it. `simulate` is `run_contact` unless it is given."""
    from bench.engines.simulate_contact import run_contact as run

    episodes = (simulate or run)(
        "native", controller, task, arm, (trial for pose in poses for trial in pose), conditions
    )
    made = [_row(task, arm, controller, [(one, next(episodes)) for one in pose], conditions) for pose in poses]
    return pd.DataFrame([{"suite": suite, **row} for row in made])


def _row(
    task: ContactTask,
    arm: Arm,
    controller: ContactController,
    ended: list[tuple[Trial, EndedEpisode]],
    conditions: Conditions,
) -> dict:
    first = ended[0][0]
    outcome = max((one.outcome for _, one in ended), key=WORST_LAST.index)
    ticks = min(len(one.record) for _, one in ended if one.outcome == outcome)
    rest = AT_REST if all(one.rested for _, one in ended) else CREEPING
    pose = Pose(task, arm, controller, tuple(response(*each) for each in ended))
    with np.errstate(all="ignore"):  # of a record that ends beyond all bounds
        measured = {one.column: one.measure(pose) for one in known_contact_metrics().values()}
    return {
        "task": task.name,
        "arm": arm.name,
        "controller": controller.law,
        "representation": controller.representation.name if controller.representation else "",
        "form": controller.form,
        "pose": first.pose,
        "complies": first.specification.name,
        **dict(zip(("alpha", "beta", "gamma"), chart(from_quaternion(first.goal_wxyz)).E, strict=True)),
        "tilt": first.tilt,
        **conditions.gains._asdict(),
        **conditions.touch._asdict(),
        "dt_s": conditions.dt_s,
        "integrator": conditions.integrator,
        "horizon_s": task.horizon_s,
        "trials": len(ended),
        "outcome": outcome,
        "rest": rest if task.rests and outcome == DONE else "",
        "failure_time_s": np.nan if outcome == DONE else ticks * conditions.dt_s,
        **measured,
        **dict(zip(MEASURED, compliance(pose).ravel(), strict=True)),
    }


EXPERIMENT = Experiment.of(
    globals(),
    "controllers of a hand in contact",
    table=read_table(__file__, "compliance", METRICS=lambda: of_metrics(known_contact_metrics().values())),
    takes=("tasks", "arms", "controllers", "representations"),
    cost_s=lambda unit: unit.episodes * TRIAL_S,
    rank=2,
)
