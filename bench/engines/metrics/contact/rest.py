"""Whether a hand has come to rest in contact: when, how fast it still moves if not, and when a tool lies as it will.

For tasks that have an end (tasks/contact_rest.py has the rule); NaN for others, and where an episode broke off.
"""

from collections.abc import Callable

import numpy as np

from bench.engines.metrics.contact.scene import FLAT, angle_to_plate
from bench.engines.metrics.contact_force import from_first_touch, last
from bench.engines.metrics.contact_metric import ContactMetric, ContactResponse, Pose
from bench.engines.metrics.measured_compliance import turned
from tasks.contact_rest import REST
from tasks.rules import RULES


def time_to_rest(pose: Pose) -> float:
    """Time [s] from the first tick until the hand is at rest; NaN if it never is."""
    one = last(pose)
    return float(one.time[-1] - REST.hold_s) if one is not None and one.rested else np.nan


def time_to_align(pose: Pose) -> float:
    """Time [s] from the first touch until the angle to the plate stays within 2 % of what it was; NaN if never."""
    one, touched = last(pose), from_first_touch(pose)
    if one is None or touched is None or pose.task.name != FLAT:
        return np.nan
    angles, time = angle_to_plate(one)[touched], one.time[touched]
    outside = np.flatnonzero(angles > RULES.tolerance * angles[0])
    aligned = outside[-1] + 1 if outside.size else 0
    return float(time[aligned] - time[0]) if aligned < len(time) else np.nan


def _remaining(pose: Pose, moved: Callable[[ContactResponse, int], np.ndarray]) -> float:
    """Return the length of the motion from the tick REST.hold_s before the end to it, over the time between them."""
    one = last(pose)
    if one is None or not pose.task.rests or len(one.time) < 2:
        return np.nan
    late = int(np.searchsorted(one.time, one.time[-1] - REST.hold_s))
    return float(np.linalg.norm(moved(one, late)) / (one.time[-1] - one.time[late]))


def remaining_speed(pose: Pose) -> float:
    """Distance over time [m/s] between the hand's place REST.hold_s before the end and at it."""
    return _remaining(pose, lambda one, late: one.p[-1] - one.p[late])


def remaining_rate(pose: Pose) -> float:
    """Angle over time [rad/s] between the hand's orientation REST.hold_s before the end and at it."""
    return _remaining(pose, lambda one, late: turned(one.R[late:]))


METRICS = (
    ContactMetric("time_to_rest_s", "s", "time until the hand is at rest", time_to_rest),
    ContactMetric("time_to_align_s", "s", "time from the first touch until the tool lies flat to 2 %", time_to_align),
    ContactMetric("remaining_speed_m_per_s", "m/s", "speed at the end", remaining_speed),
    ContactMetric("remaining_rate_rad_per_s", "rad/s", "angular speed at the end", remaining_rate),
)
