"""Run the loop in plain Python on dm_control's own environments: slow, and compiled code must reproduce it.

What it shares with the compiled engines is the text of the loop and of its parts. What it does not share is what runs
them: Python on numpy.float64, IEEE 754 as compiled code's is (1/0 is infinite, 0/0 NaN); and MuJoCo, which dm_control's
Environment steps through the Python bindings, in its order and from the state that the judge's task sets.
"""

import contextlib
from collections.abc import Callable
from typing import Any

import mujoco
import numpy as np

import tasks
from bench.engines import contact_episode
from bench.engines.arm_episode import blank_arm, controls, joints
from bench.engines.arm_episode import states as states_of
from bench.engines.binding import evaluation_of, margin_of, memory_of, observer, parts_for, plant_of
from bench.engines.curve import blank_curves
from bench.engines.episode import Metrics, Numbers, Settings, Starts, blank, numbers, start_rows
from bench.engines.mujoco_view import model_view, plain_view
from bench.engines.native.trapped import said
from bench.engines.plants import arm as arm_plant
from bench.engines.plants import contact, free_body
from bench.law.control.resolved_acceleration import assembly
from tasks.contact_episode import environment as scene_of


def _run(loop: Callable, laws: tuple, world: Any, contender: Any, begun: Any, limits: Numbers, row: Any) -> None:
    """Run one episode, in numbers of numpy's throughout."""
    exact = limits._replace(
        kp=np.float64(limits.kp),
        kv=np.float64(limits.kv),
        bound=np.float64(limits.bound),
        delay=np.float64(limits.delay),
    )
    functions = (*laws, *[None] * (3 - len(laws)))
    memory = tuple(map(np.float64, memory_of(contender))) if contender else ()
    loop(*functions, world, memory, begun[None], exact, row[None], blank_curves(1))


def run(
    contender: Any, task: str, starts: Starts, settings: Settings, metrics: Metrics, integrator: str = "euler"
) -> np.ndarray:
    """Return rows of the free body, one a start; see `episode` for the columns."""
    rows, begun, limits = blank(len(starts), metrics), start_rows(starts), numbers(settings)
    loop, laws, plant = free_body.loop_of(observer(metrics)), (evaluation_of(contender),), None
    with np.errstate(all="ignore"):
        for start, line, row in zip(starts, begun, rows, strict=True):
            plant = plant_of(contender, task, settings.gains)
            environment = _reset(plant, start, limits, integrator)
            world = free_body.FreeBodyWorld(
                plain_view(environment), int(contender.regulator.in_engine), np.zeros((1, 1))
            )
            _run(loop, laws, world, contender, line, limits, row)
    return rows


def run_arm(
    contender: Any, task: str, arm: str, starts: Starts, settings: Settings, metrics: Metrics, integrator: str,
    variation: str,
) -> np.ndarray:  # fmt: skip
    """Return rows of an arm, one a start; see `arm_episode` for the columns."""
    rows, begun, limits, of_arm = blank_arm(len(starts), metrics), start_rows(starts), numbers(settings), tasks.arm(arm)
    laws = assembly(parts_for(contender)), contender.inverse.resolve, margin_of(contender)
    loop, one = arm_plant.loop_of(observer(metrics)), tasks.variation(variation)
    believes = one.believed or variation
    with np.errstate(all="ignore"):
        for start, line, row in zip(starts, begun, rows, strict=True):
            sim = plain_view(
                _reset(task, start, limits, integrator, arm=arm, vary=lambda model: one.apply(model, of_arm.rated))
            )
            motors = one.lag_s, of_arm.torque_rate
            shape = controls(contender, bool(one.believed), settings.torque_limit, sim.model, *motors)
            believed = sim
            if shape.has_own_model:
                model = mujoco.MjModel.from_xml_string(tasks.task(task, arm).xml(limits.dt))
                tasks.variation(believes).apply(model, of_arm.rated)
                believed = model_view(model, mujoco.MjData(model))
            states, hinges = states_of([start], of_arm.joints), joints(of_arm, believes)
            work = arm_plant.work(of_arm.joints, one.late_ticks(limits.dt), shape.change)
            world = arm_plant.ArmWorld(sim, states, believed, work, shape, hinges)
            _run(loop, laws, world, contender, line, limits, row)
    return rows


def _reset(task: Any, start: Any, limits: Numbers, integrator: str, **words: Any) -> Any:
    horizon_s = (limits.ticks + 1) * limits.dt
    environment = tasks.load(task, start=start, dt=limits.dt, horizon=horizon_s, integrator=integrator, **words)
    environment.reset()
    return environment


def run_contact(
    controller: Any, task: Any, arm: Any, trial: Any, conditions: Any, model: Any, shape: Any, record: np.ndarray
) -> tuple[np.ndarray, str, object]:
    """Fill the record of a trial; return its row, MuJoCo's message and the data."""
    loop, row = scene_of(task, arm, trial, conditions.dt_s, conditions.integrator, model), np.zeros(6)
    # dm_control would raise what MuJoCo warns of, or log it by a deprecated call; the judge sees for himself
    loop.physics.check_invalid_state = contextlib.nullcontext
    data = loop.physics.data.ptr
    with np.errstate(all="ignore"):
        try:
            loop.reset()
        except mujoco.FatalError as error:
            row[:] = contact_episode.BROKEN
            return row, str(error), data
        sim = plain_view(loop)
        gap, turned = contact_episode.sensors_of(loop.physics.model.ptr)
        work = contact.work(arm.joints, sim.n)
        touch = type(conditions.touch)(*map(np.float64, conditions.touch))
        asked, push = np.zeros(3, np.int64), np.zeros(6)
        noise = conditions.sensor.draw_noise(task.horizon_s, conditions.dt_s)
        world = contact.ContactWorld(
            sim, arm.joints, push, gap, turned, 0, 0, asked, work, shape, touch, record, noise
        )
        limits = contact_episode.limits(task, conditions)
        _run(contact.loop(), (controller.assemble,), world, None, np.zeros(12), limits, row)
    return row, said(), data
