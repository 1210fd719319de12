"""What a law is given besides the body's motion: gains, the limits of its motors, and a goal."""

import inspect
import math
from collections.abc import Callable
from typing import NamedTuple

from bench.law.so3 import IDENTITY, Rotation

AT_REST = (0.0, 0.0, 0.0)
NO_MEMORY = (0.0, 0.0, 0.0, 0.0)
"""A law with memory carries four numbers from tick to tick: a quaternion fits."""


class Gains(NamedTuple):
    """Position gain kp and velocity gain kv: for small errors every law is u = kp phi - kv omega.

    phi is the rotation vector to the goal; kp is in 1/s^2, kv in 1/s.

    The defaults are the paper's (Murphy 1988, 2.3): critically damped at 10 rad/s.
    """

    kp: float = 100.0
    kv: float = 20.0


PAPERS_GAINS = Gains()


class Tuning(NamedTuple):
    """The argument `gains` of a law: the gains, and the limits of the motors that carry out the command.

    A law may use or ignore these limits. In both cases the plant applies the limits: if a command is longer than the
    bound, the plant shortens the command to the bound and keeps the direction of the command.

    Attributes:
        kp: Position gain [1/s^2], as in `Gains`.
        kv: Velocity gain [1/s], as in `Gains`.
        bound: Greatest length of the command [rad/s^2], for the inertia that the law assumes; infinite if there is no
            limit.
        delay: Time from a measurement to the effect of the command [s], in addition to the control period.
    """

    kp: float = PAPERS_GAINS.kp
    kv: float = PAPERS_GAINS.kv
    bound: float = math.inf
    delay: float = 0.0


LIMITS = frozenset(Tuning._fields) - frozenset(Gains._fields)
"""The limits of its motors that a law can read."""


def reads_limits(law: Callable) -> bool:
    """Tell whether a law, or a function that it calls, reads a limit of its motors, by the names in its code."""
    seen: set[int] = set()
    waiting = [law]
    while waiting:
        function = waiting.pop()
        if id(function) in seen or not inspect.isfunction(function):
            continue
        seen.add(id(function))
        if LIMITS.intersection(function.__code__.co_names):
            return True
        names = inspect.getclosurevars(function)
        waiting += [*names.nonlocals.values(), *names.globals.values()]
    return False


class Goal(NamedTuple):
    """Desired rotation R, with angular velocity omega and angular acceleration alpha (zero if the goal is at rest)."""

    R: Rotation = IDENTITY
    omega: tuple = AT_REST
    alpha: tuple = AT_REST
