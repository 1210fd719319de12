"""Episodes of arms: by torques, by velocities, by impedances that shape no inertia, and in contact."""

import functools
from collections.abc import Iterable, Iterator
from typing import NamedTuple

import mujoco
import numpy as np

import tasks
from bench.control.contact_controller import ContactController, check_constants
from bench.control.resolved_acceleration import assembly
from bench.engines import contact_episode, reference
from bench.engines.arm_episode import STANDING, blank_arm, controls, joints, states
from bench.engines.binding import margin_of, memory_of, parts_for
from bench.engines.compiled import (
    ASSEMBLE,
    DESIGN,
    LIMIT,
    MARGIN,
    RESOLVE,
    TOUCH,
    compile_function,
    made_once,
    own_law,
    register,
)
from bench.engines.contact_episode import BROKEN, TIME, USUAL, Conditions, Ended, made
from bench.engines.curve import Curves
from bench.engines.episode import FAILURE_TICK, FIRST_METRIC, NEVER, OUTCOME, START_WIDTH, Settings, numbers, start_rows
from bench.engines.native import trapped
from bench.engines.native.libmujoco import MUJOCO_INTEGRATORS, model_of
from bench.engines.plants import arm as on_arm
from bench.engines.plants import contact as in_contact
from bench.engines.plants import impedance, velocity
from bench.engines.plants.impedance import Springs
from bench.engines.simulate import compiled_loop, evaluation, simulate
from bench.engines.simulated import compiled_view
from bench.errors import BadNumber, UnknownWord
from bench.law.contender import NO_MEMORY, Contender
from bench.law.damping import Damping
from bench.law.limiter import Limiter
from tasks.arm_model import Arm
from tasks.contact import ContactTask, Trial, leg, prepare, refuse
from tasks.contact_checks import check_contact, check_trial
from tasks.contact_model import STANDARD, ContactModel, model_xml
from tasks.contact_rest import has_left
from tasks.rules import ticks
from tasks.velocity import servo
from tasks.verdict import GOING

NOMINAL = "nominal"
"""The variation in which the controller's model is the plant."""
ARM_TASK = "arm-regulation"
ENGINES = ("native", "reference")


def run_arm(
    engine: str,
    contender: Contender,
    task: str,
    arm: str,
    starts,
    settings: Settings,
    metrics,
    integrator: str = "euler",
    variation: str = NOMINAL,
    curves: Curves | None = None,
) -> np.ndarray:
    """Rows of `engines.arm_episode`, one per start.

    Args:
        starts: tasks.Start with joint angles, in order; metrics: Metric, in the order of their columns.
        variation: how the plant differs from the controller's model. curves: filled too, on the engine `native`.
    """
    if engine == "reference":
        return reference.run_arm(contender, task, arm, starts, settings, metrics, integrator, variation)
    kept, world = arm_world(contender, task, arm, starts, settings, integrator, variation)
    rows, limits, loop = blank_arm(len(starts), metrics), numbers(settings), compiled_loop("arm", tuple(metrics))
    simulate(loop, pointers(contender), world, memory_of(contender), start_rows(starts), limits, rows, curves)
    del kept  # what the addresses of the world point into, until here
    return rows


def arm_world(
    contender: Contender, task: str, arm: str, starts, settings: Settings, integrator: str, variation: str = NOMINAL
) -> tuple[list, on_arm.World]:
    """Return the models of one arm, the plant and the controller's if it is another one, and the world of the loop."""
    one = tasks.arm(arm)
    has_own = variation != NOMINAL or controls(contender, False, 1.0).has_own_model == STANDING
    sims = [_simulation(task, one, settings.dt_s, integrator, name) for name in (variation, NOMINAL)[: 1 + has_own]]
    kept, views = [sim[:2] for sim in sims], [compiled_view(*sim) for sim in sims]
    shape = controls(contender, has_own, settings.torque_limit)
    world = on_arm.World(views[0], states(starts, one.joints), views[-1], on_arm.work(one.joints), shape, joints(one))
    return kept, world


def _simulation(task: str, arm: Arm, dt_s: float, integrator: str = "euler", variation: str = NOMINAL) -> tuple:
    model = _model(task, arm, dt_s, integrator, variation)
    return model, mujoco.MjData(model)


@functools.lru_cache(maxsize=64)
def _model(task: str, arm: Arm, dt_s: float, integrator: str, variation: str) -> mujoco.MjModel:
    """A model that many simulations may share: stepping does not change it."""
    model = model_of(tasks.task(task, arm.name).xml(dt_s), integrator)
    if variation != NOMINAL:
        tasks.variation(variation).apply(model, arm.rated)
    return model


def pointers(contender: Contender) -> tuple:
    """The three functions of a contender, compiled or taken from the disk cache; a user's law is compiled anew."""
    law = contender._replace(jacobian=None, inverse=None)
    return _assemble(contender._replace(inverse=None)), resolution(contender.inverse), _margin(law)


@made_once
def _assemble(contender: Contender):
    with own_law(contender.regulator.origin) as cache:
        return compile_function(assembly(parts_for(contender)), ASSEMBLE, cache)


@made_once
def resolution(inverse):
    """An inverse as loops call it."""
    return compile_function(inverse.resolve, RESOLVE)


@made_once
def _margin(contender: Contender):
    return compile_function(margin_of(contender), MARGIN)


@made_once
def limit_of(limiter: Limiter):
    """A limiter as the loops call it."""
    return compile_function(limiter.limit, LIMIT)


@made_once
def design_of(damping: Damping):
    """A design of damping as the loop calls it."""
    return compile_function(damping.design, DESIGN)


def run_velocity(
    contender: Contender, limiter: Limiter, K: float, starts, settings: Settings, arm: str = "", lag_s: float = 0.0
) -> np.ndarray:
    """Rows of `plants.velocity`, one per start.

    Args:
        contender: a velocity law; on an arm with its Jacobian and inverse. K: its gain [1/s].
        starts: tasks.Start, in order, whose omega and joint rates are not used: nothing moves before a command.
        lag_s: time constant of the joints' servos [s]; 0: none. Those of the free body have none.
    """
    pace = velocity.Pace(float(K), *map(float, servo(settings.dt_s, lag_s)))
    law, rows = contender._replace(jacobian=None, inverse=None), velocity.blank_rows(len(starts), bool(arm))
    given = memory_of(law), start_rows(starts), numbers(settings), rows
    functions = evaluation(law), limit_of(limiter)
    if not arm:
        return simulate(compiled_loop("velocity"), functions, velocity.World(pace), *given)
    n, (model, data) = tasks.arm(arm).joints, _simulation(ARM_TASK, tasks.arm(arm), settings.dt_s)
    still, work = states([one._replace(qdot=(0.0,) * n) for one in starts], n), on_arm.work(n)
    work.D[:] = np.eye(n)
    world = velocity.ArmWorld(compiled_view(model, data), still, work, pace)
    return simulate(compiled_loop("velocity-arm"), (*functions, resolution(contender.inverse)), world, *given)


def prepare_velocity(contender: Contender, limiters) -> None:
    """Compile what `run_velocity` will need, or take it from the disk cache."""
    evaluation(contender._replace(jacobian=None, inverse=None))
    for one in limiters:
        limit_of(one)
    if contender.inverse:
        resolution(contender.inverse)
    compiled_loop("velocity-arm" if contender.inverse else "velocity")


def run_impedance(
    law: Contender, damping: Damping, springs: Springs, starts, settings: Settings, arm: str
) -> tuple[np.ndarray, np.ndarray]:
    """Rows of `plants.impedance`, and q and qdot at the end, one per start.

    Args:
        law: its command at omega = 0 over kp is the error of orientation.
        starts: tasks.Start with joint angles and rates, in order.
        settings: `torque_limit` is what torques over rated ones may come to.
    """
    limits, one = numbers(settings._replace(command_limit=settings.torque_limit)), tasks.arm(arm)
    kept = [_simulation(ARM_TASK, one, settings.dt_s) for _ in range(2)]
    plant, still = (compiled_view(*sim) for sim in kept)
    world = impedance.world(plant, still, states(starts, one.joints), springs, one.rated)
    rows, laws = impedance.blank_rows(len(starts)), (evaluation(law), design_of(damping))
    simulate(compiled_loop("impedance"), laws, world, memory_of(law), start_rows(starts), limits, rows)
    del kept
    return rows, world.ends


def prepare_impedance(law: Contender, dampings) -> None:
    """Compile what `run_impedance` will need, or take it from the disk cache."""
    evaluation(law)
    for one in dampings:
        design_of(one)
    compiled_loop("impedance")


class Scene(NamedTuple):
    """A model and its data, and of the loop's world what is no trial's."""

    model: mujoco.MjModel
    data: mujoco.MjData
    world: dict


def run_contact(
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
    scene = None if engine == "reference" else simulation(task, arm, conditions, contact)
    return (_episode(scene, controller, task, arm, trial, conditions, contact) for trial in trials)


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


def simulation(task: ContactTask, arm: Arm, conditions: Conditions, contact: ContactModel = STANDARD) -> Scene:
    """A fresh model of a task on an arm."""
    model = model_of(model_xml(task, arm, conditions.dt_s, contact), conditions.integrator)
    data = mujoco.MjData(model)
    asked = np.array((model._address, data._address, 0), np.int64)
    noise = conditions.sensor.noise(ticks(task.horizon_s, conditions.dt_s))
    gap, turned = contact_episode.sensors_of(model)
    world = {
        **{"sim": compiled_view(model, data), "n": arm.joints, "push": data.xfrc_applied[model.body("hand").id]},
        **{"gap": gap, "turned": turned, "work": in_contact.work(arm.joints, model.nv, noise)},
        **{"batch": trapped.batch().address, "callback": trapped.CALLBACK, "asked": asked},
    }
    return Scene(model, data, world)


def _episode(scene: Scene | None, controller, task, arm: Arm, trial: Trial, conditions: Conditions, contact) -> Ended:
    shape = contact_episode.numbers(controller, task, trial, arm.rated, conditions)
    record = contact_episode.blank(shape)
    if scene is None:
        row, message, data = reference.run_contact(controller, task, arm, trial, conditions, contact, shape, record)
    else:
        data, row, message = scene.data, np.zeros(FIRST_METRIC), ""
        mujoco.mj_resetData(scene.model, data)
        prepare(scene.model, data, trial)
        scene.world["work"].legs[: len(trial.pushes)] = trial.pushes
        touch, start = conditions.touch, np.zeros((1, START_WIDTH))
        world = in_contact.World(**scene.world, shape=shape, touch=touch, record=record)
        limits = in_contact.limits(shape, conditions.gains)
        simulate(_loop(), (pointer(controller),), world, NO_MEMORY, start, limits, row[None])
    failure = GOING if row[FAILURE_TICK] == NEVER else int(row[OUTCOME])
    if failure == BROKEN:
        message = message or trapped.batch().error()
    return made(record, failure, int(np.isfinite(record[:, TIME]).sum()), message if failure == BROKEN else "", data)


def _loop():
    for function in (leg, has_left):
        register(function)
    return compiled_loop("contact")


def pointer(controller: ContactController):
    """The rows of a controller, compiled or taken from the disk cache."""
    return _pointer(controller._replace(form=""))


@made_once
def _pointer(controller: ContactController):
    return compile_function(controller.assemble, TOUCH)
