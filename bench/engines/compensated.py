"""A free body turned by a law with a state of its own, under a constant disturbance: one Runge-Kutta step a tick.

The law's state and the body are one system in continuous time, as ideal-rk4 has it of laws without one.
"""

import math
from typing import NamedTuple

import numpy as np
from numba import float64, types

from bench.engines.compiled import FOUR, GAINS, GOAL, MATRIX, ROTATION, THREE, compile_function, made_once
from bench.law.compensator import Compensator
from bench.law.contender import AT_REST, Gains, Goal
from bench.law.scalar import kernel, sqrt
from bench.law.so3 import cross, dot, from_quaternion
from tasks.truth import angle

LAW = types.Tuple((THREE, FOUR))(ROTATION, THREE, GOAL, GAINS, FOUR)
BEGIN = FOUR(ROTATION)

SETTLED, LEFT, PEAK = range(3)
"""A row's columns: time after which the angle stays in the band [s], NaN if it does not; angle at the end [rad];
greatest |u| [rad/s^2]."""


class Asked(NamedTuple):
    """Period [s], ticks, band [rad], and the disturbance along base axes [rad/s^2]."""

    dt: float
    ticks: float
    band: float
    x: float
    y: float
    z: float


EPISODES = types.void(
    types.FunctionType(LAW), types.FunctionType(BEGIN), MATRIX, types.NamedUniTuple(float64, 6, Asked), GAINS, MATRIX
)  # fmt: skip


@kernel
def shifted(p, h, v):
    """p + h v, of four numbers."""
    return (p[0] + h * v[0], p[1] + h * v[1], p[2] + h * v[2], p[3] + h * v[3])


@kernel
def pushed(p, h, v):
    """p + h v, of three numbers."""
    return (p[0] + h * v[0], p[1] + h * v[1], p[2] + h * v[2])


@kernel
def spun(q, omega):
    """The rate of the quaternion (w, x, y, z): (0, omega) o q/2, omega in the base frame."""
    v = (q[1], q[2], q[3])
    p, along = cross(omega, v), dot(omega, v)
    return (
        -0.5 * along,
        0.5 * (q[0] * omega[0] + p[0]),
        0.5 * (q[0] * omega[1] + p[1]),
        0.5 * (q[0] * omega[2] + p[2]),
    )


@kernel
def unit(q):
    """q/|q|."""
    shorter = 1.0 / sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3])
    return (shorter * q[0], shorter * q[1], shorter * q[2], shorter * q[3])


def loop(law, begin, starts, asked, gains, rows):
    """The loop: one row a start (w, x, y, z, omega, goal's w, x, y, z)."""
    d = (asked.x, asked.y, asked.z)
    for k in range(starts.shape[0]):
        start, row = starts[k], rows[k]
        q, omega = (start[0], start[1], start[2], start[3]), (start[4], start[5], start[6])
        quat_d = (start[7], start[8], start[9], start[10])
        goal = Goal(from_quaternion(quat_d), AT_REST, AT_REST)
        state = begin(from_quaternion(q))
        outside, peak, h = -1.0, 0.0, asked.dt
        tick = 0
        while tick < asked.ticks:
            if not angle(q, quat_d) <= asked.band:
                outside = float(tick)
            q_sum, omega_sum, state_sum = q, omega, state
            at, pace, kept = q, omega, state
            for stage in range(4):
                u, rate = law(from_quaternion(unit(at)), pace, goal, gains, kept)
                if stage == 0:
                    peak = max(peak, sqrt(dot(u, u)))
                share = h / 6.0 if stage == 0 or stage == 3 else h / 3.0
                turning, gained = spun(at, pace), pushed(u, 1.0, d)
                q_sum, omega_sum = shifted(q_sum, share, turning), pushed(omega_sum, share, gained)
                state_sum = shifted(state_sum, share, rate)
                ahead = h if stage == 2 else 0.5 * h
                at, pace = shifted(q, ahead, turning), pushed(omega, ahead, gained)
                kept = shifted(state, ahead, rate)
            q, omega, state = unit(q_sum), omega_sum, state_sum
            tick += 1
        row[LEFT], row[PEAK] = angle(q, quat_d), peak
        row[SETTLED] = (outside + 1.0) * h if row[LEFT] <= asked.band else math.nan


@made_once
def _compiled():
    return compile_function(loop, EPISODES)


@made_once
def _parts(one: Compensator):
    return compile_function(one.law, LAW), compile_function(one.begin, BEGIN)


def prepare(one: Compensator) -> None:
    """Compile what `run` will need, or take it from the disk cache."""
    _compiled()
    _parts(one)


def run(one: Compensator, starts, gains: Gains, asked: Asked) -> np.ndarray:
    """Rows (SETTLED, LEFT, PEAK), one per start, from its orientation and angular velocity."""
    begun = np.array([(*one.quat_wxyz, *one.omega, *one.goal_wxyz) for one in starts], dtype=float)
    rows = np.empty((len(starts), 3))
    _compiled()(*_parts(one), begun, asked, Gains(*map(float, gains)), rows)
    return rows


@kernel
def nothing(R):
    """No state."""
    return (0.0, 0.0, 0.0, 0.0)


@made_once
def without_state(one) -> Compensator:
    """A regulator without memory as a compensator whose state stays at zero."""
    law = one.law

    @kernel
    def still(R, omega, goal, gains, state):
        return law(R, omega, goal, gains), (0.0, 0.0, 0.0, 0.0)

    words = one.name, one.title, one.source, one.formula
    return Compensator(*words, still, nothing, None, measures_rate=True, rejects=False, property=one.property)
