"""The free body behind goals that come as a stream: one episode of given length, whatever becomes of it.

The command is held over a tick and the inertia is 1: omega grows by u dt, and the body turns by their mean times dt.
Beside laws, which take matrices, runs the spring on the quaternion as it came, whose sign is the stream's.
"""

from typing import NamedTuple

import numpy as np
from numba import boolean, float64, types

from bench.engines.binding import memory_of
from bench.engines.compiled import EVALUATE, FOUR, GAINS, MATRIX, compile_function, made_once
from bench.engines.run import evaluation
from bench.law.contender import AT_REST, Contender, Gains, Goal
from bench.law.scalar import sqrt
from bench.law.so3 import dot, from_quaternion
from tasks.truth import angle
from tasks.velocity import turned


class Seen(NamedTuple):
    """Greatest |u| [rad/s^2], greatest angle to the true goal from the tick `settled` on [rad], way turned [rad]."""

    peak_u: float
    off_rad: float
    way_rad: float


EPISODE = types.UniTuple(float64, len(Seen._fields))(
    types.FunctionType(EVALUATE), boolean, FOUR, MATRIX, MATRIX, GAINS, float64
)


def episode_of():
    """`episode(evaluate, is_raw, memory, goals, truth, gains, dt)`; goals and truth: quaternions, one a tick."""

    def episode(evaluate, is_raw, memory, goals, truth, gains, dt):
        q = (truth[0, 0], truth[0, 1], truth[0, 2], truth[0, 3])
        omega, peak, off, way = AT_REST, 0.0, 0.0, 0.0
        for k in range(goals.shape[0]):
            w, x, y, z = goals[k, 0], goals[k, 1], goals[k, 2], goals[k, 3]
            if is_raw:
                e_x = w * -q[1] + x * q[0] - y * q[3] + z * q[2]
                e_y = w * -q[2] + y * q[0] - z * q[1] + x * q[3]
                e_z = w * -q[3] + z * q[0] - x * q[2] + y * q[1]
                s = 2.0 * gains.kp
                u = (s * e_x - gains.kv * omega[0], s * e_y - gains.kv * omega[1], s * e_z - gains.kv * omega[2])
            else:
                goal = Goal(from_quaternion((w, x, y, z)), AT_REST, AT_REST)
                u, memory, _ = evaluate(from_quaternion(q), omega, goal, gains, memory)
            peak = max(peak, sqrt(dot(u, u)))
            h = 0.5 * dt * dt
            turn = (dt * omega[0] + h * u[0], dt * omega[1] + h * u[1], dt * omega[2] + h * u[2])
            omega = (omega[0] + dt * u[0], omega[1] + dt * u[1], omega[2] + dt * u[2])
            q = turned(q, turn)
            way += sqrt(dot(turn, turn))
            off = max(off, angle(q, (truth[k, 0], truth[k, 1], truth[k, 2], truth[k, 3])))
        return peak, off, way

    return compile_function(episode, EPISODE)


@made_once
def loop():
    """The loop, compiled or taken from the disk cache."""
    return episode_of()


def run(
    contender: Contender, goals: np.ndarray, truth: np.ndarray, gains: Gains, dt: float, is_raw: bool = False
) -> Seen:
    """One episode from rest at the first true goal.

    Args:
        goals, truth: one a tick (n x 4). is_raw: the spring on the quaternion as it came, in the law's place.
    """
    return Seen(*loop()(evaluation(contender), is_raw, memory_of(contender), goals, truth, gains, dt))
