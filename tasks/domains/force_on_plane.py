"""A round tip slides along a plane at constant speed and presses on it with constant force.

Only one translation complies, and the hand keeps its orientation. So the choice of coordinates should not matter here:
what a controller loses on this task it does not lose to compliance about the wrong axes. On a plane that rises or
falls the tip has to move along z, and the damping of what complies costs m_p kc times that speed of the force.
"""

from __future__ import annotations

import functools
import itertools

from tasks.arm_model import Arm
from tasks.base import Quat, Vector
from tasks.contact import ContactTask, Specification, Surroundings, Trial
from tasks.hand_frames import at, leaning_trials
from tasks.rotations import columns

RADIUS = 0.01  # of the tip [m]
TIP = (0.0, 0.0, 0.14)  # its middle, in the wrist's frame [m]
CLEARANCE = 0.001  # m
# 0.05 m/s, not along a base axis
SPECIFICATION = Specification(
    "z", (1, 1, 0, 1, 1, 1), desired_wrench=(0.0, 0.0, -15.0, 0.0, 0.0, 0.0), velocity=(0.04, 0.03, 0.0)
)
# degrees: by how much the plane is tilted, and the azimuth of the axis it is tilted about: to climb, fall and lean
PLANES = ((0, 0), (5, -45), (5, 135), (10, 35))
DENSE_PLANES = ((0, 0), *itertools.product((2, 5, 10, 15), range(0, 360, 45)))


def surroundings(arm: Arm) -> Surroundings:
    """Return a ball on a stem, and a plane."""
    length = TIP[2]
    hand = (
        f'<geom type="cylinder" size=".006 {length / 2}" pos="0 0 {length / 2}" mass="0" rgba=".3 .5 .8 1"/>'
        f'<geom name="ball" size="{RADIUS}" pos="0 0 {length}" mass="0" rgba=".3 .5 .8 1"/>'
    )
    return Surroundings(hand, TIP, '<geom name="plate" type="plane" size=".2 .2 .01" rgba=".75 .7 .6 1"/>')


@functools.cache
def trials(arm: Arm, dense: bool = False) -> tuple[Trial, ...]:
    """Return a trial for every plane and frame of the hand, on a coarse grid or a dense one."""
    x, y, z = at(arm, arm.home, TIP)

    def stands(plane: Quat, tilt: float) -> tuple[Specification, Vector, Quat]:
        return SPECIFICATION, (x, y, z - (RADIUS + CLEARANCE) / columns(plane)[2][2]), plane

    return leaning_trials(arm, DENSE_PLANES if dense else PLANES, dense, stands)


TASK = ContactTask(
    name="force-on-plane",
    title="A round tip slides along a plane under constant force",
    source="Raibert and Craig 1981",
    horizon_s=2.5,
    surroundings=surroundings,
    trials=trials,
)
