"""A hand turns a crank on the wall: one translation and the yaw are held, and the hinge decides the rest.

The hand has the handle fast in its grip (a weld), so that it turns with the crank. The hinge is level and along no
base axis. So its motion keeps the yaw, and to hold one translation, moving, and the yaw asks for just what the hinge
allows; compliance along the other axes of the base must be what turns the hand. What a controller holds
instead of the yaw it holds against the hinge.

The crank begins leaning over by START to one side and is turned to the other. Trials differ in the azimuth of the
hinge, to which the last joint turns the hand, and in the hand's frame, R = Ry(beta) at the goal; those that differ in
beta alone are the same mechanics.
"""

from __future__ import annotations

import functools
import itertools
import math

from tasks.arm_model import Arm
from tasks.contact import ContactTask, Specification, Surroundings, Trial, attribute
from tasks.contact_rest import HORIZON_S
from tasks.hand_frames import BETAS, DENSE_BETAS, UP, at, mounts, wrist
from tasks.rotations import columns, multiply, zyx

RADIUS = 0.12  # of the crank [m]
START = math.radians(20.0)  # from upright
ASIDE, ABOVE = RADIUS * math.sin(START), RADIUS * math.cos(START)  # the handle from the hinge, at the start [m]
TIP = (0.0, 0.0, 0.12)  # the handle, in the wrist's frame [m]
SPEED = 0.03  # along the base's x [m/s]
AZIMUTHS = (60, 105, -75)  # of the hinge [deg]; where it is negative the crank is turned towards -x
DENSE_AZIMUTHS = (50, 60, 75, 105, 120, 130, -50, -60, -75, -105, -120, -130)


def surroundings(arm: Arm) -> Surroundings:
    """Return a hub with a hinge about the scene's x, a crank, and the hand's grip on it."""
    length, handle = TIP[2], f"{ASIDE} {ABOVE}"
    hand = f'<geom type="cylinder" size=".015 {length / 2}" pos="0 0 {length / 2}" mass="0" rgba=".3 .5 .8 1"/>'
    scene = f"""
    <geom type="capsule" size=".02" fromto="-.03 0 0 .03 0 0" rgba=".75 .7 .6 1"/>
    <body name="crank">
      <inertial pos="0 {ASIDE / 2} {ABOVE / 2}" mass=".2" diaginertia=".001 .001 .001"/>
      <joint name="hinge" axis="1 0 0" damping=".5"/>
      <geom type="capsule" size=".008" fromto="0 0 0 0 {handle}" rgba=".75 .7 .6 1"/>
      <geom type="capsule" size=".012" fromto="-.04 {handle} .04 {handle}" rgba=".75 .7 .6 1"/>
    </body>"""
    # anchor: the handle in the crank's frame; relpose: the handle, and how the crank lies, in the hand's
    grip = f'<weld body1="hand" body2="crank" anchor="0 {handle}" relpose="{attribute((*TIP, *UP))}"/>'
    return Surroundings(hand, TIP, scene, f"<equality>{grip}</equality>", joint="hinge")


@functools.cache
def trials(arm: Arm, dense: bool = False) -> tuple[Trial, ...]:
    """Return a trial for every hinge that the last joint reaches and frame of the hand, on a coarse or dense grid."""
    grid = itertools.product(DENSE_AZIMUTHS, DENSE_BETAS) if dense else itertools.product(AZIMUTHS, BETAS)
    found = []
    for azimuth, beta in grid:
        q = _turned(arm, math.radians(azimuth))
        if not arm.lower[-1] <= q[-1] <= arm.upper[-1]:
            continue
        goal = zyx(0.0, math.radians(beta), 0.0)
        hub = at(arm, q, (TIP[0], TIP[1] + ASIDE, TIP[2] + ABOVE))
        velocity = (math.copysign(SPEED, azimuth), 0.0, 0.0)
        specification = Specification("y, z, about x and y", (1, 0, 0, 0, 0, 1), velocity=velocity, moves_s=2.5)
        pose, upright = f"azimuth {azimuth}, beta{beta:+d}", multiply(wrist(arm, q)[1], UP)
        found.append(Trial(pose, pose, specification, q, goal, mounts(arm, q, goal), hub, upright))
    return tuple(found)


def _turned(arm: Arm, azimuth: float) -> tuple[float, ...]:
    """Return the posture with the wrist's x axis turned to this azimuth by the last joint, whose axis points down."""
    q = arm.home
    x = columns(wrist(arm, q)[1])[0]
    return (*q[:-1], q[-1] - math.remainder(azimuth - math.atan2(x[1], x[0]), math.tau))


TASK = ContactTask(
    name="crank",
    title="A crank turned on its hinge",
    source="Mason 1981",
    horizon_s=HORIZON_S,
    surroundings=surroundings,
    trials=trials,
    rests=True,
)
