"""Known moments at a hand in free space: which way it turns when it is commanded to comply.

Nothing touches the hand, and nothing moves fast, so that a controller's choice of coordinates is all there is to see.
One of MOMENTS, as large as `push` says, acts from the first tick on. About axes that comply the hand turns with it;
about the others, and with an impedance about all, it comes to rest where the controller's stiffness balances it.

The arm keeps its posture in all trials: only the hand's frame is drawn again, R = Rz(alpha) Ry(beta) Rx(gamma).
"""

from __future__ import annotations

import functools
import itertools
import math

from tasks.arm_model import Arm
from tasks.base import AT_REST
from tasks.contact import ContactTask, Specification, Surroundings, Trial
from tasks.hand_frames import mounts
from tasks.rotations import zyx

# N m. Small: the hand turns by some milliradians, and the coordinates' B hardly changes on the way. Each moment comes
# with its opposite, so that what changes in proportion to the angle cancels. LIGHT_PUSH is for a hand that has less
# than LIGHT kg m^2 about some axis at the tasks' posture: our arms have 0.11, 0.09, and the Panda's last link 0.005.
PUSH, LIGHT_PUSH, LIGHT = 0.02, 0.002, 0.03
MOMENTS = {
    "+x": (1.0, 0.0, 0.0),
    "-x": (-1.0, 0.0, 0.0),
    "+y": (0.0, 1.0, 0.0),
    "-y": (0.0, -1.0, 0.0),
    "+z": (0.0, 0.0, 1.0),
    "-z": (0.0, 0.0, -1.0),
}
# The single axes and pairs that comply, everything else being held.
SPECIFICATIONS = tuple(
    Specification(name, (1, 1, 1, *held))
    for name, held in (
        ("about x", (0, 1, 1)),
        ("about y", (1, 0, 1)),
        ("about z", (1, 1, 0)),
        ("about x and y", (0, 0, 1)),
        ("about y and z", (1, 0, 0)),
        ("about z and x", (0, 1, 0)),
    )
)
FEWER_SPECIFICATIONS = (SPECIFICATIONS[0], SPECIFICATIONS[3])
ONE_AXIS, ABOUT_X = SPECIFICATIONS[:3], SPECIFICATIONS[:1]

# Frames of the hand, each with every specification: turns (alpha, gamma) and betas in degrees.
Grid = tuple[tuple[tuple[int, int], ...], tuple[int, ...], tuple[Specification, ...]]
# evenly, and then towards the poles of Z-Y-X and of Z-Y-Z; elsewhere to see that alpha and gamma matter, for one axis
# at frames that lean every way; and about x near zero, where Z-Y-Z angles have none
GRIDS: tuple[Grid, ...] = (
    (((0, 0),), (0, 1, 5, 15, 30, 45, 60, 75, 85, 89, 90), SPECIFICATIONS),
    (((35, -20),), (45,), SPECIFICATIONS),
    (((-50, 15), (110, 40)), (-60, 20), ONE_AXIS),
    (((4, -3), (-6, 8)), (-8, 3, 10), ABOUT_X),
    (((35, -20),), (15, 75), FEWER_SPECIFICATIONS),
)
DENSE_GRIDS: tuple[Grid, ...] = (
    (((0, 0), (35, -20)), tuple(sorted({*range(-90, 91, 3), -89, -1, 1, 89})), SPECIFICATIONS),
    (((90, 0), (0, 90), (-120, 60)), tuple(range(-90, 91, 5)), FEWER_SPECIFICATIONS),
)


def surroundings(arm: Arm) -> Surroundings:
    """Return a bare rod of a hand, to be seen in a picture, and nothing else."""
    rod = '<geom type="cylinder" size=".02 .04" pos="0 0 .05" mass="0" rgba=".3 .5 .8 1"/>'
    return Surroundings(hand=rod, tip=(0.0, 0.0, 0.1))


def push(arm: Arm) -> float:
    """How large a moment is on this arm [N m]."""
    from tasks.kinematics import kinematics  # MuJoCo takes a moment to import; listing names must not

    return LIGHT_PUSH if kinematics(arm).least_inertia(arm.home) < LIGHT else PUSH


@functools.cache
def trials(arm: Arm, dense: bool = False) -> tuple[Trial, ...]:
    """Six moments, about x, y and z both ways, for every selection and frame of the hand, on coarse or dense grids."""
    q, size, found = arm.home, push(arm), []
    for turns, betas, specifications in DENSE_GRIDS if dense else GRIDS:
        for (alpha, gamma), beta in itertools.product(turns, betas):
            goal = zyx(math.radians(alpha), math.radians(beta), math.radians(gamma))
            mount = mounts(arm, q, goal)
            for one, (name, moment) in itertools.product(specifications, MOMENTS.items()):
                pose = f"alpha{alpha:+d} beta{beta:+d} gamma{gamma:+d}, {one.name}"
                wrench = (*AT_REST, *(size * share for share in moment))
                found.append(Trial(f"{pose}, moment {name}", pose, one, q, goal, mount, push=wrench))
    return tuple(found)


TASK = ContactTask(
    name="wrench-probe",
    title="Known moments at a hand in free space",
    source="Murphy 1988, 3.3 and equations 3.9 to 3.12",
    horizon_s=0.5,
    surroundings=surroundings,
    trials=trials,
)
