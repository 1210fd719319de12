"""What the book shows of a law or of coordinates: short name, look, family, and the equation of its angle.

The equation is that of a free body that a law turns about one fixed axis from rest:

    theta'' = -Kp f(theta) - Kv theta' + g(theta, theta')       theta the angle to the goal, from rest

Laws differ in the spring f, and a few by a term g that vanishes with the rate. Here are those that several share, or
that need a tangent: a law's file has no mathematics but the dialect's.
"""

import math
from collections.abc import Callable
from typing import Any, NamedTuple

COLOURS = ("blue", "vermillion", "green", "purple", "orange", "sky", "yellow", "wine", "violet")
"""Distinguished with any colour vision. The book draws eight laws of its own in colour, and all others in grey."""
MARKERS = ("o", "s", "^", "v", "D", "d", "p", "P", "x", "X", "h", "*", "<")
LINES = ("solid", "dashed", "dotted", "dash-dot")


class Look(NamedTuple):
    """One of COLOURS, one of MARKERS, one of LINES."""

    colour: str
    marker: str
    line: str

    @property
    def is_known(self) -> bool:
        """Whether the book can draw it."""
        return self.colour in COLOURS and self.marker in MARKERS and self.line in LINES


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


class Display(NamedTuple):
    """What the book shows, all of it optional; nothing is computed from it but theory of one axis.

    short: the name beside a curve; of coordinates in the plural. look: how curves are drawn. family: the title of the
    laws it is drawn with. equation: of the angle; of coordinates, what a linear motion of them from rest is. A law on
    several coordinates gives a function of the coordinates instead.
    """

    short: str = ""
    look: Look | None = None
    family: str = ""
    equation: Equation | Callable[[Any], Equation | None] | None = None
