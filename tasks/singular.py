"""Kinematic singularities of an arm: found near given joint angles, passed through, and passed at a distance.

Where rank J = 5 there is a twist u (6 numbers, |u| = 1, metres and radians) that no joint rates give the tool: J^T u =
0. The distance of J from the nearest singular matrix is its smallest singular value sigma_min (Eckart and Young), so
"at 10^-k from the singularity" says sigma_min = 10^-k, on any arm.

    through:  qdot = J^+ v + lambda w is the rate at which a turn v = (0, axis), v . u = 0, passes: of the null vectors
              w the one, and of lambda the values, for which u . Jdot qdot = 0, so that the joints stay smooth
    past:     the turn about the lost axis itself, u's rotational part; joint rates reach 1/sigma_min there

Derivatives of J are centred differences over 2e-6 rad: right to 1e-10, and Newton's method forgives that.

Limitations: None where Newton's method does not converge, or the singularity is not of this kind (two twists lost at
once, or a turn that cannot pass: lambda complex).
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from tasks.base import Vector
from tasks.kinematics import Kinematics
from tasks.linear_algebra import largest, least_norm, length, of_lost_rank, product, smallest, transposed_product, unit
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
    still: np.ndarray  # n x n: projects joint rates onto those that leave the tool where it is, 1 - J^+ J
    M: np.ndarray  # n x n: u . Jdot qdot = qdot . M qdot


def singularity_near(model: Kinematics, q: np.ndarray) -> Singularity | None:
    """Newton's method, steps of least norm, on J(q)^T u = 0 and |u| = 1."""
    q = np.array(q, dtype=float)
    _, u = smallest(model.jacobian(q))
    n = len(q)
    A = np.zeros((n + 1, n + 6))
    for _ in range(NEWTON_STEPS):
        J = model.jacobian(q)
        residual = np.append(transposed_product(J, u), 0.5 * (length(u) ** 2 - 1.0))
        M = _derivative(model, q, u)
        if abs(residual).max() < SINGULAR:
            s = np.linalg.svd(J, compute_uv=False)
            if not s[4] > 1e-2 * s[0]:  # more than one twist is lost; a bound that no rounding comes near
                return None
            return Singularity(q, u, np.eye(n) - np.array([of_lost_rank(J, u, column) for column in J.T]), M)
        A[:n, :n], A[:n, n:], A[n, n:] = M, J.T, u
        step = least_norm(A, -residual)
        if step is None:
            return None
        step *= min(1.0, LARGEST_STEP / abs(step).max())
        q += step[:n]
        u = u + step[n:]
    return None


def rates_through(model: Kinematics, at: Singularity, axis: Vector) -> list[np.ndarray]:
    """Return the joint rates (0 to 2 of them) at which a turn about `axis` passes smoothly through a singularity."""
    least = of_lost_rank(model.jacobian(at.q), at.u, np.array((0.0, 0.0, 0.0, *axis)))
    slope = product(at.still, product(at.M + at.M.T, least))
    b = length(slope)
    if b < 1e-6:
        return []
    w = slope / b
    a, c = _form(at.M, w), _form(at.M, least)
    root = b * b - 4.0 * a * c
    if root < 0.0:
        return []
    # the roots of a x^2 + b x + c without cancellation; a may be zero
    far = -0.5 * (b + math.sqrt(root))
    return [least + x * w for x in ([c / far] + ([far / a] if abs(a) > 1e-9 else []))]


def path_from(
    model: Kinematics, at: Singularity, axis: Vector, rates: np.ndarray, angles: list[float]
) -> np.ndarray | None:
    """Return the joint path out of a singularity along a turn about `axis` by these angles [rad], or None."""
    p, quat = model.pose(at.q)
    begin = math.copysign(BEGIN, angles[-1])
    guess = at.q + begin * rates
    q = model.reach(guess, p, turned(quat, axis, begin))
    if q is None or length(q - guess) > 0.5 * BEGIN * length(rates):
        return None
    return model.follow(q, [turned(quat, axis, angle) for angle in angles])


def beside(model: Kinematics, at: Singularity, distance: float) -> tuple[np.ndarray, Vector] | None:
    """Joint angles with sigma_min = distance, and the axis, of unit length, about which the tool can hardly turn."""
    # the rates at which J leaves the singular matrices fastest: d(sigma_min) = |(1 - J^+ J) M dq|
    w = largest(np.array([product(at.still, column) for column in at.M.T]).T)
    t = distance
    for _ in range(20):
        sigma, u = smallest(model.jacobian(at.q + t * w))
        if abs(sigma - distance) < 1e-6 * distance:
            x, y, z = unit(u[3:]).tolist()
            return at.q + t * w, (x, y, z)
        t *= distance / sigma
    return None


def widening(distance: float, half: float, step: float) -> list[float]:
    """Angles [rad] from FIRST distance to `half`, at first in ratio GROWTH, then at most `step` apart."""
    angles = [FIRST * distance]
    while angles[-1] < half:
        angles.append(min(half, angles[-1] * GROWTH, angles[-1] + step))
    return angles


def _form(M: np.ndarray, v: np.ndarray) -> float:
    """v . M v."""
    return float(product(v[None, :], product(M, v))[0])


def _derivative(model: Kinematics, q: np.ndarray, u: np.ndarray) -> np.ndarray:
    """M with M[i, j] = d(J^T u)_i / dq_j."""
    M = np.empty((len(q), len(q)))
    for j, away in enumerate(DIFFERENCE * np.eye(len(q))):
        M[:, j] = transposed_product(model.jacobian(q + away) - model.jacobian(q - away), u) / (2.0 * DIFFERENCE)
    return M
