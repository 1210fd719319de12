"""A square peg pushed into a chamfered square hole that leans: the hand yields sideways and turns until it fits.

The frame of the hand is in the middle of the peg's lower face, where compliance helps most (Whitney 1982). Everything
complies but the yaw, in which peg and hole fit from the start. The hand is pushed down by a force and not at a speed,
so that a peg that jams stands still and does not break; only an impedance's springs are pulled down.

In the frame of the body "scene" the hole's mouth is at z = 0, its axis is z, and the middle of the peg's lower face
comes to z = -DEPTH if it is all the way in.
"""

from __future__ import annotations

import functools
import itertools
import math

from tasks.arm_model import Arm
from tasks.base import Quat, Vector
from tasks.contact import ContactTask, Specification, Surroundings, Trial, attribute
from tasks.contact_rest import HORIZON_S
from tasks.hand_frames import UP, at, leaning_trials, plus, wrist
from tasks.rotations import about, multiply, to_base

PEG = 0.0125  # half its side [m]
CLEARANCE_SHARE = 0.02  # by which the hole is wider than the peg, of the peg's side
HOLE = PEG * (1.0 + CLEARANCE_SHARE)  # half its side [m]
DEPTH = 0.03  # m
CHAMFER = 0.004  # wide and deep [m]
WALL = 0.01  # thick [m]
TIP = (0.0, 0.0, 0.14)  # middle of the peg's lower face, in the wrist's frame [m]
CLEARANCE = 0.001  # over the mouth, of the peg's lowest corner at the start [m]
OFFSET = (0.0015, -0.001)  # of the peg from the hole's axis at the start, along the hole's x and y [m]
SPECIFICATION = Specification(
    "x, y, z, about x and y",
    (0, 0, 0, 0, 0, 1),
    desired_wrench=(0.0, 0.0, -30.0, 0.0, 0.0, 0.0),
    velocity=(0.0, 0.0, -0.016),  # for springs, which heed it: to 4 mm below the bottom
    moves_s=2.5,
)
# degrees: by how much the hole leans, and the azimuth of the axis it is turned about
HOLES = ((2, 90), (4, 30), (8, 0), (8, 120))
DENSE_HOLES = tuple(itertools.product((2, 4, 6, 8), range(0, 360, 45)))


def surroundings(arm: Arm) -> Surroundings:
    """Return a peg on a stem, and four walls with their chamfers and a bottom."""
    length = TIP[2]
    hand = (
        f'<geom type="cylinder" size=".008 {length / 2 - DEPTH}" pos="0 0 {length / 2 - DEPTH}" mass="0" '
        'rgba=".3 .5 .8 1"/>'
        f'<geom name="peg" type="box" size="{PEG} {PEG} {DEPTH}" pos="0 0 {length - DEPTH}" mass="0" '
        'rgba=".3 .5 .8 1"/>'
    )
    half = WALL / 2
    bottom = _box("bottom", (HOLE, HOLE, half), (0.0, 0.0, -DEPTH - half), 0)
    return Surroundings(hand, TIP, bottom + "".join(map(_side, range(4))))


def _side(k: int) -> str:
    """Return the wall and the chamfer in the direction of +x, turned by k quarters about z."""
    half, slope = WALL / 2, CHAMFER / math.sqrt(2)
    deep = (DEPTH - CHAMFER) / 2
    wall = _box(f"wall {k}", (half, HOLE + WALL, deep), (HOLE + half, 0.0, -CHAMFER - deep), k)
    sunk = half / math.sqrt(2)
    middle = (HOLE + CHAMFER / 2 + sunk, 0.0, -CHAMFER / 2 - sunk)
    return wall + _box(f"chamfer {k}", (half, HOLE + CHAMFER, slope), middle, k, math.pi / 4)


def _box(name: str, size: Vector, pos: Vector, quarters: int, lean: float = 0.0) -> str:
    turn = about((0.0, 0.0, 1.0), math.remainder(quarters * math.pi / 2, math.tau))
    place, quat = to_base(turn, pos), multiply(turn, about((0.0, 1.0, 0.0), lean))
    where = f'size="{attribute(size)}" pos="{attribute(place)}" quat="{attribute(quat)}"'
    return f'<geom name="{name}" type="box" {where} rgba=".75 .7 .6 .5"/>'


@functools.cache
def trials(arm: Arm, dense: bool = False) -> tuple[Trial, ...]:
    """Return a trial for every hole and frame of the hand, on a coarse grid or a dense one."""
    upright, tip = multiply(wrist(arm, arm.home)[1], UP), at(arm, arm.home, TIP)

    def stands(lean: Quat, tilt: float) -> tuple[Specification, Vector, Quat]:
        hole = multiply(lean, upright)
        over = CLEARANCE + 2 * PEG * math.sin(tilt)  # no corner is lower than that
        return SPECIFICATION, plus(tip, to_base(hole, (-OFFSET[0], -OFFSET[1], -over))), hole

    return leaning_trials(arm, DENSE_HOLES if dense else HOLES, dense, stands)


TASK = ContactTask(
    name="peg-in-hole",
    title="A peg pushed into a leaning, chamfered hole",
    source="Mason 1981; Whitney 1982",
    horizon_s=HORIZON_S,
    surroundings=surroundings,
    trials=trials,
    rests=True,
)
