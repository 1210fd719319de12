"""Starts of `clear`, other ones, with the tool turning at up to 5 rad/s in any direction and its position at rest.

Speeds are stratified on (0, 5] rad/s, directions uniform on the sphere. The joint rates are the least that give them,
qdot = J^+ (0, omega). At 5 rad/s the damping Kv omega is 100 rad/s^2, a third of the greatest spring term, 100 pi. The
paper starts at rest.
"""

from __future__ import annotations

from tasks.arm_model import Arm
from tasks.arm_starts.clear import clear_turns, van_der_corput
from tasks.base import ArmStartSet, Start
from tasks.haar import direction, halton
from tasks.kinematics import kinematics

SIZE = 24
SPEED_LIMIT = 5.0  # [rad/s]
OTHER_SEED = 1000  # moves the seed away from that of `clear`, whose starts these would be otherwise


def build(arm: Arm, count: int, seed: int) -> list[Start]:
    """Return the first `count` of the sequence of this seed."""
    model, starts = kinematics(arm), []
    directions = halton(count, 2, seed + OTHER_SEED)
    for i, (q, goal, _) in enumerate(clear_turns(model, count, seed + OTHER_SEED)):
        speed = SPEED_LIMIT * (1.0 - van_der_corput(i))
        x, y, z = direction(*directions[i])
        omega = (speed * x, speed * y, speed * z)
        starts.append(model.start(f"tumbling-{i:03d}", q, goal, model.rates(q, omega)))
    return starts


STARTS = ArmStartSet("tumbling", "The tool turning at up to 5 rad/s, its position at rest", SIZE, build)
