"""A closed loop of moments at a hand in free space: does a hand that complies come back?

Four moments follow each other for equal times, about x, y, -x and -y. The hand complies about x and y, so that it turns
by some 15 degrees about each and back. A rotation is more than the sum of its parts: held about z or not, what is left
in the end, and about which axis, is a matter of what was held. To hold omega_z = 0 is no constraint on orientation;
a square loop of side a then drifts by about a^2, the holonomy of rotations (Murray, Li, Sastry 1994, chapter 7).
"""

from __future__ import annotations

import functools
import math

from tasks.arm_model import Arm
from tasks.contact import ContactTask, Specification, Trial
from tasks.domains import wrench_probe
from tasks.hand_frames import mounts
from tasks.rotations import zyx

# N m: with the controllers' usual constants a quarter of the horizon turns the hand by about 0.25 rad.
PUSH = 2.5
SPECIFICATION = Specification("about x and y", (1, 1, 1, 0, 0, 1))
LOOPS = {"x first": ((1, 0), (0, 1), (-1, 0), (0, -1)), "y first": ((0, 1), (1, 0), (0, -1), (-1, 0))}
BETAS = (0, 15, 30, 45, 60, 75)
DENSE_BETAS = tuple(range(-80, 81, 5))


@functools.cache
def trials(arm: Arm, dense: bool = False) -> tuple[Trial, ...]:
    """Both ways round, for several frames of the hand, or for many."""
    q, found = arm.home, []
    for beta in DENSE_BETAS if dense else BETAS:
        goal = zyx(0.0, math.radians(beta), 0.0)
        for word, way in LOOPS.items():
            name = f"beta{beta:+d}, {word}"
            legs = tuple((0.0, 0.0, 0.0, PUSH * x, PUSH * y, 0.0) for x, y in way)
            found.append(Trial(name, name, SPECIFICATION, q, goal, mounts(arm, q, goal), legs=legs))
    return tuple(found)


TASK = ContactTask(
    name="compliance-loop",
    title="A closed loop of moments at a hand in free space",
    source="Murray, Li, Sastry 1994, chapter 7; Mason 1981",
    horizon_s=2.4,
    surroundings=wrench_probe.surroundings,
    trials=trials,
)
