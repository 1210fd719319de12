"""How far the hand has turned, in the end, about axes of the base frame that the order holds."""

import numpy as np

from bench.metrics.contact_metric import ContactMetric, Pose
from bench.metrics.measured_compliance import held, turned


def measure(pose: Pose) -> float:
    """The largest rotation [rad] about held axes from start to end; NaN if none is held, or an episode broke off."""
    about = held(pose)
    if not about.any() or any(one.outcome != "done" for one in pose.responses):
        return np.nan
    return float(max(np.linalg.norm(turned(one.R)[about]) for one in pose.responses))


METRIC = ContactMetric("held-turn", "held_turn_rad", "rad", "rotation about held axes at the end", measure)
