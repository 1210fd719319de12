"""An arm in MuJoCo, the whole closed loop compiled: kinematics and dynamics by MuJoCo, the controller by us.

The loop is compiled once, for all arms and contenders: a contender comes as three functions that are called by
pointer. The order of a tick is dm_control's, as on the free body. The controller's model is the plant itself, or
another model of the same arm that is put into the plant's state at every tick (a study of model errors).
"""

from typing import Any, NamedTuple

from bench.control.resolved_acceleration import BY_JOINT, Buffers, control
from bench.engines.arm_episode import (
    MOST,
    PROBE_TICKS,
    STANDING,
    ArmSample,
    Controls,
    Joints,
    face_joints,
    load,
    probe,
    seven,
    squared,
)
from bench.engines.compiled import MATRIX, ROTATION, float64, int64, types
from bench.engines.controllers import begin
from bench.engines.curve import keep_on_arm
from bench.engines.loop import Act, Controller, Plant, Record, episodes_of
from bench.engines.native.arm import (
    ARM_VIEW,
    WORKSPACE,
    ArmView,
    Body,
    Workspace,
    open_view,
    open_workspace,
)
from bench.engines.native.libmujoco import mj_fullM, mj_resetData, mj_step, mj_step1, mj_step2
from bench.engines.native.pointers import matrix, vector
from bench.law.contender import AT_REST, Goal
from bench.law.resolved_motion import Chain
from bench.law.scalar import kernel
from bench.law.so3 import Rotation, dot, from_quaternion
from tasks.truth import angle, haversine
from tasks.verdict import GOING, check_command, check_state


class World(NamedTuple):
    """The plant, and of each start q and qdot, then where the joints and the tool shall be (`arm_episode.states`)."""

    plant: ArmView
    states: Any


class Orders(NamedTuple):
    """The controller's model, its workspace, and the numbers of the contender and the joints."""

    model: ArmView
    work: Workspace
    controls: Controls
    joints: Joints


WORLD = types.NamedTuple((ARM_VIEW, MATRIX), World)
CONTROLS = types.NamedTuple((int64, int64, int64, float64), Controls)
JOINTS = types.NamedUniTuple(types.UniTuple(float64, MOST), len(Joints._fields), Joints)
ORDERS = types.NamedTuple((ARM_VIEW, WORKSPACE, CONTROLS, JOINTS), Orders)
MARGIN = float64(ROTATION, ROTATION)


class Arm(NamedTuple):
    """The plant, and the starts' states."""

    body: Body
    states: Any


class Desk(NamedTuple):
    """The controller's model, its buffers, D at its address too, and the numbers of `Orders`."""

    model: Body
    D: Any
    fg: Any
    G: Any
    D_address: int
    buffers: Buffers
    controls: Controls
    joints: Joints


class State(NamedTuple):
    """Where the tool shall be; the rest is MuJoCo's. path: angle of its last rotation [rad], where that is asked."""

    quat_d: tuple
    goal: Goal
    p_d: tuple
    path: float


class Sensed(NamedTuple):
    """What the sensors say, the goal, and the chain."""

    R: Rotation
    omega: tuple
    goal: Goal
    p: tuple
    p_d: tuple
    chain: Chain


@kernel
def enter(world):
    """Return the plant's arrays."""
    return Arm(open_view(world.plant), world.states)


@kernel
def reset(arm, k, start):
    """Place the arm at a start; the tool's place is to be kept where the start gives no other."""
    body, states = arm.body, arm.states
    n, s, at = body.n, body.s, 3 * body.n
    mj_resetData(body.model, body.data)
    for i in range(n):
        body.q[i], body.qdot[i] = states[k, i], states[k, n + i]
    mj_step1(body.model, body.data)
    p_d = (s[16], s[17], s[18])
    if states[k, at] == states[k, at]:
        p_d = (states[k, at], states[k, at + 1], states[k, at + 2])
    quat_d = (start[7], start[8], start[9], start[10])
    return State(quat_d, Goal(from_quaternion(quat_d), AT_REST, AT_REST), p_d, 0.0)


@kernel
def sense(arm, state):
    """Read the sensors."""
    body = arm.body
    s = body.s
    R, p = Rotation((s[0], s[1], s[2]), (s[3], s[4], s[5]), (s[6], s[7], s[8])), (s[16], s[17], s[18])
    chain = Chain(body.n, body.axes, body.anchors, body.qdot, p, R)
    return Sensed(R, (s[9], s[10], s[11]), state.goal, p, state.p_d, chain)


@kernel
def look(arm, state, tick, numbers):
    """Compare the tool with its goal."""
    s = arm.body.s
    turning = s[9] * s[9] + s[10] * s[10] + s[11] * s[11]
    return state, haversine((s[12], s[13], s[14], s[15]), state.quat_d), turning


@kernel
def advance(laws, arm, desk, state, act, gains, memory, numbers):
    """Apply the torques, and let MuJoCo step."""
    body = arm.body
    for i in range(body.n):
        body.ctrl[i] = desk.buffers.tau[i]
    if body.is_runge_kutta:
        mj_step(body.model, body.data)
    else:
        mj_step2(body.model, body.data)
    mj_step1(body.model, body.data)
    return state, memory


@kernel
def check(arm, state, numbers):
    """End an episode that diverges."""
    return check_state(squared(arm.body.qdot, arm.body.n), numbers.speed_limit_squared)


@kernel
def end(arm, state):
    """Measure the last angle and the joints' speed."""
    s = arm.body.s
    return angle((s[12], s[13], s[14], s[15]), state.quat_d), squared(arm.body.qdot, arm.body.n)


ARM = Plant(enter, reset, sense, look, advance, check, end)


class Laws(NamedTuple):
    """The functions of a contender (`resolved_acceleration`), and the margin of its coordinates."""

    assemble: Any
    resolve: Any
    margin: Any


@kernel
def ready(orders):
    """Return the arrays of the controller's model and of its workspace."""
    n, work = orders.model.n, orders.work
    D, fg, G = matrix(work.D, n, n), vector(work.fg, n), matrix(work.G, MOST, MOST)
    room = open_workspace(work)
    return Desk(open_view(orders.model), D, fg, G, work.D, room, orders.controls, orders.joints)


@kernel
def command(laws, arm, desk, state, sensed, now, gains, memory, numbers):
    """Compute the torques of a contender."""
    body, model, controls, n = arm.body, desk.model, desk.controls, arm.body.n
    if controls.has_own_model > 0:
        for i in range(n):
            model.q[i] = body.q[i]
            model.qdot[i] = body.qdot[i] if controls.has_own_model != STANDING else 0.0
        mj_step1(model.model, model.data)
    mj_fullM(model.model, model.data, desk.D_address)
    for i in range(n):
        desk.fg[i] = model.bias[i] - model.passive[i]
    if controls.gives_torque == BY_JOINT:
        q_d = arm.states[now.k, 2 * n : 3 * n]
        face_joints(desk.buffers.J, desk.buffers.a, body.q, q_d, desk.joints.inertia, n)
    u, memory = control(
        laws.assemble, laws.resolve, controls.gives_torque, controls.rows,
        sensed.chain, desk.D, desk.fg, sensed.goal, sensed.p_d, gains, memory, desk.buffers,
    )  # fmt: skip
    total = load(seven(desk.buffers.tau, n), desk.joints.rated)
    failure = check_command(total, controls.torque_limit_squared)
    return Act(u, u, dot(u, u), laws.margin(sensed.R, sensed.goal.R), failure), memory


def loop_of(observe):
    """Return the loop of arms, for all of them and all contenders."""

    @kernel
    def see(row, curves, now, arm, desk, state, sensed, act, before, numbers):
        """Show the metrics a sample, and look at the conditioning."""
        body, joints, dt, n = arm.body, desk.joints, numbers.dt, arm.body.n
        sample = ArmSample(
            now.tick * dt, dt, sensed.R, now.haversine, now.entered, now.at_rest, sensed.omega, act.u, before,
            act.margin, sensed.p, sensed.p_d, seven(body.q, n), seven(body.qdot, n), seven(desk.buffers.tau, n),
            joints.lower, joints.upper, joints.rated,
        )  # fmt: skip
        observe(row, sample)
        keep_on_arm(curves, now.k, now.tick, sample)
        if now.tick % PROBE_TICKS == 0 or act.failure != GOING:
            probe(row, sensed.chain, body.q, desk.G, desk.buffers.scratch)

    return episodes_of(ARM, Controller(Laws, ready, begin, command), Record(see))
