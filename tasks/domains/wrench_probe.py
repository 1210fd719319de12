"""Known moments at a hand in free space: which way it turns when it is told to comply.

Nothing touches the hand, and nothing moves fast, so that a controller's choice of coordinates is all there is to see.
A moment of PUSH acts from the first tick on. About axes that comply the hand turns with it; about the others, and
with an impedance about all, it comes to rest where the controller's stiffness balances it.

The arm keeps its posture in all trials: only the hand's frame is drawn anew, R = Rz(alpha) Ry(beta) Rx(gamma).

Source: Murphy 1988, 3.3 and equations 3.9 to 3.12.
"""

from __future__ import annotations

import functools
import math

from tasks.arm import Arm
from tasks.contact import ContactTask, Order, Surroundings, Trial
from tasks.hand_frames import mounts, posture
from tasks.rotations import zyx

# N m. Small: the hand turns by some milliradians, and the coordinates' B hardly changes on the way.
PUSH = 0.02
# The pairs and single axes that comply, everything else being held.
ORDERS = tuple(
    Order(name, (1, 1, 1, *held))
    for name, held in (
        ("about x", (0, 1, 1)),
        ("about y", (1, 0, 1)),
        ("about z", (1, 1, 0)),
        ("about x and y", (0, 0, 1)),
        ("about y and z", (1, 0, 0)),
        ("about z and x", (0, 1, 0)),
    )
)
# degrees: evenly, and then towards the poles of Z-Y-X and of Z-Y-Z
BETAS = (0, 1, 5, 15, 30, 45, 60, 75, 85, 89, 90)
DENSE_BETAS = tuple(range(-90, 91, 2))
# (alpha, gamma) in degrees
TURNS = ((0, 0), (35, -20))
DENSE_TURNS = (*TURNS, (90, 0), (0, 90), (-120, 60))


def surroundings(arm: Arm) -> Surroundings:
    """A bare rod of a hand, to be seen in a picture, and nothing else."""
    rod = '<geom type="cylinder" size=".02 .04" pos="0 0 .05" mass="0" rgba=".3 .5 .8 1"/>'
    return Surroundings(hand=rod, tip=(0.0, 0.0, 0.1))


@functools.cache
def trials(arm: Arm) -> tuple[Trial, ...]:
    """Three moments, about x, y and z, for every order and frame of the hand."""
    return _trials(arm, BETAS, TURNS)


@functools.cache
def dense(arm: Arm) -> tuple[Trial, ...]:
    """The same on a dense grid of frames."""
    return _trials(arm, DENSE_BETAS, DENSE_TURNS)


def _trials(arm: Arm, betas, turns) -> tuple[Trial, ...]:
    q = posture(arm)
    found = []
    for alpha, gamma in turns:
        for beta in betas:
            goal = zyx(math.radians(alpha), math.radians(beta), math.radians(gamma))
            mount = mounts(arm, q, goal)
            for order in ORDERS:
                pose = f"alpha{alpha:+d} beta{beta:+d} gamma{gamma:+d}, {order.name}"
                for i, axis in enumerate("xyz"):
                    push = tuple(PUSH if k == 3 + i else 0.0 for k in range(6))
                    found.append(Trial(f"{pose}, moment {axis}", pose, order, q, goal, mount, push=push))
    return tuple(found)


TASK = ContactTask(
    name="wrench-probe",
    title="Known moments at a hand in free space",
    source="Murphy 1988, 3.3 and equations 3.9 to 3.12",
    horizon_s=0.8,
    surroundings=surroundings,
    trials=trials,
    dense=dense,
)
