"""From records to rows: poses of a task in contact, as rows of compliance.parquet.

A record is folded into numbers as soon as the trials of its pose are there, and then dropped: it is 25 doubles a tick.

    C = argmin sum |theta_k - C m_k|^2      measured rotation per moment [rad/(N m)]

over the trials of a pose that a moment alone pushes; theta is the rotation vector from the first tick to the last,
base frame.
"""

import numpy as np
import pandas as pd

from bench.compliance import Compliant
from bench.contact_metric import Pose, Response, response
from bench.discovery import known_contact_metrics
from bench.engines.contact_episode import DONE, OUTCOMES, Conditions, Ended
from bench.engines.run_contact import run
from bench.representations.zyx_euler import chart
from bench.so3 import from_quaternion
from tasks.arm import Arm
from tasks.contact import ContactTask, Trial

WORST_LAST = (DONE, "singular", "saturated", "diverged", "broken")
"""Outcomes; a pose has the worst of its trials'."""

assert set(WORST_LAST) == set(OUTCOMES.values())

MEASURED = tuple(f"c_{i}{j}" for i in "xyz" for j in "xyz")


def frame(
    suite: str,
    compliant: Compliant,
    task: ContactTask,
    arm: Arm,
    poses: tuple[tuple[Trial, ...], ...],
    conditions: Conditions,
) -> pd.DataFrame:
    """One row a pose; a pose is the trials that share it."""
    episodes = run("native", compliant, task, arm, (trial for pose in poses for trial in pose), conditions)
    rows = [_row(task, arm, compliant, [(one, next(episodes)) for one in pose], conditions) for pose in poses]
    return pd.DataFrame([{"suite": suite, **row} for row in rows])


def _row(task: ContactTask, arm: Arm, compliant: Compliant, ended: list[tuple[Trial, Ended]], conditions) -> dict:
    first = ended[0][0]
    outcome = max((one.outcome for _, one in ended), key=WORST_LAST.index)
    ticks = min(len(one.record) for _, one in ended if one.outcome == outcome)
    pose = Pose(task, arm, compliant, tuple(response(*each) for each in ended))
    with np.errstate(all="ignore"):  # of a record that ends beyond all bounds
        measured = {one.column: one.measure(pose) for one in known_contact_metrics().values()}
    return {
        "task": task.name,
        "arm": arm.name,
        "controller": compliant.law,
        "representation": compliant.representation.name if compliant.representation else "",
        "form": compliant.form,
        "pose": first.pose,
        "complies": first.order.name,
        **dict(zip(("alpha", "beta", "gamma"), chart(from_quaternion(first.goal_wxyz)).E, strict=True)),
        "tilt": first.tilt,
        **conditions.gains._asdict(),
        **conditions.touch._asdict(),
        "dt_s": conditions.dt_s,
        "integrator": conditions.integrator,
        "horizon_s": task.horizon_s,
        "trials": len(ended),
        "outcome": outcome,
        "failure_time_s": np.nan if outcome == DONE else ticks * conditions.dt_s,
        **measured,
        **dict(zip(MEASURED, rotation_per_moment(pose.responses).ravel(), strict=True)),
    }


def rotation_per_moment(responses: tuple[Response, ...]) -> np.ndarray:
    """C, 3 x 3; NaN unless moments alone push, in three independent directions, and every trial is done."""
    pushes = np.array([one.trial.push for one in responses])
    if any(one.outcome != DONE or one.trial.legs for one in responses) or pushes[:, :3].any():
        return np.full((3, 3), np.nan)
    turned = np.array([_rotation_vector(one.R[-1] @ one.R[0].T) for one in responses])
    C, _, rank, _ = np.linalg.lstsq(pushes[:, 3:], turned, rcond=None)
    return C.T if rank == 3 else np.full((3, 3), np.nan)


def _rotation_vector(R: np.ndarray) -> np.ndarray:
    """theta, below a half turn: R - R^T is 2 sin|theta| times its direction."""
    s = 0.5 * np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]])
    sine = np.linalg.norm(s)
    return s * (np.arctan2(sine, 0.5 * (np.trace(R) - 1.0)) / sine) if sine > 0.0 else s
