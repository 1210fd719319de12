"""An arm in MuJoCo, the whole closed loop compiled: kinematics and dynamics by MuJoCo, the controller by us.

The loop is compiled once, for all arms and contenders: a contender comes as three functions that are called by
pointer. The order of a tick is dm_control's, as on the free body. The controller's model is the plant itself, or
another model of the same arm that is put into the plant's state at every tick (a study of model errors).
"""

from typing import NamedTuple

import mujoco
import numpy as np
from numba import float64, int64, types

from bench.control.resolved_acceleration import BY_JOINT, Buffers, control
from bench.engines.arm_episode import (
    MOST,
    PROBE_TICKS,
    STANDING,
    ArmSample,
    Controls,
    Joints,
    buffers,
    face_joints,
    load,
    probe,
    seven,
    squared,
)
from bench.engines.compiled import CURVES, FOUR, GAINS, GOAL, MATRIX, NUMBERS, ROTATION, THREE, compile_function
from bench.engines.curve import keep_on_arm
from bench.engines.episode import blamed, finish
from bench.engines.native.libmujoco import mj_fullM, mj_resetData, mj_step, mj_step1, mj_step2
from bench.engines.native.pointers import address_of, matrix, vector
from bench.law.contender import AT_REST, Gains, Goal
from bench.law.resolved_motion import Chain, Scratch
from bench.law.so3 import Rotation, from_quaternion
from tasks.truth import angle, haversine
from tasks.verdict import GOING, check_command, check_state, first_watch, watched


class ArmView(NamedTuple):
    """One mjData of an arm as compiled code takes it: addresses, and the numbers of joints and of sensor values."""

    model: int
    data: int
    is_runge_kutta: int
    n: int
    sensors: int
    qpos: int
    qvel: int
    ctrl: int
    sensordata: int
    bias: int
    passive: int
    axes: int
    anchors: int


class Workspace(NamedTuple):
    """Addresses of `Buffers`, of the scratch in them, and of D, fg and a Jacobian for the judge's look."""

    J: int
    a: int
    x: int
    tau: int
    A: int
    B: int
    V: int
    s: int
    t: int
    D: int
    fg: int
    G: int


VECTOR = float64[::1]
CHAIN = types.NamedTuple((int64, MATRIX, MATRIX, VECTOR, THREE, ROTATION), Chain)
SCRATCH = types.NamedTuple((MATRIX, MATRIX, MATRIX, VECTOR, VECTOR), Scratch)
ARM_VIEW = types.NamedUniTuple(int64, len(ArmView._fields), ArmView)
WORKSPACE = types.NamedUniTuple(int64, len(Workspace._fields), Workspace)
CONTROLS = types.NamedTuple((int64, int64, int64, float64), Controls)
JOINTS = types.NamedUniTuple(types.UniTuple(float64, MOST), len(Joints._fields), Joints)

ASSEMBLE = types.Tuple((THREE, FOUR))(CHAIN, GOAL, THREE, GAINS, FOUR, MATRIX, VECTOR)
RESOLVE = types.void(MATRIX, VECTOR, MATRIX, VECTOR, int64, int64, SCRATCH)
MARGIN = float64(ROTATION, ROTATION)
EPISODES = types.void(
    *(types.FunctionType(signature) for signature in (ASSEMBLE, RESOLVE, MARGIN)),
    *(ARM_VIEW, ARM_VIEW, WORKSPACE, CONTROLS, JOINTS, FOUR, MATRIX, MATRIX, NUMBERS, MATRIX, CURVES),
)


def view(model, data) -> ArmView:
    """The view of one simulation; `data` must outlive it."""
    arrays = (
        *(data.qpos, data.qvel, data.ctrl, data.sensordata, data.qfrc_bias, data.qfrc_passive),
        *(data.xaxis, data.xanchor),
    )
    return ArmView(
        model._address,
        data._address,
        int(model.opt.integrator == mujoco.mjtIntegrator.mjINT_RK4),
        model.nv,
        model.nsensordata,
        *map(address_of, arrays),
    )


def workspace(n: int) -> tuple[Workspace, tuple]:
    """Fresh buffers for n joints: their addresses, and the arrays, to be kept."""
    into = buffers(n)
    arrays = (*into[:4], *into.scratch, np.zeros((n, n)), np.zeros(n), np.zeros((MOST, MOST)))
    return Workspace(*map(address_of, arrays)), arrays


def episodes_of(observe):
    """The loop over episodes: `episodes(assemble, resolve, margin, plant, ..., rows, curves)` fills the last two."""

    def episodes(
        assemble, resolve, margin, plant, model, work, controls, joints, memory0, states, starts, numbers, rows, curves
    ):
        gains = Gains(numbers.kp, numbers.kv)
        dt, n = numbers.dt, plant.n
        qpos, qvel, ctrl, s = (
            vector(plant.qpos, n),
            vector(plant.qvel, n),
            vector(plant.ctrl, n),
            vector(plant.sensordata, plant.sensors),
        )
        axes, anchors = matrix(plant.axes, n, 3), matrix(plant.anchors, n, 3)
        model_qpos, model_qvel = vector(model.qpos, n), vector(model.qvel, n)
        bias, passive = vector(model.bias, n), vector(model.passive, n)
        D, fg, tau, G = matrix(work.D, n, n), vector(work.fg, n), vector(work.tau, n), matrix(work.G, MOST, MOST)
        scratch = Scratch(
            matrix(work.A, MOST, MOST),
            matrix(work.B, MOST, MOST),
            matrix(work.V, MOST, MOST),
            vector(work.s, MOST),
            vector(work.t, MOST),
        )
        buffers = Buffers(matrix(work.J, MOST, MOST), vector(work.a, MOST), vector(work.x, MOST), tau, scratch)
        for k in range(starts.shape[0]):
            start, row = starts[k], rows[k]
            quat_d = (start[7], start[8], start[9], start[10])
            R_d = from_quaternion(quat_d)
            goal = Goal(R_d, AT_REST, AT_REST)
            band = start[11]
            memory = memory0
            u = AT_REST
            mj_resetData(plant.model, plant.data)
            for i in range(n):
                qpos[i], qvel[i] = states[k, i], states[k, n + i]
            mj_step1(plant.model, plant.data)
            p_d = (s[16], s[17], s[18])
            q_d, to = states[k, 2 * n : 3 * n], 3 * n
            if states[k, to] == states[k, to]:
                p_d = (states[k, to], states[k, to + 1], states[k, to + 2])
            hav = haversine((s[12], s[13], s[14], s[15]), quat_d)
            turning = s[9] * s[9] + s[10] * s[10] + s[11] * s[11]
            watch = first_watch(hav, band, turning, numbers.slow_squared)
            tick = 0
            failure = GOING
            while tick < numbers.ticks and watch.quiet < numbers.hold_ticks:
                R = Rotation((s[0], s[1], s[2]), (s[3], s[4], s[5]), (s[6], s[7], s[8]))
                p = (s[16], s[17], s[18])
                chain = Chain(n, axes, anchors, qvel, p, R)
                if controls.has_own_model > 0:
                    for i in range(n):
                        model_qpos[i] = qpos[i]
                        model_qvel[i] = qvel[i] if controls.has_own_model != STANDING else 0.0
                    mj_step1(model.model, model.data)
                mj_fullM(model.model, model.data, work.D)
                for i in range(n):
                    fg[i] = bias[i] - passive[i]
                if controls.gives_torque == BY_JOINT:
                    face_joints(buffers.J, buffers.a, qpos, q_d, joints.inertia, n)
                before = u
                u, memory = control(
                    assemble, resolve, controls.gives_torque, controls.rows,
                    chain, D, fg, goal, p_d, gains, memory, buffers,
                )  # fmt: skip
                omega, torques = (s[9], s[10], s[11]), seven(tau, n)
                sample = ArmSample(
                    tick * dt, dt, R, hav, watch.entries > 0, watch.rest > 0, omega, u, before, margin(R, R_d), p, p_d,
                    seven(qpos, n), seven(qvel, n), torques, joints.lower, joints.upper, joints.rated,
                )  # fmt: skip
                observe(row, sample)
                keep_on_arm(curves, k, tick, sample)
                failure = check_command(load(torques, joints.rated), controls.torque_limit_squared)
                if tick % PROBE_TICKS == 0 or failure != GOING:
                    probe(row, chain, qpos, G, scratch)
                if failure != GOING:
                    break
                for i in range(n):
                    ctrl[i] = tau[i]
                if plant.is_runge_kutta:
                    mj_step(plant.model, plant.data)
                else:
                    mj_step2(plant.model, plant.data)
                mj_step1(plant.model, plant.data)
                tick += 1
                failure = check_state(squared(qvel, n), numbers.speed_limit_squared)
                if failure != GOING:
                    break
                hav = haversine((s[12], s[13], s[14], s[15]), quat_d)
                turning = s[9] * s[9] + s[10] * s[10] + s[11] * s[11]
                watch = watched(watch, tick, hav, band, turning, numbers.slow_squared)
            final = angle((s[12], s[13], s[14], s[15]), quat_d)
            speed, command = squared(qvel, n), u[0] * u[0] + u[1] * u[1] + u[2] * u[2]
            finish(row, blamed(failure, u), watch, tick, final, speed, command, numbers)

    return compile_function(episodes, EPISODES)
