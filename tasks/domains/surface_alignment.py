"""A flat tool pressed onto a tilted plate: a hand that complies about x and y lets itself be turned until it lies flat.

The tool's face is a square with four sharp corners, and the plate a half space, so that MuJoCo's contacts are exactly
the corners that touch: the smooth way in which the face tips from corner to edge to face is the mechanics', not a
collision routine's. The plate stands as near as it can without touching; the hand goes down until a corner meets it.

What complies turns the tool about x and y alone. That the yaw about z is held is what Euler angles get wrong: with
Z-Y-X angles the third axis that complies is the hand's own x, which leans towards z as beta grows.
"""

from __future__ import annotations

import functools
import itertools

from tasks.arm_model import Arm
from tasks.base import Quat, Vector
from tasks.contact import ContactTask, Specification, Surroundings, Trial
from tasks.contact_rest import HORIZON_S
from tasks.hand_frames import at, leaning_trials, wrist
from tasks.rotations import columns

SIDE = 0.1  # of the face [m]
TIP = (0.0, 0.0, 0.12)  # middle of the face, in the wrist's frame [m]
CLEARANCE = 0.001  # of the lowest corner at the start [m]
# Springs alone heed where the hand is held. It is lowered so fast [m/s], to so far [m] below the place where the tool
# lies flat: a spring that turns the tool has to follow it down.
LOWERING, BELOW = 0.02, 0.005
SPECIFICATION = Specification(
    "z, about x and y",
    (1, 1, 0, 0, 0, 1),
    desired_wrench=(0.0, 0.0, -20.0, 0.0, 0.0, 0.0),
    velocity=(0.0, 0.0, -LOWERING),
)
# degrees: by how much the plate is tilted, and the azimuth of the axis it is tilted about
PLATES = ((5, 90), (10, 30), (20, 0), (20, 120))
DENSE_PLATES = tuple(itertools.product((5, 10, 15, 20), range(0, 360, 45)))


def surroundings(arm: Arm) -> Surroundings:
    """Return a square tool on a stem, and a plate."""
    half, thick, length = SIDE / 2, 0.008, TIP[2]
    hand = (
        f'<geom type="cylinder" size=".02 {length / 2}" pos="0 0 {length / 2}" mass="0" rgba=".3 .5 .8 1"/>'
        f'<geom name="tool" type="box" size="{half} {half} {thick}" pos="0 0 {length - thick}" mass="0" '
        'rgba=".3 .5 .8 1"/>'
    )
    return Surroundings(hand, TIP, '<geom name="plate" type="plane" size=".12 .12 .01" rgba=".75 .7 .6 1"/>')


@functools.cache
def trials(arm: Arm, dense: bool = False) -> tuple[Trial, ...]:
    """Return a trial for every plate and frame of the hand, on a coarse grid or a dense one."""
    tip = at(arm, arm.home, TIP)

    def stands(plate: Quat, tilt: float) -> tuple[Specification, Vector, Quat]:
        normal = columns(plate)[2]
        sides = columns(wrist(arm, arm.home)[1])[:2]
        reach = sum(abs(sum(side[i] * normal[i] for i in range(3))) for side in sides) * SIDE / 2
        x, y, z = tip
        low = z - (CLEARANCE + reach) / normal[2]  # the lowest corner is CLEARANCE from the plate
        return SPECIFICATION._replace(moves_s=(z - low + BELOW) / LOWERING), (x, y, low), plate

    return leaning_trials(arm, DENSE_PLATES if dense else PLATES, dense, stands)


TASK = ContactTask(
    name="surface-alignment",
    title="A flat tool pressed onto a tilted plate",
    source="Raibert and Craig 1981; Murphy 1988, 3.3",
    horizon_s=HORIZON_S,
    surroundings=surroundings,
    trials=trials,
    rests=True,
)
