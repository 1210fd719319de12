"""One call for both engines of contact: a controller on trials of a task and an arm, one record an episode back."""

from collections.abc import Iterable, Iterator
from typing import NamedTuple

import mujoco
import numpy as np

from bench.control.contact_controller import ContactController, check_constants
from bench.engines import contact_episode
from bench.engines.compiled import compile_function, made_once
from bench.engines.contact_episode import TIME, USUAL, Conditions, Ended, blank, made, numbers
from bench.engines.curve import blank_curves
from bench.engines.episode import FAILURE_TICK, FIRST_METRIC, NEVER, OUTCOME, START_WIDTH
from bench.engines.episode import Numbers as Limits
from bench.engines.native import contact as native
from bench.engines.native import trapped
from bench.engines.native.libmujoco import MUJOCO_INTEGRATORS, model_of
from bench.engines.plants.contact import World, compile_contact
from bench.engines.reference import contact as reference
from bench.errors import BadNumber, UnknownWord
from bench.law.contender import NO_MEMORY
from tasks.arm_model import Arm
from tasks.contact import ContactTask, Trial, prepare, refuse
from tasks.contact_checks import check_contact, check_trial
from tasks.contact_model import STANDARD, ContactModel, model_xml
from tasks.rules import ticks
from tasks.verdict import GOING

ENGINES = ("native", "reference")


class Simulation(NamedTuple):
    """A model and its data, ready for the loop; legs takes a trial's pushes; kept is what the addresses point into."""

    model: mujoco.MjModel
    data: mujoco.MjData
    view: native.ContactView
    work: native.Workspace
    legs: np.ndarray
    kept: tuple


def run(
    engine: str,
    controller: ContactController,
    task: ContactTask,
    arm: Arm,
    trials: Iterable[Trial],
    conditions: Conditions = USUAL,
    contact: ContactModel = STANDARD,
) -> Iterator[Ended]:
    """One `Ended` a trial, in order, each as soon as it is there.

    Args:
        engine: "native", or "reference" for dm_control's own loop.
    Errors, before the first episode begins:
        UnknownWord: the engine or the integrator. BadNumber: a constant of the controller, or the control period.
        BadValue: the arm cannot be set the task, or a trial or the contact model is none.
    """
    trials = tuple(trials)
    _check(engine, task, arm, trials, conditions, contact)
    if engine == "reference":
        return (reference.run(controller, task, arm, trial, conditions, contact) for trial in trials)
    ready = simulation(task, arm, conditions, contact)
    return (_episode(ready, controller, task, arm, trial, conditions) for trial in trials)


def _check(
    engine: str, task: ContactTask, arm: Arm, trials: tuple[Trial, ...], conditions: Conditions, contact: ContactModel
) -> None:
    refuse(task, arm)
    known = {"engine": (engine, ENGINES), "integrator": (conditions.integrator, MUJOCO_INTEGRATORS)}
    for kind, (word, words) in known.items():
        if word not in words:
            raise UnknownWord(kind, word, sorted(words))
    if not 0.0 < conditions.dt_s < np.inf:
        raise BadNumber(f"dt_s = {conditions.dt_s} s: give a finite number above 0 (try: {USUAL.dt_s})")
    check_constants(conditions.gains, conditions.touch)
    check_contact(contact)
    for name, value in conditions.sensor._asdict().items():
        if not 0.0 <= value < np.inf:
            raise BadNumber(f"sensor: {name} = {value}: give a finite number of 0 or more")
    for trial in trials:
        check_trial(trial, arm)


def simulation(task: ContactTask, arm: Arm, conditions: Conditions, contact: ContactModel = STANDARD) -> Simulation:
    """A fresh model of a task on an arm."""
    model = model_of(model_xml(task, arm, conditions.dt_s, contact), conditions.integrator)
    data = mujoco.MjData(model)
    batch, asked = trapped.batch(), np.zeros(3, np.int64)
    noise = conditions.sensor.noise(ticks(task.horizon_s, conditions.dt_s))
    work, arrays = native.workspace(contact_episode.rows(), contact_episode.room(), model.nv, arm.joints, noise)
    seen = native.view(model, data, batch, trapped.CALLBACK, asked, arm.joints)
    return Simulation(model, data, seen, work, arrays[-2], (batch, asked, arrays))


def _episode(
    ready: Simulation, controller: ContactController, task, arm: Arm, trial: Trial, conditions: Conditions
) -> Ended:
    mujoco.mj_resetData(ready.model, ready.data)
    prepare(ready.model, ready.data, trial)
    ready.legs[: len(trial.pushes)] = trial.pushes
    shape = numbers(controller, task, trial, arm.rated, conditions)
    record, row, ticks = blank(shape), np.zeros((1, FIRST_METRIC)), shape.ticks
    limits = Limits(*conditions.gains, shape.dt, ticks, ticks + 1, 1, 0.0, 0.0, shape.speed_limit_squared, 0.0, 0.0)
    world = World(ready.view, ready.work, shape, record)
    given = NO_MEMORY, np.zeros((1, START_WIDTH)), limits, row, blank_curves(1)
    _loop()(pointer(controller), None, None, world, conditions.touch, *given)
    failure = GOING if row[0, FAILURE_TICK] == NEVER else int(row[0, OUTCOME])
    message = trapped.batch().error() if failure == contact_episode.BROKEN else ""
    return made(record, failure, int(np.isfinite(record[:, TIME]).sum()), message, ready.data)


def pointer(controller: ContactController):
    """The rows of a controller, compiled or taken from the disk cache."""
    return _pointer(controller._replace(form=""))


@made_once
def _pointer(controller: ContactController):
    return compile_function(controller.assemble, native.ASSEMBLE)


_loop = made_once(compile_contact)
