"""Rotational springs with a stiffness matrix: stiffness felt, work over closed paths, and the balance of energy.

The remaining rotation is X = exp([phi]x) in the goal's axes. A closed path is phi(s) = a cos s + b sin s + c sin 2s
with the rate in the tool's axes in closed form, omega = J_r(phi) phi', so that the trapezoid of moment . omega over s
converges faster than any power of the step: what is left of a potential's work is rounding.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from bench.base.on_first_use import ScipyRotation
from bench.experiments.experiment import Experiment, Unit
from bench.experiments.request import Request
from bench.law.contenders.registry import contenders
from tasks.rotations import columns as columns_of

if TYPE_CHECKING:
    from bench.law.kinds import Spring

STIFFNESSES = (30.0, 10.0, 3.0)
"""Eigenvalues of K [N m/rad]; its axes are drawn."""
LOOPS, POINTS, WIDTH = 10, 240, 1.2
"""Closed paths; points of each, so many that twice as many change nothing; greatest |a|, |b| and |c| [rad]."""
STEP = 1e-5
INERTIA, DAMPING, LENGTH_S = np.array([0.5, 1.0, 2.0]), 1.0, 4.0
"""The motion whose energy is balanced: principal moments [kg m^2], N m s/rad, s."""
VANISHED = 1e-9

Moment = Callable[[np.ndarray], np.ndarray]
"""moment(q) of the remaining rotation -> in the tool's axes [N m]."""

SPRINGS = tuple(contenders("springs").values())


def units(request: Request) -> tuple[Unit, ...]:
    """Return one unit."""
    return (Unit("springs", count=len(SPRINGS), total=len(SPRINGS), horizon_s=2.0),)


def rows(request: Request, unit: Unit) -> list[dict]:
    """Return a row a spring and frame of its moment."""
    rng = np.random.default_rng((request.seed, 11))
    axes = ScipyRotation.random(rng=rng).as_matrix()
    K = axes @ np.diag(STIFFNESSES) @ axes.T
    paths = rng.uniform(-WIDTH, WIDTH, (LOOPS, 3, 3)) / math.sqrt(3.0)
    found = []
    for spring in SPRINGS:
        for frame in spring.frames:
            moment, alike = in_tool(spring, frame, K), in_tool(spring, frame, STIFFNESSES[1] * np.eye(3))
            least, most = compute_felt_stiffness(moment, K)
            found.append(
                {
                    "spring": spring.name,
                    "frame": frame,
                    "potential": "yes" if spring.potential else "no",
                    "felt_least": least,
                    "felt_most": most,
                    "work_share": compute_work(moment, paths, max(STIFFNESSES)),
                    "work_share_isotropic": compute_work(alike, paths, STIFFNESSES[1]),
                    "loops": LOOPS,
                    "vanishes": sum(np.linalg.norm(moment(np.concatenate(([0.0], k)))) < VANISHED for k in axes.T),
                    "balance_share": compute_energy_error(spring, moment, K),
                }
            )
    return found


def in_tool(spring: Spring, name: str, K: np.ndarray) -> Moment:
    """Return the moment in the tool's axes: as it is, or turned there from the goal's."""
    by_rows = tuple(map(tuple, K.tolist()))

    def moment(q: np.ndarray) -> np.ndarray:
        given = np.array(spring.moment(tuple(q.tolist()), by_rows))
        return given if name == "tool" else np.array(columns_of(tuple(q.tolist()))) @ given

    return moment


def compute_felt_stiffness(moment: Moment, K: np.ndarray) -> tuple[float, float]:
    """Compute least and greatest stiffness at the goal over that of K, over K's axes, by central differences."""
    ratios, (values, vectors) = [], np.linalg.eigh(K)
    for k, e in zip(values.tolist(), vectors.T, strict=True):
        ahead, behind = (moment(turn(sign * STEP * e)) for sign in (1.0, -1.0))
        ratios.append(float(-(ahead - behind) @ e / (2.0 * STEP) / k))
    return min(ratios), max(ratios)


def turn(phi: np.ndarray) -> np.ndarray:
    """Return the unit quaternion (w, x, y, z) of a rotation vector, w >= 0."""
    return ScipyRotation.from_rotvec(phi).as_quat(canonical=True, scalar_first=True)


def compute_work(moment: Moment, paths: np.ndarray, stiffness: float, points: int = POINTS) -> float:
    """Compute the largest |work| on paths a cos s + b sin s + c sin 2s, over what is stored at the furthest angle."""
    s = np.linspace(0.0, 2.0 * math.pi, points, endpoint=False)
    shares = []
    for a, b, c in paths:
        phi = np.outer(np.cos(s), a) + np.outer(np.sin(s), b) + np.outer(np.sin(2.0 * s), c)
        rate = -np.outer(np.sin(s), a) + np.outer(np.cos(s), b) + 2.0 * np.outer(np.cos(2.0 * s), c)
        omega = np.array([right_jacobian(p) @ r for p, r in zip(phi, rate, strict=True)])
        power = [moment(turn(p)) @ w for p, w in zip(phi, omega, strict=True)]
        stored = 0.5 * stiffness * float(np.max(np.sum(phi * phi, axis=1)))
        shares.append(abs(math.fsum(power)) * 2.0 * math.pi / points / stored)
    return max(shares)


def right_jacobian(phi: np.ndarray) -> np.ndarray:
    """Compute J_r = I - (1 - cos)/theta^2 [phi]x + (theta - sin)/theta^3 [phi]x^2, with omega = J_r phi'."""
    theta = float(np.linalg.norm(phi))
    x, y, z = phi
    skew = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    first = 0.5 * np.sinc(0.5 * theta / math.pi) ** 2
    second = (theta - math.sin(theta)) / theta**3 if theta > 1e-2 else 1.0 / 6.0 - theta**2 / 120.0
    return np.eye(3) - first * skew + second * skew @ skew


def compute_energy_error(spring: Spring, moment: Moment, K: np.ndarray) -> float:
    """Compute the largest change of kinetic + stored + dissipated energy over a motion, over the energy at its start.

    The body has an uneven inertia; for a spring without a potential, stored is the work that its moment took.
    """
    from scipy.integrate import solve_ivp

    by_rows = tuple(map(tuple, K.tolist()))

    def stored(q: np.ndarray) -> float:
        return float(spring.potential(tuple(q.tolist()), by_rows)) if spring.potential else 0.0

    def rate(_: float, state: np.ndarray) -> np.ndarray:
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


EXPERIMENT = Experiment.of(
    globals(),
    "rotational springs with a stiffness matrix",
    cost_s=lambda unit: 1.0,
    compiles=False,
)
