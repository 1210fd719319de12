"""What the hand has done to the scene in the end: a tool laid flat, a crank turned, a peg put in; how deep it presses.

All but the penetration are NaN on other tasks, and where an episode broke off.
"""

import numpy as np

from bench.metrics.contact_force import insertion, last, scene_normal, wrist_axis
from bench.metrics.contact_metric import ContactMetric, Pose
from tasks.domains.peg_in_hole import DEPTH

FLAT = "surface-alignment"
# A peg this near to the bottom is in: a tenth of the way is the chamfer's, and its lower face may stand askew.
IN = 0.9 * DEPTH
# A peg stands if it has moved by less [m] in the last tenth of the episode: at that rate it takes ten times the episode
# to go all the way. Soft contacts creep under friction.
STILL = 0.01 * DEPTH


def alignment_error(pose: Pose) -> float:
    """Angle [rad] between the wrist's axis and the plate's normal at the end, pointing at each other."""
    one = last(pose)
    if one is None or pose.task.name != FLAT:
        return np.nan
    out, normal = wrist_axis(one)[-1], scene_normal(one.trial)
    return float(np.arctan2(np.linalg.norm(np.cross(out, normal)), -out @ normal))


def crank_angle(pose: Pose) -> float:
    """Angle [rad] of the scene's joint at the end, less that at the start; NaN if the scene has no joint."""
    one = last(pose)
    if one is None or not pose.task.surroundings(pose.arm).joint:
        return np.nan
    return float(one.turned[-1] - one.turned[0])


def insertion_depth(pose: Pose) -> float:
    """Depth [m] of the middle of the peg's lower face below the mouth, along the hole's axis; at least 0."""
    depth = insertion(pose)
    return float(max(depth[-1], 0.0)) if depth is not None else np.nan


def jam(pose: Pose) -> float:
    """1 if the peg is stuck at the end (not in, and goes no further), 0 if it is in or still on its way."""
    depth = insertion(pose)
    if depth is None:
        return np.nan
    late = depth[-max(2, len(depth) // 10) :]
    return float(depth[-1] < IN and late.max() - late.min() < STILL)


def penetration(pose: Pose) -> float:
    """max -gap [m] over all ticks, what the contact model gives way; NaN if they never touched."""
    nearest = float(np.fmin.reduce(np.concatenate([one.gap for one in pose.responses]), initial=np.nan))
    return -nearest if nearest < 0.0 else np.nan


METRICS = (
    ContactMetric("alignment_error_rad", "rad", "angle between tool and plate at the end", alignment_error),
    ContactMetric("crank_angle_rad", "rad", "angle that the scene's joint was turned by", crank_angle),
    ContactMetric("insertion_depth_m", "m", "depth of the peg in the hole at the end", insertion_depth),
    ContactMetric("jam", "1", "share of pegs that are stuck", jam),
    ContactMetric("penetration_m", "m", "deepest penetration of hand and scene", penetration),
)
