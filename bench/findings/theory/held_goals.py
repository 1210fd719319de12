"""Which goals the linearized law holds if the goal's angles are subtracted: u = P (Kp (E_d - E) - Kd Edot).

Near the goal e = E - E_d obeys e'' = -M (Kp e + Kd e'), M = B(E_d)^-1 P (Murphy 1988, 2.8, 2.14). Its alpha decays by
independently; beta and gamma have T = trace and D = determinant of their block of M, cos(alpha_d) (1 + s) and s, s =
1/cos(beta_d), and the polynomial x^4 + T Kd x^3 + (T Kp + D Kd^2) x^2 + 2 D Kd Kp x + D Kp^2. By Routh and Hurwitz all
its roots decay where T > 0 and T^2 Kp + 2 T D Kd^2 > 4 D Kp. gamma_d does not matter.
"""

import math
from collections.abc import Callable

import numpy as np

from bench.findings.theory.bisection import bisect
from bench.law.inputs import AT_REST, Gains, Goal
from bench.law.so3 import Rotation, from_quaternion

BISECTIONS = 40
"""Halvings of an angle up to pi: to 3e-12 rad."""

DIFFERENCE = 1e-5
"""Step of central differences [rad, rad/s]: they err by its square, 1e-10 of Kp, and by rounding of as much."""


def least_cosine(beta: float | np.ndarray, gains: Gains) -> float | np.ndarray:
    """cos(alpha_d) above which a goal with this beta_d is held."""
    s, ratio = 1.0 / np.cos(beta), gains.kv**2 / gains.kp
    # of T^2 + 2 ratio s T - 4 s the root that is positive, over 1 + s
    return (np.sqrt((ratio * s) ** 2 + 4.0 * s) - ratio * s) / (1.0 + s)


def held_share(gains: Gains, points: int = 100_000) -> float:
    """Share of all goals that are held: of random orientations alpha and sin(beta) are uniform."""
    middle = (2.0 * np.arange(points) + 1.0) / points - 1.0
    return float(np.mean(np.arccos(least_cosine(np.arcsin(middle), gains))) / math.pi)


def growth(law: Callable, R_d: Rotation, gains: Gains) -> float:
    """Largest real part of the eigenvalues of the closed loop about a goal [1/s]; above 0 the goal is not held.

    Args:
        law: law(R, omega, goal, gains), differentiated numerically by the rotation vector from the goal and by omega.
    """
    rows = np.zeros((6, 6))
    rows[:3, 3:] = np.eye(3)
    for i in range(3):
        step = DIFFERENCE * np.eye(3)[i]
        for column, at in ((i, lambda x: (_turned(R_d, x), AT_REST)), (3 + i, lambda x: (R_d, tuple(x)))):
            up, down = (np.array(law(*at(sign * step), Goal(R_d), gains)) for sign in (1.0, -1.0))
            rows[3:, column] = (up - down) / (2.0 * DIFFERENCE)
    return float(np.linalg.eigvals(rows).real.max())


def _turned(R: Rotation, turn: np.ndarray) -> Rotation:
    """exp([turn]x) R of a small turn."""
    angle = float(np.linalg.norm(turn))
    by = np.array(from_quaternion((math.cos(angle / 2.0), *(math.sin(angle / 2.0) * turn / angle).tolist()))).T
    return Rotation(*(tuple(float(x) for x in by @ np.array(column)) for column in R))


def held_to(law: Callable, axis: np.ndarray, gains: Gains, scan_rad: float = math.radians(2.5)) -> float:
    """Angle [rad] of the first goal along an axis from the identity that is not held, bisected; pi if all are."""

    def is_held(angle: float) -> bool:
        goal = from_quaternion((math.cos(angle / 2.0), *(math.sin(angle / 2.0) * np.asarray(axis)).tolist()))
        return growth(law, goal, gains) < 0.0

    angles = np.arange(scan_rad, math.pi, scan_rad)
    first = next((i for i, angle in enumerate(angles) if not is_held(angle)), None)
    if first is None:
        return math.pi
    return bisect(is_held, float(angles[first] - scan_rad), float(angles[first]), BISECTIONS)[1]
