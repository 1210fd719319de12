"""A whole controller alone: from the joints' angles and rates to their torques, without plant, judge and metrics.

A tick computes, as a robot's controller must, the forward kinematics, the inertia matrix D, the torques fg of gravity
and motion (all three by MuJoCo's functions for them), then the law, the Jacobian, its inverse and (2.2). States lie in
memory; 0 times the torques is added to the next state, so that each tick waits for the one before, as in `law`.
"""

import mujoco
import numpy as np

import tasks
from bench.control.resolved_acceleration import Buffers, control
from bench.engines import run_arm
from bench.engines.arm_episode import MOST
from bench.engines.binding import memory_of
from bench.engines.compiled import FOUR, MATRIX, compile_function, float64, int64, types
from bench.engines.native import arm as native
from bench.engines.native.libmujoco import library_function, mj_fullM, model_of
from bench.engines.native.pointers import address_of, matrix, vector
from bench.law.contender import AT_REST, PAPERS_GAINS, Contender, Gains, Goal
from bench.law.resolved_motion import Chain, Scratch
from bench.law.so3 import Rotation, from_quaternion
from bench.timing.benchmark import CONTROLLER, Benchmark
from tasks.base import Start

STATES, SWEEPS = 500, 4
"""Two thousand ticks a call, a millisecond and more."""

SPREAD, SPEED = 0.1, 0.5
"""Standard deviations of the joints' angles about the start's [rad], and of their rates [rad/s]."""

KINEMATICS = tuple(map(library_function, ("mj_kinematics", "mj_comPos", "mj_makeM", "mj_comVel", "mj_passive")))
mj_rne = library_function("mj_rne", types.intp, types.intp, types.int32, types.intp)


def controller(task: str, arm: str, one: Contender, start: Start) -> Benchmark:
    """The benchmark of a controller of an arm about a start."""
    model = model_of(tasks.task(task, arm).xml(1e-3), "euler")
    data = mujoco.MjData(model)
    work, arrays = native.workspace(model.nv)
    pointers, ticks = run_arm.pointers(one), SWEEPS * STATES
    tool = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_SITE, "tool")
    given = (
        *(pointers.assemble, pointers.resolve, native.view(model, data), work, one.rows, memory_of(one)),
        *(address_of(data.site_xpos[tool]), address_of(data.site_xmat[tool]), states(start)),
        *(PAPERS_GAINS.kp, PAPERS_GAINS.kv, SWEEPS),
    )
    loop = _loop()

    def call():
        return loop(*given), data, arrays  # the view holds addresses only: this keeps what they point to

    return Benchmark(CONTROLLER, one, "", ticks if call()[0] == 0.0 else 0, call, arm)


def states(start: Start) -> np.ndarray:
    """Seeded states, one a row: the joints' angles and rates, and the goal's quaternion, uniform on SO(3)."""
    random, n = np.random.default_rng(0), len(start.q)
    angles = np.array(start.q) + random.normal(scale=SPREAD, size=(STATES, n))
    goals = [goal.quat_wxyz for goal in tasks.start_set("uniform", STATES, 0)]
    return np.ascontiguousarray(np.hstack((angles, random.normal(scale=SPEED, size=(STATES, n)), goals)))


def _loop():
    """`loop(...)` -> the end of the chain: 0.0, or NaN if a torque was not finite."""
    mj_kinematics, mj_comPos, mj_makeM, mj_comVel, mj_passive = KINEMATICS

    def loop(assemble, resolve, view, work, rows, memory0, position, frame, states, kp, kv, sweeps):
        n, gains, memory, chain = view.n, Gains(kp, kv), memory0, 0.0
        qpos, qvel, p, r = vector(view.qpos, n), vector(view.qvel, n), vector(position, 3), vector(frame, 9)
        axes, anchors = matrix(view.axes, n, 3), matrix(view.anchors, n, 3)
        bias, passive, tau = vector(view.bias, n), vector(view.passive, n), vector(work.tau, n)
        D, fg, square = matrix(work.D, n, n), vector(work.fg, n), (MOST, MOST)
        A, B, V = matrix(work.A, *square), matrix(work.B, *square), matrix(work.V, *square)
        scratch = Scratch(A, B, V, vector(work.s, MOST), vector(work.t, MOST))
        buffers = Buffers(matrix(work.J, *square), vector(work.a, MOST), vector(work.x, MOST), tau, scratch)
        for _ in range(sweeps):
            for k in range(states.shape[0]):
                s = states[k]
                for i in range(n):
                    qpos[i], qvel[i] = s[i] + chain, s[n + i] + chain
                mj_kinematics(view.model, view.data)
                mj_comPos(view.model, view.data)
                mj_makeM(view.model, view.data)
                mj_fullM(view.model, view.data, work.D)
                mj_comVel(view.model, view.data)
                mj_passive(view.model, view.data)
                mj_rne(view.model, view.data, 0, view.bias)
                for i in range(n):
                    fg[i] = bias[i] - passive[i]
                R = Rotation((r[0], r[3], r[6]), (r[1], r[4], r[7]), (r[2], r[5], r[8]))
                at = (p[0], p[1], p[2])
                R_d = from_quaternion((s[2 * n], s[2 * n + 1], s[2 * n + 2], s[2 * n + 3]))
                _, memory = control(
                    assemble, resolve, 0, rows, Chain(n, axes, anchors, qvel, at, R), D, fg,
                    Goal(R_d, AT_REST, AT_REST), at, gains, memory, buffers,
                )  # fmt: skip
                total = 0.0
                for i in range(n):
                    total = total + tau[i]
                chain = 0.0 * total
        return chain

    signature = float64(
        *(types.FunctionType(one) for one in (native.ASSEMBLE, native.RESOLVE)),
        *(native.ARM_VIEW, native.WORKSPACE, int64, FOUR, int64, int64, MATRIX, float64, float64, int64),
    )
    return compile_function(loop, signature)
