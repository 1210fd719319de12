"""What the hand exerts and feels: its error against the force and moment ordered, how soon it is right, and peaks.

Errors are f + h and m + h along and about the axes that comply, from the first touch on (`contact_force`).
"""

from functools import partial

import numpy as np

from bench.engines.metrics.contact_force import (
    force_error,
    from_first_touch,
    last,
    lengths,
    moment_error,
    peak,
    remaining_error,
    rms,
    scene_normal,
)
from bench.engines.metrics.contact_metric import ContactMetric, Pose
from tasks.rules import RULES

SLIDING = "force-on-plane"


def contact_settling_time(pose: Pose) -> float:
    """Time [s] from the first touch until |f + h| stays within 2 % of |h|; NaN if never, or without order or touch."""
    one, touched = last(pose), from_first_touch(pose)
    ordered = np.linalg.norm(pose.first.trial.specification.desired_wrench[:3])
    if one is None or touched is None or ordered == 0.0:
        return np.nan
    outside = np.flatnonzero(lengths(force_error(pose)) > RULES.tolerance * ordered)
    settled = outside[-1] + 1 if outside.size else 0
    time = one.time[touched]
    return float(time[settled] - time[0]) if settled < len(time) else np.nan


def normal_force_error(pose: Pose) -> float:
    """Root mean square of n . (f + h) [N], n the normal of the plane that a tip slides along."""
    one, touched = pose.first, from_first_touch(pose)
    if touched is None or pose.task.name != SLIDING:
        return np.nan
    error = (one.force[touched] + np.array(one.trial.specification.desired_wrench[:3])) @ scene_normal(one.trial)
    return rms(pose, lambda _: error[:, None])


force_error_peak, force_error_rms = partial(peak, error_of=force_error), partial(rms, error_of=force_error)
moment_error_peak, moment_error_rms = partial(peak, error_of=moment_error), partial(rms, error_of=moment_error)
"""max and root mean square of |f + h| [N] and |m + h| [N m]; NaN without touch, or if no axis complies."""
force_error_end = partial(remaining_error, error_of=force_error)
moment_error_end = partial(remaining_error, error_of=moment_error)
"""|mean of f + h| [N] and |mean of m + h| [N m] over the last RULES.hold_s."""


def force_overshoot(pose: Pose) -> float:
    """max -f . h / |h|^2 - 1: by how much of the force h ordered a hand presses harder; NaN: no order or touch."""
    ordered, touched = np.array(pose.first.trial.specification.desired_wrench[:3]), from_first_touch(pose)
    if touched is None or not ordered.any():
        return np.nan
    return float((-pose.first.force[touched] @ ordered).max() / (ordered @ ordered) - 1.0)


def largest(pose: Pose, field: str) -> float:
    """Return the largest length of a field of the records over all ticks; NaN if nothing was recorded."""
    seen = np.concatenate([getattr(one, field) for one in pose.responses])
    return float(np.fmax.reduce(lengths(seen) if seen.ndim > 1 else seen, initial=np.nan))


peak_force, peak_moment = partial(largest, field="force"), partial(largest, field="moment")
"""max |f| [N] and max |m| [N m], whatever the direction."""
peak_torque_ratio = partial(largest, field="load")
"""max |tau_i| / rated_i: above 1, a real arm could not have done it."""


METRICS = (
    ContactMetric(
        "contact_settling_time_s", "s", "settling time of the force, from the first touch", contact_settling_time
    ),
    ContactMetric("normal_force_error_n", "N", "error of the force normal to the plane, rms", normal_force_error),
    ContactMetric(
        "force_error_peak_n", "N", "error of the force exerted, largest", force_error_peak
    ),
    ContactMetric("force_error_rms_n", "N", "error of the force exerted, rms", force_error_rms),
    ContactMetric(
        "force_error_end_n", "N", "error of the force exerted at the end, mean", force_error_end
    ),
    ContactMetric(
        "moment_error_end_nm", "N m", "error of the moment exerted at the end, mean", moment_error_end
    ),
    ContactMetric(
        "moment_error_peak_nm", "N m", "error of the moment exerted, largest", moment_error_peak
    ),
    ContactMetric(
        "moment_error_rms_nm", "N m", "error of the moment exerted, rms", moment_error_rms
    ),
    ContactMetric("force_overshoot", "1", "largest force over the one ordered, less 1", force_overshoot),
    ContactMetric("peak_force_n", "N", "largest force on the hand", peak_force),
    ContactMetric("peak_moment_nm", "N m", "largest moment on the hand", peak_moment),
    ContactMetric("peak_torque_ratio", "1", "largest torque over the motor's rated one", peak_torque_ratio),
)
