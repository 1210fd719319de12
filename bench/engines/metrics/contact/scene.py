"""What the hand has done to the scene in the end: a tool laid flat, a crank turned, a peg put in; how deep it presses.

All but the penetration are NaN on other tasks, and where an episode broke off.
"""

import numpy as np

from bench.engines.metrics.contact_force import insertion, last, scene_normal, wrist_axis
from bench.engines.metrics.contact_metric import ContactMetric, ContactResponse, Pose
from tasks.domains.peg_in_hole import DEPTH

FLAT = "surface-alignment"
# A peg this near to the bottom is in: a tenth of the way is the chamfer's, and its lower face may stand askew.
IN = 0.9 * DEPTH


def alignment_error(pose: Pose) -> float:
    """Angle [rad] between the wrist's axis and the plate's normal at the end, pointing at each other."""
    one = last(pose)
    return float(angle_to_plate(one)[-1]) if one is not None and pose.task.name == FLAT else np.nan


def angle_to_plate(one: ContactResponse) -> np.ndarray:
    """Return the angle to the plate [rad] at every tick, N."""
    out, normal = wrist_axis(one), scene_normal(one.trial)
    return np.arctan2(np.linalg.norm(np.cross(out, normal), axis=1), -out @ normal)


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
    """1 if the peg is not in at the end, 0 if it is: stuck, at rest or creeping."""
    depth = insertion(pose)
    return np.nan if depth is None else float(depth[-1] < IN)


def penetration(pose: Pose) -> float:
    """max -gap [m] over all ticks, what the contact model gives way; NaN if they never touched."""
    nearest = float(np.fmin.reduce(np.concatenate([one.gap for one in pose.responses]), initial=np.nan))
    return -nearest if nearest < 0.0 else np.nan


METRICS = (
    ContactMetric("alignment_error_rad", "rad", "angle between tool and plate at the end", alignment_error),
    ContactMetric("crank_angle_rad", "rad", "angle that the scene's joint was turned by", crank_angle),
    ContactMetric("insertion_depth_m", "m", "depth of the peg in the hole at the end", insertion_depth),
    ContactMetric("jam", "1", "share of pegs that are not in at the end", jam),
    ContactMetric("penetration_m", "m", "deepest penetration of hand and scene", penetration),
)
