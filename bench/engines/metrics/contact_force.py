"""A hand that touches something: from when on, and what it exerts less what it was ordered to.

    e = F + h        along and about the axes that comply: at rest F = -h, F = (f, m) what the surroundings do

The hand has no mass, so that F is exactly zero before the first touch. Base frame, N, N m.
"""

from collections.abc import Callable
from functools import partial

import numpy as np

from bench.engines.metrics.contact_metric import ContactResponse, Pose, once_a_pose
from bench.engines.metrics.measured_compliance import in_free_space
from tasks.contact import Trial
from tasks.contact_rest import WINDOW_S
from tasks.domains import peg_in_hole
from tasks.rotations import columns
from tasks.rules import RULES, ticks

NOTHING = np.empty((0, 3))


@once_a_pose
def from_first_touch(pose: Pose) -> slice | None:
    """Return the ticks of a pose's one response from the first touch on; None if nothing was touched."""
    if in_free_space(pose):
        return None
    one = pose.first
    felt = np.flatnonzero(np.any(one.force != 0.0, axis=1) | np.any(one.moment != 0.0, axis=1))
    return slice(int(felt[0]), None) if felt.size else None


def _error(pose: Pose, field: str, kind: slice) -> np.ndarray:
    specification, touched = pose.first.trial.specification, from_first_touch(pose)
    complies = np.array(specification.selection[kind]) == 0
    if touched is None or not complies.any():
        return NOTHING
    return (getattr(pose.first, field)[touched] + np.array(specification.desired_wrench[kind])) * complies


force_error = once_a_pose(partial(_error, field="force", kind=slice(0, 3)))
moment_error = once_a_pose(partial(_error, field="moment", kind=slice(3, 6)))
"""f + h [N] and m + h [N m] along and about the axes that comply, 0 for the others, N x 3 from the first touch on."""


def lengths(vectors: np.ndarray) -> np.ndarray:
    """Return the length of each of N vectors, N x 3, as numpy.linalg.norm rounds it, in a third of its time."""
    x, y, z = vectors.T
    return np.sqrt(x * x + y * y + z * z)


def rms(pose: Pose, error_of: Callable[[Pose], np.ndarray]) -> float:
    """Root of the mean square of the lengths of N vectors, N x 3, over WINDOW_S; NaN if there is none.

    What ended at rest before is taken to stay as it was.
    """
    error = error_of(pose)
    if not len(error):
        return np.nan
    squares, one = (error**2).sum(axis=1), pose.first
    count = ticks(WINDOW_S, float(one.time[1])) if len(one.time) > 1 and one.time[1] > 0.0 else len(squares)
    missing = max(0, count - len(squares)) if one.rested else 0
    total = squares[:count].sum() + missing * squares[-1]
    return float(np.sqrt(total / (min(count, len(squares)) + missing)))


def remaining_error(pose: Pose, error_of: Callable[[Pose], np.ndarray]) -> float:
    """Return the length of the mean of N vectors over the last RULES.hold_s.

    NaN if there is none, or a failure. A hand that is at rest has been at rest for as long. If a
    hand bounces, the mean is what counts.
    """
    error = error_of(pose)
    trial = last(pose)
    if trial is None or not len(error):
        return np.nan
    time = trial.time[len(trial.time) - len(error) :]
    late = time >= time[-1] - RULES.hold_s
    return float(np.linalg.norm(error[late].mean(axis=0)))


def peak(pose: Pose, error_of: Callable[[Pose], np.ndarray]) -> float:
    """Return the greatest length of N vectors, N x 3; NaN if there is none."""
    error = error_of(pose)
    return float(lengths(error).max()) if len(error) else np.nan


def last(pose: Pose) -> ContactResponse | None:
    """Return the one response of a pose if it ran to its end, at rest or at the horizon; else None."""
    return pose.first if pose.first.outcome == "done" else None


def scene_normal(trial: Trial) -> np.ndarray:
    """Return the z axis of the scene, in the base frame: the normal of a plane that stands there."""
    return np.array(columns(trial.scene_wxyz)[2])


def wrist_axis(one: ContactResponse) -> np.ndarray:
    """Return the wrist's z axis, N x 3 in the base frame, whatever the hand's frame."""
    return one.R @ np.array(columns(one.trial.mount_wxyz))[:, 2]


def insertion(pose: Pose) -> np.ndarray | None:
    """How far the tip is below the mouth of the hole, along its axis [m], N, and 0 beside it; None without a hole."""
    one = last(pose)
    if one is None or pose.task.name != peg_in_hole.TASK.name:
        return None
    across, along, depth = columns(one.trial.scene_wxyz) @ (np.array(one.trial.scene_pos) - one.p).T
    return np.where(np.maximum(np.abs(across), np.abs(along)) < peg_in_hole.HOLE, depth, 0.0)
