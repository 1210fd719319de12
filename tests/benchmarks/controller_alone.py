"""A whole controller alone: from the joints' angles and rates to their torques.

A tick computes, as a robot's controller must, the forward kinematics, the inertia matrix D, the
torques fg of gravity and motion (all three by MuJoCo's functions for them), then the law, the
Jacobian, its inverse and (2.2), without plant, judge and metrics. States lie in memory; 0 times the
torques is added to the next state, so that each tick waits for the one before, as in `law_alone`.
"""

from typing import NamedTuple

import mujoco
import numpy as np
from numba import types

import tasks
from bench.engines import simulate_arms
from bench.engines.arrays import Vector
from bench.engines.binding import memory_of
from bench.engines.compiled import bind, compile_on_demand
from bench.engines.counting.states import BOUND_OVER_KP
from bench.engines.mujoco_view import Simulated, compiled_view
from bench.engines.native.libmujoco import library_function, mj_fullM, model_of
from bench.engines.plants.arm import ArmWork
from bench.engines.plants.arm import work as arm_work
from bench.engines.typed import pass_by_reference
from bench.law.chain import Chain
from bench.law.contender import Contender
from bench.law.control.resolved_acceleration import control
from bench.law.inputs import AT_REST, PAPERS_GAINS, Goal, Tuning
from bench.law.so3 import Rotation, from_quaternion
from benchmarks.subject import CONTROLLER, Subject
from tasks.base import Start

STATES = 500
SWEEPS = 4
"""Two thousand ticks a call, a millisecond and more."""

SPREAD = 0.1
"""Standard deviation of the joints' angles about the start's [rad]."""

SPEED = 0.5
"""Standard deviation of the joints' rates [rad/s]."""

NAMES = ("mj_kinematics", "mj_comPos", "mj_makeM", "mj_comVel", "mj_passive")
KINEMATICS = tuple(library_function(name) for name in NAMES)
mj_rne = library_function("mj_rne", types.intp, types.intp, types.int32, types.intp)


class World(NamedTuple):
    """An arm, buffers, and the place and frame of its tool."""

    sim: Simulated
    work: ArmWork
    position: Vector
    frame: Vector


def make_world(task: str, arm: str) -> tuple[World, mujoco.MjData]:
    """Return the world of a controller, and the data that it holds addresses of."""
    model = model_of(tasks.task(task, arm).xml(1e-3), "euler")
    data = mujoco.MjData(model)
    tool = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_SITE, "tool")
    world = World(
        sim=compiled_view(model, data),
        work=arm_work(model.nv),
        position=data.site_xpos[tool],
        frame=data.site_xmat[tool],
    )
    return world, data


def controller_alone(task: str, arm: str, contender: Contender, start: Start) -> Subject:
    """Return the subject of a controller of an arm about a start."""
    world, data = make_world(task, arm)
    assemble, resolve, _ = simulate_arms.pointers(contender)
    about_start = states(start)
    in_order = about_start.copy()
    memory = memory_of(contender)
    kp, kv = PAPERS_GAINS.kp, PAPERS_GAINS.kv
    loop = compile_loop()

    run = bind(loop, assemble, resolve, world, contender.rows, memory, about_start, kp, kv, SWEEPS)

    def call():
        return run(), world, data

    def shuffle(number: int) -> None:
        # As for a law alone: else the processor learns the branches.
        order = np.random.default_rng(number).permutation(STATES)
        about_start[:] = in_order[order]

    chain, _, _ = call()
    ticks = SWEEPS * STATES if chain == 0.0 else 0
    return Subject(CONTROLLER, call, ticks, contender, arm=arm, prepare=shuffle)


def states(start: Start) -> np.ndarray:
    """Return seeded states, one a row: the joints' angles and rates, and the goal's quaternion.

    Goals are uniform on SO(3); shape (STATES, 2 n + 4) with n joints.
    """
    random = np.random.default_rng(0)
    shape = (STATES, len(start.q))
    angles = np.array(start.q) + random.normal(scale=SPREAD, size=shape)
    rates = random.normal(scale=SPEED, size=shape)
    goals = [goal.quat_wxyz for goal in tasks.start_set("uniform", STATES, 0)]
    return np.ascontiguousarray(np.hstack((angles, rates, goals)))


def compile_loop():
    """Return `loop(...)` -> the end of the chain: 0.0, or NaN if a torque was not finite."""
    mj_kinematics, mj_comPos, mj_makeM, mj_comVel, mj_passive = KINEMATICS

    def loop(assemble, resolve, world, rows, memory0, states, kp, kv, sweeps):
        body = pass_by_reference(world)
        view = body.sim
        p = body.position
        r = body.frame
        memory = memory0
        chain = 0.0
        gains = Tuning(kp, kv, BOUND_OVER_KP * kp, 0.0)
        n = view.n
        qpos = view.qpos
        qvel = view.qvel
        buffers = body.work.buffers
        D = body.work.D
        fg = body.work.fg
        for _ in range(sweeps):
            for k in range(states.shape[0]):
                s = states[k]
                for i in range(n):
                    qpos[i] = s[i] + chain
                    qvel[i] = s[n + i] + chain
                mj_kinematics(view.model, view.data)
                mj_comPos(view.model, view.data)
                mj_makeM(view.model, view.data)
                mj_fullM(view.model, view.data, D.ctypes.data)
                mj_comVel(view.model, view.data)
                mj_passive(view.model, view.data)
                mj_rne(view.model, view.data, 0, view.qfrc_bias.ctypes.data)
                for i in range(n):
                    fg[i] = view.qfrc_bias[i] - view.qfrc_passive[i]
                R = Rotation((r[0], r[3], r[6]), (r[1], r[4], r[7]), (r[2], r[5], r[8]))
                at = (p[0], p[1], p[2])
                R_d = from_quaternion((s[2 * n], s[2 * n + 1], s[2 * n + 2], s[2 * n + 3]))
                _, memory = control(
                    assemble,
                    resolve,
                    0,
                    rows,
                    Chain(n, view.xaxis, view.xanchor, qvel, at, R),
                    D,
                    fg,
                    Goal(R_d, AT_REST, AT_REST),
                    at,
                    gains,
                    memory,
                    buffers,
                )
                total = 0.0
                for i in range(n):
                    total = total + buffers.tau[i]
                chain = 0.0 * total
        return chain

    return compile_on_demand(loop, is_kept=True)
