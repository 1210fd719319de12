"""The loop over episodes of an arm commanded by joint rates, which its servos follow at once or with a first-order lag.

Kinematics are MuJoCo's, the joints' motion the judge's exact step: there is no dynamics. The controller resolves
(K (p_d - p), omega) by the geometric Jacobian and an inverse, with the identity for D.
"""

from numba import types

from bench.contenders.jacobians.geometric import fill
from bench.control.velocity import velocity
from bench.engines.arm_episode import squared
from bench.engines.compiled import EVALUATE, FOUR, MATRIX, NUMBERS, compile_function
from bench.engines.episode import blamed, finish
from bench.engines.native.arm import ARM_VIEW, RESOLVE, WORKSPACE
from bench.engines.native.libmujoco import mj_resetData, mj_step1
from bench.engines.native.pointers import matrix, vector
from bench.engines.velocity import LIMIT, OFF, PACE, PATH, RATE, see
from bench.law.contender import AT_REST, Gains, Goal
from bench.law.resolved_motion import Chain, Scratch
from bench.law.scalar import sqrt
from bench.law.so3 import Rotation, from_quaternion
from tasks.truth import angle, haversine
from tasks.velocity import followed
from tasks.verdict import GOING, check_command, first_watch, watched

EPISODES = types.void(
    *(types.FunctionType(signature) for signature in (EVALUATE, LIMIT, RESOLVE)),
    *(FOUR, ARM_VIEW, WORKSPACE, MATRIX, MATRIX, PACE, NUMBERS, MATRIX),
)


def episodes_of():
    """The loop: `episodes(evaluate, limit, resolve, memory0, plant, work, states, starts, pace, numbers, rows)`.

    states: of each start q, then where the tool shall be [m]; NaN where it is.
    """

    def episodes(evaluate, limit, resolve, memory0, plant, work, states, starts, pace, numbers, rows):
        gains, n = Gains(numbers.kp, numbers.kv), plant.n
        q, qdot = vector(plant.qpos, n), vector(plant.qvel, n)
        s = vector(plant.sensordata, plant.sensors)
        axes, anchors = matrix(plant.axes, n, 3), matrix(plant.anchors, n, 3)
        identity, J, a, x = matrix(work.D, n, n), matrix(work.J, 7, 7), vector(work.a, 7), vector(work.x, 7)
        scratch = Scratch(
            matrix(work.A, 7, 7), matrix(work.B, 7, 7), matrix(work.V, 7, 7), vector(work.s, 7), vector(work.t, 7)
        )
        for i in range(n):
            for j in range(n):
                identity[i, j] = 1.0 if i == j else 0.0
        for k in range(starts.shape[0]):
            start, row = starts[k], rows[k]
            quat_d = (start[7], start[8], start[9], start[10])
            goal = Goal(from_quaternion(quat_d), AT_REST, AT_REST)
            band, memory, u = start[11], memory0, AT_REST
            mj_resetData(plant.model, plant.data)
            for i in range(n):
                q[i], qdot[i] = states[k, i], 0.0
            mj_step1(plant.model, plant.data)
            p_d = (s[16], s[17], s[18])
            if states[k, n] == states[k, n]:
                p_d = (states[k, n], states[k, n + 1], states[k, n + 2])
            quat = (s[12], s[13], s[14], s[15])
            hav = haversine(quat, quat_d)
            watch = first_watch(hav, band, 0.0, numbers.slow_squared)
            tick, failure, speed = 0, GOING, 0.0
            row[OFF] = 0.0
            while tick < numbers.ticks and watch.quiet < numbers.hold_ticks:
                R = Rotation((s[0], s[1], s[2]), (s[3], s[4], s[5]), (s[6], s[7], s[8]))
                p = (s[16], s[17], s[18])
                u, memory, _ = evaluate(R, AT_REST, goal, gains, memory)
                asked, omega = velocity(limit, u, pace.K, gains.kp)
                see(row, hav, asked, omega)
                off = 0.0
                for i in range(3):
                    a[i] = pace.K * (p_d[i] - p[i])
                    a[3 + i] = omega[i]
                    off = off + (p_d[i] - p[i]) * (p_d[i] - p[i])
                fill(J, Chain(n, axes, anchors, qdot, p, R))
                resolve(J, a, identity, x, 6, n, scratch)
                rate = squared(x, n)
                failure = check_command(rate, numbers.speed_limit_squared)
                row[OFF] = sqrt(off) if sqrt(off) > row[OFF] else row[OFF]
                if failure != GOING:
                    break
                row[RATE] = sqrt(rate) if sqrt(rate) > row[RATE] else row[RATE]
                for i in range(n):
                    angle_turned, rate_after = followed(qdot[i], x[i], pace)
                    q[i] += angle_turned
                    qdot[i] = rate_after
                mj_step1(plant.model, plant.data)
                before, quat = quat, (s[12], s[13], s[14], s[15])
                row[PATH] += angle(before, quat)
                tick += 1
                hav = haversine(quat, quat_d)
                speed = s[9] * s[9] + s[10] * s[10] + s[11] * s[11]
                watch = watched(watch, tick, hav, band, speed, numbers.slow_squared)
            size = u[0] * u[0] + u[1] * u[1] + u[2] * u[2]
            finish(row, blamed(failure, u), watch, tick, angle(quat, quat_d), squared(qdot, n), size, numbers)

    return compile_function(episodes, EPISODES)
