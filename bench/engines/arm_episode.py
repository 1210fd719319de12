"""What the engines of arms share: the observation's layout, a metric's sample, buffers, the columns of a row.

A row of numbers is that of `episode` with eight columns more at its end: where the arm was worst conditioned.
"""

import functools
import math
from collections import namedtuple
from typing import Any, NamedTuple

import numpy as np

import tasks
from bench.engines.arrays import Seven
from bench.engines.episode import Metrics, Sample, Starts, blank
from bench.law.chain import Scratch
from bench.law.contender import Contender
from bench.law.contenders.jacobians.geometric import fill
from bench.law.control.resolved_acceleration import BY_JOINT, Buffers
from bench.law.linalg import determinant, gram
from bench.law.scalar import kernel
from tasks.arm_model import Arm

MOST = 7
"""The most joints an arm may have: the size of buffers and of a row's pose."""

PROBE_TICKS = 8
"""The arm's conditioning is looked at in every eighth tick: 8 ms, in which a joint at 10 rad/s turns 5 degrees."""

POSE = -1 - MOST
"""First of a row's last columns: the smallest det(J J^T), then the joint angles there."""


_record: Any = namedtuple  # which a type checker cannot follow
ArmSample = _record("ArmSample", (*Sample._fields, "p", "p_d", "q", "qdot", "tau", "lower", "upper", "rated"))
"""What a metric sees of an arm at one tick, before it moves: what `Sample` has, and the joints.

p, p_d: the tool's position and its goal [m]; q [rad], qdot [rad/s], tau [N m], and of each joint its range [rad] and
its motor's rated torque [N m]: seven numbers each, filled up with zeros (ranges with infinities, rated torques with
ones) on fewer joints. Tuples, because compiled code counts references to arrays.
"""


GIVES = {"acceleration": 0, "torque": 1, "joint-torque": BY_JOINT}
STANDING = 2


class Controls(NamedTuple):
    """A contender and the judge's rule, as numbers for a loop.

    rows of the Jacobian; gives_torque by the inverse (`resolved_acceleration.BY_JOINT`); has_own_model: 0 if the
    controller's model is the plant, 1 if it is another in the plant's state, STANDING if its joints stand still there,
    so that its torques are gravity's alone. is_cut: 1 if the plant's motors give no more than their rated torque.
    share: what motors make up in a tick of their difference from the torque that is sent; change: by how much a torque
    changes in a tick at most [N m].
    """

    rows: int
    gives_torque: int
    has_own_model: int
    torque_limit_squared: float
    is_cut: int
    share: float
    change: float


class Joints(NamedTuple):
    """Hold each joint's range [rad] and its motor's rated torque [N m], as `ArmSample` has them, and its inertia.

    inertia: the joint's element on D's diagonal at home [kg m^2], filled up with zeros.
    """

    lower: Seven
    upper: Seven
    rated: Seven
    inertia: Seven


def controls(
    contender: Contender, has_own_model: bool, torque_limit: float, plant: Any, lag_s: float = 0.0,
    torque_rate: tuple[float, ...] = (),
) -> Controls:  # fmt: skip
    """Return the numbers of a contender on an arm; plant: MuJoCo's model of it.

    lag_s: time constant of its motors. torque_rate: of motors that are cut, how fast a torque changes at most.
    """
    gives = GIVES[contender.inverse.gives] if contender.inverse else 0
    own = STANDING if gives == BY_JOINT else int(has_own_model)
    share = -math.expm1(-plant.opt.timestep / lag_s) if lag_s else 1.0
    is_cut = bool(plant.actuator_ctrllimited.any())
    change = torque_rate[0] * plant.opt.timestep if torque_rate and is_cut else math.inf
    return Controls(contender.rows, gives, own, torque_limit**2, int(is_cut), share, change)


def states(starts: Starts, n: int) -> np.ndarray:
    """Return q and qdot of each start, then the goal of the joints and the tool: NaN where the start has none."""
    unknown = (math.nan,) * n
    rows = [(*one.q, *one.qdot, *(one.goal_q or unknown), *(one.goal_p or unknown[:3])) for one in starts]
    return np.array(rows, dtype=float).reshape(len(rows), 3 * n + 3)


@functools.lru_cache(maxsize=64)
def joints(arm: Arm, variation: str) -> Joints:
    """Return the numbers of an arm's joints; variation: the controller's model."""
    from tasks.kinematics import Kinematics  # MuJoCo takes a moment to import; the ideal plant needs none

    judge, missing = Kinematics(arm), MOST - arm.joints
    tasks.variation(variation).apply(judge.model, arm.rated)
    return Joints(
        (*map(float, arm.lower), *[-math.inf] * missing),
        (*map(float, arm.upper), *[math.inf] * missing),
        (*map(float, arm.rated), *[1.0] * missing),
        (*judge.inertia_matrix(arm.home).diagonal().tolist(), *[0.0] * missing),
    )


def buffers(n: int, dtype: Any = float) -> Buffers:
    """Fresh buffers for an arm of n joints."""
    J, (a, x) = np.zeros((MOST, MOST), dtype), np.zeros((2, MOST), dtype)
    return Buffers(J, a, x, np.zeros(n, dtype), scratch(dtype))


def scratch(dtype: Any = float) -> Scratch:
    """Fresh buffers for the inverse of a matrix of an arm."""
    return Scratch(*np.zeros((3, MOST, MOST), dtype), *np.zeros((2, MOST), dtype))


def blank_arm(count: int, metrics: Metrics) -> np.ndarray:
    """Rows to be filled: metrics at their start values, and no pose yet."""
    return blank(count, metrics, (math.inf, *[math.nan] * MOST))


@kernel
def cut(tau, rated, n):
    """Cut torques to what motors are rated for; one that is not a number stays."""
    for i in range(n):
        tau[i] = max(min(tau[i], rated[i]), -rated[i])


@kernel
def drive(tau, sent, share, change, tick, fg, n):
    """Replace the torques that are sent by those that slow or late motors give; at first these hold the arm.

    sent: a row for each tick of delay and the present one, then what motors give.
    """
    slots = sent.shape[0] - 1
    for i in range(n):
        if tick == 0:
            for j in range(sent.shape[0]):
                sent[j, i] = fg[i]
        sent[tick % slots, i] = tau[i]
        more = share * (sent[(tick + 1) % slots, i] - sent[slots, i])
        sent[slots, i] += max(min(more, change), -change)
        tau[i] = sent[slots, i]


@kernel
def face_joints(J, a, q, q_d, inertia, n):
    """Give a baseline on the joints a = q_d - q and J = diag(inertia)."""
    for i in range(n):
        a[i] = q_d[i] - q[i]
        for j in range(n):
            J[i, j] = 0.0
        J[i, i] = inertia[i]


@kernel
def probe(row, chain, q, G, scratch):
    """Keep the joint angles at which det(J J^T) of the geometric Jacobian was smallest."""
    fill(G, chain)
    gram(G, scratch.A, 6, chain.n)
    for i in range(6):
        for j in range(i):
            scratch.A[j, i] = scratch.A[i, j]
    w = determinant(scratch.A, scratch.s, 6)
    if w < row[row.shape[0] + POSE]:
        row[row.shape[0] + POSE] = w
        for i in range(chain.n):
            row[row.shape[0] + POSE + 1 + i] = q[i]


@kernel
def seven(b, n):
    """Return the first n numbers of a buffer, then zero, as a tuple."""
    return (b[0], b[1], b[2], b[3], b[4], b[5], b[6] if n > 6 else 0.0)


@kernel
def load(tau, rated, n):
    """(Sum of (tau_i / rated_i)^2, the largest of them): what the rule on torques is about; NaN if a torque is."""
    total, largest = 0.0, 0.0
    for i in range(n):
        ratio = tau[i] / rated[i]
        square = ratio * ratio
        total, largest = total + square, max(largest, square)
    return total, largest


@kernel
def squared(v, n):
    """v . v of a buffer."""
    total = 0.0
    for i in range(n):
        total = total + v[i] * v[i]
    return total
