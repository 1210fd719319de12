"""Kinematic singularities of an arm: found near given joint angles, passed through, and passed at a distance.

Where rank J = 5 there is a twist u (6 numbers, |u| = 1, metres and radians) that no joint rates give the tool: J^T u =
0. The distance of J from the nearest singular matrix is its smallest singular value sigma_min (Eckart and Young), so
"at 10^-k from the singularity" says sigma_min = 10^-k, on any arm.

    through:  qdot = J^+ v + lambda w is the rate at which a turn v = (0, axis), v . u = 0, passes: of the null vectors
              w the one, and of lambda the values, for which u . Jdot qdot = 0, so that the joints stay smooth
    past:     the turn about the lost axis itself, u's rotational part; joint rates reach 1/sigma_min there

Derivatives of J are centred differences over 2e-6 rad: right to 1e-10, and Newton's method forgives that.

Fails: None where Newton's method does not converge, or the singularity is not of this kind (two twists lost at once,
or a turn that cannot pass: lambda complex).
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from tasks.base import Vector
from tasks.kinematics import Kinematics
from tasks.paths import turned

DIFFERENCE = 1e-6  # [rad]
NEWTON_STEPS = 40
LARGEST_STEP = 0.3  # [rad]
# |J^T u|: 1e-16 of J's elements, times some tens of operations.
SINGULAR = 1e-14
# How far from the singularity the two branches of a turn through it are begun [rad]: Newton's method then has
# sigma_min of some hundredths to work with, and the path's curvature leaves errors of 1e-4.
BEGIN = 0.02
# The first point of a turn past a singularity, as a share of the distance; each next one is farther by GROWTH, so that
# joints which swing by a quarter turn within a few distances move by less than 0.2 rad from point to point.
FIRST, GROWTH = 0.1, 1.3


class Singularity(NamedTuple):
    """A configuration where J has rank 5."""

    q: np.ndarray
    u: np.ndarray  # the lost twist
    null: np.ndarray  # n x (n - 5): joint rates that leave the tool where it is
    M: np.ndarray  # n x n: u . Jdot qdot = qdot . M qdot


def singularity_near(model: Kinematics, q: np.ndarray) -> Singularity | None:
    """Newton's method, steps of least norm, on J(q)^T u = 0 and |u| = 1."""
    q = np.array(q, dtype=float)
    u = np.linalg.svd(model.jacobian(q))[0][:, -1]
    n = len(q)
    A = np.zeros((n + 1, n + 6))
    for _ in range(NEWTON_STEPS):
        J = model.jacobian(q)
        residual = np.append(J.T @ u, 0.5 * (u @ u - 1.0))
        M = _derivative(model, q, u)
        if abs(residual).max() < SINGULAR:
            _, s, right = np.linalg.svd(J)
            return Singularity(q, u, right[5:].T, M) if s[4] > 1e-2 * s[0] else None
        A[:n, :n], A[:n, n:], A[n, n:] = M, J.T, u
        step = -np.linalg.lstsq(A, residual, rcond=None)[0]
        step *= min(1.0, LARGEST_STEP / abs(step).max())
        q += step[:n]
        u = u + step[n:]
    return None


def rates_through(model: Kinematics, at: Singularity, axis: Vector) -> list[np.ndarray]:
    """The joint rates, none to two of them, at which a turn about `axis` passes smoothly through a singularity."""
    least = np.linalg.pinv(model.jacobian(at.q), rcond=1e-9) @ np.array((0.0, 0.0, 0.0, *axis))
    slope = at.null.T @ (at.M + at.M.T) @ least
    length = float(np.linalg.norm(slope))
    if length < 1e-6:
        return []
    w = at.null @ slope / length
    a, b, c = float(w @ at.M @ w), length, float(least @ at.M @ least)
    root = b * b - 4.0 * a * c
    if root < 0.0:
        return []
    # the roots of a x^2 + b x + c without cancellation; a may be zero
    far = -0.5 * (b + math.sqrt(root))
    return [least + x * w for x in ([c / far] + ([far / a] if abs(a) > 1e-9 else []))]


def path_from(model: Kinematics, at: Singularity, axis: Vector, rates: np.ndarray, angles: list[float]):
    """The joint path out of a singularity along a turn about `axis`, by these angles [rad]; None if it ends early."""
    p, quat = model.pose(at.q)
    begin = math.copysign(BEGIN, angles[-1])
    guess = at.q + begin * rates
    q = model.reach(guess, p, turned(quat, axis, begin))
    if q is None or np.linalg.norm(q - guess) > 0.5 * BEGIN * np.linalg.norm(rates):
        return None
    return model.follow(q, [turned(quat, axis, angle) for angle in angles])


def beside(model: Kinematics, at: Singularity, distance: float) -> tuple[np.ndarray, Vector] | None:
    """Joint angles with sigma_min = distance, and the axis, of unit length, about which the tool can hardly turn."""
    w = np.linalg.svd(at.null.T @ at.M)[2][0]
    t = distance
    for _ in range(20):
        left, s, _ = np.linalg.svd(model.jacobian(at.q + t * w))
        if abs(s[5] - distance) < 1e-6 * distance:
            x, y, z = (left[3:, 5] / np.linalg.norm(left[3:, 5])).tolist()
            return at.q + t * w, (x, y, z)
        t *= distance / s[5]
    return None


def widening(distance: float, half: float, step: float) -> list[float]:
    """Angles [rad] from FIRST distance to `half`, at first in ratio GROWTH, then at most `step` apart."""
    angles = [FIRST * distance]
    while angles[-1] < half:
        angles.append(min(half, angles[-1] * GROWTH, angles[-1] + step))
    return angles


def _derivative(model: Kinematics, q: np.ndarray, u: np.ndarray) -> np.ndarray:
    """M with M[i, j] = d(J^T u)_i / dq_j."""
    M = np.empty((len(q), len(q)))
    for j, away in enumerate(DIFFERENCE * np.eye(len(q))):
        M[:, j] = (model.jacobian(q + away) - model.jacobian(q - away)).T @ u / (2.0 * DIFFERENCE)
    return M
