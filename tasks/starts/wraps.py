"""alpha or gamma = +-(pi - 10^-k), k = 1 to 12, and exactly: where atan2 jumps (Murphy 1988, section 2.4).

+pi and -pi are one orientation; which of the two atan2 returns hangs on the sign of a zero. Exact ones have
n_y = 0 and n_x < 0 (alpha), or o_z = 0 and a_z < 0 (gamma), exactly, which allows at most one other angle to
differ from 0: with two, the element rounds to about 1e-17.
"""

from __future__ import annotations

import itertools
import math

from tasks.base import Quat, Start, StartSet
from tasks.rotations import zyx

SIGNS = {"plus": 1, "minus": -1}
DECADES = range(1, 13)
# (beta, the other of alpha and gamma) [rad]
NEAR = ((0.0, 0.0), (0.4, 0.3), (-0.9, -1.5))
EXACT = ((0.0, 0.0), (0.4, 0.0), (-0.9, 0.0), (0.0, 0.3), (0.0, -1.5))


def build(seed: int) -> list[Start]:
    """Return exact ones first, then both jumps from both sides at every distance."""
    starts = [
        Start(f"wrap-{angle}-exact-b{beta}-o{other}", _start(angle, math.pi, beta, other))
        for angle in ("alpha", "gamma")
        for beta, other in EXACT
    ]
    kinds = itertools.product(DECADES, ("alpha", "gamma"), SIGNS.items(), NEAR)
    for k, angle, (word, sign), (beta, other) in kinds:
        name = f"wrap-{angle}-{word}-k{k:02d}-b{beta}-o{other}"
        starts.append(Start(name, _start(angle, sign * (math.pi - 10.0**-k), beta, other)))
    return starts


def _start(angle: str, value: float, beta: float, other: float) -> Quat:
    return zyx(value, beta, other) if angle == "alpha" else zyx(other, beta, value)


STARTS = StartSet(
    "wraps",
    "At and near alpha, gamma = +-pi",
    2 * len(EXACT) + 2 * len(SIGNS) * len(DECADES) * len(NEAR),
    build,
)
