"""The free body in MuJoCo: the dm_control loop bit for bit, without Python in it where it is compiled.

The order is dm_control's with legacy_step=True: mj_step1 | law | mj_step2, mj_step1 | law | ... (with Runge-Kutta
mj_step in place of mj_step2, which would silently be Euler). mjData's arrays never move, so plain views of them go
into the loop; no struct offset is needed.

Where MuJoCo's <orientation> actuator makes the command, ctrl is the goal; mj_fwdActuation shows the command before
the step, which computes it again (and under Runge-Kutta three times more within the tick).
"""

import math
from typing import NamedTuple

import mujoco
import numpy as np

from bench.engines.compiled import MATRIX, float64, int64, types
from bench.engines.controllers import ACCELERATION, accelerate
from bench.engines.loop import Act, Plant, episodes_of, pass_on, sampled
from bench.engines.native.libmujoco import mj_fwdActuation, mj_resetData, mj_step, mj_step1, mj_step2
from bench.law.contender import AT_REST, Goal
from bench.law.scalar import kernel
from bench.law.so3 import Rotation, dot, from_quaternion, rotate
from tasks.truth import angle, haversine
from tasks.verdict import check_command, check_state


class View(NamedTuple):
    """One mjData as compiled code sees it: addresses, views of arrays that never move, and the starts' states."""

    model: int
    data: int
    is_runge_kutta: int
    has_servo: int
    qpos: np.ndarray
    qvel: np.ndarray
    ctrl: np.ndarray
    qfrc_actuator: np.ndarray
    sensordata: np.ndarray
    states: np.ndarray


VIEW = types.NamedTuple((int64, int64, int64, int64, *[float64[::1]] * 5, MATRIX), View)


class Sensed(NamedTuple):
    """What the sensors say, and the goal."""

    R: Rotation
    omega: tuple
    goal: Goal


class State(NamedTuple):
    """Where the body shall be; the rest is MuJoCo's."""

    quat_d: tuple
    goal: Goal


def view(model, data, states: np.ndarray) -> View:
    """Return the view of one simulation; `data` must outlive it."""
    return View(
        model._address,
        data._address,
        int(model.opt.integrator == mujoco.mjtIntegrator.mjINT_RK4),
        int(model.actuator_gaintype[0] == mujoco.mjtGain.mjGAIN_SO3),
        data.qpos,
        data.qvel,
        data.ctrl,
        data.qfrc_actuator,
        data.sensordata,
        states,
    )


@kernel
def reset(body, k, start):
    """Place the body at a start."""
    nq = body.qpos.shape[0]
    mj_resetData(body.model, body.data)
    for i in range(nq):
        body.qpos[i] = body.states[k, i]
    for i in range(body.qvel.shape[0]):
        body.qvel[i] = body.states[k, nq + i]
    mj_step1(body.model, body.data)
    quat_d = (start[7], start[8], start[9], start[10])
    return State(quat_d, Goal(from_quaternion(quat_d), AT_REST, AT_REST))


@kernel
def sense(body, state):
    """Read the sensors."""
    s = body.sensordata
    R = Rotation((s[0], s[1], s[2]), (s[3], s[4], s[5]), (s[6], s[7], s[8]))
    return Sensed(R, (s[9], s[10], s[11]), state.goal)


@kernel
def speed_squared(body):
    """Compute the squared angular speed from the sensors."""
    s = body.sensordata
    return s[9] * s[9] + s[10] * s[10] + s[11] * s[11]


@kernel
def look(body, state, tick, numbers):
    """Compare the body with its goal."""
    s = body.sensordata
    return state, haversine((s[12], s[13], s[14], s[15]), state.quat_d), speed_squared(body)


@kernel
def command(laws, body, desk, state, sensed, now, gains, memory, numbers):
    """Command what the law says, or read what MuJoCo's actuator will do."""
    if body.has_servo:
        body.ctrl[0], body.ctrl[1], body.ctrl[2], body.ctrl[3] = state.quat_d
        mj_fwdActuation(body.model, body.data)
        f = body.qfrc_actuator
        u = rotate(sensed.R, (f[0], f[1], f[2]))
        squared = dot(u, u)
        return Act(u, u, squared, math.nan, check_command(squared, numbers.command_limit_squared)), memory
    return accelerate(laws, body, desk, state, sensed, now, gains, memory, numbers)


@kernel
def advance(laws, body, desk, state, act, gains, memory, numbers):
    """Let MuJoCo step."""
    if not body.has_servo:
        body.ctrl[0], body.ctrl[1], body.ctrl[2] = act.u
    if body.is_runge_kutta:
        mj_step(body.model, body.data)
    else:
        mj_step2(body.model, body.data)
    mj_step1(body.model, body.data)
    return state, memory


@kernel
def check(body, state, numbers):
    """End an episode that diverges."""
    return check_state(speed_squared(body), numbers.speed_limit_squared)


@kernel
def end(body, state):
    """Measure the last angle and speed."""
    s = body.sensordata
    return angle((s[12], s[13], s[14], s[15]), state.quat_d), speed_squared(body)


FREE_BODY = Plant(pass_on, reset, sense, look, advance, check, end)


def loop_of(observe):
    """Return the loop of the free body, for all laws."""
    return episodes_of(FREE_BODY, ACCELERATION._replace(command=command), sampled(observe))
