"""Plants commanded in velocity: a body that turns, and joints whose servos follow at once or with a first-order lag.

    R(t + dt) = exp([omega dt]x) R(t)            omega held over the tick, base frame
    T qddot = c - qdot                           c held over the tick: qdot - c falls by exp(-dt/T)

Both steps are exact whatever the tick, so that a limit of stability that is measured is the loop's and not a solver's.

The functions call no other function of ours, so that compiled loops compile them as they stand.
"""

from __future__ import annotations

import math
from typing import NamedTuple


class Servo(NamedTuple):
    """A tick of dt [s] of servos: decay = exp(-dt/T), coast = T (1 - decay) [s]; both are 0 if they follow at once."""

    dt: float
    decay: float
    coast: float


def servo(dt: float, lag: float) -> Servo:
    """Return the servos of a time constant T = lag [s]."""
    decay = math.exp(-dt / lag) if lag > 0.0 else 0.0
    return Servo(dt, decay, lag * (1.0 - decay))


def turned(quat, turn):
    """Return the unit quaternion after a rotation by the base-frame vector `turn` [rad]; zero keeps every bit.

    Its length is corrected by a step of Newton's, so that it stays 1 over any number of ticks.
    """
    squared = turn[0] * turn[0] + turn[1] * turn[1] + turn[2] * turn[2]
    if squared <= 0.0:
        return quat
    angle = math.sqrt(squared)
    c = math.cos(0.5 * angle)
    # sin(x/2)/x is 1/2 to the last bit below 1e-8
    s = math.sin(0.5 * angle) / angle if angle > 1e-8 else 0.5
    x, y, z = s * turn[0], s * turn[1], s * turn[2]
    p = (
        c * quat[0] - x * quat[1] - y * quat[2] - z * quat[3],
        c * quat[1] + x * quat[0] + y * quat[3] - z * quat[2],
        c * quat[2] - x * quat[3] + y * quat[0] + z * quat[1],
        c * quat[3] + x * quat[2] - y * quat[1] + z * quat[0],
    )
    factor = 1.5 - 0.5 * (p[0] * p[0] + p[1] * p[1] + p[2] * p[2] + p[3] * p[3])
    return (factor * p[0], factor * p[1], factor * p[2], factor * p[3])


def followed(rate, command, servo):
    """(angle turned, rate at the end) of a joint over a tick; rate: at its beginning [rad/s]."""
    behind = rate - command
    return servo.dt * command + servo.coast * behind, command + servo.decay * behind
