"""Which goals the linearized law holds if the goal's angles are subtracted: u = P (Kp (E_d - E) - Kd Edot).

Near the goal e = E - E_d obeys e'' = -M (Kp e + Kd e'), M = B(E_d)^-1 P (Murphy 1988, 2.8, 2.14). Its alpha decays
on its own; beta and gamma have T = trace and D = determinant of their block of M, cos(alpha_d) (1 + s) and s, s =
1/cos(beta_d), and the polynomial x^4 + T Kd x^3 + (T Kp + D Kd^2) x^2 + 2 D Kd Kp x + D Kp^2. By Routh and Hurwitz all
its roots decay where T > 0 and T^2 Kp + 2 T D Kd^2 > 4 D Kp. gamma_d does not matter.
"""

import math

import numpy as np

from bench.law.inputs import Gains


def least_cosine(beta: float | np.ndarray, gains: Gains) -> float | np.ndarray:
    """cos(alpha_d) above which a goal with this beta_d is held."""
    s, ratio = 1.0 / np.cos(beta), gains.kv**2 / gains.kp
    # of T^2 + 2 ratio s T - 4 s the root that is positive, over 1 + s
    return (np.sqrt((ratio * s) ** 2 + 4.0 * s) - ratio * s) / (1.0 + s)


def held_share(gains: Gains, points: int = 100_000) -> float:
    """Share of all goals that are held: of random orientations alpha and sin(beta) are uniform."""
    middle = (2.0 * np.arange(points) + 1.0) / points - 1.0
    return float(np.mean(np.arccos(least_cosine(np.arcsin(middle), gains))) / math.pi)
