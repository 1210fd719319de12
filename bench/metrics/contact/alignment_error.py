"""How flat a tool lies on a plate in the end: the angle between its face and the plate."""

import numpy as np

from bench.metrics.contact_force import last, scene_normal, wrist_axis
from bench.metrics.contact_metric import ContactMetric, Pose

FLAT = "surface-alignment"


def measure(pose: Pose) -> float:
    """Angle [rad] between the wrist's axis and the plate's normal at the end, pointing at each other."""
    one = last(pose)
    if one is None or pose.task.name != FLAT:
        return np.nan
    out, normal = wrist_axis(one)[-1], scene_normal(one.trial)
    return float(np.arctan2(np.linalg.norm(np.cross(out, normal)), -out @ normal))


METRIC = ContactMetric(
    "alignment-error", "alignment_error_rad", "rad", "angle between tool and plate at the end", measure
)
