"""The range that the paper gives for regulator 2, and what surrounds it (Murphy 1988, section 2.4).

    |alpha| < pi/2,  |beta| < pi/2,  |gamma| < pi

Inside are a regular grid of cell centres, and every corner and middle of a face or edge moved in by 0.001 and 0.1 rad.
Every orientation has a triple with |beta| <= pi/2 and |gamma| <= pi, so outside the box means |alpha| > pi/2 and
nothing else. On the faces beta = +-pi/2 and gamma = +-pi several ids are one orientation.
"""

from __future__ import annotations

import itertools
import math

from tasks.base import Start, StartSet
from tasks.rotations import zyx

HALF_WIDTHS = (math.pi / 2.0, math.pi / 2.0, math.pi)
GRID = (4, 4, 5)
DEPTHS = (0.1, 0.001)
EXCESSES = (0.001, 0.1, 0.5, 1.0, 1.4)
# (beta, gamma) [rad] of the outside ones
OUTSIDE = ((0.0, 0.0), (0.7, -1.5), (-0.7, 2.5), (1.2, 0.5))


def build(seed: int) -> list[Start]:
    """Return the grid, then the starts just inside, on, and outside the box."""
    starts = []
    for cell in itertools.product(*map(range, GRID)):
        of_each = zip(HALF_WIDTHS, cell, GRID, strict=True)
        angles = [width * ((2 * i + 1) / cells - 1.0) for width, i, cells in of_each]
        starts.append(Start("box-grid-" + "".join(map(str, cell)), zyx(*angles)))
    for word, depth in (*(("inside", depth) for depth in DEPTHS), ("on", 0.0)):
        starts += _shell(word, depth)
    for excess, (letter, sign), (beta, gamma) in itertools.product(EXCESSES, (("p", 1), ("m", -1)), OUTSIDE):
        name = f"box-outside-{letter}{excess}-b{beta}-g{gamma}"
        starts.append(Start(name, zyx(sign * (math.pi / 2.0 + excess), beta, gamma)))
    return starts


def _shell(word: str, depth: float) -> list[Start]:
    """Return the 26 directions of a cube, on the box drawn in by depth [rad]."""
    starts = []
    for signs in itertools.product((-1, 0, 1), repeat=3):
        if any(signs):
            angles = [sign * (width - depth) for sign, width in zip(signs, HALF_WIDTHS, strict=True)]
            letters = "".join({-1: "m", 0: "o", 1: "p"}[sign] for sign in signs)
            suffix = f"-{depth}" if depth else ""
            starts.append(Start(f"box-{word}-{letters}{suffix}", zyx(*angles)))
    return starts


STARTS = StartSet(
    "box",
    "Inside, on and outside the range given for regulator 2",
    math.prod(GRID) + 26 * (len(DEPTHS) + 1) + 2 * len(EXCESSES) * len(OUTSIDE),
    build,
)
