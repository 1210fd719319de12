"""Episodes of arms in contact: a controller on trials of a task and an arm, one record an episode back."""

from collections.abc import Callable, Iterable, Iterator
from typing import Any

import mujoco
import numpy as np

from bench.base.errors import BadNumber, UnknownWord
from bench.engines import contact_episode, reference
from bench.engines.compiled import compile_function, compile_once, register
from bench.engines.contact_episode import BROKEN, TIME, USUAL, Conditions, EndedEpisode, made
from bench.engines.episode import FAILURE_TICK, FIRST_METRIC, NEVER, OUTCOME, START_WIDTH
from bench.engines.mujoco_view import compiled_view
from bench.engines.native import trapped
from bench.engines.native.libmujoco import MUJOCO_INTEGRATORS, model_of, skip_constraints
from bench.engines.plants import contact as in_contact
from bench.engines.signatures import TOUCH
from bench.engines.simulate import compiled_loop, simulate
from bench.law.control.contact_controller import ContactController, check_constants
from bench.law.inputs import NO_MEMORY
from tasks.arm_model import Arm
from tasks.contact import ContactTask, Trial, leg, prepare, refuse
from tasks.contact_checks import check_contact, check_trial
from tasks.contact_model import STANDARD, ContactModel, model_xml
from tasks.verdict import GOING

ENGINES = ("native", "reference")


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
    scene = None if engine == "reference" else simulation(controller, task, arm, conditions, contact)
    return (_episode(scene, controller, task, arm, trial, conditions, contact) for trial in trials)


def simulation(controller: ContactController, task: ContactTask, arm: Arm, conditions: Any, contact: Any) -> tuple:
    """Return a fresh model and its data, what of the loop's world is no trial's, the loop, and the laws it calls."""
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
    return model, data, world, _loop(), (_pointer(controller._replace(form="")),)


def _episode(
    scene: Any, controller: ContactController, task: ContactTask, arm: Arm, trial: Trial, conditions: Any, contact: Any
) -> EndedEpisode:
    shape = contact_episode.numbers(controller, task, trial, arm.rated, conditions)
    limits = contact_episode.limits(task, conditions)
    record = np.full((limits.ticks, contact_episode.WIDTH), np.nan)
    if scene is None:
        row, message, data = reference.run_contact(controller, task, arm, trial, conditions, contact, shape, record)
    else:
        (model, data, parts, loop, laws), row, message = scene, np.zeros(FIRST_METRIC), ""
        mujoco.mj_resetData(model, data)
        prepare(model, data, trial)
        parts["work"].legs[: len(trial.pushes)] = trial.pushes
        world = in_contact.ContactWorld(**parts, shape=shape, record=record)
        simulate(loop, laws, world, NO_MEMORY, np.zeros((1, START_WIDTH)), limits, row[None])
    failure = GOING if row[FAILURE_TICK] == NEVER else int(row[OUTCOME])
    error = ""
    if failure == BROKEN:
        error = message or trapped.batch().error()
    return made(record, failure, int(np.isfinite(record[:, TIME]).sum()), error, data)


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
