"""Gains at which a law's greatest command from rest is a given one: what motors of one size allow."""

import functools
import math

import numpy as np

import tasks
from bench.law.contender import Contender
from bench.law.inputs import AT_REST, Gains, Goal
from bench.law.so3 import from_quaternion
from tasks.base import Start

LOOKED_AT = {"uniform": 500, "half-turn": None, "poles": None, "wraps": None}
"""Starts at rest over which a greatest command is sought, by set: they come close to where any of our laws has it."""

UNBOUNDED = 100.0
"""Greatest command over kp [rad] beyond which there is none: the starts come as near as 1e-12 rad to 180°."""


def gains_at(one: Contender, peak: float) -> Gains | None:
    """Gains with this greatest command from rest [rad/s^2], critically damped; None of a law that has none.

    From rest every law's command is proportional to kp as long as kv = 2 sqrt(kp).
    """
    greatest = greatest_command(one)
    return None if greatest > UNBOUNDED else Gains(peak / greatest, 2.0 * math.sqrt(peak / greatest))


@functools.cache
def greatest_command(one: Contender) -> float:
    """max |u| from rest over SO(3) at kp = 1/s^2 [rad]; points where the law is not defined do not count."""
    law, unit = one.law, Gains(np.float64(1.0), np.float64(2.0))
    memory = () if one.regulator.memory is None else (tuple(map(np.float64, one.regulator.memory)),)
    greatest = 0.0
    with np.errstate(all="ignore"):
        for start in _starts():
            R, R_d = (from_quaternion(tuple(map(np.float64, quat))) for quat in (start.quat_wxyz, start.goal_wxyz))
            u = law(R, AT_REST, Goal(R_d), unit, *memory)
            size = math.hypot(*(u[0] if memory else u))
            greatest = max(greatest, size) if math.isfinite(size) else greatest
    return greatest


@functools.cache
def _starts() -> list[Start]:
    return [start for name, count in LOOKED_AT.items() for start in tasks.start_set(name, count)]
