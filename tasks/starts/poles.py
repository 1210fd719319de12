"""beta = +-(pi/2 - 10^-k), k = 1 to 12, and exactly +-pi/2: where B is singular (Murphy 1988, 2.8 and 2.9).

Exact ones have n = (0, 0, -sign) with n_x and n_y exactly zero in MuJoCo's matrix (see rotations.on_pole);
|n_z| is exactly 1 but for twists 0 and pi, where sqrt(1/2) makes it 1 + 2.2e-16. Twist pi/2 is the quaternion
(1/2, -+1/2, +-1/2, 1/2), free of any rounding.
"""

from __future__ import annotations

import itertools
import math

from tasks.base import Start, StartSet
from tasks.rotations import on_pole, zyx

POLES = {"plus": 1, "minus": -1}
DECADES = range(1, 13)
# alpha - gamma at +pi/2, alpha + gamma at -pi/2 [rad]
TWISTS = {
    "0": 0.0,
    "plus-quarter": math.pi / 2.0,
    "minus-quarter": -math.pi / 2.0,
    "half": math.pi,
    "plus-1.0": 1.0,
    "minus-1.0": -1.0,
    "plus-2.5": 2.5,
    "minus-2.5": -2.5,
}
# (alpha, gamma) [rad] of the near ones: none, small, one of each sign, and both large
PAIRS = ((0.0, 0.0), (0.1, 0.2), (1.0, -0.5), (-2.0, 1.0), (2.5, 2.8))


def build(seed: int) -> list[Start]:
    """Return exact poles first, then both poles at every distance."""
    starts = [
        Start(f"pole-{pole}-exact-twist-{name}", on_pole(sign, twist))
        for pole, sign in POLES.items()
        for name, twist in TWISTS.items()
    ]
    for k, (pole, sign), (alpha, gamma) in itertools.product(DECADES, POLES.items(), PAIRS):
        angles = (alpha, sign * (math.pi / 2.0 - 10.0**-k), gamma)
        starts.append(Start(f"pole-{pole}-k{k:02d}-a{alpha}-g{gamma}", zyx(*angles)))
    return starts


STARTS = StartSet("poles", "At and near beta = +-pi/2", len(POLES) * (len(TWISTS) + len(DECADES) * len(PAIRS)), build)
