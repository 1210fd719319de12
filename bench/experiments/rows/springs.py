"""Rows of rotational springs: stiffness felt, work over closed ways, places where they vanish, balance of energy.

The turn left is X = exp([phi]x) in the goal's axes. A closed way is phi(s) = a cos s + b sin s + c sin 2s with the rate
in the tool's axes in closed form, omega = J_r(phi) phi', so that the trapezoid of moment . omega over s converges
faster than any power of the step: what is left of a potential's work is rounding.
"""

import math
from collections.abc import Callable

import numpy as np
import pandas as pd
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

from bench.contenders.registry import known_springs
from bench.law.spring import Spring
from bench.tables.schema import TABLES
from tasks.rotations import columns

STIFFNESSES = (30.0, 10.0, 3.0)
"""Eigenvalues of K [N m/rad]; its axes are drawn."""
LOOPS, POINTS, WIDTH = 10, 240, 1.2
"""Closed ways; points of each, so many that twice as many change nothing; greatest |a|, |b| and |c| [rad]."""
STEP = 1e-5
INERTIA, DAMPING, LENGTH_S = np.array([0.5, 1.0, 2.0]), 1.0, 4.0
"""Of the motion whose energy is balanced: principal moments [kg m^2], N m s/rad, s."""
VANISHED = 1e-9

Moment = Callable[[np.ndarray], np.ndarray]
"""moment(q) of the turn left -> in the tool's axes [N m]."""


def frame(seed: int) -> pd.DataFrame:
    """A row a spring and frame of its moment."""
    rng = np.random.default_rng((seed, 11))
    axes = Rotation.random(rng=rng).as_matrix()
    K = axes @ np.diag(STIFFNESSES) @ axes.T
    ways = rng.uniform(-WIDTH, WIDTH, (LOOPS, 3, 3)) / math.sqrt(3.0)
    found = []
    for spring in known_springs().values():
        for name in spring.frames:
            moment, alike = in_tool(spring, name, K), in_tool(spring, name, STIFFNESSES[1] * np.eye(3))
            found.append(
                {
                    "spring": spring.name,
                    "frame": name,
                    "potential": "yes" if spring.potential else "no",
                    **dict(zip(("felt_least", "felt_most"), felt(moment, K), strict=True)),
                    "work_share": work(moment, ways, max(STIFFNESSES)),
                    "work_share_isotropic": work(alike, ways, STIFFNESSES[1]),
                    "loops": LOOPS,
                    "vanishes": sum(np.linalg.norm(moment(half_turn(k))) < VANISHED for k in axes.T),
                    "balance_share": balance(spring, moment, K),
                }
            )
    return pd.DataFrame(found, columns=TABLES["springs"].names)


def in_tool(spring: Spring, name: str, K: np.ndarray) -> Moment:
    """The moment in the tool's axes: as it is, or turned there from the goal's."""
    by_rows = tuple(map(tuple, K.tolist()))

    def moment(q: np.ndarray) -> np.ndarray:
        given = np.array(spring.moment(tuple(q.tolist()), by_rows))
        return given if name == "tool" else np.array(columns(tuple(q.tolist()))) @ given

    return moment


def felt(moment: Moment, K: np.ndarray) -> tuple[float, float]:
    """Least and greatest stiffness at the goal over that of K, over K's axes, by central differences."""
    ratios = []
    for k, e in eigenpairs(K):
        ahead, behind = (moment(turn(sign * STEP * e)) for sign in (1.0, -1.0))
        ratios.append(float(-(ahead - behind) @ e / (2.0 * STEP) / k))
    return min(ratios), max(ratios)


def eigenpairs(K: np.ndarray):
    """(eigenvalue, eigenvector) of a symmetric matrix."""
    values, vectors = np.linalg.eigh(K)
    return list(zip(values.tolist(), vectors.T, strict=True))


def turn(phi: np.ndarray) -> np.ndarray:
    """The unit quaternion (w, x, y, z) of a rotation vector, w >= 0."""
    return Rotation.from_rotvec(phi).as_quat(canonical=True, scalar_first=True)


def half_turn(k: np.ndarray) -> np.ndarray:
    """The quaternion of 180 degrees about an axis, exactly."""
    return np.concatenate(([0.0], k))


def work(moment: Moment, ways: np.ndarray, stiffness: float, points: int = POINTS) -> float:
    """Largest |work| over the closed ways, over what the stiffness stores at the angle that is furthest on the way."""
    s = np.linspace(0.0, 2.0 * math.pi, points, endpoint=False)
    shares = []
    for a, b, c in ways:
        phi = np.outer(np.cos(s), a) + np.outer(np.sin(s), b) + np.outer(np.sin(2.0 * s), c)
        rate = -np.outer(np.sin(s), a) + np.outer(np.cos(s), b) + 2.0 * np.outer(np.cos(2.0 * s), c)
        omega = np.array([right_jacobian(p) @ r for p, r in zip(phi, rate, strict=True)])
        power = [moment(turn(p)) @ w for p, w in zip(phi, omega, strict=True)]
        stored = 0.5 * stiffness * float(np.max(np.sum(phi * phi, axis=1)))
        shares.append(abs(math.fsum(power)) * 2.0 * math.pi / points / stored)
    return max(shares)


def right_jacobian(phi: np.ndarray) -> np.ndarray:
    """J_r: omega = J_r phi' in the tool's axes, I - (1 - cos)/theta^2 [phi]x + (theta - sin)/theta^3 [phi]x^2."""
    theta = float(np.linalg.norm(phi))
    x, y, z = phi
    skew = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    first = 0.5 * np.sinc(0.5 * theta / math.pi) ** 2
    second = (theta - math.sin(theta)) / theta**3 if theta > 1e-2 else 1.0 / 6.0 - theta**2 / 120.0
    return np.eye(3) - first * skew + second * skew @ skew


def balance(spring: Spring, moment: Moment, K: np.ndarray) -> float:
    """Largest change of kinetic + stored + dissipated energy over the motion, over the energy at its start.

    A body of uneven inertia is let go; of a spring without a potential, stored is what its moment took on the way.
    """
    by_rows = tuple(map(tuple, K.tolist()))

    def stored(q) -> float:
        return float(spring.potential(tuple(q.tolist()), by_rows)) if spring.potential else 0.0

    def rate(_, state):
        q, W = state[:4], state[4:7]
        near = q / np.linalg.norm(q)
        m = moment(near if near[0] >= 0.0 else -near)
        spun = 0.5 * np.concatenate(([-q[1:] @ W], q[0] * W + np.cross(q[1:], W)))
        turned = (m - DAMPING * W - np.cross(W, INERTIA * W)) / INERTIA
        return np.concatenate((spun, turned, [DAMPING * W @ W, -m @ W]))

    begun = np.concatenate((turn(np.array([1.0, -0.8, 0.6])), [0.5, 0.0, -0.5], [0.0, 0.0]))
    run = solve_ivp(rate, (0.0, LENGTH_S), begun, method="DOP853", rtol=1e-11, atol=1e-12)
    q, W = run.y[:4] / np.linalg.norm(run.y[:4], axis=0), run.y[4:7]
    q = np.where(q[0] < 0.0, -q, q)
    kinetic = 0.5 * np.sum(INERTIA[:, None] * W * W, axis=0)
    held = np.array([stored(one) for one in q.T]) if spring.potential else run.y[8]
    total = kinetic + held + run.y[7]
    scale = kinetic[0] + (held[0] if spring.potential else 0.5 * max(STIFFNESSES) * 2.0)
    return float(np.max(np.abs(total - total[0])) / scale)
