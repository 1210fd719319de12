"""Turns whose middle is on the pole beta = +-pi/2 of the Z-Y-X angles, or misses it by 10^-k rad, in good condition.

The tool's n stands upright in the middle, n = (0, 0, -+1), and the turn about a horizontal axis d takes it through
there; or the middle is tilted by 10^-k rad towards d, and then no point of the turn is nearer to the pole. Start and
goal are HALF_ANGLE before and after the middle, where |cos beta| = sin(HALF_ANGLE) = 0.64. All of the joint path is
clear (clearance.py): the arm can do this with a geometric Jacobian, and what fails there is the representation.

The axis and the goal are computed from the start's own quaternion so that the geodesic's middle is the quaternion of
the pole to rounding, |n_z| >= 1 - 1e-15. Integrator and sampling decide how near the arm comes. Poses are found around
home: n is turned upright the shortest way, d points anywhere.
"""

from __future__ import annotations

import math

import numpy as np

from tasks.arm_model import Arm
from tasks.arm_starts.clear import around_home
from tasks.base import ArmStartSet, Quat, Start, Vector
from tasks.clearance import clear_path, clear_turn_through, steps_for
from tasks.kinematics import Kinematics, kinematics
from tasks.paths import to_vertical, turned

HALF_ANGLE = math.radians(40.0)
POLES = {"plus": 1, "minus": -1}
DECADES = range(1, 8)
POSES = 2  # for each pole
SIZE = len(POLES) * POSES * (1 + len(DECADES))
TRIES = 200  # candidates of a pose; our arms refuse up to six for each that does


def build(arm: Arm, count: int, seed: int) -> list[Start]:
    """Exact ones first, then every pose at 0.1 rad, 0.01 rad, ..."""
    model, families = kinematics(arm), []
    candidates = around_home(arm, seed)
    for i in range(POSES):
        for word, sign in POLES.items():
            family = next(filter(None, (_family(model, *next(candidates), sign) for _ in range(TRIES))), None)
            if family:
                names = [f"pole-{word}-{i}-{miss}" for miss in ("exact", *(f"k{k}" for k in DECADES))]
                families.append([model.start(name, *one) for name, one in zip(names, family, strict=True)])
    return [start for level in zip(*families, strict=True) for start in level]


def _family(model: Kinematics, q: np.ndarray, axis: Vector, sign: int) -> list[tuple[np.ndarray, Quat]] | None:
    """(q, goal) of one pose: through the pole, then past it at every distance; None if any turn is not clear."""
    there = clear_path(model, q, to_vertical(model.pose(q)[1], -sign, steps_for(math.pi)))
    if there is None:
        return None
    azimuth = math.pi * axis[2]
    d = (math.cos(azimuth), math.sin(azimuth), 0.0)
    upright = to_vertical(model.pose(there[-1])[1], -sign, 1)[-1]
    found = []
    for tilt in (0.0, *(10.0**-k for k in DECADES)):
        # about the horizontal axis z x d, n leans from the vertical along d: the turn about d leaves that part of n
        middle = turned(upright, (-d[1], d[0], 0.0), tilt)
        turn = clear_turn_through(model, there[-1], middle, d, HALF_ANGLE)
        if turn is None:
            return None
        found.append(turn)
    return found


STARTS = ArmStartSet("pole", "Turns through and past beta = +-pi/2 with the arm in good condition", SIZE, build)
