"""What a law is given besides the body's motion: gains and a goal."""

from typing import NamedTuple

from bench.law.so3 import IDENTITY, Rotation

AT_REST = (0.0, 0.0, 0.0)
NO_MEMORY = (0.0, 0.0, 0.0, 0.0)
"""A law with memory carries four numbers from tick to tick: a quaternion fits."""


class Gains(NamedTuple):
    """Position gain kp and velocity gain kv: for small errors every law is u = kp (rotation vector error) - kv omega.

    kp in 1/s^2, kv in 1/s. The defaults are the paper's (Murphy 1988, 2.3): critically damped at 10 rad/s.
    """

    kp: float = 100.0
    kv: float = 20.0


PAPERS_GAINS = Gains()


class Goal(NamedTuple):
    """Desired rotation R, with angular velocity omega and angular acceleration alpha (zero if the goal is at rest)."""

    R: Rotation = IDENTITY
    omega: tuple = AT_REST
    alpha: tuple = AT_REST
