"""Episodes of arms in contact: a controller on trials of a task and an arm, one record an episode back."""

from collections.abc import Callable, Iterable, Iterator
from typing import Any, NamedTuple

import mujoco
import numpy as np

from bench.base.errors import BadNumber, UnknownWord
from bench.engines import contact_episode, reference
from bench.engines.compiled import TOUCH, compile_function, compile_once, register
from bench.engines.contact_episode import BROKEN, TIME, USUAL, Conditions, EndedEpisode, made
from bench.engines.episode import FAILURE_TICK, FIRST_METRIC, NEVER, OUTCOME, START_WIDTH, Numbers
from bench.engines.mujoco_view import compiled_view
from bench.engines.native import trapped
from bench.engines.native.libmujoco import MUJOCO_INTEGRATORS, model_of, skip_constraints
from bench.engines.plants import contact as in_contact
from bench.engines.simulate import compiled_loop, simulate
from bench.law.control.contact_controller import ContactController, check_constants
from bench.law.inputs import NO_MEMORY
from tasks.arm_model import Arm
from tasks.contact import ContactTask, Trial, leg, prepare, refuse
from tasks.contact_checks import check_contact, check_trial
from tasks.contact_model import STANDARD, ContactModel, model_xml
from tasks.verdict import GOING

ENGINES = ("native", "reference")

Trials = tuple[Trial, ...]


def run_contact(
    engine: str, controller: ContactController, task: ContactTask, arm: Arm, trials: Iterable[Trial],
    conditions: Conditions = USUAL, contact: ContactModel = STANDARD,
) -> Iterator[EndedEpisode]:  # fmt: skip
    """Yield one `EndedEpisode` a trial, in order, by the engine "native", or "reference" for dm_control's own loop.

    Errors, before the first episode begins:
        UnknownWord: the engine or the integrator. BadNumber: a constant of the controller, or the control period.
        BadValue: the arm cannot be set the task, or a trial or the contact model is none.
    """
    trials = tuple(trials)
    refuse(task, arm)
    known = {"engine": (engine, ENGINES), "integrator": (conditions.integrator, MUJOCO_INTEGRATORS)}
    for kind, (word, words) in known.items():
        if word not in words:
            raise UnknownWord(kind, word, sorted(words))
    if not 0.0 < conditions.dt_s < np.inf:
        raise BadNumber(f"dt_s = {conditions.dt_s} s: give a finite number above 0 (try: {USUAL.dt_s})")
    check_constants(conditions.gains, conditions.touch)
    check_contact(contact)
    for trial in trials:
        check_trial(trial, arm)
    if engine == "reference":
        return _plain_episodes(controller, task, arm, trials, conditions, contact)
    return _episodes(simulation(task, arm, conditions, contact), controller, task, arm, trials, conditions)


class Scene(NamedTuple):
    """What all trials of a task on an arm share: MuJoCo's model and data, and of the loop's world what is no trial's."""

    model: mujoco.MjModel
    data: mujoco.MjData
    world: dict[str, Any]


def simulation(task: ContactTask, arm: Arm, conditions: Conditions, contact: ContactModel = STANDARD) -> Scene:
    """Return a fresh scene."""
    model = skip_constraints(model_of(model_xml(task, arm, conditions.dt_s, contact), conditions.integrator))
    data = mujoco.MjData(model)
    gap, turned = contact_episode.sensors_of(model)
    world = {
        "sim": compiled_view(model, data),
        "n": arm.joints,
        "push": data.xfrc_applied[model.body("hand").id],
        "gap": gap,
        "turned": turned,
        "batch": trapped.batch().address,
        "callback": trapped.CALLBACK,
        "asked": np.array((model._address, data._address, 0), np.int64),
        "work": in_contact.work(arm.joints, model.nv),
        "touch": conditions.touch,
        "noise": conditions.sensor.draw_noise(task.horizon_s, conditions.dt_s),
    }
    return Scene(model, data, world)


def _plain_episodes(
    controller: ContactController, task: ContactTask, arm: Arm, trials: Trials, conditions: Any, contact: Any
) -> Iterator[EndedEpisode]:
    for trial in trials:
        shape = contact_episode.numbers(controller, task, trial, arm.rated, conditions)
        record = _blank_record(contact_episode.limits(task, conditions))
        row, message, data = reference.run_contact(controller, task, arm, trial, conditions, contact, shape, record)
        yield _ended(record, row, message, data)


def _episodes(
    scene: Scene, controller: ContactController, task: ContactTask, arm: Arm, trials: Trials, conditions: Any
) -> Iterator[EndedEpisode]:
    model, data, world = scene
    loop, laws = _loop(), (_pointer(controller._replace(form="")),)
    limits, start = contact_episode.limits(task, conditions), np.zeros((1, START_WIDTH))
    before: Trial | None = None
    for trial in trials:
        if before is None or not _differ_in_push_alone(before, trial):
            shape = contact_episode.numbers(controller, task, trial, arm.rated, conditions)
        before = trial
        record, row = _blank_record(limits), np.zeros(FIRST_METRIC)
        mujoco.mj_resetData(model, data)
        prepare(model, data, trial)
        world["work"].legs[: len(trial.pushes)] = trial.pushes
        filled = in_contact.ContactWorld(**world, shape=shape, record=record)
        simulate(loop, laws, filled, NO_MEMORY, start, limits, row[None])
        yield _ended(record, row, "", data)


def _differ_in_push_alone(one: Trial, other: Trial) -> bool:
    """Tell whether two trials have the same numbers (`contact_episode.numbers`), as most that follow each other have."""
    is_one_wish = one.specification is other.specification and one.goal_wxyz is other.goal_wxyz
    return is_one_wish and len(one.pushes) == len(other.pushes)


def _blank_record(limits: Numbers) -> np.ndarray:
    return np.full((limits.ticks, contact_episode.WIDTH), np.nan)


def _ended(record: np.ndarray, row: np.ndarray, message: str, data: Any) -> EndedEpisode:
    failure = GOING if row[FAILURE_TICK] == NEVER else int(row[OUTCOME])
    if failure == BROKEN:
        message = message or trapped.batch().error()
    return made(record, failure, int(np.isfinite(record[:, TIME]).sum()), message if failure == BROKEN else "", data)


def _loop() -> Callable:
    register(leg)
    return compiled_loop("contact")


def prepare_contact(controller: ContactController) -> None:
    """Compile what `run_contact` will need, or take it from the disk cache."""
    _loop()
    _pointer(controller._replace(form=""))


@compile_once
def _pointer(law: ContactController) -> Callable:
    """Return the rows of a controller, whatever its form, compiled or taken from the disk cache."""
    return compile_function(law.assemble, TOUCH)
