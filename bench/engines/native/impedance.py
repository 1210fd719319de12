"""The loop over episodes of an arm under an impedance that shapes no inertia, with an account of its energy.

    V(t) - V(0) = -damped - elbow + added          V = qdot^T M qdot/2 + U

damped: of the hand's damping; elbow: of the null space's; added: by what is compensated beside gravity, or taken by
friction that is not. Torques are held over a tick, in which the joints go on by the mean of their rates at its ends.
"""

from typing import NamedTuple

import numpy as np
from numba import float64, int64, types

from bench.contenders.jacobians.geometric import fill
from bench.control.unshaped import apparent_inertia, damp_elbow
from bench.engines.arm_episode import MOST, squared
from bench.engines.compiled import EVALUATE, FOUR, MATRIX, NUMBERS, compile_function
from bench.engines.episode import FIRST_METRIC, blamed, blank, finish
from bench.engines.native.arm import ARM_VIEW, SCRATCH, VECTOR, WORKSPACE
from bench.engines.native.libmujoco import mj_fullM, mj_resetData, mj_step1, mj_step2
from bench.engines.native.pointers import matrix, vector
from bench.law.chain import twist
from bench.law.contender import AT_REST, Gains, Goal
from bench.law.linalg import multiply, multiply_transposed
from bench.law.resolved_motion import Chain, Scratch
from bench.law.scalar import sqrt
from bench.law.so3 import Rotation, dot, from_quaternion, minus
from tasks.truth import angle, haversine
from tasks.verdict import GOING, check_command, check_state, first_watch, watched

OVERSHOOT, OFF, LEFT, STRAIN, KINETIC, DAMPED, ELBOW, ADDED = range(FIRST_METRIC, FIRST_METRIC + 8)
"""A row's columns after the judge's: greatest component of the error of orientation against its first direction, over
its first length; greatest and last distance of the tool from its place [m]; greatest torque over the rated one; kinetic
energy at the end [J]; and of the energy's account what is damped, lost in the elbow and added [J]."""


class Springs(NamedTuple):
    """Stiffness of translation [N/m] and of turns [N m/rad], the ratio that is asked for, and what is compensated.

    is_whole: 1 if Coriolis torques and friction are compensated with gravity, 0 if gravity alone is.
    """

    translation: float
    rotation: float
    zeta: float
    is_whole: int


SPRINGS = types.NamedTuple((float64, float64, float64, int64), Springs)
DESIGN = types.void(VECTOR, MATRIX, float64, MATRIX, SCRATCH)
EPISODES = types.void(
    *(types.FunctionType(signature) for signature in (EVALUATE, DESIGN)),
    *(FOUR, ARM_VIEW, ARM_VIEW, WORKSPACE, SPRINGS, VECTOR, MATRIX, MATRIX, NUMBERS, MATRIX, MATRIX),
)


def blank_rows(count: int) -> np.ndarray:
    """Rows to be filled."""
    return np.hstack((blank(count, ()), np.zeros((count, 8))))


def episodes_of():
    """The loop: `episodes(evaluate, design, memory0, plant, still, work, springs, rated, ..., rows, ends)`.

    plant, still: the arm, and another that stands where it is, which is asked for gravity. states: of each start q,
    qdot, then where the tool shall be [m], NaN where it is. ends: q and qdot at the end.
    """

    def episodes(evaluate, design, memory0, plant, still, work, springs, rated, states, starts, numbers, rows, ends):
        gains, n, dt = Gains(numbers.kp, numbers.kv), plant.n, numbers.dt
        q, qdot, ctrl = vector(plant.qpos, n), vector(plant.qvel, n), vector(plant.ctrl, n)
        s, bias, passive = vector(plant.sensordata, plant.sensors), vector(plant.bias, n), vector(plant.passive, n)
        still_q, gravity = vector(still.qpos, n), vector(still.bias, n)
        axes, anchors = matrix(plant.axes, n, 3), matrix(plant.anchors, n, 3)
        M, J, Lambda = matrix(work.D, n, n), matrix(work.J, MOST, MOST), matrix(work.G, MOST, MOST)
        scratch = Scratch(
            matrix(work.A, MOST, MOST), matrix(work.B, MOST, MOST), matrix(work.V, MOST, MOST),
            vector(work.s, MOST), vector(work.t, MOST),
        )  # fmt: skip
        x, w, tau = vector(work.x, MOST), vector(work.a, MOST), vector(work.tau, n)
        D, K = np.zeros((MOST, MOST)), np.zeros(6)
        v, e, damp, elbow, added, before = np.zeros(6), np.zeros(6), np.zeros(n), np.zeros(n), np.zeros(n), np.zeros(n)
        for i in range(3):
            K[i], K[3 + i] = springs.translation, springs.rotation
        for k in range(starts.shape[0]):
            start, row = starts[k], rows[k]
            quat_d = (start[7], start[8], start[9], start[10])
            goal = Goal(from_quaternion(quat_d), AT_REST, AT_REST)
            band, memory, u = start[11], memory0, AT_REST
            mj_resetData(plant.model, plant.data)
            for i in range(n):
                q[i], qdot[i] = states[k, i], states[k, n + i]
            mj_step1(plant.model, plant.data)
            p_d = (s[16], s[17], s[18])
            if states[k, 2 * n] == states[k, 2 * n]:
                p_d = (states[k, 2 * n], states[k, 2 * n + 1], states[k, 2 * n + 2])
            hav = haversine((s[12], s[13], s[14], s[15]), quat_d)
            turning = s[9] * s[9] + s[10] * s[10] + s[11] * s[11]
            watch = first_watch(hav, band, turning, numbers.slow_squared)
            tick, failure, first = 0, GOING, AT_REST
            while tick < numbers.ticks and watch.quiet < numbers.hold_ticks:
                R = Rotation((s[0], s[1], s[2]), (s[3], s[4], s[5]), (s[6], s[7], s[8]))
                p = (s[16], s[17], s[18])
                chain = Chain(n, axes, anchors, qdot, p, R)
                for i in range(n):
                    still_q[i] = q[i]
                mj_step1(still.model, still.data)
                mj_fullM(plant.model, plant.data, work.D)
                fill(J, chain)
                apparent_inertia(J, M, Lambda, n, scratch)
                design(K, Lambda, springs.zeta, D, scratch)
                u, memory, _ = evaluate(R, AT_REST, goal, gains, memory)
                pdot, omega = twist(chain)
                away = minus(p_d, p)
                for i in range(3):
                    e[i], e[3 + i] = springs.translation * away[i], springs.rotation * u[i] / gains.kp
                    v[i], v[3 + i] = pdot[i], omega[i]
                multiply(D, v, w, 6, 6)
                multiply_transposed(J, w, damp, 6, n)
                multiply_transposed(J, e, tau, 6, n)
                if n > 6:
                    damp_elbow(J, M, Lambda, qdot, v, n, w, x, elbow)
                total = 0.0
                for i in range(n):
                    beside = bias[i] - passive[i] - gravity[i]
                    added[i] = beside + passive[i] if springs.is_whole > 0 else passive[i]
                    tau[i] += gravity[i] + elbow[i] - damp[i] + (beside if springs.is_whole > 0 else 0.0)
                    ratio, before[i] = tau[i] / rated[i], qdot[i]
                    total = total + ratio * ratio
                    size = sqrt(ratio * ratio)
                    row[STRAIN] = size if size > row[STRAIN] else row[STRAIN]
                if tick == 0:
                    first = u
                against = -dot(u, first)
                if against > row[OVERSHOOT] * dot(first, first):
                    row[OVERSHOOT] = against / dot(first, first)
                off = sqrt(dot(away, away))
                row[OFF] = off if off > row[OFF] else row[OFF]
                failure = check_command(total, numbers.command_limit_squared)
                if failure != GOING:
                    break
                for i in range(n):
                    ctrl[i] = tau[i]
                mj_step2(plant.model, plant.data)
                mj_step1(plant.model, plant.data)
                tick += 1
                failure = check_state(squared(qdot, n), numbers.speed_limit_squared)
                if failure != GOING:
                    break
                for i in range(n):
                    turned = 0.5 * dt * (before[i] + qdot[i])
                    row[DAMPED] += damp[i] * turned
                    row[ELBOW] -= elbow[i] * turned
                    row[ADDED] += added[i] * turned
                hav = haversine((s[12], s[13], s[14], s[15]), quat_d)
                turning = s[9] * s[9] + s[10] * s[10] + s[11] * s[11]
                watch = watched(watch, tick, hav, band, turning, numbers.slow_squared)
            mj_fullM(plant.model, plant.data, work.D)
            multiply(M, qdot, tau, n, n)
            row[KINETIC], away = 0.0, minus(p_d, (s[16], s[17], s[18]))
            row[LEFT] = sqrt(dot(away, away))
            for i in range(n):
                row[KINETIC] += 0.5 * qdot[i] * tau[i]
                ends[k, i], ends[k, n + i] = q[i], qdot[i]
            final, size = angle((s[12], s[13], s[14], s[15]), quat_d), dot(u, u)
            finish(row, blamed(failure, u), watch, tick, final, squared(qdot, n), size, numbers)

    return compile_function(episodes, EPISODES)
