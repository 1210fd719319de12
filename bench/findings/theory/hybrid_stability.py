"""Whether Raibert and Craig's hybrid control, as they wrote it, is stable where nothing touches the hand.

A servo at each joint is given what a selection S keeps of the joints' error, and of its rate. At rest, to first order,

    D qddot = -C (kp G q + kv G qdot)      original     G = J^-1 S J          (Raibert and Craig 1981)
                                           projected    G = (S J)^+ (S J)     (Fisher and Mujtaba 1991)

C [kg m^2] is what the servos take for the joints' inertias: C kp and C kv are their gains. Of every eigenvalue mu of
D^-1 C G come two roots of lambda^2 + kv mu lambda + kp mu = 0. The original's G is an oblique projection: mu may be
negative, and then the arm runs away by its own position control, whatever kp and kv are: "kinematic instability". The
second G is symmetric, so that with the same gains at every joint no mu is negative and nothing ever grows. With gains
of its own at every joint that is no theorem.

What complies has mu = 0 in both forms, moves freely, and is left out.

The controllers of `bench.law.control.hybrid` do not have this instability in either form: tau = D y cancels the arm's
inertia, and D^-1 is not between what is commanded along a row and what it does.

Limitations: where J^-1 does not exist.
Source: Raibert and Craig 1981; An and Hollerbach 1987, who found it; Fisher and Mujtaba 1991, Hewlett-Packard
Laboratories report HPL-91-140, who explained it.
"""

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple

import mujoco
import numpy as np

from bench.law.inputs import PAPERS_GAINS, Gains
from tasks.arm_model import Arm, model_xml
from tasks.kinematics import kinematics

ORIGINAL, PROJECTED = "original", "projected"


class Pose(NamedTuple):
    """J (6 x 6) and D (6 x 6) [kg m^2] at q (6) [rad]; J in metres and radians, along whatever is selected."""

    q: np.ndarray
    J: np.ndarray
    D: np.ndarray


def poses(arm: Arm, count: int, seed: int) -> list[Pose]:
    """Poses of an arm of six joints, drawn evenly from their ranges, or all round; J is the tool's, base frame."""
    model = mujoco.MjModel.from_xml_string(model_xml(arm, 1e-3))
    data, D = mujoco.MjData(model), np.zeros((arm.joints, arm.joints))
    low, high = np.clip(arm.lower, -math.pi, None), np.clip(arm.upper, None, math.pi)
    found = []
    for q in np.random.default_rng(seed).uniform(low, high, (count, arm.joints)):
        data.qpos[:] = q
        mujoco.mj_forward(model, data)
        mujoco.mj_fullM(model, data, D)
        found.append(Pose(q, kinematics(arm).jacobian(q), D.copy()))
    return found


def even(at: Pose) -> np.ndarray:
    """C of servos that are all alike: the mean of the joints' inertias, 6."""
    return np.full(len(at.D), np.trace(at.D) / len(at.D))


def tuned(at: Pose) -> np.ndarray:
    """Return C of servos that are tuned joint by joint at every pose: each joint's own inertia, 6."""
    return np.diag(at.D)


def eigenvalues(at: Pose, held: Sequence[int], form: str, servos: Callable[[Pose], np.ndarray] = even) -> np.ndarray:
    """The eigenvalues mu of D^-1 C G, as many as rows are held; those of what complies, which are 0, are left out.

    Args:
        held: of each row of J 1 if it is held, 0 if it complies. form: ORIGINAL or PROJECTED.
    """
    rows = np.flatnonzero(held)
    kept = at.J[rows]
    back = np.linalg.inv(at.J)[:, rows] if form == ORIGINAL else np.linalg.pinv(kept)
    return np.linalg.eigvals(kept @ np.linalg.solve(at.D, servos(at)[:, None] * back))


def growth(mu: np.ndarray, gains: Gains = PAPERS_GAINS) -> float:
    """The largest real part of the roots lambda [1/s]: where it is positive, the arm runs away."""
    half = 0.5 * gains.kv * mu.astype(complex)
    return float((np.sqrt(half * half - gains.kp * mu) - half).real.max())


def unstable_share(
    at: Sequence[Pose],
    held: Sequence[int],
    form: str,
    servos: Callable[[Pose], np.ndarray] = even,
    gains: Gains = PAPERS_GAINS,
) -> float:
    """The share of poses at which the arm runs away."""
    return float(np.mean([growth(eigenvalues(one, held, form, servos), gains) > 0.0 for one in at]))
