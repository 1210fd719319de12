"""A task in contact in dm_control's own loop, the controller plain Python on numpy.float64 buffers.

See `free_body` for what this is the truth of.
"""

import contextlib

import mujoco
import numpy as np

from bench.control.contact_controller import ContactController
from bench.control.hybrid import comply
from bench.control.setpoint import ContactParameters
from bench.engines.contact_episode import (
    BROKEN,
    RESTED,
    Conditions,
    Ended,
    blank,
    made,
    numbers,
    overload,
    room,
    rows,
    sensed,
    sensors_of,
    setpoint,
    wrench,
    write_record,
)
from bench.engines.episode import vector
from bench.law.contender import Gains
from bench.law.resolved_motion import Chain
from bench.law.scalar import sqrt
from bench.law.so3 import Rotation, from_quaternion
from tasks.arm_model import Arm
from tasks.contact import ContactTask, Trial
from tasks.contact_episode import environment
from tasks.contact_model import ContactModel
from tasks.contact_rest import has_left
from tasks.verdict import GOING, check_command, check_state


def run(
    controller: ContactController,
    task: ContactTask,
    arm: Arm,
    trial: Trial,
    conditions: Conditions,
    contact: ContactModel,
) -> Ended:
    """One trial; see `contact_episode` for what is recorded."""
    shape = numbers(controller, task, trial, arm.rated, conditions)
    record = blank(shape)
    with np.errstate(all="ignore"):
        loop = environment(task, arm, trial, conditions.dt_s, conditions.integrator, contact)
        # dm_control would raise what MuJoCo warns of, or log it by a deprecated call; the judge sees for himself
        loop.physics.check_invalid_state = contextlib.nullcontext
        failure, ticks, message = _episode(controller, arm, trial, loop, conditions, shape, record)
    return made(record, failure, ticks, message, loop.physics.data.ptr)


def _episode(controller, arm, trial, loop, conditions, shape, record):
    try:
        loop.reset()
    except mujoco.FatalError as error:
        return BROKEN, 0, str(error)
    plant, model, n = loop.physics.data, loop.physics.model.ptr, arm.joints
    assemble, s = controller.assemble, plant.sensordata
    gains, touch = Gains(*map(np.float64, conditions.gains)), ContactParameters(*map(np.float64, conditions.touch))
    into, about, J = rows(), room(), np.zeros((6, n))
    D, tau = np.zeros((model.nv, model.nv)), np.zeros(n)
    at_gap, at_turned = sensors_of(model)
    R_d, p_0 = from_quaternion(tuple(map(np.float64, shape.quat_d))), vector(s[16:19])
    place, frame, since, noise = p_0, R_d, 0, conditions.sensor.noise(shape.ticks)
    for tick in range(shape.ticks):
        time = tick * shape.dt
        R = Rotation(vector(s[0:3]), vector(s[3:6]), vector(s[6:9]))
        p, omega = vector(s[16:19]), vector(s[9:12])
        f, m = wrench(R, s)
        f_seen, m_seen = sensed(f, m, record, tick, shape.delay, noise)
        wanted = setpoint(R_d, p_0, shape, time)
        mujoco.mj_fullM(model, plant.ptr, D)
        fg = (plant.qfrc_bias - plant.qfrc_passive)[:n]
        chain = Chain(n, plant.xaxis, plant.xanchor, plant.qvel, p, R)
        assemble(chain, wanted, f_seen, m_seen, gains, touch, J, into)
        comply(shape.form, shape.held, chain, D, fg, J, into, gains, touch, about, tau)
        total, largest = overload(tau, shape.rated, n)
        gap = s[at_gap] if at_gap >= 0 else 0.0
        turned = s[at_turned] if at_turned >= 0 else 0.0
        write_record(record[tick], time, R, omega, p, f, m, gap, turned, sqrt(np.float64(largest)))
        failure = check_command(total, shape.torque_limit_squared)
        if failure != GOING:
            return failure, tick + 1, ""
        if has_left(shape.rest, tick, p, R, place, frame):
            place, frame, since = p, R, tick
        elif shape.rest.ticks > 0 and tick - since >= shape.rest.ticks:
            return RESTED, tick + 1, ""
        try:
            loop.step(tau.copy())
        except mujoco.FatalError as error:
            return BROKEN, tick + 1, str(error)
        speed = 0.0
        for i in range(model.nv):
            speed = speed + plant.qvel[i] * plant.qvel[i]
        failure = check_state(speed, shape.speed_limit_squared)
        if failure != GOING:
            return failure, tick + 1, ""
    return GOING, shape.ticks, ""
