"""A task in contact in MuJoCo, a whole episode compiled; MuJoCo's errors end the episode and nothing else.

The loop is compiled once, for all arms, tasks and controllers: a controller comes as a function that is called by
pointer. The order of a tick is dm_control's, as on the arm.
"""

from typing import NamedTuple

import mujoco
import numpy as np
from numba import float64, int64, types

from bench.control.hybrid import comply
from bench.control.setpoint import ContactBuffers, ContactParameters, Rows, Setpoint
from bench.engines.arm_episode import MOST
from bench.engines.compiled import MATRIX, compile_function, register
from bench.engines.contact_episode import (
    BROKEN,
    RESTED,
    Numbers,
    overload,
    sensed,
    sensors_of,
    setpoint,
    wrench,
    write_record,
)
from bench.engines.native.arm import CHAIN, GAINS, ROTATION, THREE, VECTOR
from bench.engines.native.libmujoco import mj_fullM
from bench.engines.native.pointers import address_of, integers, matrix, vector
from bench.engines.native.trapped import BEGIN, RUNGE_KUTTA, STEP, step
from bench.law.resolved_motion import Chain, Scratch
from bench.law.scalar import sqrt
from bench.law.so3 import Rotation, from_quaternion
from tasks.contact import MOST_LEGS, leg
from tasks.contact_rest import RestNumbers, has_left
from tasks.verdict import GOING, check_command, check_state


class ContactView(NamedTuple):
    """One mjData of a contact task as compiled code takes it: addresses and sizes.

    nv: degrees of freedom, the arm's n first; gap, turned: places among the sensor values, -1 if there is none.
    asked: three integers that say what to step (see `trapped`).
    """

    model: int
    data: int
    is_runge_kutta: int
    n: int
    nv: int
    sensors: int
    gap: int
    turned: int
    batch: int
    callback: int
    asked: int
    push: int
    qvel: int
    ctrl: int
    sensordata: int
    bias: int
    passive: int
    axes: int
    anchors: int


class Workspace(NamedTuple):
    """Addresses of the buffers of `Rows` and `ContactBuffers`, and of J, D (nv x nv), fg, tau, legs, noise.

    legs: the trial's pushes. noise: the sensor's, ticks x 6.
    """

    a: int
    drift: int
    F: int
    h: int
    v: int
    y: int
    b: int
    x: int
    held: int
    A: int
    B: int
    V: int
    s: int
    t: int
    J: int
    D: int
    fg: int
    tau: int
    legs: int
    noise: int


SIX = types.UniTuple(float64, 6)
SEVEN = types.UniTuple(float64, MOST)
WISH = types.NamedTuple((ROTATION, THREE, THREE, THREE, THREE), Setpoint)
TOUCH = types.NamedUniTuple(float64, len(ContactParameters._fields), ContactParameters)
ROWS = types.NamedUniTuple(VECTOR, len(Rows._fields), Rows)
FOUR = types.UniTuple(float64, 4)
REST = types.NamedTuple((int64, int64, float64, float64), RestNumbers)
NUMBERS = types.NamedTuple(
    (float64, int64, int64, float64, float64, SIX, FOUR, THREE, THREE, THREE, SEVEN, int64, float64, int64, REST),
    Numbers,
)
VIEW = types.NamedUniTuple(int64, len(ContactView._fields), ContactView)
WORKSPACE = types.NamedUniTuple(int64, len(Workspace._fields), Workspace)
ASSEMBLE = types.void(CHAIN, WISH, THREE, THREE, GAINS, TOUCH, MATRIX, ROWS)
RESULT = types.UniTuple(int64, 2)
EPISODE = RESULT(types.FunctionType(ASSEMBLE), VIEW, WORKSPACE, NUMBERS, GAINS, TOUCH, MATRIX)


def view(model, data, batch, callback: int, asked: np.ndarray, n: int) -> ContactView:
    """The view of one simulation; `data`, `batch` and `asked` must outlive it."""
    asked[:2] = model._address, data._address
    arrays = (data.qvel, data.ctrl, data.sensordata, data.qfrc_bias, data.qfrc_passive, data.xaxis, data.xanchor)
    gap, turned = sensors_of(model)
    return ContactView(
        model._address,
        data._address,
        int(model.opt.integrator == mujoco.mjtIntegrator.mjINT_RK4),
        n,
        model.nv,
        model.nsensordata,
        gap,
        turned,
        batch.address,
        callback,
        address_of(asked),
        address_of(data.xfrc_applied[model.body("hand").id]),
        *map(address_of, arrays),
    )


def workspace(rows: Rows, room: ContactBuffers, nv: int, n: int, noise: np.ndarray) -> tuple[Workspace, tuple]:
    """The addresses of a controller's buffers, and the arrays, to be kept."""
    arrays = (
        *rows, room.y, room.b, room.x, room.held, *room.scratch,
        np.zeros((6, MOST)), np.zeros((nv, nv)), np.zeros(n), np.zeros(n), np.zeros((MOST_LEGS, 6)), noise,
    )  # fmt: skip
    return Workspace(*map(address_of, arrays)), arrays


def episode_loop(cache: bool = True):
    """The loop over one episode: `episode(assemble, sim, work, numbers, gains, touch, record)` -> (failure, ticks)."""

    def episode(assemble, sim, work, numbers, gains, touch, record):
        n, nv, dt = sim.n, sim.nv, numbers.dt
        qvel, ctrl, s = vector(sim.qvel, nv), vector(sim.ctrl, n), vector(sim.sensordata, sim.sensors)
        axes, anchors = matrix(sim.axes, nv, 3), matrix(sim.anchors, nv, 3)
        bias, passive = vector(sim.bias, nv), vector(sim.passive, nv)
        J, D, fg, tau = matrix(work.J, 6, MOST), matrix(work.D, nv, nv), vector(work.fg, n), vector(work.tau, n)
        push, legs = vector(sim.push, 6), matrix(work.legs, MOST_LEGS, 6)
        noise = matrix(work.noise, numbers.ticks, 6)
        rows = Rows(vector(work.a, 6), vector(work.drift, 6), vector(work.F, 6), vector(work.h, 6), vector(work.v, 6))
        scratch = Scratch(
            matrix(work.A, MOST, MOST), matrix(work.B, MOST, MOST), matrix(work.V, MOST, MOST),
            vector(work.s, MOST), vector(work.t, MOST),
        )  # fmt: skip
        room = ContactBuffers(
            vector(work.y, MOST), vector(work.b, MOST), vector(work.x, MOST), matrix(work.held, 6, MOST), scratch
        )
        asked = integers(sim.asked, 3)
        asked[2] = BEGIN
        if step(sim.batch, sim.callback, sim.asked) > 0:
            return BROKEN, 0
        asked[2] = RUNGE_KUTTA if sim.is_runge_kutta else STEP
        R_d, p_0 = from_quaternion(numbers.quat_d), (s[16], s[17], s[18])
        place, frame, since = p_0, R_d, 0
        for tick in range(numbers.ticks):
            time = tick * dt
            R = Rotation((s[0], s[1], s[2]), (s[3], s[4], s[5]), (s[6], s[7], s[8]))
            p, omega = (s[16], s[17], s[18]), (s[9], s[10], s[11])
            f, m = wrench(R, s)
            f_seen, m_seen = sensed(f, m, record, tick, numbers.delay, noise)
            wanted = setpoint(R_d, p_0, numbers, time)
            mj_fullM(sim.model, sim.data, work.D)
            for i in range(n):
                fg[i] = bias[i] - passive[i]
            chain = Chain(n, axes, anchors, qvel, p, R)
            assemble(chain, wanted, f_seen, m_seen, gains, touch, J, rows)
            comply(numbers.form, numbers.held, chain, D, fg, J, rows, gains, touch, room, tau)
            total, largest = overload(tau, numbers.rated, n)
            gap = s[sim.gap] if sim.gap >= 0 else 0.0
            turned = s[sim.turned] if sim.turned >= 0 else 0.0
            write_record(record[tick], time, R, omega, p, f, m, gap, turned, sqrt(largest))
            failure = check_command(total, numbers.torque_limit_squared)
            if failure != GOING:
                return failure, tick + 1
            if has_left(numbers.rest, tick, p, R, place, frame):
                place, frame, since = p, R, tick
            elif numbers.rest.ticks > 0 and tick - since >= numbers.rest.ticks:
                return RESTED, tick + 1
            for i in range(n):
                ctrl[i] = tau[i]
            now = leg(numbers.legs, tick, numbers.ticks)
            for i in range(6):
                push[i] = legs[now, i]
            if step(sim.batch, sim.callback, sim.asked) > 0:
                return BROKEN, tick + 1
            speed = 0.0
            for i in range(nv):
                speed = speed + qvel[i] * qvel[i]
            failure = check_state(speed, numbers.speed_limit_squared)
            if failure != GOING:
                return failure, tick + 1
        return GOING, numbers.ticks

    register(leg)
    register(has_left)
    return compile_function(episode, EPISODE, cache)
