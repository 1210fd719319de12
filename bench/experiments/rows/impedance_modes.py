"""Modes of impedances that shape no inertia, from one tick of the loop about the goal.

    (q, qdot) -> (q, qdot) one tick later, by central differences          qdot+ = qdot - dt (X q + Y qdot)
    P = J X J^+ = Lambda^-1 K,  Q = J Y J^+ = Lambda^-1 D                  as the hand sees it

P phi = omega^2 phi; with psi the left eigenvector the mode's damping ratio is psi Q phi/(2 omega psi phi). The tick's
map of the hand is [[I - dt^2 P, dt (I - dt Q)], [-dt P, I - dt Q]], MuJoCo's rates first.
"""

import numpy as np
import pandas as pd

import tasks
from bench.contenders.registry import find_contender, known_dampings
from bench.engines.plants.impedance import Springs
from bench.engines.simulate_arms import run_impedance as run
from bench.experiments.experiment import Settings, Unit
from bench.experiments.impedance import LAW, STIFFNESSES, ZETA, Stiffness
from bench.experiments.rows.impedance import what
from bench.tables.schema import TABLES
from tasks.kinematics import kinematics

STEP = 1e-4
"""Of the differences [rad, rad/s]: they err by its square, 1e-8, and by rounding over it and the tick, 1e-9."""


def frame(settings: Settings, unit: Unit) -> pd.DataFrame:
    """The rows of a unit."""
    made = [pd.DataFrame(_modes(settings, unit, stiffness)) for stiffness in STIFFNESSES]
    return pd.concat(made, ignore_index=True)[TABLES["impedance-modes"].names]


def _modes(settings: Settings, unit: Unit, stiffness: Stiffness) -> dict:
    P, Q = hand_matrices(settings, unit, stiffness)
    omega, ratio = modes(P, Q)
    poles = np.linalg.eigvals(sampled(P, Q, settings.dt_s))
    radius = float(np.abs(poles).max())
    return {
        **what(unit, stiffness),
        "dt_s": settings.dt_s,
        "mode": np.arange(1, 1 + len(omega)),
        "omega": omega,
        "ratio": ratio,
        "decay": -np.log(radius) / settings.dt_s,
        "radius": radius,
    }


def hand_matrices(settings: Settings, unit: Unit, stiffness: Stiffness) -> tuple[np.ndarray, np.ndarray]:
    """P [1/s^2] and Q [1/s], 6 x 6, at the arm's home."""
    arm = tasks.arm(unit.arm)
    judge, n, dt = kinematics(arm), arm.joints, settings.dt_s
    p, quat = judge.pose(arm.home)
    offsets = STEP * np.vstack((np.eye(2 * n), -np.eye(2 * n)))
    states = np.hstack((arm.home, np.zeros(n))) + offsets
    begun = [judge.start("", one[:n], quat, one[n:], goal_p=tuple(p.tolist())) for one in states]
    limits = settings.limits(dt)._replace(ticks=1)
    _, ends = run(
        find_contender(LAW), known_dampings()[unit.selector], Springs(*stiffness, ZETA, 0), begun, limits, unit.arm
    )
    tick = (ends[: 2 * n] - ends[2 * n :]).T / (2.0 * STEP)
    J = judge.jacobian(arm.home)
    J_inverse = np.linalg.pinv(J)
    X, Y = -tick[n:, :n] / dt, (np.eye(n) - tick[n:, n:]) / dt
    return J @ X @ J_inverse, J @ Y @ J_inverse


def modes(P: np.ndarray, Q: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Natural frequencies [1/s] in ascending order, and their damping ratios."""
    squares, phi = np.linalg.eig(P)
    order = np.argsort(squares.real)
    omega, phi = np.sqrt(squares.real[order]), phi.real[:, order]
    psi = np.linalg.inv(phi)
    return omega, np.diag(psi @ Q @ phi) / (2.0 * omega)


def sampled(P: np.ndarray, Q: np.ndarray, dt: float) -> np.ndarray:
    """The map of the hand's place and rate over one tick, 12 x 12."""
    after = np.eye(6) - dt * Q
    return np.block([[np.eye(6) - dt * dt * P, dt * after], [-dt * P, after]])
