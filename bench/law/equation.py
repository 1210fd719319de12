"""The scalar equation of a law that turns a free body about one fixed axis from rest: what theory and figures use.

    theta'' = -Kp f(theta) - Kv theta' + g(theta, theta')       theta the angle to the goal, from rest

Laws differ in the spring f, and a few by a term g that vanishes with the rate. Here are those that several share, or
that need a tangent: a law's file has no mathematics but the dialect's.
"""

import math
from collections.abc import Callable
from typing import NamedTuple


class Equation(NamedTuple):
    """One scalar equation.

    formula: f, in TeX. spring: f(theta). added: g(theta, rate, kp, kv). the_long_way: it starts at 2 pi - theta.
    """

    formula: str
    spring: Callable[[float], float]
    added: Callable[[float, float, float, float], float] = lambda theta, rate, kp, kv: 0.0
    the_long_way: bool = False

    @property
    def is_bounded(self) -> bool:
        """Whether the spring has a greatest pull: without one it is tan(pi/2) at 180°, 1e16 in floats."""
        return abs(self.spring(math.pi)) < 1e9


SINE = Equation(r"\sin\theta", math.sin)
CHORD = Equation(r"2 \sin(\theta/2)", lambda theta: 2.0 * math.sin(theta / 2.0))
ANGLE = Equation(r"\theta", lambda theta: theta)
QUARTER = Equation(r"4 \tan(\theta/4)", lambda theta: 4.0 * math.tan(theta / 4.0))
TANGENT = Equation(r"2 \tan(\theta/2)", lambda theta: 2.0 * math.tan(theta / 2.0))
LINEAR_MRP = Equation(
    r"2 \sin(\theta/2) + \dot\theta^2 \tan(\theta/4)/(2 K_p)",
    CHORD.spring,
    lambda theta, rate, kp, kv: -0.5 * rate * rate * math.tan(theta / 4.0),
)
"""tan(theta/4) obeys the linear equation."""
LINEAR_SINE = Equation(
    r"2 \tan(\theta/2) - \dot\theta^2 \tan(\theta/2)/(2 K_p)",
    TANGENT.spring,
    lambda theta, rate, kp, kv: 0.5 * rate * rate * math.tan(theta / 2.0),
)
"""sin(theta/2) obeys the linear equation."""
