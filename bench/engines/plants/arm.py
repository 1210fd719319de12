"""An arm in MuJoCo, kinematics and dynamics by MuJoCo, the controller by us.

The loop is compiled once, for all arms and contenders. The controller's model is the plant itself, or another model of
the same arm that is put into the plant's state at every tick (a study of model errors).
"""

import math
from typing import NamedTuple

import numpy as np

from bench.engines import arm_episode
from bench.engines.arrays import Matrix, Vector
from bench.engines.curve import keep_on_arm
from bench.engines.loop import Action, Controller, Plant, Record, Sensed, begin, episodes_of
from bench.engines.mujoco_view import Simulated, compute, fill_inertia, place, step
from bench.engines.plants.free_body import measure, quaternion
from bench.law.chain import Chain
from bench.law.control.resolved_acceleration import BY_JOINT, Buffers, control
from bench.law.inputs import AT_REST, Goal
from bench.law.scalar import kernel
from bench.law.so3 import Rotation, dot, from_quaternion
from tasks.truth import haversine
from tasks.verdict import GOING, check_command


class ArmWork(NamedTuple):
    """What a controller writes into: its buffers, D, fg, a Jacobian for the judge's look, and torques that are sent."""

    buffers: Buffers
    D: Matrix
    fg: Vector
    G: Matrix
    sent: Matrix


class ArmWorld(NamedTuple):
    """The plant, of each start its state (`arm_episode.states`), the controller's model and what belongs to it."""

    sim: Simulated
    states: Matrix
    model: Simulated
    work: ArmWork
    controls: arm_episode.Controls
    joints: arm_episode.Joints


class ArmPlantState(NamedTuple):
    """Hold the goal of the tool; the rest is MuJoCo's. path: angle of its last rotation [rad], where it is recorded."""

    quat_d: tuple
    goal: Goal
    p_d: tuple
    path: float


class Tool(NamedTuple):
    """Hold the tool's place and its goal [m], and the chain."""

    p: tuple
    p_d: tuple
    chain: Chain


def work(n: int, late: int = -1, change: float = math.inf) -> ArmWork:
    """Return fresh buffers for n joints, whose motors give torques so many ticks late; -1: torques are not kept.

    change: by how much a torque changes in a tick at most [N m]; if it is finite, torques are kept.
    """
    late = max(late, 0) if change < math.inf else late
    G, sent = np.zeros((arm_episode.MOST,) * 2), np.zeros((2 + late if late >= 0 else 0, n))
    return ArmWork(arm_episode.buffers(n), np.zeros((n, n)), np.zeros(n), G, sent)


@kernel
def reset(body, k, start):
    """Place the arm at a start; the tool's place is to be kept where the start gives no other."""
    place(body.sim, body.states, k)
    s, states, at = body.sim.sensordata, body.states, 3 * body.sim.n
    p_d = (s[16], s[17], s[18])
    if states[k, at] == states[k, at]:
        p_d = (states[k, at], states[k, at + 1], states[k, at + 2])
    quat_d = (start[7], start[8], start[9], start[10])
    return ArmPlantState(quat_d, Goal(from_quaternion(quat_d), AT_REST, AT_REST), p_d, 0.0)


@kernel
def sense(body, state, tick, numbers):
    """Read the sensors."""
    sim, s = body.sim, body.sim.sensordata
    R, omega = Rotation((s[0], s[1], s[2]), (s[3], s[4], s[5]), (s[6], s[7], s[8])), (s[9], s[10], s[11])
    p, speed = (s[16], s[17], s[18]), arm_episode.squared(sim.qvel, sim.n)
    tool = Tool(p, state.p_d, Chain(sim.n, sim.xaxis, sim.xanchor, sim.qvel, p, R))
    hav = haversine(quaternion(s), state.quat_d)
    return Sensed(R, omega, state.goal, hav, dot(omega, omega), speed, speed, GOING, tool)


@kernel
def advance(laws, body, state, action, gains, memory, numbers):
    """Apply the torques, and let MuJoCo step."""
    for i in range(body.sim.n):
        body.sim.ctrl[i] = body.work.buffers.tau[i]
    step(body.sim)
    return state, memory


ARM = Plant(reset, sense, advance, measure)


@kernel
def command(laws, body, sensed, now, gains, memory, numbers):
    """Compute the torques of a contender: laws are assemble, resolve (`resolved_acceleration`) and its margin."""
    sim, model, controls, n, work = body.sim, body.model, body.controls, body.sim.n, body.work
    if controls.has_own_model > 0:
        for i in range(n):
            model.qpos[i] = sim.qpos[i]
            model.qvel[i] = sim.qvel[i] if controls.has_own_model != arm_episode.STANDING else 0.0
        compute(model)
    fill_inertia(model, work.D)
    for i in range(n):
        work.fg[i] = model.qfrc_bias[i] - model.qfrc_passive[i]
    if controls.gives_torque == BY_JOINT:
        q_d = body.states[now.episode, 2 * n : 3 * n]
        arm_episode.face_joints(work.buffers.J, work.buffers.a, sim.qpos, q_d, body.joints.inertia, n)
    u, memory = control(
        laws.law, laws.second, controls.gives_torque, controls.rows,
        sensed.extra.chain, work.D, work.fg, sensed.goal, sensed.extra.p_d, gains, memory, work.buffers,
    )  # fmt: skip
    if controls.is_cut > 0:
        arm_episode.cut(work.buffers.tau, body.joints.rated, n)
    if work.sent.shape[0] > 0:
        arm_episode.drive(
            work.buffers.tau, work.sent, controls.share, controls.change, now.number, work.fg, n
        )
    total, _ = arm_episode.load(work.buffers.tau, body.joints.rated, n)
    failure = check_command(total, controls.torque_limit_squared)
    return Action(u, u, dot(u, u), laws.third(sensed.R, sensed.goal.R), failure, ()), memory


def loop_of(observe):
    """Return the loop of arms, for all of them and all contenders."""

    @kernel
    def see(row, curves, now, body, sensed, action, before, numbers):
        """Show the metrics a sample, and look at the conditioning."""
        sim, joints, work, n = body.sim, body.joints, body.work, body.sim.n
        sample = arm_episode.ArmSample(
            now.number * numbers.dt, numbers.dt, sensed.R, sensed.haversine, now.entered, now.at_rest, sensed.omega,
            action.u, before, action.margin, sensed.extra.p, sensed.extra.p_d,
            arm_episode.seven(sim.qpos, n), arm_episode.seven(sim.qvel, n), arm_episode.seven(work.buffers.tau, n),
            joints.lower, joints.upper, joints.rated,
        )  # fmt: skip
        observe(row, sample)
        keep_on_arm(curves, now.episode, now.number, sample)
        if now.number % arm_episode.PROBE_TICKS == 0 or action.failure != GOING:
            arm_episode.probe(row, sensed.extra.chain, sim.qpos, work.G, work.buffers.scratch)

    return episodes_of(ARM, Controller(begin, command), Record(see))
