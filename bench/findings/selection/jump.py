"""How far the command of a law jumps where a body at rest is pushed through a 180° rotation."""

import functools
import math

import numpy as np

from bench.law.contender import Contender
from bench.law.inputs import AT_REST, Goal, Tuning
from bench.law.so3 import from_quaternion
from tasks.haar import axes

BESIDE_RAD, DIRECTIONS = 1e-6, 16


@functools.cache
def jump(one: Contender) -> float:
    """Return the jump of the command where a body at rest is pushed through a 180° rotation, over kp [rad].

    On coordinates: not a number, for a chart of SO(3) jumps somewhere else as well; nor of a user's law, which must not
    be called here. What a law remembers goes with it.
    """
    if one.representation is not None or one.regulator.origin:
        return math.nan
    return max(_across(one, axis) for axis in axes(DIRECTIONS))


def _across(one: Contender, axis: np.ndarray) -> float:
    gains, goal = Tuning(np.float64(1.0), np.float64(2.0)), Goal()
    memory = one.regulator.memory
    commands = []
    with np.errstate(all="ignore"):
        for angle in (math.pi - BESIDE_RAD, math.pi + BESIDE_RAD):
            quat = (math.cos(angle / 2), *(math.sin(angle / 2) * axis))
            R = from_quaternion(tuple(map(np.float64, quat)))
            found = one.law(R, AT_REST, goal, gains, *(() if memory is None else (memory,)))
            u, memory = (found, None) if memory is None else found
            commands.append(np.array(u))
    return float(np.linalg.norm(commands[1] - commands[0]))
